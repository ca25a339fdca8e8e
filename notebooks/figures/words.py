"""Pictures of visual words: how the descriptor space is split, and what one word looks like."""

from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np
from matplotlib.axes import Axes

from notebooks.figures.style import GRAY, LIGHT, PALETTE, figure, photograph, show

COLORS = [PALETTE[0], PALETTE[1], PALETTE[2]]


def _split(points: np.ndarray, k: int) -> np.ndarray:
    """Return the (k, d) centres of k groups, always the same ones for the same points."""
    cv2.setRNGSeed(4)
    criteria = (cv2.TERM_CRITERIA_MAX_ITER, 20, 0.0)
    _, _, centers = cv2.kmeans(np.float32(points), k, None, criteria, 5, cv2.KMEANS_PP_CENTERS)
    return centers


def _cell(points: np.ndarray, centers: np.ndarray) -> np.ndarray:
    return ((points[:, np.newaxis] - centers) ** 2).sum(axis=2).argmin(axis=1)


def descriptor_space(k: int = 3) -> None:
    """Draw Figure 1: a space of two dimensions, split level by level, and the tree that results."""
    rng = np.random.default_rng(2)
    blobs = rng.uniform(0.8, 9.2, (12, 2))
    points = np.concatenate([blob + rng.normal(0, 0.55, (28, 2)) for blob in blobs])
    first = _split(points, k)
    parent = _cell(points, first)
    second = [_split(points[parent == child], k) for child in range(k)]
    query = np.array([7.2, 3.4])

    fig = figure(8, 7.6)
    (plain, one), (two, tree) = fig.subplots(2, 2)
    corner, side = np.meshgrid(np.linspace(0, 10, 300), np.linspace(0, 10, 300))
    grid = np.column_stack([corner.ravel(), side.ravel()])
    at_first = _cell(grid, first)
    at_second = np.array([k * cell for cell in at_first])
    for child in range(k):
        inside = at_first == child
        at_second[inside] += _cell(grid[inside], second[child])
    for axes, title in (
        (plain, "1. descriptors, each a point"),
        (one, f"2. k-means: {k} cells"),
        (two, f"3. k-means in each cell: {k * k} words"),
    ):
        axes.set_title(title)
        axes.set_xlim(0, 10)
        axes.set_ylim(0, 10)
        axes.set_aspect("equal")
        axes.set_xlabel("descriptor, entry 1")
        axes.set_ylabel("descriptor, entry 2")
        axes.set_xticks([])
        axes.set_yticks([])
    plain.plot(*points.T, ".", color=GRAY, markersize=4)
    for axes, cells in ((one, at_first), (two, at_second)):
        shape = cells.reshape(corner.shape)
        for cell in range(cells.max() + 1):
            color = COLORS[cell if axes is one else cell // k]
            lightness = 0.25 if axes is one else 0.12 + 0.16 * (cell % k)
            axes.contourf(
                corner, side, shape == cell, levels=[0.5, 1.5], colors=[color], alpha=lightness
            )
        axes.plot(*points.T, ".", color=GRAY, markersize=3)
    one.plot(*first.T, "k^", markersize=9)
    for child in range(k):
        two.plot(*second[child].T, "ks", markersize=6)
        for leaf, center in enumerate(second[child]):
            two.text(center[0] + 0.2, center[1] + 0.2, f"{k * child + leaf}", weight="bold")
    for axes in (plain, one, two):
        axes.plot(*query, "*", color="white", mec="black", markersize=17)
    branch = int(_cell(query[np.newaxis], first)[0])
    leaf = int(_cell(query[np.newaxis], second[branch])[0])
    _draw_tree(tree, k, branch, leaf)
    show(
        fig,
        f"Points in a plane are split by k-means into {k} cells and each of these into {k} more. "
        f"The tree beside them has {k} branches with {k} leaves each. A new descriptor, the star, "
        f"goes down branch {branch} to word {k * branch + leaf}.",
    )


def _draw_tree(axes: Axes, k: int, branch: int, leaf: int) -> None:
    """Draw the tree with the way of the query in black."""
    axes.set_title("4. the tree, and the way of the star")
    axes.set_axis_off()
    middle = (k * k - 1) / 2
    for child in range(k):
        x = k * child + (k - 1) / 2
        chosen = child == branch
        axes.plot([middle, x], [2, 1], color="black" if chosen else LIGHT, lw=3 if chosen else 1.5)
        for word in range(k):
            on_way = chosen and word == leaf
            place = k * child + word
            axes.plot([x, place], [1, 0], color="black" if on_way else LIGHT, lw=3 if on_way else 1)
            axes.plot(place, 0, "s", color=COLORS[child], markersize=12, zorder=3)
            axes.text(place, -0.22, str(place), ha="center", weight="bold")
        axes.plot(x, 1, "^", color=COLORS[child], markersize=14, zorder=3)
    axes.plot(middle, 2, "ko", markersize=12, zorder=3)
    axes.text(middle + 0.35, 2, "root", va="center")
    axes.text(middle, -0.55, "words", ha="center")
    axes.set_ylim(-0.7, 2.3)


def word_patches(
    images: Sequence[np.ndarray],
    features: Sequence[tuple[Sequence[Any], np.ndarray]],
    words_by_image: Sequence[np.ndarray],
    rows: int = 6,
    columns: int = 12,
) -> None:
    """Show spots of the photographs that belong to the same word, one word a row.

    `features[i]` are OpenCV's keypoints of `images[i]` with their descriptors, `words_by_image[i]`
    their words. Shown are the words whose descriptors differ least; the spots are turned upright
    and brought to one size, as the descriptor sees them.
    """
    descriptors = np.concatenate([values for _, values in features])
    words = np.concatenate(list(words_by_image))
    owner = np.repeat(np.arange(len(images)), [len(found) for found, _ in features])
    keypoints = [keypoint for found, _ in features for keypoint in found]
    spread = {}
    for word in np.unique(words):
        members = np.flatnonzero(words == word)
        if len(members) >= 1.5 * columns and len(np.unique(owner[members])) >= 4:
            spread[int(word)] = float(descriptors[members].std(axis=0).mean())
    chosen: list[int] = []
    for word in sorted(spread, key=lambda word: spread[word]):
        # Neighbouring numbers hang from the same branch and look alike.
        if all(abs(word - other) > len(spread) // 8 for other in chosen) and len(chosen) < rows:
            chosen.append(word)
    fig = figure(8, 0.7 * len(chosen) + 0.2)
    panels = fig.subplots(len(chosen), columns, squeeze=False)
    for row, word in zip(panels, chosen, strict=True):
        members = np.flatnonzero(words == word)
        spots = members[np.linspace(0, len(members) - 1, columns).astype(int)]
        for axes, spot in zip(row, spots, strict=True):
            photograph(axes, _upright(images[owner[spot]], keypoints[spot]))
        row[0].set_ylabel(f"word {word}", fontsize=8)
    show(fig, f"Spots of photographs that belong to the words {', '.join(map(str, chosen))}.")


def _upright(image: np.ndarray, keypoint: Any, pixels: int = 48) -> np.ndarray:
    """Return the surroundings of a keypoint, turned and scaled to a square of so many pixels."""
    scale = pixels / (6 * keypoint.size)  # SIFT looks at about six times the keypoint's size
    turn = cv2.getRotationMatrix2D(keypoint.pt, keypoint.angle, scale)
    turn[:, 2] += pixels / 2 - np.array(keypoint.pt)
    return cv2.warpAffine(image, turn, (pixels, pixels), borderMode=cv2.BORDER_REFLECT)
