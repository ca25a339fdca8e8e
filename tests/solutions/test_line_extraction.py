import math
from itertools import pairwise

import numpy as np
import pytest

from solutions.lines.line_extraction import (
    Segment,
    Settings,
    sequential_ransac,
    split,
    split_and_merge,
    split_and_merge_all,
)
from solutions.lines.line_fitting import distances, fit_line, line_covariance

ANGLES = np.radians(np.linspace(-90, 89, 180))
HALL = {"ahead": (4.0, 0.0), "left": (3.0, math.pi / 2), "right": (2.0, -math.pi / 2)}


def hall(rng: np.random.Generator | None = None, sigma: float = 0.0) -> np.ndarray:
    """Ranges in a hall whose walls are x = 4, y = 3 and y = -2, seen from the origin."""
    with np.errstate(divide="ignore"):
        walls = [4 / np.cos(ANGLES), 3 / np.sin(ANGLES), -2 / np.sin(ANGLES)]
    ranges = np.min([np.where(wall > 0, wall, np.inf) for wall in walls], axis=0)
    return ranges if rng is None else ranges + rng.normal(0.0, sigma, ranges.shape)


def lines(segments: list[Segment]) -> list[tuple[float, float]]:
    return sorted(tuple(segment.line) for segment in segments)


def one_by_one(ranges: np.ndarray) -> list[Segment]:
    return split_and_merge(ranges, ANGLES)


def all_at_once(ranges: np.ndarray) -> list[Segment]:
    return split_and_merge_all(ranges[None], ANGLES).of(0)


def by_ransac(ranges: np.ndarray) -> list[Segment]:
    return sequential_ransac(ranges, ANGLES, np.random.default_rng(0))


METHODS = pytest.mark.parametrize("extract", [one_by_one, all_at_once, by_ransac])


@METHODS
def test_the_three_walls_of_a_hall_are_found(extract):
    segments = extract(hall())
    assert np.allclose(lines(segments), sorted(HALL.values()), atol=0.01)


@METHODS
def test_end_points_are_the_corners_of_the_hall(extract):
    (ahead,) = (segment for segment in extract(hall()) if abs(segment.line.alpha) < 0.1)
    assert ahead.start == pytest.approx([4.0, -2.0], abs=0.15)  # one beam is 8 cm at a corner
    assert ahead.end == pytest.approx([4.0, 3.0], abs=0.15)


@METHODS
def test_every_segment_is_the_fit_to_its_inliers(extract):
    ranges = hall(np.random.default_rng(1), 0.01)
    points = ranges[:, None] * np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])
    segments = extract(ranges)
    assert len(segments) == 3
    for segment in segments:
        line = fit_line(points[segment.inliers])
        assert segment.line == pytest.approx(line, abs=1e-9)
        expected = line_covariance(points[segment.inliers], Settings().sigma)
        assert segment.covariance == pytest.approx(expected, rel=1e-6, abs=1e-15)
        assert distances(np.array([segment.start, segment.end]), line) == pytest.approx([0, 0])


@METHODS
def test_no_beam_belongs_to_two_segments_and_nearly_all_belong_to_one(extract):
    segments = extract(hall(np.random.default_rng(2), 0.01))
    beams = np.concatenate([segment.inliers for segment in segments])
    assert len(beams) == len(set(beams.tolist()))
    assert len(beams) > 170


@METHODS
def test_beams_without_an_echo_are_left_out(extract):
    ranges = hall()
    broken = {20: math.inf, 60: math.nan, 61: 0.0, 100: -1.0, 140: 50.0, 141: 49.0}
    for beam, value in broken.items():
        ranges[beam] = value
    segments = extract(ranges)
    assert np.allclose(lines(segments), sorted(HALL.values()), atol=0.01)
    assert not set(broken) & {int(beam) for segment in segments for beam in segment.inliers}


@METHODS
def test_a_person_hides_part_of_a_wall_and_is_not_a_wall(extract):
    ranges = hall()
    person = np.abs(ANGLES - 0.1) < 0.15
    ranges[person] = 1.5 - 0.1 * np.cos((ANGLES[person] - 0.1) / 0.15 * math.pi / 2)
    segments = extract(ranges)
    assert all(not person[segment.inliers].any() for segment in segments)
    ahead = [segment for segment in segments if segment.line == pytest.approx((4, 0), abs=0.02)]
    assert len(ahead) in (1, 2)  # in one piece or, for those that need neighbours, in two
    assert len(segments) == len(ahead) + 2


@METHODS
def test_neither_a_round_room_nor_scattered_points_are_walls(extract):
    assert extract(np.full(180, 2.0)) == []
    assert extract(np.random.default_rng(3).uniform(1, 8, 180)) == []


@METHODS
@pytest.mark.parametrize("ranges", [np.full(180, np.inf), np.r_[1.0, np.full(179, 60.0)]])
def test_an_empty_scan_has_no_walls(extract, ranges):
    assert extract(ranges) == []


def test_errors_of_r_and_alpha_are_as_large_as_the_covariance_says():
    rng = np.random.default_rng(4)
    found = split_and_merge_all(np.stack([hall(rng, 0.01) for _ in range(400)]), ANGLES)
    for expected in HALL.values():
        error = np.column_stack([found.r, found.alpha]) - expected
        near = np.abs(error).max(axis=1) < 0.2
        assert near.sum() == 400
        weighed = np.einsum(
            "ni,nij,nj->n", error[near], np.linalg.inv(found.covariance[near]), error[near]
        )
        # Noise is along the beam, so across the wall it is smaller than assumed: below 2.
        assert 0.3 < weighed.mean() < 2.2


def clutter(rng: np.random.Generator) -> np.ndarray:
    """A noisy hall with things in it and lost echoes."""
    ranges = hall(rng, 0.01)
    for _ in range(3):
        first, width = rng.integers(0, 160), rng.integers(1, 20)
        ranges[first : first + width] *= rng.uniform(0.3, 0.9)
    ranges[rng.uniform(size=180) < 0.02] = 50.0
    return ranges


def test_all_scans_at_once_give_what_one_after_the_other_gives():
    rng = np.random.default_rng(5)
    scans = np.stack([clutter(rng) for _ in range(150)])  # more than one block
    found = split_and_merge_all(scans, ANGLES)
    for scan, ranges in enumerate(scans):
        expected, segments = split_and_merge(ranges, ANGLES), found.of(scan)
        assert len(segments) == len(expected) > 0
        for one, other in zip(expected, segments, strict=True):
            assert one.inliers.tolist() == other.inliers.tolist()
            assert one.line == pytest.approx(other.line, abs=1e-9)
            assert one.start == pytest.approx(other.start, abs=1e-9)
            assert one.end == pytest.approx(other.end, abs=1e-9)
            assert one.covariance == pytest.approx(other.covariance, rel=1e-5, abs=1e-12)


def test_a_corner_splits_a_run_behind_its_farthest_point():
    points = np.array([[0, 0], [1, 0], [2, 0], [3, 0], [3, 1], [3, 2], [3, 3]], dtype=float)
    assert split(points, 0.1) == [(0, 3), (4, 6)]
    assert split(points, 2.2) == [(0, 6)]  # the corner is 3/sqrt(2) = 2.12 from the chord


@pytest.mark.parametrize("count", [0, 1, 2])
def test_up_to_two_points_are_never_split(count):
    assert split(np.arange(2.0 * count).reshape(count, 2), 0.1) == [(0, count - 1)] * (count > 0)


def test_pieces_of_a_split_follow_each_other_and_are_close_to_their_chords():
    rng = np.random.default_rng(6)
    points = np.cumsum(rng.normal(size=(200, 2)), axis=0)
    pieces = split(points, 0.8)
    assert pieces[0][0] == 0
    assert pieces[-1][1] == 199
    assert all(end + 1 == start for (_, end), (start, _) in pairwise(pieces))
    for start, end in pieces:
        if end - start > 1:
            chord = fit_line(points[[start, end]])
            assert np.abs(distances(points[start : end + 1], chord)).max() <= 0.8 + 1e-9


def test_wrong_shapes_are_explained():
    with pytest.raises(ValueError, match="as many ranges as angles"):
        split_and_merge(np.ones(5), ANGLES)
    with pytest.raises(ValueError, match=r"\(M, B\) ranges and \(B,\) angles"):
        split_and_merge_all(np.ones(180), ANGLES)


def test_no_scans_at_all_have_no_segments():
    assert len(split_and_merge_all(np.empty((0, 180)), ANGLES).scan) == 0


@pytest.mark.parametrize("extract", [one_by_one, all_at_once])
def test_beams_that_turn_to_the_right_are_refused(extract, monkeypatch):
    monkeypatch.setattr(f"{__name__}.ANGLES", ANGLES[::-1])
    with pytest.raises(ValueError, match="angles must grow from beam to beam"):
        extract(hall())
    assert len(by_ransac(hall())) == 3  # which does not use their order


@pytest.mark.parametrize("min_points", [2, 3, 4])
def test_walls_of_very_few_points_may_be_asked_for(min_points):
    settings = Settings(min_points=min_points)
    rng = np.random.default_rng(6)
    for ranges in [hall(), *(clutter(rng) for _ in range(20))]:
        found = split_and_merge_all(ranges[None], ANGLES, settings).of(0)
        one_after_the_other = split_and_merge(ranges, ANGLES, settings)
        np.testing.assert_allclose(lines(found), lines(one_after_the_other), atol=1e-9)
        for segments in (found, sequential_ransac(ranges, ANGLES, rng, settings)):
            assert min(len(segment.inliers) for segment in segments) >= min_points


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ({"min_points": 1}, "A wall needs two points: min_points=1 is too few"),
        ({"roughness": -0.01}, "roughness must be a number, and not negative"),
        ({"min_length": math.nan}, "min_length must be a number"),
    ],
)
def test_settings_that_make_no_sense_are_named(setting, message):
    with pytest.raises(ValueError, match=message):
        Settings(**setting)
