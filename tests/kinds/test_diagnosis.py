"""Numbers and expressions that no mistake of the key has get their name from a relation."""

import pytest
import sympy as sp

from autograder.kinds.number.answer import NumberAlternative, NumberAnswer
from autograder.kinds.number.marking import mark_number
from autograder.kinds.number.question import Number
from autograder.marking.marker import Marker
from autograder.sandbox.inside.evaluate import evaluate

A, B = sp.symbols("a b", real=True)


def number(value: float, right: float, decimals: int | None = 2):
    question = Number(
        id="Q9", title="t", prompt="p", hints=("h",), points=1, chapter="c",
        variable="x", integer=decimals is None, decimals=decimals,
    )  # fmt: skip
    known = (NumberAlternative(name="right", credit=1.0, value=right),)
    return mark_number(question, NumberAnswer(id="Q9", alternatives=known), value)


@pytest.mark.parametrize(
    ("value", "name"),
    [
        (18.00494, "in percent"), (0.8199506, "complement"), (5.554032, "reciprocal"),
        (-0.1800494, "sign turned"), (0.3600988, "twice"), (0.0324178, "squared"),
        (0.4243223, "its root"),
    ],
)  # fmt: skip
def test_a_wrong_number_is_named_by_its_relation(value, name):
    mark = number(value, 0.1800494)
    assert (mark.status, mark.alternative) == ("wrong", name)
    assert "0.18" not in mark.feedback


@pytest.mark.parametrize("value", [0.5, 0.71, 3.3])
def test_a_number_without_a_relation_has_no_name(value):
    assert number(value, 0.1800494).alternative is None


@pytest.mark.parametrize("value", [0.18, 0.1800494, 0.18005, 0.1801, 0.1800493812])
def test_as_many_decimals_as_are_given_are_right(value):
    assert number(value, 0.1800494).status == "right"


@pytest.mark.parametrize("value", [0.184, 0.1834, 0.1765])
def test_whoever_gives_more_decimals_has_to_be_right_to_these(value):
    assert number(value, 0.1800494).status == "wrong"


def expression(course, response):
    marker = Marker(course.load(), seed=1)
    return marker.mark("Q1.4", evaluate(response, marker.drawn("Q1.4").probe))


def test_a_matrix_of_one_a_set_of_one_and_a_list_of_equal_roots_are_expressions(toy):
    right = 2 * (A + B)
    for response in (sp.Matrix([[right]]), sp.FiniteSet(right), [right], [right, 2 * A + 2 * B]):
        assert expression(toy, response).status == "right", response


def test_a_polynomial_and_a_tuple_of_sympy_are_expressions(toy):
    right = 2 * (A + B)
    for response in (sp.Poly(right, A), sp.Poly(right, A, B), sp.Tuple(right)):
        assert expression(toy, response).status == "right", response
    for response in (sp.Poly(A + B, A), sp.Tuple(right, A)):
        assert expression(toy, response).status != "right", response


def test_a_lambda_of_sympy_is_called_a_function(toy):
    mark = expression(toy, sp.Lambda((A, B), 2 * (A + B)))
    assert mark.status == "wrong"
    assert "it is a function" in mark.feedback


def test_a_list_of_roots_is_right_only_if_each_is(toy):
    assert expression(toy, [2 * (A + B), A]).status != "right"


@pytest.mark.parametrize(
    ("response", "name"),
    [
        (-2 * (A + B), "sign turned"),
        (7 * (A + B), "a constant factor"),
        (2 * (A - B), "the sign of a term"),
    ],
)
def test_a_wrong_expression_is_named_by_its_relation(toy, response, name):
    mark = expression(toy, response)
    assert (mark.status, mark.alternative) == ("wrong", name)
    assert mark.feedback.startswith("It looks as if ")
