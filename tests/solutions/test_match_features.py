"""Features of photographs and their matches, on made-up ones where the answer is known."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from solutions.place_recognition import (
    Features,
    extract_features,
    match_features,
    verify_candidates,
)
from solutions.place_recognition.features import are_bits
from solutions.place_recognition.verification import one_of_each_place


def of(*descriptors: list[float]) -> Features:
    return Features(np.zeros((len(descriptors), 2), np.float32), np.array(descriptors, np.float32))


def unlike(positions: np.ndarray) -> Features:
    """Features at these positions, no two of which look alike."""
    return Features(positions, 100 * np.eye(len(positions), 128, dtype=np.float32))


def spots(count: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).uniform([0, 0], [640, 426], (count, 2))


def test_the_second_nearest_is_farther_by_the_ratio_of_distances():
    one = of([0.0, 0.0], [100.0, 0.0])
    for second, matches in ((1.24, []), (1.26, [[0, 0]])):  # 1 / 0.8 is 1.25
        assert match_features(one, of([0.0, 1.0], [0.0, -second])).tolist() == matches
    for second, matches in ((1.9, []), (2.1, [[0, 0]])):
        assert match_features(one, of([0.0, 1.0], [0.0, -second]), 0.5).tolist() == matches
    exactly = of([0.0, 1.0], [0.0, -2.0])
    assert match_features(one, exactly, 0.5).tolist() == []
    assert match_features(one, of([0.0, 1.0], [0.0, -1.0]), 1.0).tolist() == []


@pytest.mark.parametrize("ratio", [0.5, 0.8, 0.95, 1.0])
def test_the_matches_are_those_that_one_by_one_gives(ratio):
    rng = np.random.default_rng(0)
    one = rng.normal(5.0, 1.0, (60, 3)).astype(np.float32)
    other = np.vstack([rng.normal(5.0, 1.0, (50, 3)), one[:40] + rng.normal(0, 0.2, (40, 3))])
    other = rng.permutation(other).astype(np.float32)
    apart = np.linalg.norm(one[:, None] - other, axis=2)
    expected = []
    for i, row in enumerate(apart):
        first, second = np.argsort(row)[:2]
        if row[first] < ratio * row[second] and apart[:, first].argmin() == i:
            expected.append([i, int(first)])
    assert len(expected) > 5
    assert match_features(of(*one), of(*other), ratio).tolist() == expected


def test_of_two_that_look_the_same_none_is_a_match():
    one = of([0.0, 0.0], [9.0, 0.0])
    assert match_features(one, of([0.0, 0.0], [0.0, 0.0], [9.0, 0.0])).tolist() == [[1, 2]]


def test_one_feature_has_no_second_nearest():
    one, two, three = of([1.0, 1.0]), of([1.0, 1.0], [9.0, 9.0]), of([9, 9], [5, 5], [1, 1])
    for pair in ((one, two), (two, one), (one, one)):
        matches = match_features(*pair)
        assert matches.shape == (0, 2)
        assert matches.dtype == np.intp
    assert match_features(two, three).tolist() == [[0, 2], [1, 0]]


def test_bits_are_as_far_as_the_root_of_how_many_differ():
    zero, far = [0] * 32, [255] * 32
    four, six, seven = ([bits, *zero[1:]] for bits in (0b1111, 0b11111100, 0b11111110))
    one = Features(np.zeros((2, 2)), np.array([zero, far], np.uint8))
    for second, matches in ((six, []), (seven, [[0, 0]])):  # 4 / 0.64 is 6.25
        other = Features(np.zeros((2, 2)), np.array([four, second], np.uint8))
        assert match_features(one, other).tolist() == matches


def test_masked_descriptors_are_refused():
    whole = of([1.0, 1.0], [9.0, 9.0])
    masked = Features(whole.positions, np.ma.masked_greater(whole.descriptors, 5.0))
    for pair in ((whole, masked), (masked, whole)):
        with pytest.raises(ValueError, match="Some descriptors are masked"):
            match_features(*pair)


@pytest.mark.parametrize(("count", "found"), [(19, []), (20, [("same", 20)])])
def test_twenty_inliers_verify_a_place(count, found):
    features = unlike(spots(count))
    rng = np.random.default_rng(0)
    assert verify_candidates(features, ["same"], {"same": features}, rng) == found
    enough = verify_candidates(features, ["same"], {"same": features}, rng, fewest=count)
    assert enough == [("same", count)]
    assert verify_candidates(features, ["same"], {"same": features}, rng, fewest=count + 1) == []


def test_the_most_certain_candidate_comes_first_and_of_equals_the_better_ranked():
    query = unlike(spots(40))
    features = {
        "nothing": unlike(np.zeros((0, 2))),
        "some": Features(query.positions[:25], query.descriptors[:25]),
        "all": query,
        "others": unlike(spots(40, seed=1)),
        "all again": query,
    }
    found = verify_candidates(query, list(features), features, np.random.default_rng(0))
    assert found == [("all", 40), ("all again", 40), ("some", 25)]


def test_each_match_is_found_where_its_features_are():
    """The other photograph is moved, and its features are in another order, with more of them."""
    query = unlike(spots(30))
    moved = Features(
        np.vstack([spots(5, seed=1), query.positions[::-1] @ [[0.9, 0.1], [-0.1, 1.1]] + [30, 9]]),
        np.vstack([query.descriptors[:5] * 0 - 100, query.descriptors[::-1]]),
    )
    for one, other in ((query, moved), (moved, query)):
        found = verify_candidates(one, ["moved"], {"moved": other}, np.random.default_rng(0))
        assert found == [("moved", 30)]


def test_a_candidate_without_a_geometry_has_no_inliers():
    query, nothing = unlike(spots(30)), unlike(np.zeros((0, 2)))
    for fewest, found in ((1, []), (0, [("nothing", 0)])):
        rng = np.random.default_rng(0)
        assert verify_candidates(query, ["nothing"], {"nothing": nothing}, rng, fewest) == found


def test_matches_of_the_same_pixels_are_one():
    x = np.array([[1.0, 1.0], [9.4, 1.0], [8.6, 1.0], [1.0, 1.0], [1.0, 2.0]])
    y = np.array([[7.0, 1.0], [7.0, 1.0], [7.0, 1.4], [7.0, 2.0], [7.0, 1.0]])
    assert one_of_each_place(x, y).tolist() == [0, 1, 3, 4]
    assert one_of_each_place(x[::-1], y[::-1]).tolist() == [0, 1, 2, 4]


def picture() -> np.ndarray:
    """Red, green and blue circles on black, most of them in the right half."""
    image = np.zeros((240, 320, 3), np.uint8)
    rng = np.random.default_rng(0)
    for _ in range(60):
        center = tuple(int(c) for c in rng.integers([170, 20], [300, 220]))
        color = tuple(int(c) for c in rng.integers(60, 256, 3))
        cv2.circle(image, center, int(rng.integers(3, 12)), color, -1)
    return image


@pytest.mark.parametrize(("kind", "size", "dtype"), [("sift", 128, "f4"), ("orb", 32, "u1")])
def test_features_have_positions_and_descriptors_of_their_kind(kind, size, dtype):
    for image in (picture(), np.zeros((50, 50), np.uint8)):
        features = extract_features(image, kind)
        count = len(features.positions)
        assert (count > 50) is bool(image.any())
        assert features.positions.shape == (count, 2)
        assert features.positions.dtype == np.float32
        assert features.descriptors.shape == (count, size)
        assert features.descriptors.dtype == np.dtype(dtype)
    x, y = extract_features(picture(), kind).positions.T
    assert x.min() > 140
    assert y.max() < 240


@pytest.mark.parametrize("kind", ["sift", "orb"])
def test_a_picture_in_color_has_the_features_of_its_gray_one(kind):
    image = picture()
    gray = np.rint(image @ [0.299, 0.587, 0.114]).astype(np.uint8)
    in_color, in_gray = (extract_features(one, kind) for one in (image, gray))
    assert len(in_color.positions) == pytest.approx(len(in_gray.positions), rel=0.05)
    other = extract_features(image[..., ::-1], kind)  # its blue is as weak as the red here
    weights = [abs(one.descriptors.astype(float).sum()) for one in (in_gray, in_color, other)]
    assert abs(weights[1] - weights[0]) < 0.2 * abs(weights[2] - weights[0])


@pytest.mark.parametrize("kind", ["sift", "orb"])
def test_no_more_features_than_asked_for(kind):
    noise = np.random.default_rng(0).integers(0, 256, (600, 800)).astype(np.uint8)
    noise = cv2.GaussianBlur(noise, (0, 0), 1.5)
    assert len(extract_features(noise, kind, 30).positions) == pytest.approx(30, abs=1)
    every = len(extract_features(noise, kind).positions)
    assert every == 1000 if kind == "orb" else every > 1000


def test_the_default_is_sift_and_other_kinds_are_named():
    assert extract_features(picture()).descriptors.shape[1] == 128
    with pytest.raises(ValueError, match="kinds 'sift' and 'orb', not 'surf'"):
        extract_features(picture(), "surf")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("dtype", "size", "bits"),
    [("u1", 32, True), ("u1", 64, True), ("u1", 61, True), ("u1", 128, False), ("f4", 32, False),
     ("u1", 127, True), ("u1", 129, True), ("f4", 128, False)],
)  # fmt: skip
def test_bytes_are_bits_unless_they_are_those_of_sift(dtype, size, bits):
    assert are_bits(np.zeros((3, size), dtype)) is bits
