"""The still picture of a keypoint's journey, for where no widget can be drawn."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import ConnectionPatch

from notebooks.explorers.journey import Journey, Level, first_spot
from notebooks.figures.style import (
    BLUE,
    GRAY,
    LIGHT,
    ORANGE,
    VERMILLION,
    figure,
    note,
    photograph,
    quiet,
    show,
)
from notebooks.figures.words import _upright

CHILDREN = 8
EXAMPLES = 6
NOT_YET = "A function that the journey needs is not written yet."


def journey(journey: Journey) -> None:
    """Draw one keypoint's way down a tree of three levels, its votes, and its epipolar line."""
    levels = journey.levels(CHILDREN)
    spots, _ = journey.features[journey.query]
    number = first_spot(journey)
    votes = journey.votes(levels[-1])
    place = int(votes.argmax())
    name, views = journey.places[place], journey.views[place]

    fig = figure(8, 8.4)
    parts: Any = fig.subfigures(3, 1, height_ratios=[3, 2.2, 3])
    top, middle, bottom = parts
    photo, way = top.subplots(1, 2, width_ratios=[1.4, 1])
    photograph(photo, journey.photographs[journey.query], f"{journey.query}: keypoint {number + 1}")
    photo.plot(*spots[number].pt, "o", mfc="none", mec=VERMILLION, mew=2.5, markersize=14)
    _draw_way(way, journey, levels, number)
    _draw_votes(middle.subplots(), journey, levels[-1], votes, number)
    left, right = bottom.subplots(1, 2)
    photograph(left, journey.photographs[journey.query], journey.query)
    photograph(right, journey.photographs[name], f"{name}, the best candidate")
    for start, end, good in zip(views.here, views.there, views.agree, strict=True):
        style: dict[str, Any] = {"color": BLUE, "lw": 0.9} if good else {"color": ORANGE, "ls": ":"}
        axes = {"axesA": left, "axesB": right}
        bottom.add_artist(ConnectionPatch(start, end, "data", "data", **axes, **style))
    left.plot(*spots[number].pt, "o", mfc="none", mec=VERMILLION, mew=2.5, markersize=12)
    if views.fundamental is not None:
        _draw_epipolar(right, views.fundamental @ [*spots[number].pt, 1.0])
    agree = f"{views.agree.sum()} of {len(views.agree)} matches agree with one geometry (solid)"
    bottom.suptitle(agree, fontsize=10)
    words = levels[-1].words
    show(
        fig,
        f"Keypoint {number + 1} of {journey.query} "
        + (f"is word {words[number]}. " if words is not None else "goes nowhere yet. ")
        + (
            f"The best candidate is {name} with {votes[place]:.0f} votes. "
            if votes.any()
            else NOT_YET
        )
        + f" Of the matches with {name}, {agree}.",
    )


def _draw_way(axes: Axes, journey: Journey, levels: list[Level], number: int) -> None:
    """Draw, for each node on the way, spots of the walk that were in it in training."""
    axes.set_axis_off()
    axes.set_title(f"the way down, {CHILDREN} children a node", fontsize=10)
    if levels[0].words is None:
        return note(axes, "descend_tree is not written yet.")
    axes.set_xlim(0, EXAMPLES)
    axes.set_ylim(-0.1, 1.5 * len(levels))
    for row, level in enumerate(levels):
        low = 1.5 * (len(levels) - 1 - row)
        node = int(level.words[number]) if level.words is not None else 0
        members = np.flatnonzero(level.members == node)
        text = f"level {row + 1}: row {node}, {level.sizes[node]} spots of the walk"
        axes.text(0, low + 1.05, text, fontsize=8)
        if len(members) == 0:
            continue
        for column, spot in enumerate(
            members[np.linspace(0, len(members) - 1, EXAMPLES).astype(int)]
        ):
            owner = journey.places[journey.owners[spot]]
            patch = _upright(journey.photographs[owner], journey.spots[spot])
            axes.imshow(
                patch, extent=(column + 0.03, column + 0.97, low, low + 0.97), aspect="auto"
            )
    return None


def _draw_votes(axes: Axes, journey: Journey, level: Level, votes: np.ndarray, number: int) -> None:
    """Draw the votes of all keypoints, and which places this one votes for."""
    axes.set_ylabel("votes")
    axes.grid(axis="y", color=LIGHT)
    quiet(axes)
    if level.words is None or level.rows is None:
        return note(axes, NOT_YET)
    row = level.rows[int(level.words[number])]
    best = np.arange(len(votes)) == votes.argmax()
    axes.bar(np.arange(len(votes)), votes, color=[BLUE if one else GRAY for one in best])
    axes.plot(row, votes[row], "o", color=VERMILLION, mec="white", markersize=8)
    axes.set_xticks(range(len(votes)), journey.places, fontsize=7)
    title = f"all votes; dots: the {len(row)} places in the row of word {level.words[number]}"
    axes.set_title(title, fontsize=10)
    return None


def _draw_epipolar(axes: Axes, line: np.ndarray) -> None:
    """Draw the line a x + b y + c = 0 across a photograph."""
    limits = axes.get_xlim(), axes.get_ylim()
    a, b, c = line / np.hypot(*line[:2])
    ends = np.array([-a * c, -b * c]) + np.outer([-2000, 2000], [-b, a])
    axes.plot(*ends.T, color=VERMILLION, linewidth=2)
    axes.set_xlim(limits[0])
    axes.set_ylim(limits[1])
