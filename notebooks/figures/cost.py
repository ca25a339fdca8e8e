"""Pictures of the cost S(r, alpha), evaluated straight from its definition."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from notebooks.figures.style import (
    BLUE,
    GRAY,
    GREEN,
    ORANGE,
    VERMILLION,
    draw_line,
    figure,
    plan,
    quiet,
    show,
)


def _cost(points: np.ndarray, r: float, alpha: float) -> float:
    """Return S in square metres: equation 2 of the sheet, word for word."""
    x, y = points.T
    return float(np.sum((r - x * np.cos(alpha) - y * np.sin(alpha)) ** 2))


def squared_distances(points: np.ndarray, line: Any) -> None:
    """Draw the squares whose areas make up the cost of a line (r, alpha)."""
    r, alpha = line
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    along = np.array([-normal[1], normal[0]])
    fig = figure(6.4, 4.4)
    axes = fig.subplots()
    plan(
        axes, f"r = {r:.2f} m, α = {np.degrees(alpha):.0f}°:  S = {_cost(points, r, alpha):.2f} m²"
    )
    axes.plot(*points.T, "o", color=BLUE, markersize=6, zorder=3)
    axes.plot(0, 0, "k+", markersize=10)
    axes.set_xlim(-0.5, 5.5)
    axes.set_ylim(-0.5, 3.5)
    draw_line(axes, r, alpha, color=VERMILLION, linewidth=2)
    for point, distance in zip(points, points @ normal - r, strict=True):
        foot = point - distance * normal
        corners = [point, foot, foot + distance * along, point + distance * along]
        axes.fill(*np.array(corners).T, color=ORANGE, alpha=0.35, linewidth=0)
        axes.plot(*np.array([point, foot]).T, color=VERMILLION, linewidth=1)
    show(
        fig,
        f"{len(points)} points, a line, and a square on each point's distance from it. "
        f"The squares add up to S = {_cost(points, r, alpha):.2f} square metres.",
    )


def cost_over_angle(clouds: dict[str, np.ndarray], angle: object = None) -> None:
    """Draw S over alpha for each cloud, always with the best r, and mark hill and valley.

    `angle` is the student's expression in S_xx, S_yy, S_xy (sympy); it is marked on each curve
    once it is there.
    """
    fig = figure(8, 6.0)
    panels = fig.subplots(2, len(clouds), squeeze=False, height_ratios=[1.15, 1])
    said = []
    for column, (name, points) in enumerate(clouds.items()):
        turns = np.radians(np.arange(-90.0, 90.25, 0.25))
        # For a given alpha the best r is the mean distance in that direction.
        reach = points @ np.array([np.cos(turns), np.sin(turns)])
        costs = ((reach - reach.mean(axis=0)) ** 2).sum(axis=0)
        valley, hill = int(costs.argmin()), int(costs.argmax())
        above, below = panels[:, column]
        _cloud(above, points, reach, turns, valley, hill)
        above.set_title(name)
        below.plot(np.degrees(turns), costs, color=GRAY, linewidth=2)
        below.plot(np.degrees(turns[valley]), costs[valley], "o", color=GREEN, markersize=10)
        below.plot(np.degrees(turns[hill]), costs[hill], "s", color=VERMILLION, markersize=9)
        found = _value(angle, points)
        if found is not None:
            wrapped = (found + np.pi / 2) % np.pi - np.pi / 2
            below.axvline(np.degrees(wrapped), color="black", linestyle=":", linewidth=2)
            below.text(
                np.degrees(wrapped),
                1.02,
                "your angle",
                transform=below.get_xaxis_transform(),
                ha="center",
            )
        below.set_xlabel("α [degrees]")
        below.set_ylabel("S [m²]")
        below.set_xticks([-90, -45, 0, 45, 90])
        below.set_ylim(-0.05 * costs.max(), 1.1 * costs.max())
        quiet(below)
        said.append(
            f"{name}: valley at {np.degrees(turns[valley]):.0f}°, hill at "
            f"{np.degrees(turns[hill]):.0f}°"
        )
    show(fig, "The cost over the angle has one valley and one hill. " + "; ".join(said) + ".")


def _cloud(
    axes: Axes,
    points: np.ndarray,
    reach: np.ndarray,
    turns: np.ndarray,
    valley: int,
    hill: int,
) -> None:
    """Draw the points with the line of the valley and the line of the hill."""
    plan(axes)
    axes.plot(*points.T, "o", color=BLUE, markersize=4)
    axes.set_xlim(-1, 5)
    axes.set_ylim(-0.5, 4)
    for index, color, style in ((valley, GREEN, "-"), (hill, VERMILLION, "--")):
        draw_line(
            axes,
            reach[:, index].mean(),
            turns[index],
            color=color,
            linestyle=style,
            linewidth=2,
            label="valley of S" if index == valley else "hill of S",
        )
    axes.legend(loc="upper right", fontsize=8)


def _value(angle: Any, points: np.ndarray) -> float | None:
    """Return the student's expression for these points, or None while there is none."""
    if not hasattr(angle, "free_symbols"):
        return None
    x, y = (points - points.mean(axis=0)).T
    sums = {"S_xx": x @ x, "S_yy": y @ y, "S_xy": x @ y}
    known = {symbol: sums[symbol.name] for symbol in angle.free_symbols if symbol.name in sums}
    value = angle.subs(known)
    return float(value) if value.is_real else None
