"""Explorers without a browser: what they refuse, and the sums behind their still pictures."""

import math

import numpy as np
import pytest

from notebooks.explorers import explore_cloud, explore_polar_line, explore_ransac_steps
from notebooks.explorers.still import ransac_run, samples_asked_for

LINE = np.column_stack([np.arange(10.0), np.zeros(10)])


@pytest.mark.parametrize("explore", [explore_polar_line, explore_ransac_steps])
@pytest.mark.parametrize(
    ("points", "words"),
    [
        (np.zeros((3, 3)), "shape (N, 2)"),
        ([(1, 2)], "shape (N, 2)"),
        ([(0, 1), (math.nan, 1)], "finite points"),
        ([(1, 1), (1, 1)], "different places"),
    ],
)
def test_points_that_cannot_be_explored_are_refused_in_one_sentence(explore, points, words):
    with pytest.raises(ValueError, match=explore.__name__) as refusal:
        explore(points)
    assert words in str(refusal.value)


def test_a_run_on_points_of_one_line_agrees_with_all_and_asks_for_one_sample():
    run = ransac_run(LINE, 0.01, 5, seed=1)
    assert run.inliers.tolist() == list(range(10))
    assert run.asked == [1] * 5


@pytest.mark.parametrize("share", [0.1, 0.2, 0.5, 0.9])
def test_the_samples_asked_for_are_the_fewest_that_are_enough(share):
    """Checked by powers: the last sample makes the difference."""
    count = samples_asked_for(share)
    assert (1 - share**2) ** count <= 0.05 < (1 - share**2) ** (count - 1)


@pytest.mark.parametrize("answer", [..., None, 0, -3, 1001, 2.5, "74"])
def test_an_answer_that_is_no_number_of_samples_does_not_stop_the_explorer(answer):
    assert "10 points" in repr(explore_ransac_steps(LINE, answer))


def test_a_cloud_with_an_outlier_can_be_explored_and_nothing_else():
    assert "11 points" in repr(explore_cloud(LINE, (4, 2)))
    with pytest.raises(ValueError, match="explore_cloud needs finite points"):
        explore_cloud(LINE, (4, math.inf))
