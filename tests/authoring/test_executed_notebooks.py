"""Only what changed is run again, and what is not run shows what a run would show."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from autograder.authoring import build
from autograder.authoring.build import build_solved_notebooks, write

KITCHEN = "notebooks/source/1_kitchen.py"


@pytest.fixture
def runs(toy, monkeypatch):
    """Build the toy course; the result tells which notebooks ran. Running itself is made up."""

    def execute(notebook, course, stem):
        for count, cell in enumerate(
            (cell for cell in notebook.cells if cell.cell_type == "code"), 1
        ):
            cell.execution_count = count
            cell.outputs = [
                build.nbformat.v4.new_output("stream", text=f"{stem} has run {cell.source}")
            ]

    monkeypatch.setattr(build, "run_solved_notebook", execute)

    def built() -> list[str]:
        ran: list[str] = []
        write(build_solved_notebooks(toy.load(), ran.append))
        return ran

    assert built() == ["1_kitchen", "2_cellar"]
    return built


def outputs(root: Path, stem: str) -> str:
    cells = json.loads((root / f"solutions/notebooks/{stem}.ipynb").read_text())["cells"]
    return json.dumps([cell["outputs"] for cell in cells if cell["cell_type"] == "code"])


def test_nothing_runs_twice(runs):
    assert runs() == []


def test_prose_changes_without_a_run_and_keeps_the_outputs(runs, toy):
    before = outputs(toy.root, "1_kitchen")
    toy.replace(KITCHEN, "Now some numbers.", "Now some other numbers.")
    assert runs() == []
    text = (toy.root / "solutions/notebooks/1_kitchen.ipynb").read_text()
    assert "some other numbers" in text
    assert outputs(toy.root, "1_kitchen") == before


# What is changed, and which notebooks that concerns.
CHANGES = {
    "code in a master": (KITCHEN, "import numpy as np", "import numpy", ["1_kitchen"]),
    "a prompt": ("notebooks/questions/cellar.toml", "Two of six", "2 of 6", ["2_cellar"]),
    "the key": ("solutions/answers/cellar.toml", '"A third."', '"One third."', ["2_cellar"]),
    "a mistake": ("solutions/kitchen.py", "np.median", "1 * np.median", ["1_kitchen"]),
}


@pytest.mark.parametrize("name", CHANGES)
def test_a_change_runs_the_notebooks_that_it_concerns(name, runs, toy):
    file, old, new, expected = CHANGES[name]
    toy.replace(file, old, new)
    assert runs() == expected
    assert runs() == []


@pytest.mark.parametrize("file", ["data/new.csv", "notebooks/figures.py"])
def test_what_all_notebooks_may_import_runs_all(file, runs, toy):
    (toy.root / file).parent.mkdir(exist_ok=True)
    (toy.root / file).write_text("")
    assert runs() == ["1_kitchen", "2_cellar"]


def test_outputs_that_somebody_changed_are_made_again(runs, toy):
    path = toy.root / "solutions/notebooks/2_cellar.ipynb"
    before = path.read_text()
    path.write_text(before.replace("has run", "has never run"))
    assert runs() == ["2_cellar"]
    assert path.read_text() == before


@pytest.mark.parametrize("text", ["", "[]", '{"1_kitchen": 3}', "{"])
def test_a_damaged_memory_only_costs_time(text, runs, toy):
    (toy.root / ".build_cache/executed.json").write_text(text)
    assert "1_kitchen" in runs()
