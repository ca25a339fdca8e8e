"""Masters become notebooks: stubs for students, answers in the solved ones, ids that stay."""

import json
from pathlib import Path
from typing import Any

import pytest
from nbformat import NotebookNode

from autograder.authoring.build import (
    build_solved_notebooks,
    build_student_notebooks,
    stale_notebooks,
    write,
)
from autograder.authoring.masters import read_masters
from autograder.authoring.raising_cells import raised
from autograder.cli import main
from autograder.errors import CourseError

MASTER = "notebooks/source/1_kitchen.py"
STUDENT = "notebooks/1_kitchen.ipynb"
SOLVED = "solutions/notebooks/1_kitchen.ipynb"


def cells(path: Path) -> dict[str, str]:
    """Sources by cell id."""
    notebook = json.loads(path.read_text(encoding="utf-8"))
    return {cell["id"]: "".join(cell["source"]) for cell in notebook["cells"]}


def change(path: Path, edit: Any) -> None:
    notebook = json.loads(path.read_text(encoding="utf-8"))
    edit(notebook)
    path.write_text(json.dumps(notebook, indent=1) + "\n", encoding="utf-8")


def stale(toy) -> list[str]:
    return [str(path.relative_to(toy.root)) for path in stale_notebooks(toy.load())]


@pytest.fixture
def built(toy):
    """The toy course with its notebooks, the solved ones not run."""
    toy.write_notebooks()
    return toy


def test_each_kind_of_exercise_has_its_stub(built):
    sources = cells(built.root / STUDENT)
    assert sources["Q1-1-response"] == 'ask("Q1.1")'
    assert sources["Q1-2-response"] == 'ask("Q1.2")'
    assert sources["Q1-3-response"] == "eggs = ..."
    assert sources["Q1-4-response"] == "rim = ..."
    assert sources["Q1-5-response"] == (
        "def mean_weight(weights):\n"
        '    """Return the mean of `weights`, a list of numbers in grams; 0 for none."""\n'
        "    raise NotImplementedError"
    )
    assert sources["Q1-3-check"] == 'check("Q1.3", eggs)'
    assert "Q1-1-check" not in sources


def test_the_solved_notebook_differs_in_the_responses_only(built):
    student, solved = cells(built.root / STUDENT), cells(built.root / SOLVED)
    assert student.keys() == solved.keys()
    differing = {id for id in student if student[id] != solved[id]}
    assert differing == {f"Q1-{n}-response" for n in range(1, 6)}
    assert solved["Q1-1-response"] == 'ask("Q1.1").respond([True, False, True])'
    order = solved["Q1-2-response"].partition("respond(")[2].removesuffix(")")
    assert json.loads(order) == ["cup", "boil", "stir", "pour", "stir_again", "drink"]
    assert solved["Q1-3-response"] == "eggs = 3 * 4"
    assert solved["Q1-5-response"].endswith("    return total / len(weights)")


def test_the_heading_holds_title_points_prompt_and_symbols(built):
    heading = cells(built.root / STUDENT)["Q1-4-question"]
    for part in ("### Q1.4 · A tray", "*4 points*", "How long is the rim", "| `a` | one side |"):
        assert part in heading
    assert "*1 point*" in cells(built.root / "notebooks/2_cellar.ipynb")["Q2-1-question"]


def test_hints_stand_in_the_heading_only_where_no_widget_gives_them(built):
    student = cells(built.root / STUDENT)
    assert "<details><summary>Hint 1</summary>" in student["Q1-5-question"]  # a function
    assert "Walk around it." not in student["Q1-4-question"]


def test_building_twice_gives_the_same_bytes(built):
    course = built.load()
    assert build_student_notebooks(course) == build_student_notebooks(built.load())
    assert write(build_student_notebooks(course)) == []


@pytest.mark.parametrize("inserted", ["# %% [markdown]\n# A new thought.\n\n", "# %%\nnew = 1\n\n"])
@pytest.mark.parametrize(
    "before", ["# %% [markdown]\n# # The", '# %% exercise="Q1.3"', "# %%\na, b"]
)
def test_all_ids_stay_when_a_cell_is_inserted(built, inserted, before):
    old = cells(built.root / STUDENT)
    built.replace(MASTER, before, inserted + before)
    built.write_notebooks()
    new = cells(built.root / STUDENT)
    assert {id: new.get(id) for id in old} == old
    assert len(new) == len(old) + 1


def test_two_equal_cells_have_different_ids(built):
    built.append(MASTER, "\n# %%\nsame = 1\n\n# %%\nsame = 1\n")
    built.write_notebooks()
    assert list(cells(built.root / STUDENT).values()).count("same = 1") == 2


def test_nothing_is_stale_after_building_whatever_outputs_are_stored(built):
    def execute(notebook):
        for cell in notebook["cells"]:
            if cell["cell_type"] == "code":
                cell["execution_count"] = 3
                cell["outputs"] = [{"output_type": "stream", "name": "stdout", "text": ["12"]}]

    change(built.root / SOLVED, execute)
    assert stale(built) == []


def edited(notebook: dict[str, Any]) -> None:
    notebook["cells"][0]["source"] = ["# Another kitchen"]


def tagged(notebook: dict[str, Any]) -> None:
    notebook["cells"][1]["metadata"] = {"tags": ["mine"]}


def shortened(notebook: dict[str, Any]) -> None:
    del notebook["cells"][2]


def answered(notebook: dict[str, Any]) -> None:
    cell = next(cell for cell in notebook["cells"] if cell["id"] == "Q1-3-response")
    cell["source"] = ["eggs = 13"]


@pytest.mark.parametrize("edit", [edited, tagged, shortened, answered])
@pytest.mark.parametrize("notebook", [STUDENT, SOLVED])
def test_an_edited_notebook_is_stale(built, notebook, edit):
    change(built.root / notebook, edit)
    assert stale(built) == [notebook]


def test_a_student_notebook_with_outputs_is_stale(built):
    def execute(notebook):
        notebook["cells"][1]["execution_count"] = 1

    change(built.root / STUDENT, execute)
    assert stale(built) == [STUDENT]


@pytest.mark.parametrize("notebook", [STUDENT, SOLVED])
def test_a_missing_notebook_is_stale(built, notebook):
    (built.root / notebook).unlink()
    assert stale(built) == [notebook]


@pytest.mark.parametrize("text", ["", "<<<<<<< HEAD\n{}", "[]", "{}", '{"cells": [3]}', "null"])
@pytest.mark.parametrize("notebook", [STUDENT, SOLVED])
def test_a_damaged_notebook_is_stale(built, notebook, text):
    (built.root / notebook).write_text(text)
    assert stale(built) == [notebook]


@pytest.mark.parametrize("folder", ["notebooks", "solutions/notebooks"])
def test_a_notebook_without_a_master_is_stale(built, folder):
    (built.root / folder / "9_attic.ipynb").write_text("{}")
    assert stale(built) == [f"{folder}/9_attic.ipynb"]


def test_an_edited_answer_makes_only_the_solved_notebook_stale(built):
    built.replace("solutions/answers/kitchen.toml", 'code = "3 * 4"', 'code = "4 * 3"')
    assert stale(built) == [SOLVED]


def test_build_check_tells_what_differs_and_writes_nothing(built, capsys):
    command = ["--course", str(built.root), "build", "--check"]
    assert main(command) == 0
    (built.root / STUDENT).unlink()
    assert main(command) == 1
    said = capsys.readouterr().out
    assert f"{STUDENT} differs from what the masters give." in said
    assert "Run `autograder build`" in said
    assert not (built.root / STUDENT).exists()


def test_a_solved_notebook_is_executed_and_keeps_text_but_no_picture(toy):
    (toy.root / MASTER).write_text(
        "# %%\nprint('a shelf')\n\n"
        "# %%\nimport matplotlib.pyplot as plt\n\nplt.plot([1, 2])\nNone\n"
    )
    for file in ("questions", "source"):
        for path in (toy.root / "notebooks" / file).glob("*cellar*"):
            path.unlink()
    (toy.root / "notebooks/questions/kitchen.toml").write_text('title = "The kitchen"\n')
    (toy.root / "solutions/answers/kitchen.toml").write_text("")
    (notebook,) = build_solved_notebooks(toy.load())
    outputs = [cell["outputs"] for cell in json.loads(notebook.text)["cells"]]
    assert outputs[1][0]["text"] == ["a shelf\n"]
    assert "image/png" not in notebook.text


RAISING_CELLS = {
    "x = 1\n1 / 0": r"line 3 raises ZeroDivisionError: division by zero \(1 / 0\)\.",
    "x = 1\nprint(x": r"line 3 raises SyntaxError: .* \(print\(x\)\.",
    "import cheesemaking": (
        r"line 2 raises ModuleNotFoundError: No module named 'cheesemaking' "
        r"\(import cheesemaking\); "
        "install cheesemaking, and name it among the dependencies in pyproject.toml, "
    ),
    "import data.cheese": r"line 2 raises ModuleNotFoundError: No module named 'data.*' \(import",
}


TRACEBACKS = {
    "Cell In[1], line 2\n      1 x = 1\n----> 2 1 / 0": 2,
    "File <ipython-input-1-abc>:2\n": 2,
    "/tmp/ipykernel_54/36.py in <cell line: 0>()\n      1 x = 1\n----> 2 1 / 0\n": 2,
    "/tmp/ipykernel_54/36.py in f()\n      8 x\n---> 12 y\n": 12,
    'File "/tmp/ipykernel_52/23.py", line 2\n    print(x\n': 2,
    "nothing that is known": 1,
}


@pytest.mark.parametrize("traceback", TRACEBACKS)
def test_the_line_is_found_in_what_each_ipython_says(toy, traceback: str):
    master = next(m for m in read_masters(toy.load()) if m.stem == "1_kitchen")
    source = "\n".join(f"x{n} = {n}" for n in range(20))
    error = NotebookNode(output_type="error", ename="_IncompleteInputError", evalue="incomplete")
    error.traceback = [traceback]
    cell = NotebookNode(source=source, outputs=[error])
    number = TRACEBACKS[traceback]
    said = raised(master, cell, None)
    assert said.endswith(f"raises SyntaxError: incomplete (x{number - 1} = {number - 1}).")


@pytest.mark.parametrize("cell", RAISING_CELLS)
def test_a_cell_that_raises_is_told_by_its_line_in_the_master(toy, cell):
    (toy.root / "notebooks/source/2_cellar.py").write_text(
        f'# %%\n{cell}\n\n# %% exercise="Q2.1"\n'
    )
    (toy.root / "notebooks/source/1_kitchen.py").rename(toy.root / "notebooks/source/3_kitchen.py")
    with pytest.raises(CourseError, match=f"notebooks/source/2_cellar.py, {RAISING_CELLS[cell]}"):
        build_solved_notebooks(toy.load())


def test_a_solved_cell_that_raises_is_told_by_its_question(toy):
    toy.replace("solutions/answers/kitchen.toml", 'code = "3 * 4"', 'code = "3 * four"')
    with pytest.raises(CourseError, match=r"cell of Q1.3 in 1_kitchen.py raises NameErr"):
        build_solved_notebooks(toy.load())


MASTER_MISTAKES = {
    "a question that is asked twice": (
        '# %% exercise="Q1.3"',
        '# %% exercise="Q1.3"\n\n' * 2,
        "2 times",
    ),
    "a question that is never asked": ('# %% exercise="Q1.3"\n', "", "Q1.3 is asked 0 times"),
    "a question of another chapter": ('exercise="Q1.3"', 'exercise="Q2.1"', "belongs to cellar"),
    "a question that does not exist": ('exercise="Q1.3"', 'exercise="Q7"', "asks 'Q7'"),
    "an exercise that holds code": (
        '# %% exercise="Q1.3"',
        '# %% exercise="Q1.3"\neggs = 12',
        "notebooks/source/1_kitchen.py, line [0-9]+: the exercise Q1.3 holds code",
    ),
    "a mark that is misspelt": (
        'exercise="Q1.3"',
        'excercise="Q1.3"',
        "line [0-9]+ marks a cell by 'excercise'; perhaps 'exercise' is meant",
    ),
    "the key in a notebook": (
        '# %% exercise="Q1.3"',
        '# %%\nfrom solutions import kitchen\n\n# %% exercise="Q1.3"',
        "line [0-9]+ imports solutions, which students do not get",
    ),
    "the numbers of no story": (
        '# %% exercise="Q1.3"',
        '# %%\nboxes = numbers("shelf")\n\n# %% exercise="Q1.3"',
        "line [0-9]+ reads the numbers of 'shelf'; the stories that questions tell are none",
    ),
}


@pytest.mark.parametrize("mistake", MASTER_MISTAKES)
def test_a_mistake_in_a_master_is_said(toy, mistake):
    old, new, said = MASTER_MISTAKES[mistake]
    toy.replace(MASTER, old, new)
    with pytest.raises(CourseError, match=said):
        read_masters(toy.load())


REFERENCE_MISTAKES = {
    "no docstring": (
        '    """Return the mean of `weights`, a list of numbers in grams; 0 for none."""\n',
        "",
        "Q1.5 has no docstring",
    ),
    "another name": ("def mean_weight(", "def mean(", "cannot be loaded"),
}


@pytest.mark.parametrize("mistake", REFERENCE_MISTAKES)
def test_a_reference_that_gives_no_stub_is_said(toy, mistake):
    old, new, said = REFERENCE_MISTAKES[mistake]
    toy.replace("solutions/kitchen.py", old, new)
    with pytest.raises(CourseError, match=said):
        build_student_notebooks(toy.load())


def test_an_answer_without_code_is_said(toy):
    toy.replace("solutions/answers/kitchen.toml", 'code = "3 * 4"\n', "")
    with pytest.raises(CourseError, match=r"Q1\.3 has no code"):
        build_student_notebooks(toy.load())


def test_the_committed_notebooks_of_the_real_course_are_those_of_the_masters(real_course):
    assert stale_notebooks(real_course) == []
