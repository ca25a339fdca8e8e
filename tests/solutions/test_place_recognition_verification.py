"""Two-view geometry on simulated cameras, and the whole pipeline on the campus photographs."""

import cv2
import numpy as np
import pytest

import data
from solutions.place_recognition import (
    Features,
    ImageDatabase,
    VocabularyTree,
    extract_features,
    match_features,
    ransac_fundamental,
    verify_candidates,
)
from solutions.place_recognition.fundamental_matrix import fit_fundamental, sampson_distances

CAMERA = np.array([[500.0, 0.0, 320.0], [0.0, 500.0, 213.0], [0.0, 0.0, 1.0]])


def two_views(rng: np.random.Generator, count: int, noise: float = 0.0) -> tuple:
    """Positions of points in space in two images, and the fundamental matrix of the cameras."""
    points = rng.uniform([-4, -3, 6], [4, 3, 14], (count, 3))
    angle = rng.uniform(0.05, 0.15)
    turn = np.array(
        [[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]
    )
    step = np.array([1.0, rng.uniform(-0.3, 0.3), rng.uniform(-0.5, 0.5)])
    cross = np.array([[0, -step[2], step[1]], [step[2], 0, -step[0]], [-step[1], step[0], 0]])
    x, y = points @ CAMERA.T, (points @ turn.T + step) @ CAMERA.T
    x, y = x[:, :2] / x[:, 2:], y[:, :2] / y[:, 2:]
    inverse = np.linalg.inv(CAMERA)
    matrix = inverse.T @ cross @ turn @ inverse
    return x + rng.normal(0, noise, x.shape), y + rng.normal(0, noise, y.shape), matrix


def up_to_scale(matrix: np.ndarray) -> np.ndarray:
    matrix = matrix / np.linalg.norm(matrix)
    return matrix * np.sign(matrix.ravel()[np.abs(matrix).argmax()])


@pytest.mark.parametrize("seed", range(10))
def test_eight_exact_matches_fix_the_matrix_of_the_cameras(seed):
    x, y, matrix = two_views(np.random.default_rng(seed), 8)
    found = fit_fundamental(x[None], y[None])[0]
    np.testing.assert_allclose(up_to_scale(found), up_to_scale(matrix), atol=1e-6)
    assert np.linalg.svd(found)[1][2] < 1e-12 * np.linalg.norm(found)


def test_the_eight_point_algorithm_agrees_with_that_of_opencv():
    x, y, _ = two_views(np.random.default_rng(1), 40, noise=0.5)
    theirs, _ = cv2.findFundamentalMat(x, y, cv2.FM_8POINT)
    ours = fit_fundamental(x[None], y[None])[0]
    np.testing.assert_allclose(up_to_scale(ours), up_to_scale(theirs), atol=1e-6)


def test_the_sampson_distance_is_how_far_a_match_has_to_move():
    # Cameras side by side: epipolar lines are rows, so a match that is 2 px off in y is mended
    # when each of its ends moves by 1 px, in four dimensions by the square root of 2.
    sideways = np.array([[[0.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]])
    x, y = np.array([[100.0, 50.0], [10.0, 7.0]]), np.array([[80.0, 52.0], [90.0, 7.0]])
    distances = sampson_distances(sideways, x, y)
    np.testing.assert_allclose(distances, [[np.sqrt(2.0), 0.0]])


@pytest.mark.parametrize("seed", range(5))
def test_ransac_finds_the_true_matches_among_as_many_wrong_ones(seed):
    rng = np.random.default_rng(seed)
    x, y, _ = two_views(rng, 80, noise=0.3)
    wrong_x, wrong_y = rng.uniform(0, 426, (2, 60, 2))
    found = ransac_fundamental(np.vstack([x, wrong_x]), np.vstack([y, wrong_y]), rng)
    assert found is not None
    assert np.isin(np.arange(80), found.inliers).mean() > 0.9
    by_chance = (found.inliers >= 80).sum()
    assert by_chance <= 8


def test_random_matches_hardly_agree():
    rng = np.random.default_rng(0)
    for _ in range(3):
        found = ransac_fundamental(*rng.uniform(0, 426, (2, 60, 2)), rng)
        assert found is None or len(found.inliers) < 20


def test_degenerate_matches_give_no_exception():
    rng = np.random.default_rng(0)
    assert ransac_fundamental(np.zeros((7, 2)), np.zeros((7, 2)), rng) is None
    same = np.ones((20, 2))
    for x in (same, np.arange(40.0).reshape(20, 2)):  # one spot, one line
        found = ransac_fundamental(x, x, rng)
        assert found is None or np.isfinite(found.matrix).all()


def features_at(descriptors: np.ndarray) -> Features:
    return Features(np.zeros((len(descriptors), 2), np.float32), descriptors)


def test_a_match_is_the_nearest_both_ways_and_clearly_nearer_than_the_second():
    one = np.array([[0.0, 0.0], [10.0, 0.0], [0.0, 30.0], [50.0, 50.0]], np.float32)
    other = np.array([[1.0, 0.0], [9.0, 0.0], [9.0, 0.5], [0.0, 31.0], [0.0, 90.0]], np.float32)
    matches = match_features(features_at(one), features_at(other))
    # 1 has two that are about as near, and the nearest to 3 is nearer to 2.
    assert matches.tolist() == [[0, 0], [2, 3]]


def test_bits_match_as_in_opencv():
    rng = np.random.default_rng(0)
    one = rng.integers(0, 256, (50, 32)).astype(np.uint8)
    other = rng.permutation(one) ^ (1 << rng.integers(0, 8, (50, 32))).astype(np.uint8)
    theirs = cv2.BFMatcher(cv2.NORM_HAMMING, crossCheck=True).match(one, other)
    matches = match_features(features_at(one), features_at(other), ratio=1.0)
    assert matches.tolist() == sorted([m.queryIdx, m.trainIdx] for m in theirs)


def test_images_with_hardly_any_features_have_no_matches():
    nothing, one = (features_at(np.zeros((n, 128), np.float32)) for n in (0, 1))
    assert len(match_features(nothing, one)) == 0
    assert verify_candidates(nothing, ["one"], {"one": one}, np.random.default_rng(0)) == []


@pytest.mark.parametrize("kind", ["sift", "orb"])
def test_a_picture_of_nothing_has_no_features(kind):
    features = extract_features(np.full((100, 100, 3), 128, np.uint8), kind)
    assert features.positions.shape == (0, 2)
    assert len(features.descriptors) == 0


@pytest.fixture(scope="module")
def campus() -> dict[str, Features]:
    names = ("0491", "0495", "0497", "0501", "0503", "0506", "0509", "0514")
    walk = {name: extract_features(data.campus_photographs()[name], most=1200) for name in names}
    return walk | {"0502": extract_features(data.campus_queries()["0502"], most=1200)}


def test_a_photograph_of_the_campus_is_recognised_and_verified(campus):
    rng = np.random.default_rng(0)
    walk = {name: features for name, features in campus.items() if name != "0502"}
    collection = np.concatenate([features.descriptors for features in walk.values()])
    database = ImageDatabase(VocabularyTree(10, 4).fit(collection, rng))
    for name, features in walk.items():
        database.add(name, features.descriptors)
    candidates = database.query(campus["0502"].descriptors, top=5)
    assert candidates[0].name == "0503"
    verified = verify_candidates(campus["0502"], [c.name for c in candidates], walk, rng)
    assert {candidate.name for candidate in verified} == {"0501", "0503"}
    assert verified[0].name == "0503"
    assert verified[0].inliers > 200


def test_photographs_of_different_places_are_not_verified(campus):
    rng = np.random.default_rng(1)
    others = ["0491", "0495", "0497", "0514"]
    assert verify_candidates(campus["0502"], others, campus, rng) == []
