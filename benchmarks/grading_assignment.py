"""One assignment of ten questions, written down for this project, nbgrader and otter-grader.

The student's code, the questions and how strictly they are checked are the same for all three.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from textwrap import dedent
from typing import Any, NamedTuple

PRELUDE = dedent("""
    import math
    import cv2
    import matplotlib.pyplot as plt
    import numpy as np
    import sympy as sp

    x, y = sp.symbols("x y", real=True)
    rng = np.random.default_rng(3)
    points = np.column_stack([np.linspace(0, 1, 50), np.linspace(0, 2, 50)])
    picture = np.zeros((120, 160), np.uint8)
    cv2.rectangle(picture, (40, 30), (110, 90), 255, -1)
""").strip()
FIT_LINE = dedent("""
    def fit_line(points):
        centre = points.mean(axis=0)
        u, v = (points - centre).T
        alpha = 0.5 * np.arctan2(-2 * np.sum(u * v), np.sum(v * v) - np.sum(u * u))
        r = centre[0] * np.cos(alpha) + centre[1] * np.sin(alpha)
        if r < 0:
            r, alpha = -r, alpha + np.pi
        return np.array([r, alpha])
""").strip()


class Question(NamedTuple):
    """A question; ``wanted`` is a number, a formula in x and y, or None for the function."""

    name: str
    code: str
    wanted: float | str | None


QUESTIONS = (
    Question("dice", "dice = 6**3", 216),
    Question("mean_x", "mean_x = points[:, 0].mean()", 0.5),
    Question("rank", "rank = int(np.linalg.matrix_rank(np.outer([1, 2, 3], [4, 5, 6])))", 1),
    Question("stretch", "stretch = np.linalg.svd(np.array([[3, 0], [4, 5]]))[1][0]", 6.7082039),
    Question("slope", "slope = sp.diff(x * sp.sin(x * y), x)", "sin(x*y) + x*y*cos(x*y)"),
    Question("shorter", "shorter = sp.simplify((x**2 - 1) / (x - 1))", "x + 1"),
    Question("determinant", "determinant = sp.Matrix([[x, 1], [1, y]]).det()", "x*y - 1"),
    Question(
        "corners",
        "outlines, _ = cv2.findContours(picture, cv2.RETR_LIST, cv2.CHAIN_APPROX_SIMPLE)\n"
        "corners = len(outlines[0])",
        4,
    ),
    Question(
        "bars",
        "figure, axes = plt.subplots()\naxes.plot(points[:, 0], points[:, 1])\n"
        'axes.hist(points[:, 1], bins=7)\naxes.set_xlabel("x [m]")\nplt.show()\n'
        "bars = len(axes.patches)",
        7,
    ),
    Question("fit_line", FIT_LINE, None),
)
_CASES = dedent("""
    def clouds():
        for seed in range(5):
            rng = np.random.default_rng(seed)
            yield rng.normal(size=(40, 2)) * [3, 0.2] + rng.uniform(-5, 5, 2)
""").strip()

Cell = dict[str, Any]  # of a notebook, as nbformat writes it


def notebook(cells: list[dict[str, object]]) -> str:
    """The text of a notebook with these cells."""
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    return json.dumps({"cells": cells, "metadata": kernel, "nbformat": 4, "nbformat_minor": 5})


def cell(number: int, source: str, **metadata: object) -> Cell:
    """A code cell."""
    return {
        "cell_type": "code",
        "id": f"cell-{number}",
        "metadata": metadata,
        "source": source,
        "outputs": [],
        "execution_count": None,
    }


def submission() -> str:
    """What each student hands in: everything right."""
    codes = [PRELUDE, *(question.code for question in QUESTIONS)]
    return notebook([cell(number, code) for number, code in enumerate(codes)])


def assertions(question: Question) -> str:
    """How the peers, which check inside the student's process, are told to check."""
    if question.wanted is None:
        expected = FIT_LINE.replace("fit_line", "expected_line")
        return (
            f"{expected}\n{_CASES}\n"
            + dedent("""
            for cloud in clouds():
                assert np.allclose(fit_line(cloud), expected_line(cloud), rtol=1e-6)
        """).strip()
        )
    if isinstance(question.wanted, str):
        return dedent(f"""
            for a, b in [(0.3, 1.2), (1.7, 0.4), (2.2, 2.9), (0.9, 3.1), (1.1, 1.3)]:
                value = float({question.name}.subs({{x: a, y: b}}))
                functions = {{"sin": math.sin, "cos": math.cos}}
                expected = eval("{question.wanted}", functions, {{"x": a, "y": b}})
                assert abs(value - expected) < 1e-9
        """).strip()
    return f"assert abs({question.name} - {question.wanted}) < 1e-6"


def write_course(root: Path, students: int) -> None:
    """Lay out a course for this project, with submissions in ``submitted``."""
    for folder in ("notebooks/questions", "solutions/answers", "data", "submitted"):
        (root / folder).mkdir(parents=True)
    for package in ("notebooks", "solutions", "data"):
        (root / package / "__init__.py").touch()
    asked, answers = ['title = "Ten questions"'], []
    for number, question in enumerate(QUESTIONS, 1):
        kind, field, extra = "number", "variable", "decimals = 6"
        answer = f"value = {question.wanted}"
        head = ""
        if question.wanted is None:
            kind, field, extra = "function", "function", ""
            head = 'reference = "solutions.line:fit_line"\ncases = "solutions.line:cases"'
        elif isinstance(question.wanted, str):
            kind, extra = "expression", '[question.symbols]\nx = "x"\ny = "y"'
            head = "sample = {x = [0.2, 3.0], y = [0.2, 3.0]}"
            answer = f'expression = "{question.wanted}"'
        asked.append(
            f'[[question]]\nid = "Q{number}"\nkind = "{kind}"\npoints = 1\n'
            f'title = "{question.name}"\n'
            f'prompt = "Find {question.name}."\nhints = ["Look again."]\n'
            f'{field} = "{question.name}"\n{extra}'
        )
        answers.append(f'["Q{number}"]\nexplanation = "See the code."\n{head}')
        if question.wanted is not None:
            alternative = f'name = "right"\ncredit = 1.0\n{answer}'
            answers.append(f'[["Q{number}".alternative]]\n{alternative}')
    (root / "notebooks/questions/ten.toml").write_text("\n\n".join(asked))
    (root / "solutions/answers/ten.toml").write_text("\n\n".join(answers))
    (root / "solutions/line.py").write_text(
        f"import numpy as np\n\n\n{FIT_LINE}\n\n\n{_CASES}\n\n\ndef cases(rng):\n"
        '    return [{"name": "a cloud", "args": [cloud]} for cloud in clouds()]\n'
    )
    for student in range(students):
        handed_in = root / "submitted" / f"student{student:04}"
        handed_in.mkdir()
        (handed_in / "1_ten.ipynb").write_text(submission())


def write_nbgrader(root: Path, students: int) -> None:
    """Lay out a course for nbgrader: its source, and submissions in ``submitted``."""

    def marked(number: int, source: str, name: str, *, solution: bool, points: int) -> Cell:
        fields = {
            "grade": points > 0,
            "grade_id": name,
            "locked": not solution,
            "schema_version": 3,
            "solution": solution,
            "task": False,
        }
        if points:
            fields["points"] = points
        return cell(number, source, nbgrader=fields)

    def cells(solved: bool) -> list[Cell]:
        written = [cell(0, PRELUDE)]
        for number, question in enumerate(QUESTIONS, 1):
            code = question.code
            if not solved:
                code = f"### BEGIN SOLUTION\n{code}\n### END SOLUTION"
            answer, test = f"answer-{question.name}", f"test-{question.name}"
            written.append(marked(2 * number, code, answer, solution=True, points=0))
            written.append(
                marked(2 * number + 1, assertions(question), test, solution=False, points=1)
            )
        return written

    source = root / "source/ten"
    source.mkdir(parents=True)
    (source / "ten.ipynb").write_text(notebook(cells(solved=False)))
    (root / "nbgrader_config.py").write_text(
        'c = get_config()\nc.CourseDirectory.course_id = "ten"\n'
        "c.ClearSolutions.enforce_metadata = False\n"
    )
    for student in range(students):
        folder = root / f"submitted/student{student:04}/ten"
        folder.mkdir(parents=True)
        (folder / "ten.ipynb").write_text(notebook(cells(solved=True)))


def write_otter(root: Path, students: int) -> None:
    """Lay out tests for otter-grader, submissions, and a program that grades all of them."""
    tests = root / "tests"
    tests.mkdir(parents=True)
    for question in QUESTIONS:
        lines = assertions(question).splitlines()
        # A doctest: continuation lines begin with dots, and each statement is entered by itself.
        code = ">>> exec(" + repr("\n".join(lines)) + ", globals())"
        test = {
            "name": question.name,
            "points": 1,
            "suites": [
                {
                    "cases": [{"code": code, "hidden": False, "locked": False}],
                    "scored": True,
                    "setup": "",
                    "teardown": "",
                    "type": "doctest",
                }
            ],
        }
        (tests / f"{question.name}.py").write_text(f"OK_FORMAT = True\n\ntest = {test!r}\n")
    folder = root / "submitted"
    folder.mkdir()
    for student in range(students):
        (folder / f"student{student:04}.ipynb").write_text(submission())
    # `otter run` in a loop in one process, which saves it starting anew for each submission, with
    # a table of the grades at the end.
    (root / "grade_all.py").write_text(
        dedent("""
            import csv, pathlib
            from otter.api import grade_submission

            rows = []
            for path in sorted(pathlib.Path("submitted").glob("*.ipynb")):
                results = grade_submission(str(path), "autograder.zip", quiet=True)
                scores = {name: result.score for name, result in results.results.items()}
                rows.append({"student": path.stem, "total": results.total, **scores})
            with open("grades.csv", "w", newline="") as file:
                writer = csv.DictWriter(file, rows[0])
                writer.writeheader()
                writer.writerows(rows)
        """).lstrip()
    )


def fresh(template: Path, copy: Path) -> Path:
    """A copy of a laid out course, so that each round begins alike."""
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(template, copy)
    return copy
