"""Work that uses the functions which a chapter itself gives is right in the bundle's checks too."""

from __future__ import annotations

from typing import Any

import pytest
from given import what_a_chapter_gives

from autograder.course import Course
from autograder.marking.draw import draw
from autograder.questions.registry import kind_of
from autograder.release.take_snapshots import SEED
from autograder.sandbox.inside.evaluate import evaluate

RANSAC_LINE = """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], int)
    for _ in range(iterations):
        pair = points[rng.choice(len(points), size=2, replace=False)]
        if np.array_equal(*pair):
            continue
        agree = np.flatnonzero(abs(distances(points, fit_line(pair))) <= threshold)
        if len(agree) > len(best):
            best = agree
    if not len(best):
        raise ValueError("no line")
    return {result}, best
"""


@pytest.fixture(scope="module")
def snapshot(real_course: Course) -> dict[str, Any]:
    question, answer = real_course.question("Q3.4"), real_course.key["Q3.4"]
    drawn, again = (draw(question, answer, seed, real_course.root) for seed in (SEED, SEED + 1))
    taken, _ = kind_of(question).take_snapshot(question, answer, drawn, again)
    return taken


def credit(course: Course, snapshot: dict[str, Any], result: str) -> tuple[str, float]:
    """What the check of a bundle says to a solution that uses what the chapter gives."""
    names = what_a_chapter_gives("3_ransac", "Line", "fit_line", "distances")
    exec(RANSAC_LINE.format(result=result), names)
    question = course.question("Q3.4")
    kind = kind_of(question)
    reply = evaluate(names["ransac_line"], kind.snapshot_probe(question, snapshot))
    mark = kind.mark_snapshot(question, snapshot, reply)
    return mark.status, mark.credit


def test_the_given_fit_is_precise_enough(real_course, snapshot):
    """It is OpenCV's, which computes with single precision."""
    assert credit(real_course, snapshot, "fit_line(points[best])") == ("right", 1.0)


@pytest.mark.parametrize(
    "result", ["fit_line(points)", "fit_line(pair)", "fit_line(points[best] + 1e-3)", "(0.0, 0.0)"]
)
def test_what_is_not_the_last_fit_is_not_right(real_course, snapshot, result):
    status, earned = credit(real_course, snapshot, result)
    assert status != "right"
    assert earned < 1
