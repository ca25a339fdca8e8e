"""Pictures of features: where they are, and how SIFT and ORB compare."""

import time
from collections.abc import Collection, Sequence
from typing import Any

import cv2
import numpy as np
from matplotlib.ticker import ScalarFormatter

from notebooks.figures.style import (
    BLUE,
    GRAY,
    LIGHT,
    ORANGE,
    figure,
    photograph,
    predicted_beside,
    quiet,
    show,
)
from notebooks.two_views import two_views


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


def compare_features(
    images: dict[str, np.ndarray],
    pairs: Collection[frozenset[str]],
    predicted: str | None = None,
    count: int = 1000,
) -> None:
    """Compare SIFT and ORB on all pairs of photographs that show the same place.

    Drawn are the matches that agree with one geometry of the two cameras, and as a band the most
    that agree by chance: between each pair's first photograph and one of another place. Times are
    the median over all photographs, on this computer.
    """
    listed = sorted(sorted(pair) for pair in pairs)
    names = list(images)
    strangers = []
    for n, (one, other) in enumerate(listed):
        far = [
            name for name in names if not {frozenset((name, x)) for x in (one, other)} & set(pairs)
        ]
        strangers.append((one, [name for name in far if name not in (one, other)][(7 * n) % 15]))
    fig = figure(8, 4.4)
    clock, dots = fig.subplots(1, 2, width_ratios=[1, 4])
    counts, chance = {}, 1
    for row, (name, (detector, norm, color, marker)) in enumerate(_detectors(count).items()):
        found, seconds = {}, []
        for photo, image in images.items():
            gray = cv2.cvtColor(image, cv2.COLOR_RGB2GRAY)
            start = time.perf_counter()
            found[photo] = detector.detectAndCompute(gray, None)
            seconds.append(time.perf_counter() - start)
        right, wrong = (
            np.array([two_views(found[a], found[b], norm).agree.sum() for a, b in these])
            for these in (listed, strangers)
        )
        counts[name], chance = right, max(chance, int(wrong.max(initial=1)))
        order = np.argsort(-next(iter(counts.values())), kind="stable").tolist()
        clock.bar(row, 1000 * np.median(seconds), width=0.6, color=color)
        dots.plot(right[order], marker, color=color, label=name, markersize=7)
    label = f"by chance, in {len(strangers)} pairs of different places"
    dots.axhspan(1, chance, color=GRAY, alpha=0.2, lw=0, label=label)
    above = ", ".join(
        f"{name} {(right > chance).sum()} of {len(listed)}" for name, right in counts.items()
    )
    clock.set_xticks(range(2), ["SIFT", "ORB"])
    clock.set_ylabel("time for one photograph [ms]")
    dots.set_xticks(range(len(listed)), ["-".join(listed[n]) for n in order], rotation=90)
    dots.tick_params(axis="x", labelsize=7)
    dots.set_yscale("log")
    dots.yaxis.set_major_formatter(ScalarFormatter())
    dots.set_ylabel("matches that agree")
    dots.set_ylim(bottom=5)
    dots.grid(axis="y", color=LIGHT)
    dots.set_title(f"pairs above the band: {above}", fontsize=9)
    dots.legend(fontsize=8)
    for axes in (clock, dots):
        quiet(axes)
    guess = predicted_beside(fig, predicted)
    show(
        fig,
        f"SIFT and ORB on {len(listed)} pairs of photographs of the same place. Between different "
        f"places up to {chance} matches agree by chance. Pairs with more than that: {above}. "
        f"{guess}",
    )


def _detectors(count: int) -> dict[str, tuple[Any, int, str, str]]:
    return {
        "SIFT": (cv2.SIFT.create(count), cv2.NORM_L2, BLUE, "o"),
        "ORB": (cv2.ORB.create(count), cv2.NORM_HAMMING, ORANGE, "s"),
    }


def binary_descriptors(one: np.ndarray, other: np.ndarray) -> None:
    """Draw the 256 bits of a spot, of the same spot in another photograph, and of a third one."""
    detector, norm, *_ = _detectors(1000)["ORB"]
    images = [cv2.cvtColor(image, cv2.COLOR_RGB2GRAY) for image in (one, other)]
    (spots, bits), (others, other_bits) = (detector.detectAndCompute(i, None) for i in images)
    matches = cv2.BFMatcher(norm, crossCheck=True).match(bits, other_bits)
    best = min(matches, key=lambda match: match.distance)
    third = max(range(len(bits)), key=lambda n: spots[n].response)
    shown = [
        ("a spot", images[0], spots[best.queryIdx], bits[best.queryIdx]),
        ("found again", images[1], others[best.trainIdx], other_bits[best.trainIdx]),
        ("another spot", images[0], spots[third], bits[third]),
    ]
    fig = figure(8, 1.7)
    panels = fig.subplots(1, 6)
    said = []
    for n, (title, image, spot, descriptor) in enumerate(shown):
        differ = int(np.unpackbits(descriptor ^ shown[0][3]).sum())
        x, y = (int(value) for value in spot.pt)
        photograph(panels[2 * n], image[max(0, y - 24) : y + 24, max(0, x - 24) : x + 24], title)
        photograph(panels[2 * n + 1], np.unpackbits(descriptor).reshape(16, 16))
        panels[2 * n + 1].set_title(f"{differ} of 256 differ" if n else "256 bits", fontsize=9)
        said.append(f"{title}: {differ} of 256 bits differ")
    show(fig, f"ORB descriptors as squares of black and white bits. {'; '.join(said[1:])}.")
