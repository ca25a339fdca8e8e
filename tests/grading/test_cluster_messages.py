"""What crosses to a worker and back is the same on the other side, and no file or path crosses."""

import math
from pathlib import Path

from autograder.grading.cluster_messages import (
    Broken,
    pack_order,
    pack_result,
    unpack_order,
    unpack_result,
)
from autograder.grading.graded_submission import Graded
from autograder.grading.spread import Task
from autograder.intake.submissions import Contents, Notebook, Submission
from autograder.marking import Mark, Part

CONTENTS = Contents(
    {"kitchen": Notebook(["eggs = 12", "é\ud800\x00"], {"Q1.1": [True, None]}, ["odd"])},
    {"kitchen": {"Q1.2": {"response": [0.1 + 0.2, 10**40, math.inf, "x"], "at": 1}}},
    {"cellar": "2_cellar.ipynb is cut off."},
    ["a note"],
    "f" * 64,
)
SUBMISSION = Submission("Ada\ud800 Łuk", Path("/secret/place/ada.zip"))
MARKS = (
    Mark("Q1", "partial", 1 / 3, 3.0, "Say why.", "half", (Part("a", None, "b", "c"),), "e", "u"),
    Mark("Q2", "right", 1.0, 0.1 + 0.2, "", shown=[[1.5, None], {"a": 1e-300}]),
)


def test_the_contents_of_a_submission_cross_unchanged():
    order = unpack_order(pack_order(Task(SUBMISSION, CONTENTS), 7, frozenset({"Q2", "Q1"})))
    assert order.contents == CONTENTS
    assert order.student == SUBMISSION.student
    assert (order.seed, order.questions) == (7, {"Q1", "Q2"})
    assert unpack_order(pack_order(Task(SUBMISSION, CONTENTS), 7, None)).questions is None


def test_where_the_submission_lies_does_not_cross():
    assert b"secret" not in pack_order(Task(SUBMISSION, CONTENTS), 7, None)


def test_marks_cross_back_to_the_last_digit():
    graded = Graded(SUBMISSION, "graded", "f" * 64, MARKS, ("a note",), 0.1, isolation="walls")
    assert unpack_result(pack_result(graded), SUBMISSION) == graded


def test_a_broken_machine_crosses_as_its_sentence():
    broken = Broken("The disk is full.")
    assert unpack_result(pack_result(broken), SUBMISSION) == broken


def test_nothing_that_crosses_is_a_pickle():
    """A pickle begins with a byte that no JSON begins with."""
    graded = Graded(SUBMISSION, "graded", "f" * 64, MARKS)
    for data in (pack_order(Task(SUBMISSION, CONTENTS), 7, None), pack_result(graded)):
        assert type(data) is bytes
        assert data.startswith(b"{")
