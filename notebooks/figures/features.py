"""Pictures of features: where they are, and how SIFT and ORB compare."""

import time
from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np

from notebooks.figures.style import BLUE, ORANGE, figure, photograph, quiet, show


def photographs(images: dict[str, np.ndarray], columns: int = 5) -> None:
    """Show small photographs with their numbers."""
    rows = -(-len(images) // columns)
    fig = figure(8, 1.35 * rows)
    panels = fig.subplots(rows, columns, squeeze=False).flat
    for axes in panels:
        axes.set_axis_off()
    for axes, (name, image) in zip(fig.axes, images.items(), strict=False):
        axes.set_axis_on()
        photograph(axes, image[::3, ::3], name, size=9)
    show(fig, f"{len(images)} photographs: {', '.join(images)}.")


def keypoints(image: np.ndarray, found: Sequence[Any], most: int = 300) -> None:
    """Draw the strongest keypoints (OpenCV's) as circles of their size, with their direction."""
    fig = figure(8, 5.4)
    axes = fig.subplots()
    strongest = sorted(found, key=lambda keypoint: -keypoint.response)[:most]
    photograph(axes, image, f"the {len(strongest)} strongest of {len(found)} keypoints")
    turn = np.linspace(0, 2 * np.pi, 24)
    for keypoint in strongest:
        (x, y), radius = keypoint.pt, keypoint.size / 2
        first = np.radians(keypoint.angle)
        xs = np.append(x, x + radius * np.cos(first + turn))
        ys = np.append(y, y + radius * np.sin(first + turn))
        axes.plot(xs, ys, color=ORANGE, linewidth=0.9)
    show(fig, f"A photograph with {len(strongest)} keypoints, most of them at corners and leaves.")


def _agreeing(detector: Any, norm: int, first: np.ndarray, second: np.ndarray) -> int:
    """Return how many matches of two photographs agree with one geometry of the two cameras."""
    (found, descriptors), (others, other_descriptors) = (
        detector.detectAndCompute(image, None) for image in (first, second)
    )
    matches = cv2.BFMatcher(norm).knnMatch(descriptors, other_descriptors, k=2)
    back = cv2.BFMatcher(norm).match(other_descriptors, descriptors)
    good = [
        best
        for best, second_best in matches
        if best.distance < 0.8 * second_best.distance
        and back[best.trainIdx].trainIdx == best.queryIdx
    ]
    if len(good) < 8:
        return 0
    here = np.array([found[match.queryIdx].pt for match in good])
    there = np.array([others[match.trainIdx].pt for match in good])
    cv2.setRNGSeed(0)
    _, inliers = cv2.findFundamentalMat(here, there, cv2.FM_RANSAC, 1.5, 0.999)
    return 0 if inliers is None else int(inliers.sum())


def compare_features(pairs: dict[str, tuple[np.ndarray, np.ndarray]], count: int = 1000) -> None:
    """Compare SIFT and ORB on pairs of photographs of the same place.

    A match counts as right if it agrees with one geometry of the two cameras. Times are the best
    of five, on this computer.
    """
    detectors = {
        "SIFT": (cv2.SIFT.create(count), cv2.NORM_L2, BLUE, ""),
        "ORB": (cv2.ORB.create(count), cv2.NORM_HAMMING, ORANGE, "//"),
    }
    grey = {
        name: [cv2.cvtColor(image, cv2.COLOR_RGB2GRAY) for image in pair]
        for name, pair in pairs.items()
    }
    fig = figure(8, 5.4)
    grid = fig.add_gridspec(3, 2 + len(pairs), height_ratios=[1, 1, 2.2])
    clock, bars = fig.add_subplot(grid[:, :2]), fig.add_subplot(grid[2, 2:])
    for column, (name, pair) in enumerate(pairs.items(), start=2):
        for row, image in enumerate(pair):
            axes = fig.add_subplot(grid[row, column])
            photograph(axes, image, name if row == 0 else "", size=8)
    said = []
    for row, (name, (detector, norm, colour, hatch)) in enumerate(detectors.items()):
        image = next(iter(grey.values()))[0]
        seconds = []
        for _ in range(5):
            start = time.perf_counter()
            detector.detectAndCompute(image, None)
            seconds.append(time.perf_counter() - start)
        style: dict[str, Any] = {"color": colour, "hatch": hatch, "edgecolor": "white"}
        clock.bar(row, 1000 * min(seconds), width=0.6, **style)
        right = [_agreeing(detector, norm, *pair) for pair in grey.values()]
        places = np.arange(len(right)) + 0.4 * row - 0.2
        drawn = bars.bar(places, right, width=0.38, label=name, **style)
        bars.bar_label(drawn, fontsize=8)
        said.append(f"{name} {', '.join(map(str, right))}")
    clock.set_xticks(range(len(detectors)), list(detectors))
    clock.set_ylabel("time for one photograph [ms]")
    bars.set_xticks(range(len(pairs)), list(pairs), fontsize=8)
    bars.set_ylabel("right matches")
    bars.legend(loc="upper right", fontsize=8)
    for axes in (clock, bars):
        quiet(axes)
    show(
        fig,
        "SIFT takes several times longer than ORB and finds more right matches between "
        f"photographs of the same place. For {', '.join(pairs)}: {'; '.join(said)}.",
    )
