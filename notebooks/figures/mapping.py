"""Pictures of the capstone: all walls of a scan, and the map of the building."""

from typing import Any

import numpy as np

from notebooks.figures.style import (
    BLUE,
    GRAY,
    LIGHT,
    ORANGE,
    PALETTE,
    VERMILLION,
    StudentFunction,
    attempt,
    figure,
    not_written,
    note,
    photograph,
    plan,
    show,
)


def _ends(points: np.ndarray, line: Any) -> np.ndarray:
    """Return the two ends (2, 2) of the piece of a line that its points cover."""
    r, alpha = line
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    along = np.array([-normal[1], normal[0]])
    reach = points @ along
    return r * normal + np.outer([reach.min(), reach.max()], along)


def walls_of_scan(
    points: np.ndarray,
    find_walls: StudentFunction,
    threshold: float,
    iterations: int,
    min_points: int,
) -> None:
    """Draw (N, 2) points of a scan, each wall of the student's find_walls in its own colour."""
    fig = figure(8, 4.6)
    axes = fig.subplots()
    plan(axes)
    axes.plot(*points.T, ".", color=GRAY, markersize=4)
    axes.plot(0, 0, marker=(3, 0, -90), color=ORANGE, markersize=12, mec="black")
    rng = np.random.default_rng(0)
    walls = attempt(find_walls, points, threshold, iterations, min_points, rng)
    if walls is None:
        note(axes, not_written(find_walls))
        show(fig, not_written(find_walls))
        return
    for number, (line, indices) in enumerate(walls, start=1):
        color = PALETTE[(number - 1) % len(PALETTE)]
        axes.plot(*points[indices].T, "o", color=color, markersize=4)
        ends = _ends(points[indices], line)
        axes.plot(*ends.T, color=color, linewidth=2, label=f"wall {number}: {len(indices)} points")
    if walls:
        axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    axes.set_title(f"{len(walls)} walls in {len(points)} points")
    show(fig, f"A laser scan from above with the {len(walls)} walls that were found in it.")


def corridor(x: np.ndarray, y: np.ndarray, path: np.ndarray) -> None:
    """Draw the map: all laser points in the world (m), and the (M, 2) path of the robot."""
    fig = figure(8, 7.2)
    axes = fig.subplots()
    plan(axes, f"{np.isfinite(x).sum()} laser points of {len(path)} scans")
    axes.plot(x.ravel(), y.ravel(), ",", color="black", alpha=0.15, rasterized=True)
    axes.plot(*path.T, color=VERMILLION, linewidth=1, label="the robot's way")
    axes.legend(loc="lower right")
    show(fig, f"The map of a building from {len(path)} laser scans, with the way of the robot.")


def corridor_walls(
    scans: Any,
    find_walls: StudentFunction,
    every: int,
    threshold: float,
    iterations: int,
    min_points: int,
    max_range: float = 30.0,
) -> None:
    """Draw the map as walls only: what the student's find_walls sees in every so many scans."""
    fig = figure(8, 7.2)
    axes = fig.subplots()
    plan(axes)
    axes.plot(*scans.poses[:, :2].T, color=LIGHT, linewidth=3, label="the robot's way")
    axes.legend(loc="lower right")
    rng = np.random.default_rng(0)
    count = 0
    for ranges, (x, y, heading) in zip(scans.ranges[::every], scans.poses[::every], strict=True):
        near = ranges < max_range
        beams = np.stack([np.cos(scans.angles[near]), np.sin(scans.angles[near])], axis=1)
        points = ranges[near, None] * beams
        walls = attempt(find_walls, points, threshold, iterations, min_points, rng)
        if walls is None:
            note(axes, not_written(find_walls))
            break
        cosine, sine = np.cos(heading), np.sin(heading)
        turned = np.array([[cosine, sine], [-sine, cosine]])
        for line, indices in walls:
            ends = _ends(points[indices], line) @ turned + [x, y]
            axes.plot(*ends.T, color=BLUE, linewidth=1.2)
        count += len(walls)
    axes.set_title(f"{count} walls")
    show(fig, f"A map of a building, drawn with {count} wall segments.")


def three_senses(photograph_taken: np.ndarray, points: np.ndarray, scans: Any) -> None:
    """Draw what the course is about: a photograph, a laser scan (N, 2), the map of a building."""
    fig = figure(8, 3.5)
    left, middle, right = fig.subplots(1, 3)
    photograph(left, photograph_taken, "1. Have I been here?", size=11)
    plan(middle, "2. Where are the walls?")
    middle.plot(*points.T, ".", color=BLUE, markersize=3)
    middle.plot(0, 0, marker=(3, 0, -90), color=ORANGE, markersize=10, mec="black")
    plan(right, "3. What is the map?")
    angles = scans.poses[::10, 2:] + scans.angles
    ranges = np.where(scans.ranges[::10] < 30, scans.ranges[::10], np.nan)
    x = scans.poses[::10, :1] + ranges * np.cos(angles)
    y = scans.poses[::10, 1:2] + ranges * np.sin(angles)
    right.plot(x.ravel(), y.ravel(), ",", color="black", alpha=0.3)
    show(
        fig,
        "Three pictures: a photograph of a campus, a laser scan of a corridor from above, and the "
        "map of a whole building made from thousands of scans.",
    )
