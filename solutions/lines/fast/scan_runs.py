"""Splitting and merging the runs of many scans at once.

A run is a pair of indices (first, last) into the echoes of all scans, in one long row.
"""

import numpy as np

from solutions.lines.scan import SAME_DISTANCE


class RunSums:
    """The sums over any run, each as one difference of prefix sums.

    The prefix sums start anew with every scan, so they stay small and exact.
    """

    def __init__(self, x: np.ndarray, y: np.ndarray, scan: np.ndarray, beam: np.ndarray) -> None:
        """Take (M, B) coordinates, 0 without an echo, and the N echoes' scans and beams."""
        M, B = x.shape
        prefix = np.zeros((5, M, B + 1))
        for row, term in zip(prefix, (x, y, x * x, x * y, y * y), strict=True):
            np.cumsum(term, axis=1, out=row[:, 1:])
        self._prefix = prefix.reshape(5, -1)
        self._position = scan * (B + 1) + beam

    def moments(self, first: np.ndarray, last: np.ndarray) -> tuple[np.ndarray, ...]:
        """Return N, x_c, y_c and the centred sums S_xx, S_xy, S_yy: six arrays (R,) for R runs."""
        before, after = self._position[first], self._position[last] + 1
        x, y, xx, xy, yy = self._prefix[:, after] - self._prefix[:, before]
        N = last - first + 1
        return N, x / N, y / N, xx - x * x / N, xy - x * y / N, yy - y * y / N

    def roughness(self, first: np.ndarray, last: np.ndarray) -> np.ndarray:
        """Return (R,) root mean square distances of the runs from their best lines, in metres."""
        N, _, _, S_xx, S_xy, S_yy = self.moments(first, last)
        least = (S_xx + S_yy - np.hypot(S_yy - S_xx, 2 * S_xy)) / 2
        return np.sqrt(np.maximum(least, 0.0) / N)


def split_runs(
    points: np.ndarray, first: np.ndarray, last: np.ndarray, distance: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the pieces of the runs, in order: first and last point, and the run's number.

    `points` is (N, 2) in metres; `first` and `last` hold the indices of R runs. What is returned
    has one entry for each piece.
    """
    run = np.arange(len(first))
    x, y = np.ascontiguousarray(points.T)
    straight = [(first[:0], last[:0], run[:0])]
    while len(first):
        short = last - first < 2
        straight.append((first[short], last[short], run[short]))
        first, last, run = first[~short], last[~short], run[~short]
        if not len(first):
            break
        # All points of all runs, one run after the other.
        lengths = last - first + 1
        offsets = np.cumsum(lengths) - lengths
        members = np.arange(lengths.sum()) + np.repeat(first - offsets, lengths)
        dx, dy = x[last] - x[first], y[last] - y[first]
        chord = np.maximum(np.hypot(dx, dy), 1e-12)
        nx, ny = -dy / chord, dx / chord
        r = nx * x[first] + ny * y[first]
        offset = np.repeat(nx, lengths) * x[members] + np.repeat(ny, lengths) * y[members]
        offset = np.abs(offset - np.repeat(r, lengths))
        farthest = np.maximum.reduceat(offset, offsets)
        split = farthest > distance
        straight.append((first[~split], last[~split], run[~split]))

        # The first of the farthest points is the corner; it ends the left part.
        corner_distance = np.where(split, farthest - SAME_DISTANCE, np.inf)
        at_corner = np.flatnonzero(offset >= np.repeat(corner_distance, lengths))
        owner = np.repeat(np.arange(len(first)), lengths)[at_corner]
        corner = members[at_corner[np.unique(owner, return_index=True)[1]]]
        first = np.concatenate([first[split], corner + 1])
        last = np.concatenate([corner, last[split]])
        run = np.tile(run[split], 2)
    first, last, run = (np.concatenate(parts) for parts in zip(*straight, strict=True))
    order = np.argsort(first)
    return first[order], last[order], run[order]


def merge_runs(
    sums: RunSums, first: np.ndarray, last: np.ndarray, run: np.ndarray, roughness: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Join the straightest two neighbours of every run at once, as long as they are straight.

    `first`, `last` and `run`, each (P,), hold the indices and the run of P pieces; what is
    returned holds those of the pieces that are left. `roughness` is in metres.
    """
    settled = [(first[:0], last[:0], run[:0])]
    while len(first):
        cost = np.full(len(first), np.inf)  # of joining a piece with the next one
        pair = np.flatnonzero(run[:-1] == run[1:])
        # To 0.1 mm, so that any two single points cost the same; the first pair then goes first.
        cost[pair] = np.round(sums.roughness(first[pair], last[pair + 1]), 4)
        run_starts = np.flatnonzero(np.diff(run, prepend=-1))
        lengths = np.diff(run_starts, append=len(run))
        cheapest = np.minimum.reduceat(cost, run_starts)
        goes_on = cheapest <= roughness  # the other runs are settled
        keep = np.repeat(goes_on, lengths)
        settled.append((first[~keep], last[~keep], run[~keep]))

        best = np.flatnonzero(keep & (cost == np.repeat(cheapest, lengths)))
        best = best[np.unique(run[best], return_index=True)[1]]
        last[best] = last[best + 1]
        keep[best + 1] = False
        first, last, run = first[keep], last[keep], run[keep]
    first, last, run = (np.concatenate(parts) for parts in zip(*settled, strict=True))
    order = np.argsort(first)
    return first[order], last[order], run[order]
