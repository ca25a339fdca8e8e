"""How far a number may be off, by what was asked for and by how finely it was given."""

from __future__ import annotations

import pytest
from test_number import mark

from autograder.kinds.number.answer import NumberAlternative, NumberAnswer

RIGHT, MISTAKE = 1.0, 0.5


def answer_of(*alternatives: tuple[float, float], feedback: str = "") -> NumberAnswer:
    """Alternatives as (value, credit), called by their values."""
    made = [
        NumberAlternative(
            name=str(value),
            credit=credit,
            feedback=feedback or ("" if credit == RIGHT else "Look again."),
            value=value,
        )
        for value, credit in alternatives
    ]
    return NumberAnswer(id="Q9", explanation="why", code="", alternatives=tuple(made))


TWO_DECIMALS: dict[str, object] = {"decimals": 2}
WHOLE: dict[str, object] = {"integer": True}


@pytest.mark.parametrize(
    ("asked", "known", "value", "name"),
    [
        # Two decimals are asked for, and the key has four.
        (TWO_DECIMALS, [(0.1801, RIGHT)], 0.18, "0.1801"),
        (TWO_DECIMALS, [(0.1801, RIGHT)], 0.2, None),
        (TWO_DECIMALS, [(0.1801, RIGHT)], 0.19, None),
        # Whoever gives more has to be right to these, by one in the last.
        (TWO_DECIMALS, [(0.1801, RIGHT)], 0.1802, "0.1801"),
        (TWO_DECIMALS, [(0.1801, RIGHT)], 0.1803, None),
        (TWO_DECIMALS, [(0.1801, RIGHT)], 0.181, "0.1801"),
        (TWO_DECIMALS, [(0.1801, RIGHT)], 0.182, None),
        # More than the key has are compared as far as the key goes.
        (TWO_DECIMALS, [(0.1801, RIGHT)], 0.180199, "0.1801"),
        (TWO_DECIMALS, [(0.1801, RIGHT)], 0.180211, None),
        # One in the last place exactly, where binary fractions are a little further apart.
        (TWO_DECIMALS, [(0.581, RIGHT)], 0.582, "0.581"),
        (TWO_DECIMALS, [(0.125, RIGHT)], 0.126, "0.125"),
        (TWO_DECIMALS, [(0.0625, RIGHT)], 0.0635, None),
        # Nobody has to be more exact than a float32, which is this one's here.
        (TWO_DECIMALS, [(0.180049445, RIGHT)], 0.18004944920539856, "0.180049445"),
        (TWO_DECIMALS, [(-0.180049445, RIGHT)], -0.18004944920539856, "-0.180049445"),
        (TWO_DECIMALS, [(0.180049445, RIGHT)], 0.180049445 * (1 + 0.9e-6), "0.180049445"),
        (TWO_DECIMALS, [(0.180049445, RIGHT)], 0.180049445 * (1 + 1.1e-6), None),
        # Known mistakes are recognised however finely they are given.
        (TWO_DECIMALS, [(0.5, RIGHT), (0.8199, MISTAKE)], 0.8176, "0.8199"),
        (TWO_DECIMALS, [(0.5, RIGHT), (0.8199, MISTAKE)], 0.82, "0.8199"),
        # A whole number is asked for: a mistake that is none is given as one, rounded.
        (WHOLE, [(74, RIGHT), (73.4, MISTAKE)], 73, "73.4"),
        (WHOLE, [(74, RIGHT), (36.5, MISTAKE)], 37, "36.5"),
        (WHOLE, [(74, RIGHT), (36.5, MISTAKE)], 36, "36.5"),
        (WHOLE, [(74, RIGHT), (36.5, MISTAKE)], 38, None),
        (WHOLE, [(74, RIGHT), (37, MISTAKE)], 37.4, None),
        (WHOLE, [(73.5, RIGHT)], 74, None),
        (TWO_DECIMALS, [(74, RIGHT), (36.5, MISTAKE)], 36.6, None),
        (TWO_DECIMALS, [(74, RIGHT), (36.5, MISTAKE)], 36.5, "36.5"),
    ],
)
def test_which_alternative_a_value_is_taken_for(asked, known, value, name):
    verdict = mark(value, answer_of(*known), **asked)
    assert (verdict.alternative if verdict.credit else None) == name
    assert verdict.credit == next((credit for v, credit in known if str(v) == name), 0.0)


def test_what_a_mark_says():
    right = mark(3, answer_of((3, RIGHT)), unit="m", decimals=2)
    assert (right.feedback, right.understood, right.explanation) == ("Right.", "3 m", "why")
    right = mark(3, answer_of((3, RIGHT), feedback="Well counted."), "3.0", unit="m", decimals=2)
    assert (right.feedback, right.understood) == ("Well counted.", "3 m")
    # What the response looked like first is shown, not what it has become.
    assert mark(3, answer_of((3, RIGHT)), "4.5", unit="m", decimals=2).understood == "4.5 m"
    wrong = mark(5000.25, answer_of((3, RIGHT)), "log(3)", decimals=2)
    assert (wrong.status, wrong.credit, wrong.max_points) == ("wrong", 0.0, 4.0)
    assert wrong.feedback.count("That is not the value asked for.") == 1
    assert wrong.understood == "log(3)"
    assert wrong.evidence == "value 5000.25"


def test_a_diagnosis_says_on_what_it_rests():
    verdict = mark(0.82, answer_of((0.18, RIGHT)), decimals=2)
    assert (verdict.status, verdict.alternative) == ("wrong", "complement")
    assert verdict.evidence == "value 0.82"
