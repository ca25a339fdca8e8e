"""Pictures of lines: why a slope is not enough, and what r and alpha mean."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc

from notebooks.figures.style import (
    BLUE,
    GRAY,
    GREEN,
    VERMILLION,
    draw_line,
    figure,
    plan,
    show,
)


def steep_walls(wall: np.ndarray, degrees: tuple[float, ...] = (20, 70, 85, 90)) -> None:
    """Turn a wall more and more upright and fit y = mx + b to it each time.

    `wall` is an (N, 2) array of points along the x-axis, in metres.
    """
    fig = figure(8, 3.1)
    panels = fig.subplots(1, len(degrees), sharex=True, sharey=True)
    slopes = []
    for axes, turn in zip(panels, degrees, strict=True):
        cosine, sine = np.cos(np.radians(turn)), np.sin(np.radians(turn))
        x, y = (wall @ np.array([[cosine, sine], [-sine, cosine]])).T
        slope, intercept = np.polyfit(x, y, 1)
        slopes.append(slope)
        axes.plot(x, y, ".", color=GRAY, markersize=5)
        ends = np.array([-3.0, 3.0])
        axes.plot(ends, slope * ends + intercept, color=VERMILLION, linewidth=2)
        plan(axes, f"wall at {turn:.0f}°\nm = {slope:.2f}, true {_tangent(turn)}")
        axes.set_xlim(-2.6, 2.6)
        axes.set_ylim(-2.6, 2.6)
    for axes in panels[1:]:
        axes.set_ylabel("")
    show(
        fig,
        "One wall, turned more and more upright, with the fit of y = mx + b in each panel. "
        f"Slopes found: {', '.join(f'{slope:.2f}' for slope in slopes)}. "
        "The steeper the wall, the worse the fit; the vertical one is missed completely.",
    )


def _tangent(degrees: float) -> str:
    return "∞" if degrees == 90 else f"{np.tan(np.radians(degrees)):.2f}"


def _polar(axes: Axes, r: float, alpha: float, label: bool = True) -> None:
    """Draw one line with its shortest connection to the origin and its angle."""
    foot = r * np.array([np.cos(alpha), np.sin(alpha)])
    draw_line(axes, r, alpha, color=BLUE, linewidth=2.5)
    axes.plot([0, foot[0]], [0, foot[1]], color=VERMILLION, linewidth=2)
    axes.plot(0, 0, "ko", markersize=5, zorder=4)
    radius = 0.55 * max(r, 0.8)
    low, high = sorted((0.0, float(np.degrees(alpha))))
    axes.add_patch(
        Arc((0, 0), 2 * radius, 2 * radius, theta1=low, theta2=high, color=GREEN, linewidth=2)
    )
    if label:
        x, y = 1.28 * radius * np.cos(alpha / 2), 1.28 * radius * np.sin(alpha / 2)
        axes.text(x, y, "α", color=GREEN, size=15, ha="center", va="center")
        beside = 0.62 * foot + 0.17 * np.array([-np.sin(alpha), np.cos(alpha)])
        axes.text(
            beside[0], beside[1], "r", color=VERMILLION, fontsize=15, ha="center", va="center"
        )


def polar_line(r: float, alpha: float) -> None:
    """Draw Figure 2: a line, its distance r from the origin and its normal's angle alpha (rad)."""
    fig = figure(6, 4.2)
    axes = fig.subplots()
    plan(axes)
    axes.set_xlim(-0.6, 3.4)
    axes.set_ylim(-0.5, 2.5)
    axes.axhline(0, color="black", linewidth=0.8)
    axes.axvline(0, color="black", linewidth=0.8)
    _polar(axes, r, alpha)
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    along = np.array([-normal[1], normal[0]])
    corner = r * normal
    square = np.array([along, along - normal, -normal]) * 0.12 + corner
    axes.plot(*square.T, color="black", linewidth=1)
    point = corner + 1.05 * along
    axes.plot(*point, "o", color=BLUE, markersize=8)
    axes.annotate(
        "(x, y)", (point[0], point[1]), xytext=(8, 6), textcoords="offset points", fontsize=12
    )
    axes.set_title("x cos α + y sin α = r")
    show(
        fig,
        f"A line in the plane. A segment of length r = {r:.2f} m goes from the origin to the line "
        "and meets it at a right angle; it makes the angle "
        f"α = {np.degrees(alpha):.0f}° with the x-axis.",
    )


def polar_lines(lines: list[tuple[float, float]]) -> None:
    """Draw several lines (r, alpha) side by side, three in a row."""
    rows = -(-len(lines) // 3)
    fig = figure(8, 2.9 * rows)
    panels = list(fig.subplots(rows, 3, squeeze=False).flat)
    for axes in panels[len(lines) :]:
        axes.set_visible(False)
    for axes, (r, alpha) in zip(panels, lines, strict=False):
        plan(axes, f"r = {r:.1f} m, α = {np.degrees(alpha):.0f}°")
        axes.set_xlim(-3, 3)
        axes.set_ylim(-3, 3)
        _polar(axes, r, alpha, label=False)
    show(fig, f"{len(lines)} lines with different distances r and angles α of their normals.")
