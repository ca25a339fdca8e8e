"""Input that is not meant is refused in one sentence, or understood; never misread."""

from functools import partial

import numpy as np
import pytest

from solutions.lines.fast.scan_lines import split_and_merge_all
from solutions.lines.line_extraction import split_and_merge
from solutions.lines.line_fitting import fit_line, line_covariance
from solutions.lines.plane_fitting import fit_plane
from solutions.place_recognition import (
    Features,
    VocabularyTree,
    assign_words,
    build_inverted_file,
    count_votes,
    descend_tree,
    extract_features,
    match_features,
)
from solutions.place_recognition.fundamental_matrix import ransac_fundamental
from solutions.ransac.fast.consensus import ransac_line as all_at_once
from solutions.ransac.line import ransac_line
from solutions.ransac.plane import ransac_plane
from solutions.ransac.walls import find_walls


@pytest.mark.parametrize("kind", [np.uint8, np.int8, np.int16, np.float16])
def test_small_numbers_do_not_overflow_on_the_way_to_a_word(kind):
    # In one byte, 100 squared is 16, and the nearest word would be the farthest.
    descriptors = np.array([[100, 100], [3, 1]]).astype(kind)
    words = np.array([[0, 0], [99, 98], [120, 1]]).astype(kind)
    assert assign_words(descriptors, words).tolist() == [1, 0]
    assert [descend_tree(descriptor, [words]) for descriptor in descriptors] == [1, 0]


def test_an_unknown_kind_of_feature_is_not_taken_for_orb():
    with pytest.raises(ValueError, match="'sift' and 'orb', not 'surf'"):
        extract_features(np.zeros((20, 20), np.uint8), "surf")  # type: ignore[arg-type]


def test_masked_points_are_not_used_behind_the_readers_back():
    points = np.ma.array(np.random.default_rng(0).normal(size=(9, 3)))
    points[4] = np.ma.masked
    with pytest.raises(ValueError, match="masked; leave them out"):
        fit_plane(points)
    with pytest.raises(ValueError, match="masked; leave them out"):
        fit_line(points[:, :2])


def test_no_other_mask_is_dropped_either():
    points = np.random.default_rng(0).normal(size=(9, 2))
    masked, weights = np.ma.array(points), np.ma.array(np.ones(9))
    masked[4] = weights[4] = np.ma.masked
    for look in (
        lambda: fit_line(points, weights),
        lambda: line_covariance(masked, 0.1),
        lambda: all_at_once(masked, 0.1, 5, np.random.default_rng(0)),
        lambda: ransac_fundamental(points, masked, np.random.default_rng(0)),
        lambda: ransac_fundamental(masked, points, np.random.default_rng(0)),
    ):
        with pytest.raises(ValueError, match="masked"):
            look()
    with pytest.raises(ValueError, match="standard deviation"):
        line_covariance(points, 0.1 * weights)


@pytest.mark.parametrize("kind", ["f4", "u1"])
def test_no_masked_descriptor_becomes_a_word(kind):
    rng = np.random.default_rng(0)
    descriptors, others = rng.integers(0, 200, (2, 9, 4)).astype(kind)
    masked = np.ma.array(descriptors)
    masked[4, 1] = np.ma.masked
    top, below = others[:2], others[:4]
    for look in (
        lambda: assign_words(masked, others),
        lambda: assign_words(others, masked),
        lambda: descend_tree(masked[4], [top, below]),
        lambda: descend_tree(descriptors[0], [np.ma.masked_equal(top, top[1, 1]), below]),
        lambda: descend_tree(descriptors[0], [top, np.ma.masked_equal(below, below[3, 0])]),
    ):
        with pytest.raises(TypeError, match="masked"):
            look()
    tree = VocabularyTree(2, 2).fit(others, rng)
    spots = np.zeros((9, 2), np.float32)
    for look in (
        lambda: tree.words(masked),
        lambda: VocabularyTree(2, 2).fit(masked, rng),
        lambda: match_features(Features(spots, masked), Features(spots, others)),
        lambda: match_features(Features(spots, others), Features(spots, masked)),
    ):
        with pytest.raises(ValueError, match="Some descriptors are masked: leave these"):
            look()


def test_descriptors_with_a_mask_that_hides_nothing_have_their_words():
    rng = np.random.default_rng(0)
    descriptors = rng.normal(size=(20, 4)).astype(np.float32)
    plain = np.ma.array(descriptors)
    words = assign_words(descriptors, descriptors[:3]).tolist()
    assert assign_words(plain, plain[:3]).tolist() == words
    assert [descend_tree(one, [plain[:3]]) for one in plain] == words
    tree, same = (
        VocabularyTree(2, 2).fit(d, np.random.default_rng(1)) for d in (plain, descriptors)
    )
    assert tree.fingerprint() == same.fingerprint()
    assert np.array_equal(tree.words(plain), same.words(descriptors))


def test_a_mask_without_a_masked_entry_changes_nothing():
    points = np.random.default_rng(0).normal(size=(9, 2))
    plain = np.ma.array(points)
    assert fit_line(plain) == fit_line(points)
    assert np.array_equal(line_covariance(plain, 0.1), line_covariance(points, 0.1))
    one, other = (all_at_once(p, 0.3, 9, np.random.default_rng(0)) for p in (plain, points))
    assert one.model == other.model


def test_a_masked_beam_has_no_echo():
    angles = np.radians(np.arange(60.0, 120.0))
    ranges = 2.0 / np.sin(angles)  # the wall y = 2
    masked = np.ma.array(ranges.copy())
    masked[20:25] = np.ma.masked
    masked.data[20:25] = 1.0
    silent = ranges.copy()
    silent[20:25] = np.nan
    (wall,), (as_well,) = split_and_merge(masked, angles), split_and_merge(silent, angles)
    assert wall.line == as_well.line
    assert wall.line == pytest.approx((2.0, np.pi / 2))
    one, other = (split_and_merge_all(r[None], angles) for r in (masked, silent))
    assert np.array_equal(one.r, other.r)
    assert len(one.r) == 1


@pytest.mark.parametrize("rng", [None, 7, np.random])
@pytest.mark.parametrize(("ransac", "axes"), [(ransac_line, 2), (ransac_plane, 3)])
def test_samples_are_not_drawn_with_anything_but_a_generator(ransac, axes, rng):
    points = np.random.default_rng(0).normal(size=(9, axes))
    with pytest.raises(TypeError, match=r"drawn with a np\.random\.Generator, not"):
        ransac(points, 0.1, 5, rng)


def test_ransac_does_not_drop_a_mask():
    rng = np.random.default_rng(0)
    points = np.ma.array(rng.normal(size=(9, 3)))
    points[4] = np.ma.masked
    for look in (ransac_plane, ransac_line, partial(find_walls, min_points=2)):
        axes = 3 if look is ransac_plane else 2
        with pytest.raises(TypeError, match="masked; leave them out"):
            look(points[:, :axes], threshold=0.1, iterations=5, rng=rng)


def test_walls_are_not_looked_for_without_a_generator():
    with pytest.raises(TypeError, match="not with None"):
        find_walls(np.random.default_rng(0).normal(size=(9, 2)), 0.1, 5, 3, None)  # type: ignore[arg-type]


def test_a_negative_deviation_is_refused():
    points = np.array([[2.0, 1.0], [2.0, 2.0], [2.0, 3.0]])
    for sigma in (-0.1, np.array([0.1, -0.1, 0.1]), float("nan")):
        with pytest.raises(ValueError, match="standard deviation"):
            line_covariance(points, sigma)


def test_a_word_below_zero_is_not_the_last_one():
    with pytest.raises(ValueError, match="the word -1, not 0 to 3"):
        build_inverted_file([np.array([0, -1])], 4)
    with pytest.raises(ValueError, match="word -1 is not in the file"):
        count_votes(np.array([-1]), [[0], [1]], 2)


def test_a_word_beyond_the_last_is_refused():
    with pytest.raises(ValueError, match="the word 4, not 0 to 3"):
        build_inverted_file([np.array([0, 4])], 4)
    with pytest.raises(ValueError, match="word 2 is not in the file"):
        count_votes(np.array([2]), [[0], [1]], 2)
