"""The parts of RANSAC for the fundamental matrix, each by itself."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from solutions.place_recognition import fundamental_matrix as module
from solutions.place_recognition import ransac_fundamental
from solutions.place_recognition.fundamental_matrix import (
    Epipolar,
    fit_fundamental,
    sampson_distances,
)

NOTHING = Epipolar(np.zeros((3, 3)), np.zeros(0, dtype=np.intp))


def turned(rng: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(count, 2) positions in two cameras, and the matrix (3, 3) that they agree with.

    The second one has gone forward and to the side, so that no image can stand for the other.
    """
    space = rng.uniform([-4, -3, 6], [4, 3, 14], (count, 3))
    camera = np.array([[500.0, 0.0, 320.0], [0.0, 500.0, 213.0], [0.0, 0.0, 1.0]])
    angle, step = 0.12, np.array([0.7, 0.1, 0.9])
    turn = np.array(
        [[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]
    )
    x, y = space @ camera.T, (space @ turn.T + step) @ camera.T
    cross = np.array([[0, -step[2], step[1]], [step[2], 0, -step[0]], [-step[1], step[0], 0]])
    inverse = np.linalg.inv(camera)
    return x[:, :2] / x[:, 2:], y[:, :2] / y[:, 2:], inverse.T @ cross @ turn @ inverse


def side_by_side(rng: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray]:
    """(count, 2) positions in two cameras side by side: the rows of a match are equal."""
    x = rng.uniform([0, 0], [640, 426], (count, 2))
    return x, x - np.column_stack([rng.uniform(20, 90, count), np.zeros(count)])


class Counted:
    """A generator that notes how many samples are drawn at a time."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.drawn: list[int] = []
        monkeypatch.setattr(module, "draw_samples", self)

    def __call__(self, N: int, s: int, count: int, rng: np.random.Generator) -> np.ndarray:
        assert (N, s) == (60, 8)
        self.drawn.append(count)
        return np.argsort(rng.random((N, count)), axis=0)[:s]


def test_eight_matches_are_enough_and_seven_are_not():
    x, y = side_by_side(np.random.default_rng(0), 8)
    found = ransac_fundamental(x, y, np.random.default_rng(1))
    assert found is not None
    assert_array_equal(found.inliers, np.arange(8))
    assert ransac_fundamental(x[:7], y[:7], np.random.default_rng(1)) is None


def test_fewer_than_eight_need_no_samples():
    x, y = side_by_side(np.random.default_rng(0), 7)
    rng = np.random.default_rng(1)
    assert ransac_fundamental(x, y, rng) is None
    assert rng.random() == np.random.default_rng(1).random()


def test_where_all_agree_the_first_samples_are_the_last(monkeypatch):
    counted = Counted(monkeypatch)
    ransac_fundamental(*side_by_side(np.random.default_rng(0), 60), np.random.default_rng(1))
    assert counted.drawn == [64]


def test_by_default_two_thousand_samples_are_drawn_and_never_more(monkeypatch):
    counted = Counted(monkeypatch)
    x, y = np.random.default_rng(0).uniform(0, 426, (2, 60, 2))
    ransac_fundamental(x, y, np.random.default_rng(1))
    assert counted.drawn == [64] * 31 + [16]
    counted.drawn.clear()
    ransac_fundamental(x, y, np.random.default_rng(1), iterations=100)
    assert counted.drawn == [64, 36]


def test_by_default_matches_agree_within_two_pixels_and_99_percent_is_sure_enough(monkeypatch):
    asked = []

    def better(best: Epipolar, *others: object) -> Epipolar:
        asked.append(others[-1])
        return best

    def enough(confidence: float, inlier_ratio: float, size: int) -> float:
        asked.append((confidence, inlier_ratio, size))
        return 1

    monkeypatch.setattr(module, "_better", better)
    monkeypatch.setattr(module, "required_iterations", enough)
    x, y = side_by_side(np.random.default_rng(0), 20)
    assert ransac_fundamental(x, y, np.random.default_rng(1)) is None
    assert asked == [2.0, (0.99, 0.0, 8)]


def test_the_geometry_is_fitted_to_all_that_agree():
    rng = np.random.default_rng(3)
    x, y = side_by_side(rng, 200)
    y = y + rng.normal(0, 0.8, y.shape)
    found = ransac_fundamental(x, y, rng)
    assert found is not None
    again = fit_fundamental(x[found.inliers][None], y[found.inliers][None])
    # Another fit to them finds no more of them: it was made again as long as that helped.
    assert (sampson_distances(again, x, y)[0] <= 2.0).sum() <= len(found.inliers)
    true = np.array([[[0.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]])
    assert len(found.inliers) >= 0.97 * (sampson_distances(true, x, y)[0] <= 2.0).sum()


@pytest.mark.parametrize(
    ("agree", "fitted"),
    [
        ([9, 10, 12, 12], [(5, 8), (1, 9), (1, 10), (1, 12)]),
        ([8, 11, 11], [(5, 8), (1, 8), (1, 11)]),
    ],
    ids=["many", "eight"],
)
def test_it_is_fitted_again_as_long_as_more_matches_agree(monkeypatch, agree, fitted):
    counts, samples_of = iter(agree), []

    def better(best: Epipolar, samples: np.ndarray, *others: object) -> Epipolar:
        samples_of.append(samples.shape)
        count = next(counts)
        return best if count == len(best.inliers) else Epipolar(np.eye(3), np.arange(count))

    monkeypatch.setattr(module, "_better", better)
    x, y = side_by_side(np.random.default_rng(0), 20)
    found = ransac_fundamental(x, y, np.random.default_rng(1), iterations=5)
    assert found is not None
    assert_array_equal(found.inliers, np.arange(agree[-1]))
    assert samples_of == fitted


def test_only_more_matches_are_better():
    x, y = side_by_side(np.random.default_rng(0), 20)
    samples = np.arange(16).reshape(2, 8)
    first = module._better(NOTHING, samples, x, y, 2.0)
    assert_array_equal(first.inliers, np.arange(20))
    assert module._better(first, samples[::-1], x, y, 2.0) is first


def test_of_several_samples_that_of_most_matches_is_taken():
    x, y = side_by_side(np.random.default_rng(0), 30)
    y[20:] = np.random.default_rng(1).uniform(0, 426, (10, 2))
    mixed = np.array([[0, 1, 2, 20, 21, 22, 23, 24], np.arange(8), [8, 9, 10, 25, 26, 27, 28, 29]])
    found = module._better(NOTHING, mixed, x, y, 1.0)
    assert set(range(20)) <= set(found.inliers.tolist())
    assert_allclose(found.matrix, fit_fundamental(x[:8][None], y[:8][None])[0])


def test_matches_on_a_line_say_nothing_at_exactly_the_threshold():
    along = np.linspace(0, 100, 12)
    flat = np.column_stack([along, np.tile([2.0, -2.0], 6)])  # its variance across is 4
    wide, _ = side_by_side(np.random.default_rng(0), 12)
    no_lines = np.eye(3) * [0, 0, 1e-9]  # explains nothing: every distance is huge
    assert module._is_degenerate(no_lines, flat, wide, 2.0)
    assert module._is_degenerate(no_lines, wide, flat, 2.0)
    assert not module._is_degenerate(no_lines, flat, wide, 1.9)


def test_half_of_the_matches_on_two_lines_say_nothing():
    rng = np.random.default_rng(0)
    x, y = rng.uniform(0, 426, (2, 12, 2))
    column = np.array([[1.0], [0.0], [-50.0]])  # the line x = 50 in the second image
    row = np.array([[0.0], [1.0], [-70.0]])  # the line y = 70 in the first one
    rank_one = column @ row.T
    y[:6, 0] = 50.0
    assert module._is_degenerate(rank_one, x, y, 0.5)
    y[5, 0] = 90.0
    assert not module._is_degenerate(rank_one, x, y, 0.5)


def test_points_are_centred_and_scaled_and_the_transform_says_how():
    points = np.random.default_rng(0).uniform(0, 600, (3, 9, 2))
    made, transforms = module._normalised(points)
    assert_allclose(made[..., :2].mean(axis=1), 0, atol=1e-12)
    assert_allclose(np.linalg.norm(made[..., :2], axis=2).mean(axis=1), np.sqrt(2.0))
    assert_allclose(made[..., 2], 1.0)
    ones = np.concatenate([points, np.ones((3, 9, 1))], axis=2)
    assert_allclose(np.einsum("kij,knj->kni", transforms, ones), made)


def test_points_in_one_spot_are_scaled_by_a_finite_number():
    made, transforms = module._normalised(np.full((1, 8, 2), 100.25))
    assert np.isfinite(made).all()
    assert_allclose(transforms[0, 0, 0], np.sqrt(2.0) * 1e12)


def test_a_matrix_without_slopes_has_finite_or_huge_distances():
    x, y = side_by_side(np.random.default_rng(0), 5)
    assert_array_equal(sampson_distances(np.zeros((1, 3, 3)), x, y), np.zeros((1, 5)))
    far = sampson_distances(np.eye(3)[None] * [0, 0, 1e-9], x, y)
    assert (far > 1e100).all()


@pytest.mark.parametrize("argument", ["threshold", "iterations", "confidence"])
def test_the_argument_out_of_range_is_named_with_its_value(argument):
    x, y = side_by_side(np.random.default_rng(0), 10)
    with pytest.raises(ValueError, match="not") as raised:
        ransac_fundamental(x, y, np.random.default_rng(1), **{argument: -7})
    values = {"threshold": 2.0, "iterations": 2000, "confidence": 0.99} | {argument: -7}
    last = "{threshold}, {iterations} and {confidence}.".format(**values)
    assert str(raised.value).endswith(last)


@pytest.mark.parametrize(
    ("argument", "value"), [("threshold", 0.0), ("iterations", 0), ("confidence", 0.0),
                            ("confidence", 1.0)],
)  # fmt: skip
def test_the_ends_of_the_ranges_are_out_of_them(argument, value):
    x, y = side_by_side(np.random.default_rng(0), 10)
    with pytest.raises(ValueError, match="Needs threshold"):
        ransac_fundamental(x, y, np.random.default_rng(1), **{argument: value})


def test_one_iteration_is_allowed():
    x, y = side_by_side(np.random.default_rng(0), 20)
    found = ransac_fundamental(x, y, np.random.default_rng(1), iterations=1)
    assert found is not None
    assert len(found.inliers) == 20


def test_the_matrix_leads_from_the_first_image_to_the_second():
    x, y, true = turned(np.random.default_rng(0), 40)
    found = ransac_fundamental(x, y, np.random.default_rng(1))
    assert found is not None
    assert len(found.inliers) == 40
    scale = (found.matrix * true).sum() / (true * true).sum()
    assert_allclose(found.matrix, scale * true, atol=1e-6 * np.abs(found.matrix).max())


def test_the_sampson_distance_is_that_of_the_book_for_each_matrix_and_match():
    x, y, matrix = turned(np.random.default_rng(0), 6)
    y += [3.0, -2.0]
    for F, distances in zip(
        (matrix, matrix.T), sampson_distances(np.stack([matrix, matrix.T]), x, y), strict=True
    ):
        for one, other, distance in zip(x, y, distances, strict=True):
            a, b = F @ [*one, 1.0], F.T @ [*other, 1.0]
            error = np.array([*other, 1.0]) @ a
            assert_allclose(
                distance, abs(error) / np.sqrt(a[0] ** 2 + a[1] ** 2 + b[0] ** 2 + b[1] ** 2)
            )


def test_the_rank_one_part_has_rank_one_and_is_the_largest():
    rng = np.random.default_rng(0)
    x, y = rng.uniform(0, 426, (2, 3, 12, 2))
    F, rank_one = module._fit_with_rank_one(x, y)
    assert F.shape == rank_one.shape == (3, 3, 3)
    for whole, one in zip(F, rank_one, strict=True):
        sizes = np.linalg.svd(one)[1]
        assert sizes[1] < 1e-9 * sizes[0]
        sizes = np.linalg.svd(whole)[1]
        assert sizes[2] < 1e-9 * sizes[1]
    # What is left of a matrix without its largest part, in the coordinates of the fit.
    for k in range(3):
        (_, to_x), (_, to_y) = module._normalised(x[k][None]), module._normalised(y[k][None])
        scaled = np.linalg.inv(to_y[0]).T @ np.stack([F[k], rank_one[k]]) @ np.linalg.inv(to_x[0])
        sizes = np.linalg.svd(scaled)[1]
        assert_allclose(sizes[0][0], sizes[1][0])


@pytest.mark.parametrize("seed", range(3))
def test_all_that_are_said_to_agree_agree_with_the_matrix(seed):
    rng = np.random.default_rng(seed)
    x, y, _ = turned(rng, 120)
    y += rng.normal(0, 1.2, y.shape)
    found = ransac_fundamental(x, y, rng)
    assert found is not None
    distances = sampson_distances(found.matrix[None], x, y)[0]
    assert_array_equal(found.inliers, np.flatnonzero(distances <= 2.0))


def test_samples_are_enough_as_soon_as_they_are_as_many_as_needed(monkeypatch):
    counted = Counted(monkeypatch)
    monkeypatch.setattr(module, "required_iterations", lambda *known: 128)
    x, y = np.random.default_rng(0).uniform(0, 426, (2, 60, 2))
    ransac_fundamental(x, y, np.random.default_rng(1))
    assert counted.drawn == [64, 64]


def test_a_degenerate_geometry_gives_way_to_the_next_best():
    rng = np.random.default_rng(0)
    x, y, _ = turned(rng, 42)
    # More matches end in one spot of the second image than agree otherwise.
    x[:22], y[:22] = rng.uniform(0, 426, (22, 2)), 100.25
    samples = np.array([np.arange(8), np.arange(30, 38)])
    found = module._better(NOTHING, samples, x, y, 1.0)
    assert set(range(22, 42)) <= set(found.inliers.tolist())
    assert module._better(NOTHING, samples[:1], x, y, 1.0) is NOTHING


def test_lists_are_positions_too_and_a_small_threshold_is_one():
    x, y = side_by_side(np.random.default_rng(0), 20)
    found = ransac_fundamental(x.tolist(), y.tolist(), np.random.default_rng(1), threshold=0.5)
    assert found is not None
    assert len(found.inliers) == 20


@pytest.mark.parametrize("which", [0, 1])
def test_each_image_is_looked_at(which):
    pair = list(side_by_side(np.random.default_rng(0), 20))
    for wrong, words in (
        (np.ma.masked_less(pair[which], 50.0), "masked"),
        (np.where(pair[which] < 50.0, np.nan, pair[which]), "finite"),
        (pair[which][:, 0], "arrays, not"),
        (pair[which][:, :1], "arrays, not"),
    ):
        images = [wrong if n == which else image for n, image in enumerate(pair)]
        with pytest.raises(ValueError, match=words):
            ransac_fundamental(*images, np.random.default_rng(1))


def test_lists_of_numbers_are_no_positions():
    row = np.arange(10.0)
    with pytest.raises(ValueError, match=r"two \(N, 2\) arrays, not \(10,\) and \(10,\)"):
        ransac_fundamental(row, row, np.random.default_rng(1))


def test_positions_in_space_are_none_in_an_image():
    with pytest.raises(ValueError, match=r"two \(N, 2\) arrays, not \(10, 3\)"):
        ransac_fundamental(np.zeros((10, 3)), np.zeros((10, 3)), np.random.default_rng(1))


def test_the_first_image_is_looked_at_as_the_first_one(monkeypatch):
    seen = []

    def degenerate(rank_one: np.ndarray, *images: object) -> bool:
        seen.extend(images)
        return False

    monkeypatch.setattr(module, "_is_degenerate", degenerate)
    x, y = side_by_side(np.random.default_rng(0), 12)
    found = module._better(NOTHING, np.arange(8)[None], x, y, 2.0)
    assert_array_equal(seen[0], x[found.inliers])
    assert_array_equal(seen[1], y[found.inliers])
