"""Pictures of RANSAC at work: a hypothesis, its inliers, its outliers."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from notebooks.figures.style import (
    BLUE,
    GRAY,
    GREEN,
    ORANGE,
    SKY,
    VERMILLION,
    StudentFunction,
    attempt,
    draw_line,
    figure,
    not_written,
    note,
    plan,
    show,
)


def _inliers(points: np.ndarray, line: Any, threshold: float) -> np.ndarray:
    r, alpha = line
    return np.abs(points @ [np.cos(alpha), np.sin(alpha)] - r) <= threshold


def _band(axes: Axes, line: Any, threshold: float) -> None:
    """Shade what is closer to the line than the threshold."""
    r, alpha = line
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    along = 50.0 * np.array([-normal[1], normal[0]])
    near, far = (r - threshold) * normal, (r + threshold) * normal
    limits = axes.get_xlim(), axes.get_ylim()
    axes.fill(
        *np.array([near - along, near + along, far + along, far - along]).T,
        color=SKY,
        alpha=0.3,
        linewidth=0,
    )
    axes.set_xlim(limits[0])
    axes.set_ylim(limits[1])


def _votes(axes: Axes, points: np.ndarray, inliers: np.ndarray, size: float = 7) -> None:
    axes.plot(*points[inliers].T, "o", color=BLUE, markersize=size, label="inlier")
    axes.plot(*points[~inliers].T, "x", color=VERMILLION, markersize=size, label="outlier", mew=1.8)


def _frame(axes: Axes, points: np.ndarray, margin: float = 0.4) -> None:
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])


def few_points() -> np.ndarray:
    """Return the (26, 2) points of Figure 3: 16 along r = 2, alpha = 115°, 10 elsewhere."""
    rng = np.random.default_rng(3)
    alpha = np.radians(115)
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    along = np.array([normal[1], -normal[0]])
    positions = np.sort(rng.uniform(0, 6, 16))
    wall = np.outer(2 + rng.uniform(-0.25, 0.25, 16), normal) + np.outer(positions, along)
    others = rng.uniform([-1, 0], [6, 6], (200, 2))
    others = others[np.abs(others @ normal - 2) > 0.5][:10]
    return np.vstack([wall, others])


def hypothesis(points: np.ndarray, line: Any, threshold: float) -> None:
    """Draw Figure 3: a line (r, alpha), its band, and the points that agree with it or do not."""
    fig = figure(7, 4.6)
    axes = fig.subplots()
    inliers = _inliers(points, line, threshold)
    count = int(inliers.sum())
    plan(axes, f"{count} inliers, {len(points) - count} outliers")
    _frame(axes, points)
    _band(axes, line, threshold)
    draw_line(axes, *line, color="black", linewidth=2)
    _votes(axes, points, inliers)
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    show(
        fig,
        f"A line through {len(points)} points with a band of {threshold} m on both sides. "
        f"{count} points lie in the band (inliers), {len(points) - count} outside (outliers).",
    )


def guesses(points: np.ndarray, threshold: float, rng: np.random.Generator) -> None:
    """Draw six samples of two of the (N, 2) points, the line through each, and its votes."""
    fig = figure(8, 5.4)
    counts = []
    for axes in fig.subplots(2, 3).flat:
        pair = points[rng.choice(len(points), 2, replace=False)]
        across = np.array([[0, -1], [1, 0]]) @ (pair[1] - pair[0])
        alpha = float(np.arctan2(across[1], across[0]))
        line = (float(pair[0] @ [np.cos(alpha), np.sin(alpha)]), alpha)
        inliers = _inliers(points, line, threshold)
        counts.append(int(inliers.sum()))
        plan(axes, f"{counts[-1]} points agree")
        axes.set_xlabel("")
        axes.set_ylabel("")
        _frame(axes, points)
        _band(axes, line, threshold)
        draw_line(axes, *line, color="black", linewidth=1.5)
        _votes(axes, points, inliers, size=4)
        axes.plot(*pair.T, "o", color=ORANGE, markersize=9, mec="black", zorder=5)
    fig.supxlabel("x [m]")
    fig.supylabel("y [m]")
    show(
        fig,
        "Six guesses. In each, two random points (orange) define a line; "
        f"the numbers of points that agree are {', '.join(map(str, counts))}.",
    )


def found_line(
    points: np.ndarray, ransac_line: StudentFunction, threshold: float, iterations: int
) -> None:
    """Draw the (N, 2) points, and the line and inliers that the student's ransac_line finds."""
    fig = figure(7, 4.6)
    axes = fig.subplots()
    plan(axes)
    _frame(axes, points)
    found = attempt(ransac_line, points, threshold, iterations, np.random.default_rng(1))
    if found is None:
        axes.plot(*points.T, "o", color=GRAY, markersize=4)
        note(axes, not_written(ransac_line))
        show(fig, f"{len(points)} points. {not_written(ransac_line)}")
        return
    line, indices = found
    inliers = np.isin(np.arange(len(points)), indices)
    _band(axes, line, threshold)
    _votes(axes, points, inliers, size=4)
    draw_line(axes, *line, color=GREEN, linewidth=2)
    axes.set_title(f"{inliers.sum()} of {len(points)} points agree after {iterations} iterations")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    show(fig, f"The line found by RANSAC in {len(points)} points; {inliers.sum()} of them agree.")
