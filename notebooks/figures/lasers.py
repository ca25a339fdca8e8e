"""A picture of what the assumption of equal noise in all directions costs for a laser."""

import numpy as np

from notebooks.figures.style import (
    BLUE,
    GRAY,
    ORANGE,
    StudentFunction,
    attempt,
    figure,
    note,
    predicted_beside,
    quiet,
    show,
)

RUNS = 1000
NOT_YET = "A function that this picture needs is not written yet."


def laser_errors(
    wall: np.ndarray,
    fit_line: StudentFunction,
    line_covariance: StudentFunction,
    sigma: float,
    step: float,
    rng: np.random.Generator,
    predicted: str | None = None,
) -> None:
    """Draw how far fits to (N, 2) points spread under three kinds of error, and what is predicted.

    The errors are equal in all directions, along the beams from the origin only, and along the
    beams with ranges rounded to `step`; `sigma` and `step` are in metres.
    """
    fig = figure(8, 2.8)
    panels = fig.subplots(1, 2)
    line = attempt(fit_line, wall)
    covariance = None if line is None else attempt(line_covariance, wall, sigma)
    if line is None or covariance is None:
        for axes in panels:
            note(axes, NOT_YET)
        return show(fig, NOT_YET)
    r, alpha = line
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    exact = wall - np.outer(wall @ normal - r, normal)
    ranges = np.hypot(*exact.T)
    beams = exact / ranges[:, np.newaxis]
    spread = {"your formula": np.sqrt(np.diag(np.asarray(covariance, dtype=float)))}
    for name in ("all directions", "along the beam", f"and {100 * step:.0f} cm steps"):
        fits = []
        for _ in range(RUNS):
            if name == "all directions":
                points = exact + rng.normal(0, sigma, exact.shape)
            else:
                measured = ranges + rng.normal(0, sigma, len(ranges))
                if "steps" in name:
                    measured = np.round(measured / step) * step
                points = beams * measured[:, np.newaxis]
            found = fit_line(points)
            turn = (found[1] - alpha + np.pi) % (2 * np.pi) - np.pi
            fits.append((found[0] - r, turn))
        spread[name] = np.sqrt((np.array(fits) ** 2).mean(axis=0))  # a bias counts as well
    colors = [GRAY, BLUE, BLUE, ORANGE]
    for axes, entry, scale, label in zip(
        panels, (0, 1), (1000, 180 / np.pi), ("r [mm]", "α [°]"), strict=True
    ):
        values = [scale * float(both[entry]) for both in spread.values()]
        bars = axes.barh(range(len(values)), values, color=colors, height=0.6)
        axes.bar_label(bars, [f" {value:.2g}" for value in values], fontsize=9)
        axes.set_yticks(range(len(values)), list(spread) if entry == 0 else [""] * len(values))
        axes.invert_yaxis()
        axes.set_xlim(0, 1.2 * max(values))
        axes.set_xlabel(f"root mean square error of {label}")
        quiet(axes)
    said = "; ".join(
        f"{name}: r {1000 * both[0]:.2g} mm, α {np.degrees(both[1]):.2g}°"
        for name, both in spread.items()
    )
    guess = predicted_beside(fig, predicted)
    return show(fig, f"The errors of {RUNS} fitted lines. {said}. {guess}")
