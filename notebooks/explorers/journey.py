"""A keypoint's journey: from a spot of a photograph down the tree, into votes and geometry."""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import cv2
import numpy as np

from notebooks.explorers.explorer import Explorer
from notebooks.two_views import TwoViews, two_views

CHILDREN = (4, 8, 12)  # of each node, to choose from
DEPTH = 3
_EXAMPLES = 6  # spots of the walk that are shown for each node
_QUALITY = 50  # of the photographs, in JPEG's per cent: they travel to the browser

Images = Mapping[str, np.ndarray]
Found = tuple[Sequence[Any], np.ndarray]  # OpenCV's keypoints, and their descriptors


class Functions(NamedTuple):
    """The functions of the chapter with which the journey is made; any may still be a stub."""

    train_tree: Callable[..., Any]
    descend_tree: Callable[..., Any]
    build_inverted_file: Callable[..., Any]
    idf_weights: Callable[..., object]


class Level(NamedTuple):
    """What is known about a tree that ends at one level; None where a function is not written."""

    word_count: int
    words: np.ndarray | None  # (N,) the words of the query's spots
    rows: list[list[int]] | None  # of the inverted file: for each word the places that have it
    weights: np.ndarray | None  # (word_count,)
    sizes: np.ndarray  # (word_count,) how many spots of the walk were in the group in training
    members: np.ndarray  # (spots of the walk,) the group of each in training


class Journey:
    """Everything the explorer and its still picture show, computed when it is asked for."""

    def __init__(
        self,
        query: str,
        photographs: Images,
        features: Mapping[str, Found],
        places: Sequence[str],
        functions: Functions,
    ) -> None:
        self.query = query
        self.photographs = photographs
        self.features = features
        self.places = [place for place in places if place != query]
        self.functions = functions
        self._trees: dict[int, list[Level]] = {}

    @cached_property
    def views(self) -> list[TwoViews]:
        """The matches of the query with each place."""
        return [two_views(self.features[self.query], self.features[name]) for name in self.places]

    @cached_property
    def owners(self) -> np.ndarray:
        """(spots of the walk,) the place of each spot, and `spots` the keypoints themselves."""
        return np.repeat(
            np.arange(len(self.places)), [len(self.features[name][0]) for name in self.places]
        )

    @cached_property
    def spots(self) -> list[object]:
        """OpenCV's keypoints of all places, one place after the other."""
        return [spot for name in self.places for spot in self.features[name][0]]

    def levels(self, children: int) -> list[Level]:
        """Return what a tree with so many children at each node gives, ended at level 1, 2, 3."""
        if children not in self._trees:
            self._trees[children] = self._grown(children)
        return self._trees[children]

    def votes(self, level: Level, weighted: bool = False, voters: int | None = None) -> np.ndarray:
        """Return the votes (places,) of the query's first `voters` spots (all by default)."""
        votes = np.zeros(len(self.places))
        weights = level.weights if weighted else np.ones(level.word_count)
        if level.words is None or level.rows is None or weights is None:
            return votes
        for word in level.words[:voters]:
            votes[level.rows[word]] += weights[word]
        return votes

    def _grown(self, children: int) -> list[Level]:
        collection = np.vstack([self.features[name][1] for name in self.places])
        centers, members = self.functions.train_tree(collection, children, DEPTH)
        ends = np.cumsum([len(self.features[name][0]) for name in self.places])[:-1]
        leaves = [self._words(self.features[self.query][1], centers)]
        if leaves[0] is not None:
            leaves += [self._words(part, centers) for part in np.split(collection, ends)]
        levels = []
        for depth in range(1, DEPTH + 1):
            count, above = children**depth, children ** (DEPTH - depth)
            words = [leaf // above for leaf in leaves if leaf is not None]
            rows = weights = None
            if words:
                rows = self._rows(words[1:], count)
                bags = np.array([np.bincount(word, minlength=count) for word in words[1:]])
                weights = self._weights(bags)
            sizes = np.bincount(members // above, minlength=count)
            own = words[0] if words else None
            levels.append(Level(count, own, rows, weights, sizes, members // above))
        return levels

    def _words(self, descriptors: np.ndarray, centers: list[np.ndarray]) -> np.ndarray | None:
        found = _tried(
            lambda: [self.functions.descend_tree(descriptor, centers) for descriptor in descriptors]
        )
        return None if found is None else _whole(found, len(centers[-1]), "descend_tree", "a word")

    def _rows(self, words: list[Any], count: int) -> list[list[int]] | None:
        name = "build_inverted_file"
        found = _tried(lambda: self.functions.build_inverted_file(words, count))
        if found is not None and len(found) != count:
            raise ValueError(f"{name} should return {count} lists, not {len(found)}; check it.")
        return found and [
            _whole(list(row), len(words), name, "a list of images").tolist() for row in found
        ]

    def _weights(self, bags: np.ndarray) -> np.ndarray | None:
        found = _tried(lambda: self.functions.idf_weights(bags))
        if found is None:
            return None
        weights = np.asarray(found, dtype=float)
        if weights.shape != bags.shape[1:] or not np.isfinite(weights).all():
            raise ValueError("idf_weights should return a finite number for each word; check it.")
        return weights


def explore_journey(
    query: str,
    photographs: Images,
    features: Mapping[str, Found],
    places: Sequence[str],
    functions: Sequence[Callable[..., object]],
) -> Explorer:
    """Follow one spot of a photograph down the tree, into the votes and into the best candidate.

    Args:
        query: the name of the photograph that asks.
        photographs: (H, W, 3) arrays of bytes by name.
        features: OpenCV's keypoints and (N, 128) descriptors by name.
        places: the names of the photographs that may be found.
        functions: the chapter's train_tree, descend_tree, build_inverted_file and idf_weights;
            what a function shows is left out while it is not written.

    Raises:
        ValueError: if a name has no photograph or no features, or, when it is shown, if one of the
            functions returns what cannot be drawn.
    """
    for name in [query, *places]:
        if name not in photographs or name not in features or len(features[name][0]) < 2:
            raise ValueError(f"explore_journey needs a photograph with features for {name!r}.")
    journey = Journey(query, photographs, features, places, Functions(*functions))

    def still() -> None:
        from notebooks import figures

        figures.journey(journey)

    return Explorer(
        "journey.js",
        lambda: _values(journey),
        f"Explorer: the journey of a keypoint of {query} through {len(journey.places)} places. "
        "Open this notebook in JupyterLab to use it.",
        still,
    )


def first_spot(journey: Journey) -> int:
    """Return the spot that is shown first: the strongest one of those whose match agrees."""
    spots, _ = journey.features[journey.query]
    best = max(journey.views, key=lambda views: views.agree.sum())
    agreeing = {tuple(spot) for spot in best.here[best.agree].tolist()}
    strongest = sorted(range(len(spots)), key=lambda number: -spots[number].response)
    return next((n for n in strongest if spots[n].pt in agreeing), strongest[0])


def _values(journey: Journey) -> dict[str, object]:
    """What the browser needs, as plain data: pixels are rounded to tenths."""
    shown: dict[int, int] = {}  # spot of the walk -> its row in `patches`
    trees = []
    for children in CHILDREN:
        levels = journey.levels(children)
        trees.append({"children": children, "levels": [_level(one, shown) for one in levels]})
    patches = [[int(journey.owners[spot]), *_circle(journey.spots[spot])] for spot in shown]
    return {
        "query": journey.query,
        "places": journey.places,
        "photographs": {
            name: _picture(journey.photographs[name]) for name in [journey.query, *journey.places]
        },
        "size": [*reversed(journey.photographs[journey.query].shape[:2])],
        "spots": [_circle(spot) for spot in journey.features[journey.query][0]],
        "first": first_spot(journey),
        "trees": trees,
        "patches": patches,
        "matches": [_matches(views) for views in journey.views],
    }


def _level(level: Level, shown: dict[int, int]) -> dict[str, object]:
    examples: dict[str, list[int]] = {}
    visited = [] if level.words is None else np.unique(level.words).tolist()
    for word in visited:
        members = np.flatnonzero(level.members == word)
        if len(members) == 0:  # the walk's spots went elsewhere in training
            examples[str(word)] = []
            continue
        chosen = members[np.linspace(0, len(members) - 1, _EXAMPLES).astype(int)]
        examples[str(word)] = [
            shown.setdefault(int(spot), len(shown)) for spot in dict.fromkeys(chosen)
        ]
    return {
        "count": level.word_count,
        "words": None if level.words is None else level.words.tolist(),
        "rows": level.rows,
        "weights": None if level.weights is None else level.weights.round(4).tolist(),
        "sizes": level.sizes.tolist(),
        "examples": examples,
    }


def _matches(views: TwoViews) -> dict[str, object]:
    pairs = np.column_stack([views.here, views.there]).round(1)
    matrix = views.fundamental
    return {
        "pairs": pairs.tolist(),
        "agree": views.agree.astype(int).tolist(),
        "fundamental": None if matrix is None else matrix.tolist(),
    }


def _circle(spot: Any) -> list[float]:
    return [round(value, 1) for value in (*spot.pt, spot.size, spot.angle)]


def _picture(image: np.ndarray) -> str:
    quality = [cv2.IMWRITE_JPEG_QUALITY, _QUALITY]
    _, content = cv2.imencode(".jpg", np.ascontiguousarray(image[:, :, ::-1]), quality)
    return "data:image/jpeg;base64," + base64.b64encode(content.tobytes()).decode()


def _tried(function: Callable[[], object]) -> Any:
    try:
        return function()
    except NotImplementedError:
        return None


def _whole(found: object, below: int, name: str, what: str) -> np.ndarray:
    numbers = np.asarray(found)
    if numbers.size == 0:
        return np.zeros(0, dtype=int)
    if numbers.dtype.kind not in "iu" or numbers.min() < 0 or numbers.max() >= below:
        raise ValueError(
            f"{name} should return {what}, whole numbers from 0 to {below - 1}; check it."
        )
    return numbers.astype(int)
