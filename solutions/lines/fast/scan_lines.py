"""Split-and-merge for many scans at once.

The same steps as `solutions.lines.line_extraction.split_and_merge`, but level by level: one NumPy
pass splits all runs of all scans, the next pass all of their parts. Prefix sums give the sums
over any run of points as one difference, so fitting a line to a run costs the same however
long it is, and merging needs no pass over the points at all.
"""

from dataclasses import dataclass, fields

import numpy as np

from solutions.lines.fast.scan_runs import RunSums, merge_runs, split_runs
from solutions.lines.line_fitting import Line
from solutions.lines.scan import (
    Segment,
    Settings,
    as_ranges,
    breaks,
    check_angles,
    check_unit,
    first_beams,
    is_bend,
    is_curved,
    is_echo,
    is_full_turn,
)

AT_ONCE = 128  # scans: their arrays fit in the processor's cache


@dataclass(frozen=True)
class ScanSegments:
    """S segments of many scans, sorted by scan and beam."""

    scan: np.ndarray  # (S,) index of the scan
    first_beam: np.ndarray  # (S,)
    last_beam: np.ndarray  # (S,) the last one, included; it may lie across a full turn's ends
    r: np.ndarray  # (S,) m
    alpha: np.ndarray  # (S,) rad
    covariance: np.ndarray  # (S, 2, 2), of (r, alpha)
    start: np.ndarray  # (S, 2) m, the foot of the first inlier
    end: np.ndarray  # (S, 2) m, the foot of the last inlier
    echo: np.ndarray  # (M, B) whether a beam of a scan has an echo

    def of(self, scan: int) -> list[Segment]:
        """Return the segments of one scan."""
        segments = []
        for i in range(*np.searchsorted(self.scan, [scan, scan + 1])):
            first, last = self.first_beam[i], self.last_beam[i]
            B = self.echo.shape[1]
            beams = (first + np.arange((last - first) % B + 1)) % B
            inliers = beams[self.echo[scan, beams]]
            line = Line(float(self.r[i]), float(self.alpha[i]))
            segments.append(Segment(line, self.start[i], self.end[i], self.covariance[i], inliers))
        return segments


def split_and_merge_all(
    ranges: np.ndarray, angles: np.ndarray, settings: Settings | None = None
) -> ScanSegments:
    """Return the walls in all scans; `ranges` is (M, B) in metres, `angles` (B,) in radians.

    The angles have to ascend. Beams without an echo (not finite, not positive, at the maximum
    range) are left out.

    Raises:
        ValueError: for arrays of other shapes, or other angles.
    """
    settings = settings or Settings()
    ranges, angles = as_ranges(ranges), np.asarray(angles, dtype=float)
    if ranges.ndim != 2 or ranges.shape[1:] != angles.shape:
        raise ValueError(
            f"Needs (M, B) ranges and (B,) angles, not {ranges.shape} and {angles.shape}."
        )
    check_angles(angles)
    check_unit(ranges, settings)
    parts = [
        _extract(ranges[scan : scan + AT_ONCE], angles, scan, settings)
        for scan in range(0, max(1, len(ranges)), AT_ONCE)
    ]
    return ScanSegments(
        *(
            np.concatenate([getattr(part, field.name) for part in parts])
            for field in fields(ScanSegments)
        )
    )


def _extract(
    ranges: np.ndarray, angles: np.ndarray, first_scan: int, settings: Settings
) -> ScanSegments:
    """Return the walls in some scans, of which the first one has the index `first_scan`."""
    full = is_full_turn(angles)
    echo_as_measured = is_echo(ranges, settings)
    offset = np.zeros(len(ranges), dtype=np.intp)
    if full:
        B = len(angles)
        offset = first_beams(ranges, angles, settings)
        order = (offset[:, None] + np.arange(B)) % B
        ranges = np.take_along_axis(ranges, order, axis=1)
        angles = angles[order] + 2 * np.pi * (order < offset[:, None])
    echo = is_echo(ranges, settings)
    scan, beam = np.nonzero(echo)
    seen = np.where(echo, ranges, 0.0)
    x, y = seen * np.cos(angles), seen * np.sin(angles)
    points = np.column_stack([x[echo], y[echo]])

    turned = angles[echo] if full else angles[beam]
    gaps = breaks(points, ranges[echo], turned, settings) | (np.diff(scan) != 0)
    ends = np.flatnonzero(gaps)
    first, last = np.append(0, ends + 1), np.append(ends, len(points) - 1)
    if not len(points):
        first, last = ends, ends

    sums = RunSums(x, y, scan, beam)
    first, last, run = split_runs(points, first, last, settings.split_distance)
    first, last, run = merge_runs(sums, first, last, run, settings.roughness)

    enough = last - first + 1 >= settings.min_neighbor_points
    first, last, run = first[enough], last[enough], run[enough]

    lines = _fit(sums, points, first, last, settings)
    wall = lines.pop("is_wall") & (last - first + 1 >= settings.min_points)
    neighbors = np.flatnonzero(lines.pop("length") >= settings.min_length / 2)
    left, right = neighbors[:-1], neighbors[1:]
    bend = is_bend(lines["alpha"][left], lines["alpha"][right], settings)
    bend &= run[left] == run[right]
    wall[left[bend]] = wall[right[bend]] = False
    return ScanSegments(
        scan=first_scan + scan[first[wall]],
        first_beam=(beam[first[wall]] + offset[scan[first[wall]]]) % echo.shape[1],
        last_beam=(beam[last[wall]] + offset[scan[last[wall]]]) % echo.shape[1],
        echo=echo_as_measured,
        **{name: column[wall] for name, column in lines.items()},
    )


def _fit(
    sums: RunSums, points: np.ndarray, first: np.ndarray, last: np.ndarray, settings: Settings
) -> dict[str, np.ndarray]:
    """Fit a line to every run; `fit_line`, `line_covariance` and `is_wall` in columns."""
    moments = sums.moments(first, last)
    r, alpha = _lines(moments)
    normal = np.column_stack([np.cos(alpha), np.sin(alpha)])
    along = np.column_stack([-np.sin(alpha), np.cos(alpha)])
    foot = r[:, None] * normal
    start = np.sum(points[first] * along, axis=1)[:, None]
    end = np.sum(points[last] * along, axis=1)[:, None]
    length = np.abs(end - start)[:, 0]
    return {
        "r": r,
        "alpha": alpha,
        "covariance": _covariances(moments, alpha, settings.sigma),
        "start": foot + start * along,
        "end": foot + end * along,
        "length": length,
        "is_wall": _are_walls(sums, first, last, r, alpha, length, settings),
    }


def _lines(moments: tuple[np.ndarray, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Return r and alpha of the best line of each run, as `fit_line` does."""
    _, x_c, y_c, S_xx, S_xy, S_yy = moments
    alpha = 0.5 * np.arctan2(-2 * S_xy, S_yy - S_xx)
    r = x_c * np.cos(alpha) + y_c * np.sin(alpha)
    alpha = np.where(r < 0, alpha + np.pi, alpha)
    alpha = np.where(alpha > np.pi, alpha - 2 * np.pi, alpha)
    return np.abs(r), alpha


def _covariances(moments: tuple[np.ndarray, ...], alpha: np.ndarray, sigma: float) -> np.ndarray:
    """Return (runs, 2, 2): the sums in `line_covariance`, written out for equal weights."""
    N, x_c, y_c, S_xx, S_xy, S_yy = moments
    lever = y_c * np.cos(alpha) - x_c * np.sin(alpha)
    R = np.hypot(S_yy - S_xx, 2 * S_xy)
    with np.errstate(divide="ignore", invalid="ignore"):
        variance = sigma**2 * (S_xx + S_yy) / R**2
    covariance = np.empty((len(alpha), 2, 2))
    covariance[:, 0, 0] = sigma**2 / N + lever**2 * variance
    covariance[:, 0, 1] = covariance[:, 1, 0] = lever * variance
    covariance[:, 1, 1] = variance
    return covariance


def _are_walls(
    sums: RunSums,
    first: np.ndarray,
    last: np.ndarray,
    r: np.ndarray,
    alpha: np.ndarray,
    length: np.ndarray,
    settings: Settings,
) -> np.ndarray:
    """Tell which runs are long and straight enough; how many points they have is not asked."""
    N, _, _, S_xx, S_xy, S_yy = sums.moments(first, last)
    _, x_middle, y_middle, *_ = sums.moments(first + N // 4, last - N // 4)
    middle = x_middle * np.cos(alpha) + y_middle * np.sin(alpha) - r
    return (
        ((S_yy != S_xx) | (S_xy != 0))  # else every direction fits as well
        & (length >= settings.min_length)
        & (sums.roughness(first, last) <= settings.roughness)
        & ~is_curved(N, length, middle, settings)
    )
