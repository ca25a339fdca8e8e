"""Pictures of place recognition: who gets the votes, and do the places match?"""

from collections.abc import Callable, Collection
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import ConnectionPatch
from matplotlib.ticker import ScalarFormatter

from notebooks.figures.style import (
    BLUE,
    GRAY,
    GREEN,
    LIGHT,
    ORANGE,
    PREDICTED,
    VERMILLION,
    StudentFunction,
    attempt,
    figure,
    note,
    photograph,
    predicted_beside,
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
        colors = [GREEN if _is_same(name, other, pairs) else GRAY for other in names]
        bars.bar(range(len(names)), scores, color=colors)
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


def agreement(
    agreeing: StudentFunction,
    queries: tuple[str, ...],
    walk: tuple[str, ...],
    pairs: Pairs,
    threshold: int,
    undecided: Pairs = (),
) -> None:
    """Draw for each query how many matches agree with each photograph that was verified.

    `agreeing(name, walk)` returns one number for each photograph of the walk, 0 where it was not
    looked at. The most that wrong photographs reach on the walk itself is drawn as a band.
    """
    fig = figure(8, 3.4)
    axes = fig.subplots()
    learnt, tried = (
        _decisions(agreeing, names, walk, pairs, undecided) for names in (walk, queries)
    )
    if learnt is None or tried is None:
        note(axes, NOT_YET)
        return show(fig, NOT_YET)
    chance = float(learnt.scores[~learnt.same].max(initial=1.0))
    for row, query in enumerate(queries):
        values = np.asarray(agreeing(query, walk))
        same = np.array([_is_same(query, name, pairs) for name in walk])
        for these, marker, color in ((~same, "x", GRAY), (same, "o", GREEN)):
            these = these & (values > 0)
            axes.plot(values[these], np.full(these.sum(), row), marker, color=color, markersize=8)
    axes.plot([], [], "o", color=GREEN, label="the same place")
    axes.plot([], [], "x", color=GRAY, label="another place")
    label = f"wrong on the walk: up to {chance:.0f}"
    axes.axvspan(1, chance, color=GRAY, alpha=0.2, lw=0, label=label)
    axes.axvline(threshold, color=VERMILLION, linestyle="--", label=f"threshold {threshold}")
    axes.set_xscale("log")
    axes.set_xlim(left=5)
    axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.set_yticks(range(len(queries)), [f"query {name}" for name in queries])
    axes.invert_yaxis()
    axes.set_xlabel("matches that agree with one geometry")
    axes.grid(axis="x", color=LIGHT)
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    quiet(axes)
    return show(
        fig,
        "Matches that agree with one geometry, for each query and its candidates on the walk, with "
        f"the threshold {threshold}. Wrong candidates reach {chance:.0f} on the walk, and "
        f"{tried.scores[~tried.same].max(initial=0):.0f} for the queries.",
    )


def first_places(
    searches: dict[str, StudentFunction],
    images: Images,
    pairs: Pairs,
    predicted: float | None = None,
) -> None:
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
    if predicted is not None:
        axes.axvline(predicted, color=PREDICTED, ls="--", lw=2)
    guess = predicted_beside(fig, predicted, f" of {len(asked)}")
    axes.set_yticks(range(len(searches)), list(searches))
    axes.invert_yaxis()
    axes.set_xlim(0, len(asked) * 1.12)
    axes.set_xticks(range(0, len(asked) + 1, 5))
    axes.set_xlabel("photographs whose first place is right")
    quiet(axes)
    show(fig, f"How often the first place is right. {'; '.join(said) or NOT_YET} {guess}")


class _Decisions(NamedTuple):
    """Scores of pairs of photographs, and which of them show the same place."""

    scores: np.ndarray  # (N,)
    same: np.ndarray  # (N,) bool

    def at(self, threshold: float) -> tuple[int, int, int]:
        """Count the right, the wrong and the missed loops at a threshold."""
        closed = self.scores >= threshold
        right = int((closed & self.same).sum())
        return right, int((closed & ~self.same).sum()), int(self.same.sum()) - right


def precision_recall(
    scores: dict[str, StudentFunction],
    walk: tuple[str, ...],
    queries: tuple[str, ...],
    pairs: Pairs,
    wrong_costs: float,
    predicted: str | None = None,
    undecided: Pairs = (),
) -> None:
    """Draw precision and recall over the threshold of each score, on the walk and on the queries.

    `score(name, walk)` returns one number for each photograph of the walk, large for a good match;
    every photograph of the walk is compared with all others. The threshold is the one that costs
    least on the walk, if a wrong loop costs as much as `wrong_costs` missed ones; of several the
    highest. It may lie above all scores of the walk: then no loop is closed. Pairs that are
    `undecided` count for neither.
    """
    fig = figure(8, 3.1 * len(scores))
    panels = fig.subplots(len(scores), 2, squeeze=False)
    said = []
    for row, (label, score) in zip(panels, scores.items(), strict=True):
        learnt = _decisions(score, walk, walk, pairs, undecided)
        tried = _decisions(score, queries, walk, pairs, undecided)
        if learnt is None or tried is None:
            for axes in row:
                note(axes, NOT_YET)
            continue
        most = learnt.scores.max()
        steps = np.unique(np.append(learnt.scores, most + 0.03 * np.ptp(learnt.scores) + 1e-9))
        costs = [wrong_costs * wrong + missed for _, wrong, missed in map(learnt.at, steps)]
        threshold = float(steps[::-1][int(np.argmin(costs[::-1]))])
        for axes, decisions, where in zip(
            row, (learnt, tried), ("walk", "five queries"), strict=True
        ):
            _draw_decisions(axes, decisions, steps, threshold)
            # Above all scores of the walk means: close no loop, whatever the queries score.
            closes = threshold <= most
            right, wrong, missed = decisions.at(threshold if closes else np.inf)
            loops = f"{right} right, {wrong} wrong, {missed} missed loops"
            chosen = f"threshold {threshold:.3g}" if closes else "no loop closed"
            axes.set_title(f"{where}, {chosen}:\n{loops}", fontsize=9)
            axes.set_xlabel(f"threshold: {label}")
            said.append(f"{label}, {where}, {chosen}: {loops}")
    if said:
        lines = next(axes for axes in panels[:, 0] if axes.lines).get_legend_handles_labels()
        fig.legend(*lines, fontsize=9, frameon=False, loc="outside lower center", ncols=3)
    guess = predicted_beside(fig, predicted)
    show(fig, f"Precision and recall over the threshold. {'; '.join(said) or NOT_YET} {guess}")


def _decisions(
    score: StudentFunction,
    names: tuple[str, ...],
    walk: tuple[str, ...],
    pairs: Pairs,
    undecided: Pairs,
) -> _Decisions | None:
    found, same = [], []
    for name in names:
        values = attempt(score, name, walk)
        if values is None:
            return None
        for other, value in zip(walk, np.asarray(values, dtype=float).tolist(), strict=True):
            if other != name and not _is_same(name, other, undecided):
                found.append(value)
                same.append(_is_same(name, other, pairs))
    return _Decisions(np.array(found), np.array(same))


def _draw_decisions(axes: Axes, decisions: _Decisions, steps: np.ndarray, threshold: float) -> None:
    counted = np.array([decisions.at(step) for step in steps], dtype=float)
    right, wrong, missed = counted.T
    closed = right + wrong > 0
    precision = right[closed] / (right + wrong)[closed]
    axes.plot(steps[closed], precision, color=BLUE, lw=2, label="precision")
    axes.plot(
        steps, right / np.maximum(right + missed, 1), color=ORANGE, lw=2, ls="--", label="recall"
    )
    axes.axvline(threshold, color=VERMILLION, ls=":", lw=2, label="threshold chosen on the walk")
    if steps.max() > 10:
        axes.set_xscale("symlog", linthresh=10)
        axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.set_ylim(-0.03, 1.05)
    axes.grid(color=LIGHT)
    quiet(axes)
