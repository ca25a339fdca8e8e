"""Pictures of when RANSAC may stop, and of what it may count."""

from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator

from notebooks.explorers.still import samples_asked_for
from notebooks.figures.style import (
    BLUE,
    GRAY,
    ORANGE,
    VERMILLION,
    StudentFunction,
    attempt,
    figure,
    not_written,
    note,
    predicted_beside,
    quiet,
    show,
)

RUNS = 300
MOST = 400  # samples of a run that does not stop
ENOUGH = 0.9  # a run has found the wall if its line keeps this share of the most that agree


def stopping(
    points: np.ndarray,
    adaptive_stop: StudentFunction,
    threshold: float,
    p: float,
    rng: np.random.Generator,
    predicted: str | None = None,
) -> None:
    """Draw after how many samples runs of RANSAC on (N, 2) points stop by themselves."""
    fig = figure(8, 3)
    axes = fig.subplots()
    axes.set_xlabel("samples drawn when the run stops")
    axes.set_ylabel(f"of {RUNS} runs")
    quiet(axes)
    agreeing = [_agreeing(points, threshold, rng) for _ in range(RUNS)]
    stops = attempt(lambda: [int(adaptive_stop(one, len(points), p)) for one in agreeing])
    if stops is None:
        note(axes, not_written(adaptive_stop))
        return show(fig, not_written(adaptive_stop))
    most = max(one.max() for one in agreeing)
    found = sum(
        bool(one[:stop].max(initial=0) >= ENOUGH * most)
        for one, stop in zip(agreeing, stops, strict=True)
    )
    width = max(1, -(-(max(stops) - min(stops) + 1) // 40))
    edges = np.arange(min(stops), max(stops) + width + 1, width) - 0.5
    axes.hist(stops, bins=edges.tolist(), color=BLUE)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    mean = float(np.mean(stops))
    axes.axvline(mean, color=VERMILLION, ls="--", label=f"mean {mean:.0f}")
    text = f"{found} of {RUNS} runs have found the largest wall, {most} of {len(points)} points"
    axes.set_title(text, fontsize=10)
    known = samples_asked_for(most / len(points), 1 - p)
    axes.axvline(known, color=GRAY, ls=":", label=f"with the wall's share known: {known}")
    axes.legend(frameon=False)
    guess = predicted_beside(fig, predicted)
    return show(
        fig,
        f"Runs stop after {min(stops)} to {max(stops)} samples, {mean:.0f} in the mean; with the "
        f"wall's share known {known} would do. {text}. {guess}",
    )


def _agreeing(points: np.ndarray, threshold: float, rng: np.random.Generator) -> np.ndarray:
    """Return for each of many samples how many points agree with its line."""
    first = rng.integers(len(points), size=MOST)
    second = (first + rng.integers(1, len(points), size=MOST)) % len(points)
    along = points[second] - points[first]
    lengths = np.maximum(np.hypot(*along.T), 1e-12)
    across = np.column_stack([-along[:, 1], along[:, 0]]) / lengths[:, np.newaxis]
    offsets = across @ points.T - (across * points[first]).sum(axis=1)[:, np.newaxis]
    return (np.abs(offsets) <= threshold).sum(axis=1)


def pushed_line(
    points: np.ndarray, line: Any, msac_cost: StudentFunction, threshold: float
) -> None:
    """Draw what a line costs that is pushed across (N, 2) points, by counting and by MSAC."""
    r, alpha = line
    offsets = points @ [np.cos(alpha), np.sin(alpha)] - r
    pushes = np.linspace(-2 * threshold, 2 * threshold, 201)
    outside = np.array([(np.abs(offsets - push) > threshold).sum() for push in pushes])
    fig = figure(8, 3)
    axes = fig.subplots()
    axes.step(100 * pushes, outside * threshold**2, color=GRAY, label="counting: outliers · t²")
    costs = attempt(lambda: [float(msac_cost(offsets - push, threshold)) for push in pushes])
    least = outside.min()
    flat = 100 * np.ptp(pushes[outside == least])
    said = f"the lowest step of counting is {flat:.1f} cm wide"
    if costs is None:
        note(axes, not_written(msac_cost))
    else:
        best = 100 * pushes[int(np.argmin(costs))]
        axes.plot(100 * pushes, costs, color=BLUE, lw=2, label="your cost")
        axes.plot(best, min(costs), "o", color=ORANGE, mec="black", markersize=9)
        said += f"; your cost is least at {best + 0.0:.1f} cm"
    axes.set_xlabel("line pushed by [cm]")
    axes.set_ylabel("cost [m²]")
    axes.set_title(said, fontsize=10)
    axes.legend(frameon=False, loc="lower right")
    quiet(axes)
    show(fig, f"The cost of a wall's line that is pushed to and fro: {said}.")
