"""Explorers without a browser: what they refuse, and the sums behind their still pictures."""

import math
from functools import cache

import cv2
import numpy as np
import pytest

import data
from notebooks.explorers import (
    explore_cloud,
    explore_journey,
    explore_polar_line,
    explore_ransac_steps,
)
from notebooks.explorers.journey import Functions, Journey, _values
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


WALK = dict(list(data.campus_photographs().items())[:3])


@cache
def features():
    find = cv2.SIFT.create(60).detectAndCompute
    return {name: find(image, None) for name, image in WALK.items()}


def train_tree(descriptors, k, depth):
    """Leaf number i modulo their number: which one does not matter here."""
    return [np.zeros((k**level, 128)) for level in range(1, depth + 1)], (
        np.arange(len(descriptors)) % k**depth
    )


def stub(*args):
    raise NotImplementedError


def journey(descend_tree=lambda d, levels: int(d.sum()) % len(levels[-1]), build=None):
    build = build or (
        lambda words, count: [[i for i, w in enumerate(words) if n in w] for n in range(count)]
    )
    functions = Functions(
        train_tree, descend_tree, build, lambda bags: np.arange(bags.shape[1]) / 2
    )
    return Journey("0491", WALK, features(), list(WALK), functions)


def test_the_votes_of_a_journey_are_the_rows_of_its_words():
    """Counted in another way: a place gets a vote of each keypoint whose word it has."""
    trip = journey()
    level = trip.levels(4)[1]
    assert trip.places == ["0493", "0494"]
    places = [{(int(d.sum()) % 64) // 4 for d in features()[name][1]} for name in trip.places]
    words = [(int(d.sum()) % 64) // 4 for d in features()["0491"][1]]
    assert trip.votes(level).tolist() == [sum(w in own for w in words) for own in places]
    weighted = [sum(w / 2 for w in words if w in own) for own in places]
    assert trip.votes(level, weighted=True).tolist() == pytest.approx(weighted)


def test_what_is_not_written_yet_is_left_out_of_a_journey():
    for trip in (journey(descend_tree=stub), journey(build=stub)):
        values = _values(trip)
        assert values["trees"][0]["levels"][0]["rows"] is None
        assert len(values["matches"]) == 2
    assert values["trees"][0]["levels"][0]["words"] is not None


def test_functions_that_return_what_cannot_be_drawn_are_named():
    with pytest.raises(ValueError, match="descend_tree should return a word, whole numbers from 0"):
        journey(descend_tree=lambda *_: -1).levels(4)
    with pytest.raises(ValueError, match="build_inverted_file should return 4 lists, not 1"):
        journey(build=lambda *_: [[]]).levels(4)
    with pytest.raises(ValueError, match="explore_journey needs a photograph with features"):
        explore_journey("0999", WALK, features(), list(WALK), [stub] * 4)
