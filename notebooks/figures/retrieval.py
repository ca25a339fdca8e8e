"""Pictures of place recognition: who gets the votes, and do the places match?"""

from collections.abc import Callable, Collection, Sequence
from typing import Any

import numpy as np
from matplotlib.patches import ConnectionPatch
from matplotlib.ticker import ScalarFormatter

from notebooks.figures.style import (
    BLUE,
    GREEN,
    GREY,
    LIGHT,
    ORANGE,
    VERMILLION,
    attempt,
    figure,
    note,
    photograph,
    quiet,
    show,
)

Images = dict[str, np.ndarray]
Pairs = Collection[frozenset[str]]
NOT_YET = "A function that this search needs is not written yet."


def _is_same(one: str, other: str, pairs: Pairs) -> bool:
    return frozenset((one, other)) in pairs


def search_results(
    queries: Images, walk: Images, search: Callable[[str], Any], pairs: Pairs, label: str
) -> None:
    """Show each query, the score of every photograph, and the three photographs found.

    `search(name)` returns one number for each photograph of the walk, large for a good match.
    `pairs` are the pairs of names that show the same place: their bars are green, and a
    photograph found is framed green or red.
    """
    fig = figure(8, 1.55 * len(queries))
    grid = fig.add_gridspec(len(queries), 6)
    names = list(walk)
    right = 0
    said = []
    for row, (name, image) in enumerate(queries.items()):
        axes = fig.add_subplot(grid[row, 0])
        photograph(axes, image[::2, ::2], f"query {name}", size=8)
        bars = fig.add_subplot(grid[row, 1:3])
        scores = attempt(search, name)
        if scores is None:
            bars.set_axis_off()
            if row == 0:
                fig.text(0.55, 0.9, NOT_YET, ha="center", color=VERMILLION)
            continue
        scores = np.asarray(scores, dtype=float)
        colours = [GREEN if _is_same(name, other, pairs) else GREY for other in names]
        bars.bar(range(len(names)), scores, color=colours)
        low, high = scores.min(), scores.max()
        bars.set_ylim(low - 0.15 * (high - low), high + 0.05 * (high - low))
        bars.set_xticks([])
        bars.tick_params(labelsize=7)
        bars.set_ylabel(label, fontsize=7)
        quiet(bars)
        if row == len(queries) - 1:
            bars.set_xlabel("photographs of the walk, in order", fontsize=8)
        best = np.argsort(-scores, kind="stable")[:3]
        for place, index in enumerate(best):
            found = names[index]
            same = _is_same(name, found, pairs)
            axes = fig.add_subplot(grid[row, 3 + place])
            title = f"{place + 1}. {found} {'✓' if same else '✗'}"
            photograph(axes, walk[found][::2, ::2], title, size=8)
            for side in axes.spines.values():
                side.set(color=GREEN if same else VERMILLION, linewidth=2.5)
        right += _is_same(name, names[best[0]], pairs)
        said.append(f"{name}: {', '.join(names[index] for index in best)}")
    if said:
        fig.suptitle(f"{right} of {len(queries)} first places are right (green: the same place)")
    show(fig, f"The photographs found for each query. {'; '.join(said) or NOT_YET}")


def matches(
    first: np.ndarray,
    second: np.ndarray,
    here: np.ndarray,
    there: np.ndarray,
    agree: np.ndarray,
    title: str = "",
) -> None:
    """Draw two photographs and their matches from `here` to `there`, (N, 2) pixels each.

    `agree` tells which matches agree with one geometry; all others are drawn thin.
    """
    fig = figure(8, 3.1)
    left, right = fig.subplots(1, 2)
    photograph(left, first)
    photograph(right, second)
    agree = np.asarray(agree, dtype=bool).ravel()
    for start, end, good in sorted(
        zip(here.tolist(), there.tolist(), agree.tolist(), strict=True), key=lambda item: item[2]
    ):
        line = ConnectionPatch(
            start,
            end,
            "data",
            "data",
            axesA=left,
            axesB=right,
            color=BLUE if good else ORANGE,
            linewidth=1.0 if good else 0.5,
            linestyle="-" if good else ":",
        )
        fig.add_artist(line)
    text = f"{agree.sum()} of {len(agree)} matches agree with one geometry (solid blue)"
    fig.suptitle(f"{title}: {text}" if title else text, fontsize=11)
    show(fig, f"Two photographs and their matches. {title}: {text}.")


def agreement(counts: dict[str, Sequence[int]], walk: Images, pairs: Pairs, threshold: int) -> None:
    """Draw for each query how many matches agree with each photograph of the walk."""
    fig = figure(8, 3.4)
    axes = fig.subplots()
    names = list(walk)
    for row, (query, numbers) in enumerate(counts.items()):
        same = np.array([_is_same(query, name, pairs) for name in names])
        values = np.maximum(np.asarray(numbers), 1)
        axes.plot(values[~same], np.full((~same).sum(), row), "x", color=GREY, markersize=7)
        axes.plot(values[same], np.full(same.sum(), row), "o", color=GREEN, markersize=8)
    axes.plot([], [], "o", color=GREEN, label="the same place")
    axes.plot([], [], "x", color=GREY, label="another place")
    axes.axvline(threshold, color=VERMILLION, linestyle="--", label=f"threshold {threshold}")
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.set_yticks(range(len(counts)), [f"query {name}" for name in counts])
    axes.invert_yaxis()
    axes.set_xlabel("matches that agree with one geometry")
    axes.grid(axis="x", color=LIGHT)
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    quiet(axes)
    show(
        fig,
        "Matches that agree with one geometry, for each query and each photograph of the walk. "
        f"Photographs of other places stay below {threshold}; some of the same place do too.",
    )


def first_places(searches: dict[str, Callable[..., Any]], images: Images, pairs: Pairs) -> None:
    """Let every photograph search among all others, and draw how often each search is right.

    `search(name, names)` returns one number for each of the names; the entry of the photograph
    itself is left out. Photographs without another one of the same place do not count.
    """
    names = tuple(images)
    asked = [name for name in names if any(name in pair for pair in pairs)]
    fig = figure(8, 0.7 * len(searches) + 0.9)
    axes = fig.subplots()
    said = []
    for row, (label, search) in enumerate(searches.items()):
        right = 0
        for name in asked:
            scores = attempt(search, name, names)
            if scores is None:
                break
            scores = np.array(scores, dtype=float)
            scores[names.index(name)] = -np.inf
            right += _is_same(name, names[int(scores.argmax())], pairs)
        else:
            bar = axes.barh(row, right, color=BLUE, height=0.6)
            axes.bar_label(bar, [f" {right} of {len(asked)}"])
            said.append(f"{label}: {right} of {len(asked)}")
    if not said:
        note(axes, NOT_YET)
    axes.set_yticks(range(len(searches)), list(searches))
    axes.invert_yaxis()
    axes.set_xlim(0, len(asked) * 1.12)
    axes.set_xticks(range(0, len(asked) + 1, 5))
    axes.set_xlabel("photographs whose first place is right")
    quiet(axes)
    show(fig, f"How often the first place is right. {'; '.join(said) or NOT_YET}")
