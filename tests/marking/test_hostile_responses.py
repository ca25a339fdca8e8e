"""A student's process may send anything: every kind gives a mark, never more than it earns."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.exchange import wire
from autograder.kinds.function.marking import Expected, mark_function
from autograder.marking import STATUSES, Mark
from autograder.marking.marker import Marker
from autograder.questions.drawn import Drawn
from tests.toy import make_toy

IDS = ["Q1.1", "Q1.2", "Q1.3", "Q1.4", "Q1.5"]


@pytest.fixture
def marker(toy) -> Marker:
    return Marker(toy.load(), seed=4)


def rubbish() -> list[Any]:
    array = np.arange(6.0)
    values: list[Any] = [None, True, 0, -1, 12, 10**400, -(10**400), 1e308, 0.5j]
    values += [math.nan, math.inf, "", "12", "given", "\ud800", "x" * 10_000, b"12", ..., object()]
    values += [[], [None], [True], [[]], [1, "a", None], ["stir"] * 6, {}, {"a": array}, (), (1, 2)]
    values += [array, array.reshape(2, 3), array > 2, array * 1j, np.array(3.0), np.array([]), int]
    values += [np.array(["a", "b"]), np.array([None, {}]), np.full(48, np.nan), np.ones((48, 1))]
    values += [{"state": value} for value in (None, 1, "given", "raised", "other", array, [], {})]
    values += [{"state": "unusable", "reason": value} for value in ("missing", None, array, [], 7)]
    values += [{"state": "raised", "error": value} for value in ("ValueError", None, array, {})]
    inner: list[Any] = [None, True, 10**400, math.nan, math.inf, "12", [], {}, array, array > 1]
    inner += [np.ones(48), np.ones(48) > 0, np.array(["a"] * 48), np.full(48, np.inf), 1j, [[]] * 4]
    inner += [[{}] * 4, [{"value": array}] * 4, [{"raised": array}] * 4, [{"unusable": array}] * 4]
    inner += [[1] * 4, [None] * 4, [{"raised": 7}] * 4, [{"unusable": 10**5000}] * 4, ["x"] * 4]
    inner += [
        [{"value": value}] * 4 for value in (None, "3", math.nan, 10**400, {}, [[]], 1j, object())
    ]
    for field in ("value", "values", "outcomes"):
        values += [{"state": "given", field: value} for value in inner]
    return values


@pytest.mark.parametrize("id", IDS)
def test_no_response_of_any_type_raises_or_earns_anything(marker, id):
    for response in rubbish():
        mark = marker.mark(id, response)
        assert mark.status in STATUSES
        assert mark.credit == 0, response


@pytest.mark.parametrize("id", IDS)
def test_what_is_not_understood_is_called_neither_right_nor_untouched(marker, id):
    for response in rubbish():
        said_to_be_missing = isinstance(response, dict) and str(response.get("reason")) == "missing"
        if response is not None and not said_to_be_missing:
            assert marker.mark(id, response).status not in ("right", "not attempted"), response


plain = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.complex_numbers()
    | st.text(max_size=5)
    | st.sampled_from(["given", "raised", "unusable", "missing", "stir", "boil", "cup"])
    | st.sampled_from([np.ones(48), np.ones(4), np.zeros((2, 2)), np.array([True])]),
    lambda inner: (
        st.lists(inner, max_size=6)
        | st.dictionaries(
            st.sampled_from(["state", "value", "values", "outcomes", "raised", "reason", "error"]),
            inner,
            max_size=3,
        )
    ),
    max_leaves=12,
)


@pytest.fixture(scope="module")
def ready(tmp_path_factory) -> dict[str, tuple[Marker, Drawn]]:
    """A marker of the kinds that need no reference, for many examples in one test."""
    course = make_toy(tmp_path_factory.mktemp("course")).load()
    marker = Marker(course, seed=4)
    return {id: (marker, marker.drawn(id)) for id in IDS[:4]}


@given(response=plain)
def test_nothing_plain_raises_and_the_mark_can_be_sent_on(ready, response):
    for id, (marker, _) in ready.items():
        mark = marker.mark(id, response, understood="?")
        assert 0 <= mark.points <= mark.max_points
        assert Mark.from_dict(wire.decode(*_parts(mark))) == mark


def _parts(mark: Mark) -> tuple[bytes, bytes]:
    frame = wire.encode(mark.to_dict())
    json_length, _ = wire.HEADER.unpack(frame[: wire.HEADER.size])
    body = frame[wire.HEADER.size :]
    return body[:json_length], body[json_length:]


@given(outcomes=plain | st.lists(plain, min_size=3, max_size=3))
def test_no_outcomes_of_a_function_raise_even_where_the_reference_does(ready, outcomes):
    """Where the right outcome is an exception, an outcome is compared as it is."""
    marker, _ = ready["Q1.1"]
    question, answer = marker.course.question("Q1.5"), marker.course.key["Q1.5"]
    expected = Expected(
        cases=[{"name": name, "args": []} for name in "abc"],
        outcomes=[{"value": 1.0}, {"raised": "ValueError"}, {"unusable": "not plain"}],
        compare=lambda case, right, actual: right == actual,
        mistakes=[(answer.alternatives[0], [{"raised": "ValueError"}] * 3)],
    )
    mark = mark_function(question, answer, expected, outcomes)
    assert mark.status in STATUSES
    assert 0 <= mark.credit <= 1
