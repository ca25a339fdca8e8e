"""Still pictures of the explorers, for where no widget can be drawn."""

from typing import Any

import numpy as np

from notebooks.figures.consensus import _band, _frame, _votes
from notebooks.figures.style import BLUE, GREY, ORANGE, draw_line, figure, plan, quiet, show


def ransac_steps(points: np.ndarray, run: Any, threshold: float) -> None:
    """Draw what a run of RANSAC found, and how many samples it asked for after each."""
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
    asked.semilogy(drawn, drawn, "--", color=GREY, label="drawn = asked for")
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
