"""Pictures of fitted lines: what a fit finds, how certain it is, and what ruins it."""

import numpy as np

from notebooks.figures.style import (
    BLUE,
    GRAY,
    GREEN,
    ORANGE,
    PREDICTED,
    SKY,
    VERMILLION,
    StudentFunction,
    attempt,
    draw_line,
    figure,
    not_written,
    note,
    plan,
    predicted_beside,
    quiet,
    show,
)


def _normal_and_along(alpha: float) -> tuple[np.ndarray, np.ndarray]:
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    return normal, np.array([-normal[1], normal[0]])


def scan(points: np.ndarray, wall: np.ndarray | None = None) -> None:
    """Draw a laser scan seen from above, the robot at the origin; `wall` (M, 2) is marked."""
    fig = figure(8, 4.6)
    axes = fig.subplots()
    plan(axes, f"{len(points)} laser points, seen from above")
    beams = np.stack([np.zeros_like(points), points, np.full_like(points, np.nan)], axis=1)
    axes.plot(*beams.reshape(-1, 2).T, color=SKY, linewidth=0.4, alpha=0.7)
    axes.plot(*points.T, ".", color=GRAY, markersize=4)
    if wall is not None:
        axes.plot(*wall.T, "o", color=BLUE, markersize=4, label=f"a wall ({len(wall)} points)")
        axes.legend(loc="best")
    axes.plot(0, 0, marker=(3, 0, -90), color=ORANGE, markersize=14, mec="black")
    show(fig, f"A laser scan of {len(points)} points from above. The robot looks along x.")


def fitted_line(points: np.ndarray, fit_line: StudentFunction) -> None:
    """Draw the (N, 2) points with the line that the student's fit_line finds."""
    fig = figure(7, 4.4)
    axes = fig.subplots()
    plan(axes)
    axes.plot(*points.T, "o", color=BLUE, markersize=4)
    axes.plot(0, 0, marker=(3, 0, -90), color=ORANGE, markersize=12, mec="black")
    line = attempt(fit_line, points)
    if line is None:
        note(axes, not_written(fit_line))
        show(fig, f"{len(points)} points. {not_written(fit_line)}")
        return
    r, alpha = line
    draw_line(axes, r, alpha, color=VERMILLION, linewidth=2)
    normal, _ = _normal_and_along(alpha)
    axes.plot([0, r * normal[0]], [0, r * normal[1]], color=GREEN, linewidth=1.5)
    said = f"r = {r:.3f} m, α = {np.degrees(alpha):.2f}°"
    axes.set_title(f"your line: {said}")
    show(fig, f"{len(points)} points of a wall and the fitted line, {said}.")


def uncertain_line(
    points: np.ndarray,
    fit_line: StudentFunction,
    line_covariance: StudentFunction,
    sigma: float,
    predicted: str | None = None,
) -> None:
    """Draw a wall of (N, 2) points, stretched across, with the 95 % band of its line."""
    fig = figure(8, 3.6)
    axes = fig.subplots()
    quiet(axes)
    axes.set_xlabel("position along the wall [m]")
    axes.set_ylabel("distance from the line [cm]")
    line = attempt(fit_line, points)
    covariance = None if line is None else attempt(line_covariance, points, sigma)
    if covariance is None:
        text = not_written(fit_line if line is None else line_covariance)
        note(axes, text)
        show(fig, text)
        return
    r, alpha = line
    normal, along = _normal_and_along(alpha)
    position, distance = points @ along, points @ normal - r
    t = np.linspace(position.min() - 1, position.max() + 1, 200)
    # A change of r shifts the line; a change of alpha turns it about the foot of the normal.
    change = np.stack([np.ones_like(t), -t])
    deviation = np.sqrt(np.einsum("it,ij,jt->t", change, np.asarray(covariance), change))
    axes.fill_between(t, -200 * deviation, 200 * deviation, color=SKY, alpha=0.5, label="± 2 σ")
    axes.plot(position, 100 * distance, "o", color=BLUE, markersize=4, label="laser points")
    axes.axhline(0, color=VERMILLION, linewidth=2, label="the fitted line")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    spread = np.sqrt(np.diag(covariance))
    said = f"σ of r: {1000 * spread[0]:.1f} mm, σ of α: {np.degrees(spread[1]):.3f}°"
    axes.set_title(said)
    guess = predicted_beside(fig, predicted)
    show(fig, f"The wall's points around the fitted line, with its uncertainty: {said}. {guess}")


def one_outlier(
    wall: np.ndarray,
    fit_line: StudentFunction,
    predicted: float | None = None,
    offsets: tuple[float, ...] = (0.0, 1.0, 3.0),
) -> None:
    """Move the last point of a wall towards the robot, step by step (m), and fit again.

    `predicted` is by how many degrees the first step was expected to turn the line, which is drawn.
    """
    fig = figure(8, 4.2)
    panels = fig.subplots(1, len(offsets), sharex=True, sharey=True)
    length = wall[-1] - wall[0]
    across = np.array([-length[1], length[0]]) / np.hypot(*length)
    low = np.minimum(wall.min(axis=0), wall[-1] + max(offsets) * across) - 0.4
    high = wall.max(axis=0) + 0.4
    said, alphas = [], list[float]()
    for axes, offset in zip(panels, offsets, strict=True):
        points = wall.copy()
        points[-1] += offset * across
        plan(axes, f"one point {offset:.0f} m off")
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        axes.plot(*points[:-1].T, "o", color=BLUE, markersize=3)
        line = attempt(fit_line, points)
        if line is not None:
            draw_line(axes, *line, color=GREEN, linewidth=2)
            said.append(f"{offset:.0f} m: {np.degrees(line[1]):.1f}°")
            alphas.append(line[1])
            axes.set_title(f"one point {offset:.0f} m off\nα = {np.degrees(line[1]):.1f}°")
        axes.plot(*points[-1], "X", color=VERMILLION, markersize=10)
    for axes in panels[1:]:
        axes.set_ylabel("")
    if not said:
        fig.suptitle(not_written(fit_line).replace("\n", " "), color=VERMILLION, fontsize=10)
        show(fig, f"A wall with one outlier. {not_written(fit_line)}")
        return
    turned = np.array([(alpha - alphas[0] + np.pi) % (2 * np.pi) - np.pi for alpha in alphas[1:]])
    true = f"It turns by {np.degrees(np.abs(turned[0])):.1f}°."
    guess = predicted_beside(fig, predicted, "°", true)
    if predicted is not None:
        alpha = alphas[0] + np.copysign(np.radians(predicted), turned[0])
        r = float(wall.mean(axis=0) @ [np.cos(alpha), np.sin(alpha)])
        draw_line(panels[1], r, alpha, color=PREDICTED, ls="--", label="predicted")
        panels[1].legend(loc="lower left", fontsize=8, frameon=False)
    show(
        fig,
        f"One outlier turns the fitted line. Its α for each offset: {', '.join(said)}. {guess}",
    )


def scattered_fits(
    wall: np.ndarray,
    fit_line: StudentFunction,
    line_covariance: StudentFunction,
    sigma: float,
    rng: np.random.Generator,
    times: int = 1000,
) -> None:
    """Fit a wall of (N, 2) points with new errors many times, beside what the covariance says."""
    fig = figure(6, 4.2)
    axes = fig.subplots()
    quiet(axes)
    axes.set_xlabel("change of r [mm]")
    axes.set_ylabel("change of α [degrees]")
    line = attempt(fit_line, wall)
    covariance = None if line is None else attempt(line_covariance, wall, sigma)
    if covariance is None:
        text = not_written(fit_line if line is None else line_covariance)
        note(axes, text)
        show(fig, text)
        return
    # Points exactly on the line, so that all the spread comes from the new errors.
    normal, _ = _normal_and_along(line[1])
    exact = wall - np.outer(wall @ normal - line[0], normal)
    fits = np.array([fit_line(exact + rng.normal(0, sigma, exact.shape)) for _ in range(times)])
    change = (fits - np.asarray(line, dtype=float)) * [1000, 180 / np.pi]
    axes.plot(*change.T, ".", color=GRAY, markersize=3, label=f"{times} fits")
    scale = np.diag([1000, 180 / np.pi])
    values, vectors = np.linalg.eigh(scale @ np.asarray(covariance, dtype=float) @ scale)
    turn = np.linspace(0, 2 * np.pi, 200)
    circle = (
        np.stack([np.cos(turn), np.sin(turn)]) * np.sqrt(np.maximum(values, 0) * 5.991)[:, None]
    )
    axes.plot(*(vectors @ circle), color=VERMILLION, linewidth=2, label="95 % by your formula")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    inside = (((change @ vectors) ** 2 / np.maximum(values, 1e-12)).sum(axis=1) <= 5.991).mean()
    axes.set_title(f"{inside:.1%} of the fits lie in the ellipse")
    show(fig, f"{times} fits with new errors; {inside:.1%} of them lie in the 95 % ellipse.")
