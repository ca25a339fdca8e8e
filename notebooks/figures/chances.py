"""Pictures of RANSAC's chances, all of them simulated: samples are drawn and counted.

No formula of the chapter stands here, so that a simulation can confirm or refute one.
"""

import numpy as np
from matplotlib.colors import ListedColormap

from notebooks.figures.style import (
    BLUE,
    GREEN,
    LIGHT,
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


def _clean(
    runs: int, draws: int, N: int, inliers: int, size: int, rng: np.random.Generator
) -> np.ndarray:
    """Draw samples of `size` different points; tell, as (runs, draws), which hold inliers only.

    Points 0 to inliers - 1 are the inliers.
    """
    clean = np.ones((runs, draws), dtype=bool)
    left_good, left = np.full((runs, draws), inliers), N
    for _ in range(size):
        good = rng.random((runs, draws)) * left < left_good
        clean &= good
        left_good, left = left_good - good, left - 1
    return clean


def _number(value: object) -> float | None:
    """Return a student's response as a number, or None while it is not one."""
    return float(value) if isinstance(value, int | float | np.number) else None


def waiting_times(
    N: int,
    w: float,
    size: int,
    claimed: object,
    rng: np.random.Generator,
    runs: int = 10_000,
    p: float = 0.95,
) -> None:
    """Draw how many samples many runs needed until the first without an outlier.

    `claimed` is the student's number of iterations; the share of runs that were done by then, or
    by the end of the picture, is written above it, once it is a number. `p` is the share that the
    student looks for.
    """
    longest = round(5 / w**size)
    first = np.full(runs, np.inf)
    for start in range(0, runs, 1000):
        clean = _clean(1000, longest, N, round(N * w), size, rng)
        first[start : start + 1000] = np.where(clean.any(axis=1), clean.argmax(axis=1) + 1, np.inf)
    fig = figure(8, 3.4)
    axes = fig.subplots()
    width = -(-longest // 60)
    bins = np.arange(0.5, longest + width, width).tolist()
    axes.hist(first, bins=bins, color=LIGHT, edgecolor="white")
    axes.set_xlabel(f"samples of {size} points drawn until the first without an outlier")
    axes.set_ylabel(f"runs (of {runs})")
    quiet(axes)
    text = f"{runs} simulated runs: how many samples each needed until the first clean one."
    value = _number(claimed)
    if value is not None and 0 < value <= longest:
        share = float((first <= value).mean())
        axes.hist(first[first <= value], bins=bins, color=BLUE, edgecolor="white")
        axes.axvline(value, color=VERMILLION, linewidth=2)
        axes.set_title(
            f"{share:.1%} of the runs had a clean sample within your {value:g} iterations"
        )
        text += f" Within {value:g} samples, {share:.1%} of the runs were done."
    elif value is not None and value > longest:
        share = float((first <= longest).mean())
        beyond = (
            f"Your {value:.10g} lies beyond the picture: "
            f"{share:.1%} of the runs were done by {longest}."
        )
        axes.set_title(beyond)
        text += f" {beyond}"
    else:
        axes.set_title(f"Where must the line stand, so that {p:.0%} of the runs lie to its left?")
        text += " No number was given."
    show(fig, text)


def runs_that_failed(
    N: int, w: float, iterations: int, claimed: object, rng: np.random.Generator, runs: int = 1000
) -> None:
    """Draw each of many runs as a square, dark if none of its samples was free of outliers.

    `claimed` is the student's probability; it is compared with the share of dark squares.
    """
    failed = ~_clean(runs, iterations, N, round(N * w), 2, rng).any(axis=1)
    fig = figure(8, 3.2)
    axes = fig.subplots()
    rows = 20
    axes.imshow(failed.reshape(rows, -1), cmap=ListedColormap([LIGHT, VERMILLION]), vmin=0, vmax=1)
    axes.set_xticks(np.arange(runs // rows + 1) - 0.5, [])
    axes.set_yticks(np.arange(rows + 1) - 0.5, [])
    axes.grid(color="white", linewidth=1)
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    share = failed.mean()
    title = (
        f"{runs} runs of {iterations} iterations. Without any clean sample (dark): "
        f"{share:.1%}; with one: {1 - share:.1%}."
    )
    value = _number(claimed)
    if value is not None:
        title += (
            f"\nYou computed {value:.3f} (a simulation of {runs} runs is itself off by 1 % or so)."
        )
    axes.set_title(title, fontsize=11)
    show(fig, title.replace("\n", " "))


def noisy_inliers(
    N: int,
    w: float,
    iterations: object,
    rng: np.random.Generator,
    predicted: float | None = None,
    runs: int = 1000,
    sigma: float = 0.005,
    threshold: float = 0.0125,
) -> None:
    """Draw how many of the true inliers the best guess keeps, before and after refitting.

    A wall of 1 m, its points `sigma` metres off; `iterations` is the student's number. Each run
    gets as many clean samples as luck allows in so many iterations; the model of each is the
    line through two noisy points.
    """
    draws = _number(iterations)
    if draws is None:
        fig = figure(8, 1.5)
        axes = fig.subplots()
        axes.set_axis_off()
        note(axes, "This simulation needs your number of iterations from Q3.2.1.")
        show(fig, "This simulation needs the number of iterations from Q3.2.1.")
        return
    inliers = round(N * w)
    raw, refitted = [], []
    for clean in _clean(runs, min(int(draws), 10_000), N, inliers, 2, rng).sum(axis=1):
        if clean == 0:  # an outlier model: it keeps none but by accident
            raw.append(0.0)
            refitted.append(0.0)
            continue
        x, y = rng.random(inliers), rng.normal(0, sigma, inliers)
        i, j = rng.integers(inliers, size=(2, int(clean)))
        distance = np.abs(x[j] - x[i]) > 1e-9
        i, j = i[distance], j[distance]
        slope = (y[j] - y[i]) / (x[j] - x[i])
        away = (y - y[i, None]) - slope[:, None] * (x - x[i, None])
        agree = np.abs(away) <= threshold * np.sqrt(1 + slope[:, None] ** 2)
        best = agree[agree.sum(axis=1).argmax()]
        raw.append(best.mean())
        fit = np.polyfit(x[best], y[best], 1)  # the wall lies along x, so this is harmless
        refitted.append((np.abs(y - np.polyval(fit, x)) <= threshold).mean())
    fig = figure(8, 3.4)
    left, right = fig.subplots(1, 2, sharey=True, sharex=True)
    said = []
    for axes, kept, color, name in (
        (left, raw, ORANGE, "best guess"),
        (right, refitted, GREEN, "after refitting"),
    ):
        axes.hist(
            100 * np.array(kept), bins=np.arange(0, 102.5, 2.5), color=color, edgecolor="white"
        )
        axes.axvline(90, color="black", linestyle=":")
        share = np.count_nonzero(np.array(kept) >= 0.9) / runs
        axes.set_title(f"{name}: {share:.1%} of the runs\nkeep 90 % of the inliers or more")
        axes.set_xlabel("inliers that it keeps [%]")
        quiet(axes)
        said.append(f"{name} {share:.1%}")
    left.set_ylabel(f"runs (of {runs})")
    guess = predicted_beside(fig, predicted, " % for the best guess")
    show(
        fig,
        f"How many of the true inliers are kept, over {runs} runs of {iterations} iterations. "
        f"Runs that keep 90 % or more: {', '.join(said)}. {guess}",
    )


def growth(required_iterations: StudentFunction, sizes: dict[str, int], p: float = 0.95) -> None:
    """Draw the student's numbers of iterations over the share of inliers, for each sample size."""
    fig = figure(8, 3.8)
    axes = fig.subplots()
    ratios = np.linspace(0.1, 0.95, 86)
    for (name, size), style, color in zip(
        sizes.items(), ("-", "--", ":"), (BLUE, VERMILLION, GREEN), strict=False
    ):
        numbers = [attempt(required_iterations, p, float(ratio), size) for ratio in ratios]
        if None in numbers:
            note(axes, not_written(required_iterations))
            break
        label = f"{name} (sample of {size})"
        axes.semilogy(100 * ratios, numbers, style, color=color, linewidth=2.5, label=label)
    else:
        axes.legend()
    axes.set_xlabel("share of inliers w [%]")
    axes.set_ylabel(f"iterations for p = {p}")
    axes.grid(color=LIGHT, linewidth=0.5)
    quiet(axes)
    show(fig, f"Iterations needed over the share of inliers, for {', '.join(sizes)}.")
