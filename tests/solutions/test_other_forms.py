"""Right results in other forms, and such as are wrong in form alone, of the questions asked."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

from autograder.course import load_course
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.sandbox.inside.evaluate import evaluate
from solutions.cases.adaptive import same_cost, same_stop
from solutions.cases.line_fitting import same_covariance, same_line
from solutions.cases.ransac import same_count
from solutions.lines.line_fitting import fit_line, line_covariance
from solutions.place_recognition.inverted_file import build_inverted_file
from solutions.ransac.adaptive import msac_cost
from solutions.ransac.line import ransac_line
from solutions.ransac.walls import find_walls
from tests.conftest import ROOT


class Thing:
    """No plain data."""


@cache
def marker() -> Marker:
    return Marker(load_course(ROOT), seed=3, tells=False)


def mark(id: str, function: Callable[..., Any]) -> Mark:
    return marker().mark(id, evaluate(function, marker().drawn(id).probe))


def changed(function: Callable[..., Any], how: Callable[[Any], Any]) -> Callable[..., Any]:
    return lambda *args, **kwargs: how(function(*args, **kwargs))


def with_float_indices(found: Any) -> Any:
    line, indices = found
    return line, indices.astype(float)


def test_float_indices_are_named():
    consensus = mark("Q3.4", changed(ransac_line, with_float_indices))
    assert consensus.alternative == "floats for indices (second result)"
    assert "indices are floats and not whole numbers" in consensus.feedback
    lists = mark(
        "Q1.5", changed(build_inverted_file, lambda file: [[float(i) for i in at] for at in file])
    )
    assert lists.alternative == "floats for indices, in each"


def test_what_is_no_plain_data_is_not_taken_for_a_change_that_never_ends():
    def with_things(walls: Any) -> Any:
        return [([Thing(), 0.0], indices) for _, indices in walls]

    assert mark("Q3.6", changed(find_walls, with_things)).alternative is None


def test_values_that_only_their_form_makes_wrong_are_not_put_down_to_random_draws():
    def with_complex(walls: Any) -> Any:
        return [([complex(line[0], 1e-12), line[1]], indices) for line, indices in walls]

    found = mark("Q3.6", changed(find_walls, with_complex))
    assert found.credit < 1
    assert found.alternative is None


def test_a_generator_that_the_given_one_spawned_counts_as_it_does():
    def searching(points: Any, threshold: Any, iterations: Any, rng: Any) -> Any:
        return ransac_line(points, threshold, iterations, rng.spawn(2)[1])

    def searching_less(points: Any, threshold: Any, iterations: Any, rng: Any) -> Any:
        return ransac_line(points, threshold, iterations // 2, rng.spawn(1)[0])

    assert mark("Q3.4", searching).status == "right"
    assert mark("Q3.4", searching_less).credit < 1


def test_the_terms_of_a_sum_and_a_second_result_are_named():
    terms = mark("Q3.7b", lambda offsets, threshold: np.minimum(offsets**2, threshold**2))
    assert terms.alternative == "terms for a sum"
    two = mark("Q3.7b", lambda offsets, t: (msac_cost(offsets, t), len(offsets)))
    assert two.alternative == "more results"
    nothing = mark("Q3.7b", lambda offsets, threshold: None)
    assert nothing.alternative == "returns nothing"
    assert "nothing is returned" in nothing.feedback


@pytest.mark.parametrize("shape", [(), (1,)])
@pytest.mark.parametrize(
    ("same", "args", "right"),
    [(same_count, [0.99, 0.5, 2], 17), (same_stop, [], 17), (same_cost, [], 0.25)],
)
def test_a_complex_number_is_no_count(same, args, right, shape):
    case = {"args": args}
    assert same(case, right, np.full(shape, float(right)))
    assert not same(case, right, np.full(shape, right + 3j))


def test_a_complex_line_is_no_line():
    points = np.array([[1.0, 0.0], [0.0, 2.0], [2.0, -2.1]])
    line, covariance = np.array(fit_line(points)), line_covariance(points, 0.1)
    assert same_line({"args": [points]}, fit_line(points), line)
    assert not same_line({"args": [points]}, fit_line(points), line + 1j)
    assert same_covariance({"args": [points, 0.1]}, covariance, covariance)
    assert not same_covariance({"args": [points, 0.1]}, covariance, covariance + 1j)
