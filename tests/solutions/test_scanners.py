"""Line extraction with the scanners that robots carry: fine beams, full turns, coarse readings."""

import math
from dataclasses import replace

import numpy as np
import pytest

from solutions.lines import scanners
from solutions.lines.line_extraction import Settings, split_and_merge, split_and_merge_all
from solutions.lines.scan import is_full_turn

ROOM = (4.0, 3.0, 2.0, 2.5)  # m, the distances of four walls from the scanner
TURN = 2 * math.pi


def room(
    angles: np.ndarray, turned: float, distances: tuple[float, ...] = ROOM
) -> tuple[np.ndarray, np.ndarray]:
    """Ranges in a rectangular room around the scanner, and which wall each beam meets."""
    walls = turned + np.arange(4) * math.pi / 2
    across = np.cos(angles - walls[:, None])
    with np.errstate(divide="ignore"):
        ranges = np.where(across > 1e-9, np.array(distances)[:, None] / across, np.inf)
    return ranges.min(axis=0), ranges.argmin(axis=0)


def beams(start: float, stop: float, step: float) -> np.ndarray:
    return np.radians(np.arange(round((stop - start) / step)) * step + start)


@pytest.mark.parametrize("step", [0.1, 0.125, 0.25, 0.5])
@pytest.mark.parametrize("near", [1.0, 4.0])
def test_a_flat_wall_stays_whole_however_fine_the_beams_are(step, near):
    angles = beams(-60, 60, step)
    for seed in range(4):
        noise = np.random.default_rng(seed).normal(0, 0.01, angles.shape)
        (wall,) = split_and_merge(near / np.cos(angles) + noise, angles)
        assert len(wall.inliers) == len(angles)


def test_a_gap_that_is_wider_than_noise_still_parts_two_walls():
    angles = beams(-60, 60, 0.25)
    ranges = np.where(np.abs(angles) < 0.05, 6.0, 2 / np.cos(angles))  # a door stands open
    left, right = split_and_merge(ranges, angles)
    assert len(left.inliers) + len(right.inliers) == np.count_nonzero(np.abs(angles) >= 0.05)


@pytest.mark.parametrize("start", [-180.0, 0.0, 37.0])
@pytest.mark.parametrize("step", [0.25, 1.0])
def test_a_full_turn_has_no_seam(start, step):
    angles = beams(start, start + 360, step)
    for seed in range(4):
        rng = np.random.default_rng(seed)
        ranges, wall = room(angles, rng.uniform(-0.7, 0.7))
        ranges = ranges + rng.normal(0, 0.01, angles.shape)
        segments = split_and_merge(ranges, angles)
        assert len(segments) == 4
        for segment in segments:
            # All beams are one wall's, but for a few at its two corners, where noise decides.
            counts = np.bincount(wall[segment.inliers], minlength=4)
            assert counts.max() >= len(segment.inliers) - 5


def test_the_wall_behind_the_robot_is_one_wall_in_the_order_of_its_beams():
    angles = beams(-180, 180, 1)
    (behind,) = (
        segment
        for segment in split_and_merge(room(angles, 0.0)[0], angles)
        if abs(segment.line.alpha) > 3
    )
    assert behind.line == pytest.approx((2.0, math.pi))
    beyond = int(np.flatnonzero(np.diff(behind.inliers) < 0)[0])
    assert behind.inliers[beyond] == 359
    assert behind.inliers[beyond + 1] == 0
    assert behind.start[1] == pytest.approx(3.0, abs=0.2)  # from its left end, as the beams go
    assert behind.end[1] == pytest.approx(-2.5, abs=0.2)


@pytest.mark.parametrize("span", [180, 270, 360])
@pytest.mark.parametrize("step", [0.25, 1.0])
def test_one_scan_and_many_give_the_same(span, step):
    angles = beams(-span / 2, span / 2, step)
    rng = np.random.default_rng(8)
    scans = np.stack([room(angles, rng.uniform(-0.7, 0.7))[0] for _ in range(20)])
    scans += rng.normal(0, 0.02, scans.shape)
    scans[rng.random(scans.shape) < 0.1] = np.inf  # no echo
    scans[3, :] = np.nan
    scans[4, 1:] = 0.0
    person = rng.integers(0, len(angles) - 20, 20)
    for scan, first in zip(scans, person, strict=True):
        scan[first : first + round(15 / step)] = 0.8
    together = split_and_merge_all(scans, angles)
    for number, scan in enumerate(scans):
        alone = split_and_merge(scan, angles)
        found = {tuple(segment.inliers): segment.line for segment in together.of(number)}
        assert found.keys() == {tuple(segment.inliers) for segment in alone}
        for segment in alone:
            assert found[tuple(segment.inliers)] == pytest.approx(segment.line, abs=1e-9)


def test_a_turn_with_one_beam_missing_is_a_full_turn_and_270_degrees_are_not():
    assert is_full_turn(beams(0, 360, 1))
    assert is_full_turn(np.linspace(0, TURN, 361))  # the first direction once more at the end
    assert not is_full_turn(beams(0, 270, 1))
    assert not is_full_turn(np.array([0.0, 1.0]))


def test_more_than_a_full_turn_is_refused():
    with pytest.raises(ValueError, match="more than once round"):
        split_and_merge(np.ones(400), beams(0, 400, 1))


@pytest.mark.parametrize(
    ("settings", "angles", "sigma", "unit", "distances"),
    [
        (scanners.SICK_LMS_200, beams(-90, 90.5, 0.5), 0.01, 0.01, ROOM),
        (scanners.SICK_PLS_101, beams(-90, 90.5, 0.5), 0.015, 0.05, ROOM),
        (scanners.HOKUYO_UTM_30LX, beams(-135, 135.25, 0.25), 0.02, 0.001, (8.0, 6.0, 4.0, 5.0)),
        (scanners.ROBOTIS_LDS_01, beams(0, 360, 1), 0.015, 0.001, (2.0, 1.5, 1.0, 1.2)),
    ],
    ids=["LMS 200", "PLS 101", "UTM-30LX", "LDS-01"],
)
def test_each_scanner_sees_a_room_with_the_settings_for_it(
    settings, angles, sigma, unit, distances
):
    for seed in range(8):
        rng = np.random.default_rng(seed)
        turned = rng.uniform(-0.7, 0.7)
        ranges, wall = room(angles, turned, distances)
        ranges = np.round((ranges + rng.normal(0, sigma, ranges.shape)) / unit) * unit
        segments = split_and_merge(ranges, angles, settings)
        explained = sum(len(segment.inliers) for segment in segments)
        assert explained > 0.9 * np.count_nonzero(ranges < settings.max_range)
        # Every wall that is seen well is found where it stands.
        for number in np.flatnonzero(np.bincount(wall, minlength=4) > 3 * settings.min_points):
            direction = turned + number * math.pi / 2
            assert any(
                abs(math.remainder(segment.line.alpha - direction, TURN)) < math.radians(4)
                and abs(segment.line.r - distances[number]) < 2 * sigma + unit
                for segment in segments
            )


def test_noise_beyond_the_settings_breaks_walls_which_the_settings_for_it_do_not():
    """Whole steps of 5 cm are rougher than the defaults allow."""
    angles = beams(-60, 60, 1)
    ranges = np.round(4 / np.cos(angles) / 0.05) * 0.05
    ranges += 0.05 * np.random.default_rng(0).integers(-1, 2, ranges.shape)
    rough = split_and_merge(ranges, angles, Settings())
    fitting = split_and_merge(ranges, angles, replace(scanners.SICK_PLS_101, sigma=0.04))
    assert sum(len(wall.inliers) for wall in rough) < 60
    assert sum(len(wall.inliers) for wall in fitting) > 110


@pytest.mark.parametrize("step", [0.1, 0.125, 0.25, 0.36, 0.5, 1.0])
@pytest.mark.parametrize("turned", [0.0, 0.3, math.pi / 4, 1.0])
def test_one_scan_and_many_give_the_same_without_noise(step, turned):
    """Where a beam meets a corner, both walls fit it as well, to the last digit."""
    angles = beams(-180, 180, step)
    ranges, _ = room(angles, turned)
    found = split_and_merge_all(ranges[None], angles).of(0)
    for one, other in zip(split_and_merge(ranges, angles), found, strict=True):
        assert (one.inliers == other.inliers).all()
        assert one.line.r == pytest.approx(other.line.r, abs=1e-9)
        assert math.cos(one.line.alpha - other.line.alpha) == pytest.approx(1)  # pi is near -pi


@pytest.mark.parametrize("dtype", [int, np.uint16, float])
def test_millimetres_are_refused_and_not_taken_for_beams_without_an_echo(dtype):
    angles = beams(-90, 90.5, 0.5)
    millimetres = (1000 * room(angles, 0.1)[0]).astype(dtype)
    millimetres[::7] = 0
    for extract in (split_and_merge, lambda scan, angles: split_and_merge_all(scan[None], angles)):
        with pytest.raises(ValueError, match=r"Ranges are in metres.*Divide millimetres by 1000"):
            extract(millimetres, angles)


@pytest.mark.parametrize("nothing", [0.0, 81.83, 1000.0, np.inf, np.nan, -1.0])
def test_a_scan_without_an_echo_has_no_walls_whatever_its_readings_stand_for(nothing):
    angles = beams(-90, 90.5, 0.5)
    ranges = np.full(len(angles), nothing)
    assert split_and_merge(ranges, angles) == []
    assert split_and_merge_all(ranges[None], angles).of(0) == []


def test_degrees_and_endless_angles_are_refused():
    with pytest.raises(ValueError, match="angles are in radians"):
        split_and_merge(np.ones(181), np.arange(-90.0, 91.0))
    with pytest.raises(ValueError, match="must grow"):
        split_and_merge(np.ones(3), np.array([0.0, 0.1, np.inf]))
