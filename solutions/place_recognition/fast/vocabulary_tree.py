"""The vocabulary tree: hierarchical k-means, and the words of many descriptors at once.

Source: Nister and Stewenius, Scalable recognition with a vocabulary tree, CVPR 2006.
"""

import hashlib
from collections.abc import Iterator
from pathlib import Path
from typing import Self

import numpy as np

from solutions.place_recognition.fast.storage import read_arrays, write_arrays
from solutions.place_recognition.features import are_bits
from solutions.place_recognition.k_means import half_squares, k_means, nearest_centers

# A centre is settled well before it has seen this many points; faiss draws the line there too.
POINTS_PER_CENTER = 256


class VocabularyTree:
    """A tree in which every node has `branching` children, and the leaves are the visual words.

    Descriptors are (N, d): numbers such as SIFT's (also as 128 bytes), or other bytes (uint8),
    each with 8 bits, such as ORB's. Bits are taken as coordinates 0 and 1: the squared distance
    of two such points is the number of bits in which they differ, and a centre holds the share
    of ones.

    The centres of a level are one (nodes, branching, d) array: [i, j] is child j of node i,
    and node branching * i + j of the next level. Where a node had fewer different
    descriptors than children, some of them do not exist: their `offset` is infinite.
    """

    def __init__(self, branching: int = 10, depth: int = 3):
        if branching < 2 or depth < 1:
            raise ValueError(
                f"Needs branching of 2 or more and depth of 1 or more, not {branching} and {depth}."
            )
        self.branching = branching
        self.depth = depth
        self.binary = False
        self._centers: list[np.ndarray] = []
        self._offsets: list[np.ndarray] = []  # |c|²/2, infinite for a child that does not exist

    @property
    def word_count(self) -> int:
        return self.branching**self.depth

    @property
    def levels(self) -> list[np.ndarray]:
        """The centres as `words.descend_tree` takes them: (nodes, d) on each level.

        Children that do not exist are inf.
        """
        return [
            np.where(np.isinf(offsets)[..., None], np.inf, centers).reshape(-1, centers.shape[-1])
            for centers, offsets in zip(self._centers, self._offsets, strict=True)
        ]

    def fit(self, descriptors: np.ndarray, rng: np.random.Generator, iterations: int = 10) -> Self:
        """Learn the words from the descriptors of a large collection of images.

        Each node's descriptors are divided by k-means; where there are very many, a sample of
        them decides.

        Raises:
            ValueError: for descriptors that are none; the tree then stays as it was.
        """
        points = _as_points(descriptors)
        descriptors = np.asarray(descriptors)
        if len(points) == 0:
            raise ValueError("There are no descriptors to learn words from.")
        self.binary = are_bits(descriptors)
        self._centers, self._offsets = [], []
        node = np.zeros(len(points), dtype=np.intp)
        for level in range(self.depth):
            shape = (self.branching**level, self.branching, points.shape[1])
            centers = np.zeros(shape, np.float32)
            offsets = np.full(shape[:2], np.inf, np.float32)
            child = np.zeros_like(node)
            for parent, members in _groups(node):
                own = points.take(members, axis=0)
                most = POINTS_PER_CENTER * self.branching
                sample = own if len(own) <= most else rng.choice(own, most, replace=False)
                found = k_means(sample, self.branching, rng, iterations)
                centers[parent, : len(found)] = found
                offsets[parent, : len(found)] = half_squares(found)
                child[members] = nearest_centers(own, found)
            node = self.branching * node + child
            self._centers.append(centers)
            self._offsets.append(offsets)
        return self

    def words(self, descriptors: np.ndarray | None) -> np.ndarray:
        """Return the word of each descriptor: (N,) integers below `word_count`.

        None, which OpenCV gives for an image without features, counts as no descriptors.

        Raises:
            ValueError: if the tree was not fitted, or to other descriptors.
        """
        self._check_fitted()
        if descriptors is None or len(descriptors) == 0:
            return np.zeros(0, dtype=np.intp)
        points = _as_points(descriptors)
        descriptors = np.asarray(descriptors)
        dimension = self._centers[0].shape[-1]
        binary = are_bits(descriptors)
        if points.shape[1] != dimension or binary != self.binary:
            raise ValueError(
                f"These descriptors are {descriptors.dtype} of length {descriptors.shape[1]}; the "
                f"tree was fitted to {_described(self.binary, dimension)}."
            )
        node = np.zeros(len(points), dtype=np.intp)
        closeness = np.empty((len(points), self.branching), np.float32)
        for centers, offsets in zip(self._centers, self._offsets, strict=True):
            child = np.empty_like(node)
            # One small product for each node that any descriptor has reached.
            for parent, members in _groups(node):
                own = closeness[: len(members)]
                np.matmul(points.take(members, axis=0), centers[parent].T, out=own)
                own -= offsets[parent]
                child[members] = own.argmax(axis=1)
            node = self.branching * node + child
        return node

    def fingerprint(self) -> str:
        """Return the SHA-256 of all centres: trees with the same one give the same words."""
        digest = hashlib.sha256(b"bits" if self.binary else b"floats")
        for level in self.levels:
            digest.update(repr(level.shape).encode())
            digest.update(level.tobytes())
        return digest.hexdigest()

    def save(self, path: str | Path) -> None:
        """Write the tree to an npz file, which holds nothing but arrays.

        Raises:
            ValueError: if the tree was not fitted.
        """
        self._check_fitted()
        levels = {f"level_{i}": level for i, level in enumerate(self.levels)}
        write_arrays(path, binary=np.array(self.binary), **levels)

    @classmethod
    def load(cls, path: str | Path) -> Self:
        """Read a tree that `save` wrote.

        Raises:
            ValueError: if the file holds something else.
        """
        stored = read_arrays(path, "a vocabulary tree", "binary", "level_0")
        names = [f"level_{i}" for i in range(len(stored) - 1)]
        levels = [stored[name] for name in names if name in stored]
        if len(levels) < len(names) or not _make_a_tree(levels):
            raise ValueError(f"{path} is damaged, its levels make no tree: save the tree again.")
        tree = cls(len(levels[0]), len(levels))
        tree.binary = bool(stored["binary"])
        for level in levels:
            centers = level.reshape(-1, tree.branching, level.shape[1])
            missing = np.isinf(centers[..., 0])
            centers = np.where(missing[..., None], np.float32(0), centers)
            tree._centers.append(centers)
            tree._offsets.append(np.where(missing, np.float32(np.inf), half_squares(centers)))
        return tree

    def _check_fitted(self) -> None:
        if not self._centers:
            raise ValueError("This tree has no words yet: call fit, or load a tree.")


def _make_a_tree(levels: list[np.ndarray]) -> bool:
    """Tell whether each level has all children of the one above it, as points or infinite."""
    if levels[0].ndim != 2 or len(levels[0]) < 2:
        return False
    branching, d = levels[0].shape
    return all(
        level.dtype == np.float32
        and level.shape == (branching ** (i + 1), d)
        and not np.isnan(level).any()
        for i, level in enumerate(levels)
    )


def _groups(node: np.ndarray) -> Iterator[tuple[int, np.ndarray]]:
    """Yield each node that occurs, in rising order, and the indices at which it stands."""
    # Sixteen bits are sorted many times faster.
    keys = node.astype(np.uint16) if node.max() < 2**16 else node
    order = np.argsort(keys, kind="stable")
    ordered = node[order]
    cuts = [0, *(np.flatnonzero(np.diff(ordered)) + 1).tolist(), len(node)]
    parents = ordered[cuts[:-1]].tolist()
    for i, parent in enumerate(parents):
        yield parent, order[cuts[i] : cuts[i + 1]]


def _as_points(descriptors: np.ndarray) -> np.ndarray:
    """Return (N, d) float32 points, or say what is wrong with the descriptors."""
    if np.ma.is_masked(descriptors):  # the mask would be dropped without a word
        raise ValueError("Some descriptors are masked: leave these features out.")
    descriptors = np.asarray(descriptors)
    if descriptors.ndim != 2:
        raise ValueError(f"The descriptors must be an (N, d) array, not {descriptors.shape}.")
    if are_bits(descriptors):
        return np.unpackbits(descriptors, axis=1).astype(np.float32)
    points = np.ascontiguousarray(descriptors, dtype=np.float32)
    if not np.isfinite(points).all():
        raise ValueError("Some descriptors are not finite: leave these features out.")
    return points


def _described(binary: bool, dimension: int) -> str:
    return f"uint8 of length {dimension // 8}" if binary else f"floats of length {dimension}"
