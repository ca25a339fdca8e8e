import itertools
import math
from fractions import Fraction

import numpy as np
import pytest

from solutions.ransac import exact_probabilities as ransac_exact
from solutions.ransac.fast.consensus import (
    candidate_count,
    outlier_model_probability,
    required_iterations,
    success_probability,
)


def test_the_numbers_of_the_sheet():
    assert required_iterations(0.95, 0.2, 2) == 74
    assert required_iterations(0.95, 0.2, 3) == 373
    assert candidate_count(1000, 2) == 499500
    assert outlier_model_probability(0.2, 2) == pytest.approx(0.96)
    assert outlier_model_probability(0.2, 2, 42) == pytest.approx(0.18, abs=5e-5)
    assert success_probability(0.2, 2, 100) == pytest.approx(0.98313, abs=5e-6)


def test_the_numbers_of_the_sheet_counted_exactly():
    assert ransac_exact.required_iterations(0.95, 1000, 200, 2) == 74
    assert ransac_exact.required_iterations(0.95, 1000, 200, 3) == 378
    assert ransac_exact.success_probability(1000, 200, 3, 373) == pytest.approx(0.9482, abs=5e-5)


@pytest.mark.parametrize("sixteenths", [1, 3, 8, 12, 15])
@pytest.mark.parametrize("s", [1, 2, 3])
def test_the_count_is_the_smallest_that_is_enough(sixteenths, s):
    failure = 1 - Fraction(sixteenths, 16) ** s
    for p in (Fraction(1, 10), Fraction(1, 2), Fraction(95, 100), Fraction(999, 1000)):
        k = required_iterations(float(p), sixteenths / 16, s)
        assert 1 - failure**k >= p > 1 - failure ** (k - 1)


def test_a_whole_number_is_not_rounded_up_further():
    for k in range(1, 30):  # half of the samples are good: k of them succeed with 1 - 2^-k
        assert required_iterations(1 - 2.0**-k, 0.5, 1) == k


def test_tiny_probabilities_are_not_rounded_away():
    # With all_inliers = a very small: k = -log(1 - p) / a.
    assert required_iterations(0.95, 1e-5, 4) == pytest.approx(-math.log(0.05) * 1e20)
    assert outlier_model_probability(1e-5, 4, 1e20) == pytest.approx(math.exp(-1))
    assert success_probability(1e-5, 4, 1) == pytest.approx(1e-20)


def test_only_inliers_and_no_inliers():
    assert required_iterations(0.95, 1.0, 2) == 1
    assert required_iterations(0.95, 0.0, 2) == math.inf
    assert outlier_model_probability(1.0, 2, 3) == 0
    assert outlier_model_probability(1.0, 2, 0) == 1
    assert outlier_model_probability(0.0, 2, 3) == 1
    assert success_probability(1.0, 2, 3) == 1
    assert success_probability(1.0, 2, 0) == 0
    assert success_probability(0.0, 2, 3) == 0


def test_one_sample_is_drawn_however_little_is_asked_for():
    assert required_iterations(1e-10, 0.5, 2) == 1
    assert required_iterations(1e-300, 1e-5, 2) == 1


@pytest.mark.parametrize("w", [1e-160, 1e-200])  # w² is a denormal number, and zero
def test_a_number_beyond_all_floats_is_infinite(w):
    assert required_iterations(0.99, w, 2) == math.inf


def test_an_infinite_number_of_samples_fails_only_without_inliers():
    for w, fails in ((0.0, 1.0), (1e-5, 0.0), (0.5, 0.0), (1.0, 0.0)):
        assert outlier_model_probability(w, 2, math.inf) == fails
        assert success_probability(w, 2, math.inf) == 1.0 - fails


@pytest.mark.parametrize(
    "arguments", [(-0.2, 1, 1), (-0.2, 2, 1), (1.2, 2, 1), (0.5, 0, 1), (0.5, 2, -1)]
)
def test_probabilities_out_of_range_are_reported(arguments):
    for probability in (outlier_model_probability, success_probability):
        with pytest.raises(ValueError, match="Needs 0 <= w <= 1"):
            probability(*arguments)
        with pytest.raises(ValueError, match="k=nan"):
            probability(0.5, 2, math.nan)


@pytest.mark.parametrize(
    "arguments", [(0, 0.2, 2), (1, 0.2, 2), (0.9, 1.1, 2), (0.9, -0.2, 2), (0.9, 0.2, 0)]
)
def test_numbers_out_of_range_are_reported(arguments):
    with pytest.raises(ValueError, match="Needs 0 < p < 1"):
        required_iterations(*arguments)


@pytest.mark.parametrize("counts", [(10, 11, 2), (10, -1, 2), (10, 5, 0), (10, 5, 11)])
def test_impossible_counts_are_reported(counts):
    with pytest.raises(ValueError, match="Needs 0 <= inliers <= N"):
        ransac_exact.all_inlier_probability(*counts)


def test_no_points_all_points_and_a_sample_of_all_are_possible():
    assert ransac_exact.all_inlier_probability(10, 0, 2) == 0
    assert ransac_exact.all_inlier_probability(10, 10, 2) == 1
    assert ransac_exact.all_inlier_probability(10, 9, 10) == 0
    assert ransac_exact.all_inlier_probability(10, 10, 10) == 1


def test_one_sample_is_meant_where_no_number_is_given():
    assert ransac_exact.outlier_model_probability(10, 4, 2) == pytest.approx(1 - 6 / 45)
    assert outlier_model_probability(0.5, 2) == pytest.approx(0.75)


@pytest.mark.parametrize("s", [1, 2, 3, 4])
def test_exact_probabilities_are_shares_of_all_samples(s):
    good = [all(point < 4 for point in sample) for sample in itertools.combinations(range(9), s)]
    assert candidate_count(9, s) == len(good)
    assert ransac_exact.all_inlier_probability(9, 4, s) == pytest.approx(np.mean(good))


def test_both_kinds_agree_for_a_large_cloud():
    assert ransac_exact.outlier_model_probability(10**7, 2 * 10**6, 3, 373) == pytest.approx(
        outlier_model_probability(0.2, 3, 373), rel=1e-5
    )


def test_simulated_draws_fail_as_often_as_predicted():
    rng = np.random.default_rng(0)
    runs, k = 4000, 20
    points = rng.permuted(np.tile(np.arange(30), (runs * k, 1)), axis=1)[:, :2]
    failed = (points.reshape(runs, k, 2) >= 9).any(axis=2).all(axis=1).mean()
    predicted = ransac_exact.outlier_model_probability(30, 9, 2, k)
    assert failed == pytest.approx(predicted, abs=4 * math.sqrt(predicted / runs))
