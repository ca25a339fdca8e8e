"""The chapter whose numbers vary, run with those of three students: solved, and blank."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import nbformat
import pytest

from autograder import me
from autograder.authoring.build import build_student_notebooks, unexecuted_solved_notebooks
from autograder.course import Course, load_course
from autograder.course.placeholders import value_of

ROOT = Path(__file__).parents[2]
NAMES = ("boole", "kepler", "hopper")
CHAPTER = "3_ransac"
# Cells are run that import or mention one of these names; the others do not know the numbers.
TOUCHES = re.compile(
    r"\bimport\b|\bnumbers\(|\b[Nwp]\b|predict\(|Q3\.2"
    r"|\b(iterations|outlier_model|candidate_lines|outlier_after_42|success_after_100)\b"
    r"|\bplane_iterations\b"
)
# They take long, and what they do with the numbers is what others do.
LONG = re.compile(
    r"\b(def|explore_\w+|stopping|noisy_inliers|found_line|walls_of_scan|corridor_walls)\b"
)


@pytest.fixture
def personal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    """The course with numbers of everybody's own."""
    for name in ("data", "notebooks", "solutions"):
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / "pyproject.toml").write_text('[tool.autograder]\nvariants = "student"\n')
    monkeypatch.setenv("AUTOGRADER_COURSE", str(tmp_path))
    monkeypatch.setenv("AUTOGRADER_RESPONSES", str(tmp_path / "responses"))
    monkeypatch.setattr("autograder.student.frontend.widgets_wanted", lambda: False)
    monkeypatch.setattr(plt, "show", lambda: None)
    return load_course(tmp_path)


def cells_to_run(built: Any) -> Iterator[str]:
    text = next(one.text for one in built if one.path.stem == CHAPTER)
    cells = nbformat.reads(text, 4).cells
    code = [cell for cell in cells if cell.cell_type == "code"]
    for cell in code:
        known = TOUCHES.search(cell.source)
        if known and (known[0] == "import" or not LONG.search(cell.source)):
            yield cell.source


def run(cells: Iterator[str]) -> tuple[dict[str, Any], list[str]]:
    space: dict[str, Any] = {}
    done = []
    for source in cells:
        exec(compile(source, CHAPTER, "exec"), space)
        plt.close("all")
        done.append(source)
    return space, done


@pytest.mark.parametrize("name", NAMES)
def test_the_chapter_runs_with_other_numbers_and_earns_everything(name, personal, capsys):
    own = personal.for_student(name)
    assert all(variant for id, variant in own.variants.items() if id.startswith("Q3.2"))
    me(name)
    blank, done = run(cells_to_run(build_student_notebooks(personal)))
    assert blank["iterations"] is ...
    assert sum("figures." in source for source in done) >= 4
    space, _ = run(cells_to_run(unexecuted_solved_notebooks(personal)))
    folder = personal.root / "responses"
    kept = json.loads((folder / "ransac.json").read_text())["responses"]
    asked = [id for id in own.varied if id.startswith("Q3.2")]
    assert {id: kept[id]["status"] for id in asked} == dict.fromkeys(asked, "right")
    # By a formula written down here, not by the key's.
    k = "ceil(log(1 - p) / log(1 - w**2))"
    assert space["iterations"] == value_of(k, own.story("cloud"))


def test_the_students_who_are_tried_have_three_variants(personal):
    told = {tuple(personal.for_student(name).story("cloud").values()) for name in NAMES}
    assert len(told | {(1000, 0.2, 0.95)}) == 4


@pytest.mark.parametrize("name", NAMES)
def test_the_examples_worked_by_hand_are_tried_with_the_same_numbers(name, personal, capsys):
    """The first chapter's two: each is said in a prompt, and drawn by a cell with its numbers."""
    me(name)
    own = personal.for_student(name)
    text = next(
        one.text
        for one in unexecuted_solved_notebooks(personal)
        if one.path.stem == "1_place_recognition"
    )
    cells = [cell.source for cell in nbformat.reads(text, 4).cells if cell.cell_type == "code"]
    functions = re.compile(r"\Adef (assign_words|descend_tree)\b", re.MULTILINE)
    space, _ = run(
        cell
        for cell in cells
        if "from autograder import" in cell
        or cell.startswith(("import", "from"))
        or functions.search(cell)
        or "numbers(" in cell
    )
    d, (far, high) = own.story("words")["d"], own.story("tree").values()
    assert space["two"].tolist() == [[0, 0], [d, 0]]
    assert f"$({d - 1}, 1)$" in own.question("Q1.3").prompt
    assert f"The descriptor $({far - 1}, {high})$" in own.question("Q1.4").prompt
    assert space["small_tree"][0].tolist() == [[0, 0], [far, 0]]
    assert personal.question("Q1.4").prompt != own.question("Q1.4").prompt or (far, high) == (10, 1)
