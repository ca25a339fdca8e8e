"""Copied code is found through new names and comments; what everybody was given is not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.reports.code_fingerprints import fingerprints
from autograder.reports.similarity import shared_by_many, similar_pairs
from tests.classroom import RIGHT, START, make_course, notebook

ORIGINAL = """
def fit_line(points, weights=None):
    weights = np.ones(len(points)) if weights is None else np.asarray(weights)
    centre = (weights[:, None] * points).sum(axis=0) / weights.sum()
    offsets = points - centre
    s_xx = (weights * offsets[:, 0] ** 2).sum()
    s_yy = (weights * offsets[:, 1] ** 2).sum()
    s_xy = (weights * offsets[:, 0] * offsets[:, 1]).sum()
    angle = 0.5 * np.arctan2(-2 * s_xy, s_yy - s_xx)
    distance = centre[0] * np.cos(angle) + centre[1] * np.sin(angle)
    if distance < 0:
        distance, angle = -distance, angle + np.pi
    while angle > np.pi:
        angle -= 2 * np.pi
    return Line(float(distance), float(angle))
"""
INDEPENDENT = """
def fit_line(points, weights=None):
    if weights is None:
        weights = [1.0] * len(points)
    total = float(sum(weights))
    cx = sum(w * p[0] for w, p in zip(weights, points)) / total
    cy = sum(w * p[1] for w, p in zip(weights, points)) / total
    matrix = np.zeros((2, 2))
    for w, p in zip(weights, points):
        d = np.array([p[0] - cx, p[1] - cy])
        matrix += w * np.outer(d, d)
    values, vectors = np.linalg.eigh(matrix)
    normal = vectors[:, 0]
    r = float(normal @ [cx, cy])
    if r < 0:
        r, normal = -r, -normal
    return Line(r, math.atan2(normal[1], normal[0]))
"""
HANDOUT = """
def draw_everything(points, lines, colours, labels, axes):
    for line, colour, label in zip(lines, colours, labels):
        axes.plot(line[:, 0], line[:, 1], color=colour, label=label)
    axes.scatter(points[:, 0], points[:, 1], s=12, color="black")
    axes.set_xlabel("x in m")
    axes.set_ylabel("y in m")
    axes.legend(loc="upper right")
    axes.set_aspect("equal")
    return axes
"""


def disguised(code: str) -> str:
    """The same code with every name of its own replaced, other numbers and comments."""
    names = ("points", "weights", "centre", "offsets", "s_xx", "s_yy", "s_xy", "angle", "distance")
    for number, name in enumerate(names):
        code = re.sub(rf"\b{name}\b", f"thing{number}", code)
    code = code.replace("0.5", "0.50").replace("return", "# mine, all mine\n    return")
    return code.replace("    ", "  ")


def pairs_of(students: dict[str, list[str]], handout: str = "", least: float = 0.5):
    codes = {student: fingerprints(cells) for student, cells in students.items()}
    return similar_pairs(codes, fingerprints([handout]), least)


def test_a_copy_with_new_names_is_found():
    students = {"ada": [ORIGINAL], "boole": [disguised(ORIGINAL)], "curie": [INDEPENDENT]}
    (pair,) = pairs_of(students)
    assert (pair.first, pair.second) == ("ada", "boole")
    assert pair.share > 0.9
    assert all(pair.lines)


def test_two_who_solved_it_themselves_are_no_pair():
    assert pairs_of({"ada": [ORIGINAL], "curie": [INDEPENDENT]}, least=0.2) == []


def test_what_the_handout_gave_does_not_count():
    students = {"ada": [HANDOUT, ORIGINAL], "curie": [HANDOUT, INDEPENDENT]}
    assert len(pairs_of(students, least=0.2)) == 1
    assert pairs_of(students, HANDOUT, least=0.2) == []


def test_what_a_large_part_of_the_class_shares_does_not_count():
    students = {f"student {n:02}": [HANDOUT, ORIGINAL] for n in range(20)}
    assert pairs_of(students) == []


def test_a_copied_part_of_a_longer_work_is_found_by_the_shorter_one():
    students = {"ada": [ORIGINAL, INDEPENDENT, HANDOUT], "boole": [disguised(ORIGINAL)]}
    assert pairs_of(students)[0].share > 0.9


@pytest.mark.parametrize(
    "cells", [[], [""], ["def broken(:\n  '''"], ["%%bash\nls"], ["\x00\ud800"], ["x = 1"]]
)
def test_anything_that_was_handed_in_can_be_compared(cells: list[str]):
    assert pairs_of({"ada": cells, "boole": cells}) == []


def test_a_broken_end_does_not_hide_a_copy():
    students = {"ada": [ORIGINAL], "boole": [disguised(ORIGINAL) + "\ndef unfinished(:\n"]}
    assert pairs_of(students)[0].share > 0.9


def test_the_command_prints_the_pairs_and_writes_them(tmp_path: Path, capsys):
    make_course(tmp_path / "course")
    for student, code in (("ada", ORIGINAL), ("=boole", disguised(ORIGINAL)), ("c", INDEPENDENT)):
        folder = tmp_path / "work" / student
        folder.mkdir(parents=True)
        cells = [START, *RIGHT.values(), code]
        (folder / "3_orchard.ipynb").write_text(notebook(cells))
    (tmp_path / "work/broken.zip").write_text("no zip")
    command = ["similar", str(tmp_path / "work"), "--out", str(tmp_path / "grades")]
    assert main(["--course", str(tmp_path / "course"), *command]) == 0
    out = capsys.readouterr().out
    assert "=boole and ada" in out
    assert "1 pair among 3 submissions" in out
    assert "'=boole" in (tmp_path / "grades/similar.csv").read_text()


def test_how_much_of_each_one_s_own_work_is_alike_is_said():
    padded = ORIGINAL + INDEPENDENT.replace("fit_line", "fit_again")
    students = {"ada": fingerprints([ORIGINAL]), "boole": fingerprints([padded])}
    (pair,) = similar_pairs(students, fingerprints([]))
    assert pair.first_share == 1.0
    assert pair.second_share is not None
    # boole's other function is a bit longer than the shared one
    assert 0.3 < pair.second_share < 0.7


def test_a_copy_of_the_reference_is_named_as_such():
    students = {"ada": fingerprints([ORIGINAL]), "boole": fingerprints([INDEPENDENT])}
    (pair,) = similar_pairs(
        students, fingerprints([]), public={"the references": fingerprints([ORIGINAL])}
    )
    assert (pair.first, pair.second, pair.second_share) == ("ada", "the references", None)
    assert pair.first_share == 1.0


SHORT_FUNCTION = '''
def heaviest(weights):
    """Return the weight of the heaviest apple, which must be in the list of them all, and so on."""
    most = weights[0]
    for weight in weights:
        most = max(most, weight)
    return most
'''


def test_a_function_that_is_too_short_to_tell_does_not_count():
    assert not fingerprints([SHORT_FUNCTION]).places
    assert not fingerprints(["import math\n" + SHORT_FUNCTION + "x = 1\n"]).places
    assert fingerprints([ORIGINAL]).places


def test_a_short_function_between_long_ones_is_left_out_alone():
    both = fingerprints([SHORT_FUNCTION + ORIGINAL])
    assert both.places.keys() == fingerprints([ORIGINAL]).places.keys()


def test_the_command_compares_with_the_solved_notebooks(tmp_path: Path, capsys):
    course = make_course(tmp_path / "course")
    (course.root / "solutions/notebooks").mkdir()
    (course.root / "solutions/notebooks/3_orchard.ipynb").write_text(notebook([ORIGINAL]))
    for student, code in (("ada", ORIGINAL), ("boole", INDEPENDENT)):
        folder = tmp_path / "work" / student
        folder.mkdir(parents=True)
        (folder / "3_orchard.ipynb").write_text(notebook([START, code]))
    arguments = ["similar", str(tmp_path / "work"), "--out", str(tmp_path / "grades")]
    assert main(["--course", str(course.root), *arguments]) == 0
    said = capsys.readouterr().out
    assert "ada and the solved notebooks: 100% of ada's own work is alike" in said
    assert "boole" not in said


def test_what_was_not_compared_since_many_have_it_is_said(tmp_path: Path, capsys):
    """A solution that has gone round must not read as if nobody were alike."""
    make_course(tmp_path / "course")
    cells = {"curie": INDEPENDENT} | dict.fromkeys(("ada", "boole", "dijkstra"), ORIGINAL)
    for student, code in cells.items():
        folder = tmp_path / "work" / student
        folder.mkdir(parents=True)
        (folder / "3_orchard.ipynb").write_text(notebook([START, code]))
    arguments = ["similar", str(tmp_path / "work"), "--out", str(tmp_path / "grades")]
    assert main(["--course", str(tmp_path / "course"), *arguments]) == 0
    captured = capsys.readouterr()
    assert "0 pairs" in captured.out
    assert "3 submissions were not compared (ada, boole, dijkstra)" in captured.err


def test_work_that_is_a_students_own_or_the_handouts_is_compared():
    handout = fingerprints([HANDOUT])
    students = {"ada": [HANDOUT, ORIGINAL], "curie": [HANDOUT, INDEPENDENT], "eve": [HANDOUT]}
    codes = {student: fingerprints(cells) for student, cells in students.items()}
    assert shared_by_many(codes, handout) == []
