"""Values, expressions and functions: `check`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from autograder import ask, check, progress

w, l = sp.symbols("w l")  # noqa: E741  -- the orchard's own letters


def stub(weights):
    """As the handout gives it."""
    raise NotImplementedError


def heaviest(weights):
    return float(np.max(weights))


def forgets_the_first(weights):
    return max(weights[1:], default=0.0)


def divides_by_zero(weights):
    return 1 / 0


@pytest.mark.parametrize(
    ("id", "response", "status", "points"),
    [
        ("Q2", 12, "right", 2),
        ("Q2", 12.0, "right", 2),
        ("Q2", np.int64(12), "right", 2),
        ("Q2", sp.Integer(12), "right", 2),
        ("Q2", 7, "partial", 0.5),
        ("Q2", 13, "wrong", 0),
        ("Q2", ..., "not attempted", 0),
        ("Q3", 2 * (w + l), "right", 2),
        ("Q3", sp.expand(2 * (w + l)), "right", 2),
        ("Q3", w + l, "partial", 1),
        ("Q3", w * l, "wrong", 0),
        ("Q3", ..., "not attempted", 0),
        ("Q4", heaviest, "right", 4),
        ("Q4", forgets_the_first, "partial", 2),
        ("Q4", stub, "not attempted", 0),
        ("Q4", ..., "not attempted", 0),
    ],
)
def test_a_response_is_marked(orchard: Path, id: str, response: object, status: str, points: float):
    mark = check(id, response).mark
    assert (mark.status, mark.points) == (status, points)


@pytest.mark.parametrize(
    ("id", "response", "said"),
    [
        ("Q2", "12", "it is a string; write it without quotes"),
        ("Q2", [3, 4], "it holds several values"),
        ("Q2", float("nan"), "not a"),
        ("Q2", 12 * w, "cannot be marked"),
        ("Q2", heaviest, "it is a function"),
        ("Q2", None, "it is not a number"),
        ("Q3", "2*w + 2*l", "it is a string; write it without quotes"),
        ("Q3", sp.Eq(w, l), "give only the side that is asked for"),
        ("Q3", sp.Symbol("height"), "it declares w, l"),
        ("Q4", 12, "cannot be marked"),
    ],
)
def test_a_response_of_the_wrong_type_is_told_so(
    orchard: Path, id: str, response: object, said: str
):
    shown = check(id, response)
    assert shown.mark.points == 0
    assert said in repr(shown)


def test_a_function_that_raises_is_marked_and_not_raised(orchard: Path):
    mark = check("Q4", divides_by_zero).mark
    assert mark.points == 0
    assert "ZeroDivisionError" in mark.feedback


def test_a_known_mistake_is_named_in_the_feedback(orchard: Path):
    assert "first apple is missing" in repr(check("Q4", forgets_the_first))


def test_an_untouched_stub_does_not_count_as_an_attempt(orchard: Path):
    check("Q2", ...)
    check("Q4", stub)
    assert not (orchard / "orchard.json").exists()


def test_ask_also_takes_values_expressions_and_functions(orchard: Path):
    assert ask("Q2").respond(12).mark.status == "right"
    assert ask("Q3").respond(2 * w + 2 * l).mark.status == "right"
    assert ask("Q4").respond(heaviest).mark.status == "right"


def test_a_value_question_says_how_to_check_it_and_names_its_symbols(orchard: Path):
    assert 'check("Q2", trees)' in repr(ask("Q2"))
    assert "`w`: width" in repr(ask("Q3"))


def test_check_without_a_response_says_what_to_write(
    orchard: Path, capsys: pytest.CaptureFixture[str]
):
    assert check("Q2") is None
    assert capsys.readouterr().out == 'Give your response too: check("Q2", trees).\n'


@pytest.mark.parametrize("id", ["Q9", "", None, 3, ["Q1"], {"Q1"}])
@pytest.mark.parametrize("action", [ask, check])
def test_a_wrong_id_gets_one_sentence_that_lists_the_ids(
    orchard: Path, capsys: pytest.CaptureFixture[str], action, id: object
):
    assert action(id) is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "this course has Q1, Q2, Q3, Q4, Q5" in said


def test_no_course_nearby_gets_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    monkeypatch.delenv("AUTOGRADER_COURSE", raising=False)
    monkeypatch.chdir(tmp_path)
    for action in (progress, lambda: ask("Q1"), lambda: check("Q2", 12)):
        assert action() is None
        said = capsys.readouterr().out
        assert said.count("\n") == 1
        assert "outside of its course" in said


def test_a_missing_answer_file_gets_one_sentence(
    own_orchard: Path, capsys: pytest.CaptureFixture[str]
):
    (own_orchard / "solutions/answers/orchard.toml").unlink()
    assert check("Q2", 12) is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "orchard.toml is missing" in said
