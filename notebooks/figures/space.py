"""Pictures of point clouds and of the planes in them."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from notebooks.figures.style import (
    GRAY,
    PALETTE,
    StudentFunction,
    attempt,
    figure,
    not_written,
    predicted_beside,
    show,
)

TRIES = 20  # runs with the predicted number of iterations
MOST_TRIED = 1000  # iterations
ENOUGH = 0.9  # a run has found the plane if it keeps this share of its points
MARKERS = ["o", "^", "s", "D"]
VIEWS = (("from the right", -60.0, 18.0), ("from above", -90.0, 89.0))  # azimuth, elevation [°]


def _spaces(fig: Figure, points: np.ndarray) -> list[Any]:
    """Add two views of the camera's space: x to the right, z ahead, and -y upwards.

    The few points far away are left outside, so that there is room for the others.
    """
    views = []
    for column, (title, azimuth, elevation) in enumerate(VIEWS, start=1):
        axes: Any = fig.add_subplot(1, len(VIEWS), column, projection="3d")
        axes.set_title(title, y=0.95)
        axes.set_xlabel("x [m]")
        axes.set_ylabel("z [m]")
        if elevation < 80:
            axes.set_zlabel("height [m]")
        else:
            axes.set_zticks([])
        low, high = np.percentile(points[:, [0, 2, 1]] * [1, 1, -1], [0.5, 96.5], axis=0)
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        axes.set_zlim(low[2], high[2])
        axes.set_box_aspect(high - low, zoom=0.95)
        axes.view_init(elev=elevation, azim=azimuth)
        axes.locator_params(nbins=5)
        views.append(axes)
    return views


def cloud(points: np.ndarray, colors: np.ndarray) -> None:
    """Draw a cloud, (N, 3) in metres, in its own colours, (N, 3) from 0 to 255."""
    fig = figure(8, 4.2)
    for axes in _spaces(fig, points):
        x, y, z = points.T
        axes.scatter(x, z, -y, s=2, c=colors / 255, axlim_clip=True)
    show(fig, f"A cloud of {len(points)} points of a brick house, seen from two directions.")


def largest_planes(
    points: np.ndarray,
    ransac_plane: StudentFunction,
    threshold: float,
    iterations: int,
    predicted: int | None = None,
    count: int = 3,
) -> None:
    """Draw the largest planes that the student's ransac_plane finds in (N, 3) points, in turn.

    `predicted` is a number of iterations; it is tried in some runs of its own.
    """
    fig = figure(8, 4.6)
    rng = np.random.default_rng(0)
    plane_of = np.full(len(points), -1)
    sizes = []
    for number in range(count):
        free = np.flatnonzero(plane_of < 0)
        found = attempt(ransac_plane, points[free], threshold, iterations, rng)
        if found is None:
            fig.suptitle(not_written(ransac_plane).replace("\n", " "), fontsize=10)
            break
        plane_of[free[found[1]]] = number
        sizes.append(len(found[1]))
    for axes in _spaces(fig, points):
        for number in (-1, *range(len(sizes))):
            x, y, z = points[plane_of == number].T
            label = "the rest" if number < 0 else f"plane {number + 1}"
            axes.plot(
                x,
                z,
                -y,
                "." if number < 0 else MARKERS[number % len(MARKERS)],
                markersize=1.5,
                color=GRAY if number < 0 else PALETTE[number],
                axlim_clip=True,
                label=f"{label}: {len(x)} points",
            )
    true = ""
    if predicted is not None and sizes:
        true = _tried(points, ransac_plane, threshold, predicted, sizes[0])
    guess = "" if not sizes else predicted_beside(fig, predicted, " iterations", true)
    handles, labels = axes.get_legend_handles_labels()
    fig.legend(handles, labels, loc="outside lower center", ncols=4, markerscale=4, frameon=False)
    show(fig, f"A cloud of {len(points)} points; points on its largest planes: {sizes}. {guess}")


def _tried(
    points: np.ndarray,
    ransac_plane: StudentFunction,
    threshold: float,
    iterations: int,
    largest: int,
) -> str:
    """Say in how many runs of so many iterations the largest plane is found."""
    if iterations > MOST_TRIED:
        return "That is more than anybody wants to wait for here."
    found = sum(
        len(ransac_plane(points, threshold, iterations, np.random.default_rng(seed))[1])
        >= ENOUGH * largest
        for seed in range(TRIES)
    )
    return f"In {found} of {TRIES} runs they find the largest plane."
