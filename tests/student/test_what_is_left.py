"""What a notebook says without widgets: hints, what is open, and what a name is for."""

from __future__ import annotations

from pathlib import Path

import nbformat
import numpy as np
from nbformat.v4 import new_code_cell, new_notebook

from autograder import ask, check, hint, me, progress, submit
from autograder.course import load_course
from autograder.course.predictions import Prediction
from autograder.course.questions import Question
from autograder.kinds.number.question import Number
from autograder.student.desk import Desk
from autograder.student.responses import Responses
from autograder.student.widgets.progress import ProgressWidget
from tests.toy import Toy


def test_hints_come_one_at_a_time_and_are_counted(orchard: Path):
    first, second = (repr(hint("Q1")) for _ in range(2))
    assert first.startswith("Hint 1 of 2: Look up in spring.")
    assert "For the next one, run this again." in first
    assert "Hint 2 of 2: Look up in summer." in second
    assert "run this again" not in second
    assert Responses(orchard, "orchard").get("Q1")["hints"] == 2


def test_a_wrong_answer_and_a_question_say_how_to_get_a_hint(orchard: Path):
    assert 'hint("Q2")' in repr(check("Q2", 999))
    assert 'hint("Q2")' not in repr(check("Q2", 12))
    assert 'hint("Q1")' in repr(ask("Q1"))


def test_the_hints_of_a_function_stand_in_the_notebook(orchard: Path):
    def wrong(weights):
        return -1.0

    assert "hint(" not in repr(check("Q4", wrong))


def test_progress_names_what_is_open_and_what_is_marked_later(bundle: Path):
    assert "Not answered yet" not in repr(progress())  # nothing is begun
    check("Q2", 12)
    said = repr(progress())
    assert "Not answered yet: Q1, Q3, Q4, Q5." in said
    assert "marked only after you hand in: Q2." in said
    (chapter,) = ProgressWidget(Desk(load_course(bundle))).what_is_kept()["chapters"]
    assert chapter["later"] == ["Q2"]
    assert chapter["open"] == ["Q1", "Q3", "Q4", "Q5"]


def test_submit_says_that_the_name_is_missing_where_the_course_asks_for_it(own_orchard: Path):
    asks = "You have not said who you are"
    assert asks not in repr(submit())  # this course never asks
    start = new_notebook(cells=[new_code_cell("me()")])
    nbformat.write(start, own_orchard / "notebooks/0_start.ipynb")
    assert asks in repr(submit())
    me("Ada Lovelace")
    assert asks not in repr(submit())


def fails(weights):
    raise LookupError(f"no apple among {np.size(weights)}")


def test_an_exception_is_told_with_its_message_where_the_input_is_public(orchard: Path):
    assert "LookupError: no apple among 3." in repr(check("Q4", fails))


def test_what_an_exception_says_of_a_hidden_input_is_not_told(own_orchard: Path):
    Toy(own_orchard).replace("orchard_reference.py", ', "public": True', "")
    assert "no apple among" not in repr(check("Q4", fails))


def test_one_of_a_thing_has_a_unit_of_its_own():
    prediction = Prediction(
        id="P1", prompt="How far?", between=(0, 90), unit="degrees", unit_of_one="degree"
    )
    said = [prediction.in_words(value) for value in (0.5, 1, 2)]
    assert said == ["0.5 degrees", "1 degree", "2 degrees"]
    question = Number(
        id="Q1",
        title="Jars",
        prompt="How many?",
        points=1,
        hints=("Count.",),
        variable="jars",
        integer=True,
        unit="jars",
        unit_of_one="jar",
    )
    assert isinstance(question, Question)
    assert [question.in_unit(value) for value in (1, 2)] == ["1 jar", "2 jars"]
