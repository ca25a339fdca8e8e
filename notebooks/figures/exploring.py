"""Still pictures of the explorers, for where no widget can be drawn."""

from typing import Any

import numpy as np

from notebooks.explorers.still import consensus
from notebooks.figures.consensus import _band, _frame, _votes
from notebooks.figures.style import (
    BLUE,
    GRAY,
    ORANGE,
    VERMILLION,
    draw_line,
    figure,
    plan,
    predicted_beside,
    quiet,
    show,
)

BAND = 0.3  # m, half the width of the band in which points agree with a line, as in cloud.js


def ransac_steps(points: np.ndarray, run: Any, threshold: float) -> None:
    """Draw what a run of RANSAC found in (N, 2) points, and the samples it asked for after each."""
    fig = figure(8, 4)
    scene, asked = fig.subplots(1, 2)
    first, second = points[list(run.pair)]
    across = np.array([[0, -1], [1, 0]]) @ (second - first)
    alpha = float(np.arctan2(across[1], across[0]))
    line = (float(first @ [np.cos(alpha), np.sin(alpha)]), alpha)
    inliers = np.isin(np.arange(len(points)), run.inliers)
    plan(scene, f"best of {len(run.asked)} samples: {len(run.inliers)} of {len(points)} agree")
    _frame(scene, points)
    _band(scene, line, threshold)
    draw_line(scene, *line, color="black", linewidth=1.5)
    _votes(scene, points, inliers, size=4)
    scene.plot(*points[list(run.pair)].T, "o", color=ORANGE, markersize=9, mec="black", zorder=5)
    drawn = np.arange(1, len(run.asked) + 1)
    asked.semilogy(drawn, drawn, "--", color=GRAY, label="drawn = asked for")
    asked.step(drawn, run.asked, where="post", color=BLUE, label="asked for")
    asked.set_xlabel("samples drawn")
    asked.set_ylabel("samples asked for")
    asked.legend(frameon=False)
    quiet(asked)
    show(
        fig,
        f"RANSAC after {len(run.asked)} samples: the best line has {len(run.inliers)} of "
        f"{len(points)} points in its band. With this share of inliers, {run.asked[-1]} samples "
        f"are asked for; after the first sample it was {run.asked[0]}.",
    )


def cloud_views(points: np.ndarray, predicted: str | None = None) -> None:
    """Draw (N, 2) points, the last an outlier, their cost over r and alpha, and over alpha."""
    fig = figure(8, 3.2)
    scene, space, cost = fig.subplots(1, 3)
    center = points.mean(axis=0)
    normals = np.linalg.svd(points - center)[2][::-1]  # the valley's, then the hill's
    stationary = [_half_turn(normal, center) for normal in normals]
    valley, hill = stationary
    agreeing = points[consensus(points, BAND)]
    middle = agreeing.mean(axis=0)
    agreed = _half_turn(np.linalg.svd(agreeing - middle)[2][-1], middle)

    _frame(scene, points, margin=0.8)
    for line, style, name in ((valley, "-", "least squares"), (agreed, "--", "consensus")):
        label = f"{name}, {np.degrees(line[1]):.0f}°"
        color = "black" if style == "-" else ORANGE
        draw_line(scene, *line, color=color, linestyle=style, linewidth=1.5, label=label)
    plan(scene)
    scene.legend(loc="lower center", bbox_to_anchor=(0.5, 1), frameon=False, fontsize=8)
    scene.plot(*points[:-1].T, "o", color=BLUE)
    scene.plot(*points[-1:].T, "s", color=VERMILLION)

    reach = np.ceil(np.hypot(*points.T).max() + 0.5)
    angles, radii = np.radians(np.linspace(-90, 90, 181)), np.linspace(-reach, reach, 121)
    across = points @ [np.cos(angles), np.sin(angles)]  # shape (N, 181): each point's curve
    costs = ((radii[:, np.newaxis, np.newaxis] - across) ** 2).sum(axis=1)
    extent = (-90.0, 90.0, float(-reach), float(reach))
    space.imshow(np.log(costs + 0.01), origin="lower", extent=extent, aspect="auto", cmap="viridis")
    space.plot(np.degrees(angles), across.T, color="white", linewidth=0.8)
    space.set_ylim(-reach, reach)
    space.set_ylabel("distance r [m]")

    best = ((across - across.mean(axis=0)) ** 2).sum(axis=0)
    cost.plot(np.degrees(angles), best, color=BLUE)
    cost.set_ylabel("cost S [m²], best r")
    quiet(cost)
    for axes, height in ((space, lambda line: line[0]), (cost, lambda line: _cost(points, line))):
        axes.set_xlabel("angle α [°]")
        axes.set_xticks([-90, -45, 0, 45, 90])
        for line, marker in zip(stationary, "o^", strict=True):
            axes.plot(
                np.degrees(line[1]), height(line), marker, color=VERMILLION, mec="white", ms=9
            )
    predicted_beside(fig, predicted)
    show(
        fig,
        f"{len(points)} points, one of them an outlier, in three views. The cost is least at "
        f"r = {valley[0]:.2f} m, α = {np.degrees(valley[1]):.0f}° (circle), where S is "
        f"{_cost(points, valley):.3g} m². The other stationary angle, "
        f"{np.degrees(hill[1]):.0f}° (triangle), is the hill. {len(agreeing)} points agree on the "
        f"dashed line, whose normal is at {np.degrees(agreed[1]):.0f}°.",
    )


def _half_turn(normal: np.ndarray, point: np.ndarray) -> tuple[float, float]:
    """Return r and alpha of the line through a point, alpha within a quarter turn from 0."""
    normal = normal if normal[0] > 0 or (normal[0] == 0 and normal[1] > 0) else -normal
    return float(point @ normal), float(np.arctan2(normal[1], normal[0]))


def _cost(points: np.ndarray, line: tuple[float, float]) -> float:
    r, alpha = line
    return float(((points @ [np.cos(alpha), np.sin(alpha)] - r) ** 2).sum())
