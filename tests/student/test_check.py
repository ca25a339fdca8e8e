"""Values, expressions and functions: `check`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from autograder import ask, check, progress

w, l = sp.symbols("w l")  # noqa: E741  -- the garden's own letters


def stub(baskets):
    """As the handout gives it."""
    raise NotImplementedError


def harvest(baskets):
    return float(np.sum(baskets))


def forgets_the_first(baskets):
    return sum(baskets[1:])


def divides_by_zero(baskets):
    return 1 / 0


@pytest.mark.parametrize(
    ("id", "response", "status", "points"),
    [
        ("Q1.3", 12, "right", 2),
        ("Q1.3", 12.0, "right", 2),
        ("Q1.3", np.int64(12), "right", 2),
        ("Q1.3", sp.Integer(12), "right", 2),
        ("Q1.3", 7, "partial", 0.5),
        ("Q1.3", 13, "wrong", 0),
        ("Q1.3", ..., "not attempted", 0),
        ("Q1.4", 2 * (w + l), "right", 2),
        ("Q1.4", sp.expand(2 * (w + l)), "right", 2),
        ("Q1.4", w + l, "partial", 1),
        ("Q1.4", w * l, "wrong", 0),
        ("Q1.4", ..., "not attempted", 0),
        ("Q1.5", harvest, "right", 4),
        ("Q1.5", forgets_the_first, "partial", 2),
        ("Q1.5", stub, "not attempted", 0),
        ("Q1.5", ..., "not attempted", 0),
    ],
)
def test_a_response_is_marked(garden: Path, id: str, response: object, status: str, points: float):
    mark = check(id, response).mark
    assert (mark.status, mark.points) == (status, points)


@pytest.mark.parametrize(
    ("id", "response", "said"),
    [
        ("Q1.3", "12", "it is a string; write it without quotes"),
        ("Q1.3", [3, 4], "it holds several values"),
        ("Q1.3", float("nan"), "not a"),
        ("Q1.3", 12 * w, "cannot be marked"),
        ("Q1.3", harvest, "it is a function"),
        ("Q1.3", None, "it is not a number"),
        ("Q1.4", "2*w + 2*l", "it is a string; write it without quotes"),
        ("Q1.4", sp.Eq(w, l), "give only the side that is asked for"),
        ("Q1.4", sp.Symbol("height"), "declared are w, l"),
        ("Q1.5", 12, "cannot be marked"),
    ],
)
def test_a_response_of_the_wrong_type_is_told_so(
    garden: Path, id: str, response: object, said: str
):
    shown = check(id, response)
    assert shown.mark.points == 0
    assert said in repr(shown)


def test_a_function_that_raises_is_marked_and_not_raised(garden: Path):
    mark = check("Q1.5", divides_by_zero).mark
    assert mark.points == 0
    assert "ZeroDivisionError" in mark.feedback


def test_a_known_mistake_is_named_in_the_feedback(garden: Path):
    assert "first basket is missing" in repr(check("Q1.5", forgets_the_first))


def test_an_untouched_stub_does_not_count_as_an_attempt(garden: Path):
    check("Q1.3", ...)
    check("Q1.5", stub)
    assert not (garden / "garden.json").exists()


def test_ask_also_takes_values_expressions_and_functions(garden: Path):
    assert ask("Q1.3").respond(12).mark.status == "right"
    assert ask("Q1.4").respond(2 * w + 2 * l).mark.status == "right"
    assert ask("Q1.5").respond(harvest).mark.status == "right"


def test_a_value_question_says_how_to_check_it_and_names_its_symbols(garden: Path):
    assert 'check("Q1.3", bed_area)' in repr(ask("Q1.3"))
    assert "`w`: width" in repr(ask("Q1.4"))


def test_check_without_a_response_says_what_to_write(
    garden: Path, capsys: pytest.CaptureFixture[str]
):
    assert check("Q1.3") is None
    assert capsys.readouterr().out == 'Give your response too: check("Q1.3", bed_area).\n'


@pytest.mark.parametrize("id", ["Q9", "", None, 3, ["Q1.1"], {"Q1.1"}])
@pytest.mark.parametrize("action", [ask, check])
def test_a_wrong_id_gets_one_sentence_that_lists_the_ids(
    garden: Path, capsys: pytest.CaptureFixture[str], action, id: object
):
    assert action(id) is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "this course has Q1.1, Q1.2, Q1.3, Q1.4, Q1.5" in said


def test_no_course_nearby_gets_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    monkeypatch.delenv("AUTOGRADER_COURSE", raising=False)
    monkeypatch.chdir(tmp_path)
    for action in (progress, lambda: ask("Q1.1"), lambda: check("Q1.3", 12)):
        assert action() is None
        said = capsys.readouterr().out
        assert said.count("\n") == 1
        assert "outside of its course" in said


def test_a_missing_answer_file_gets_one_sentence(
    own_garden: Path, capsys: pytest.CaptureFixture[str]
):
    (own_garden / "solutions/answers/garden.toml").unlink()
    assert check("Q1.3", 12) is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "garden.toml is missing" in said
