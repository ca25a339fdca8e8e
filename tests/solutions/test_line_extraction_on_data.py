"""Line extraction on the course's own scans: real ones, and a corridor whose walls are known."""

import math

import numpy as np

import data
from solutions.lines.line_extraction import Settings, split_and_merge, split_and_merge_all
from solutions.lines.line_fitting import fit_line


def test_on_real_scans_both_forms_find_the_same_walls():
    scans = data.killian_court()
    chosen = scans.ranges[::40]
    found = split_and_merge_all(chosen, scans.angles)
    same = 0
    for scan, ranges in enumerate(chosen):
        expected = [segment.inliers.tolist() for segment in split_and_merge(ranges, scans.angles)]
        same += expected == [segment.inliers.tolist() for segment in found.of(scan)]
    # Ranges in whole centimetres make ties; which of two farthest points is the corner, and
    # which of two neighbours is straighter, is then up to the last bit.
    assert same >= 0.96 * len(chosen)


def test_on_real_scans_prefix_sums_lose_no_digits():
    scans = data.killian_court()
    chosen = scans.ranges[::200]
    found = split_and_merge_all(chosen, scans.angles)
    direction = np.column_stack([np.cos(scans.angles), np.sin(scans.angles)])
    for scan, ranges in enumerate(chosen):
        for segment in found.of(scan):
            line = fit_line(ranges[segment.inliers, None] * direction[segment.inliers])
            assert abs(line.r - segment.line.r) < 1e-8
            assert abs(math.remainder(line.alpha - segment.line.alpha, 2 * math.pi)) < 1e-9


def test_the_walls_of_the_corridor_are_found_and_nothing_else():
    scans, walls, wall_of_beam = data.corridor()
    settings = Settings(max_range=scans.max_range)
    found = split_and_merge_all(scans.ranges, scans.angles, settings)
    starts, ends = walls[:, :2], walls[:, 2:]
    along = (ends - starts) / np.hypot(*(ends - starts).T)[:, None]
    normal = along[:, ::-1] * [-1.0, 1.0]
    right = wrong = missed = 0
    for scan, (x, y, heading) in enumerate(scans.poses):
        turn = np.array(
            [[math.cos(heading), -math.sin(heading)], [math.sin(heading), math.cos(heading)]]
        )
        seen = set()
        for segment in found.of(scan):
            tips = np.array([segment.start, segment.end]) @ turn.T + [x, y]
            across = np.abs(np.einsum("tkx,kx->tk", tips[:, None] - starts, normal)).max(axis=0)
            seen |= set(np.flatnonzero(across < 0.06).tolist())
            right += across.min() < 0.06
            wrong += across.min() >= 0.06
        counts = np.bincount(wall_of_beam[scan][wall_of_beam[scan] >= 0], minlength=len(walls))
        missed += len(set(np.flatnonzero(counts >= 25).tolist()) - seen)
    assert wrong <= 0.05 * right
    assert missed <= 0.05 * right
