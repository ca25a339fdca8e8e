"""The vocabulary tree: what it is by default, what it refuses, its fingerprint, and its file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from solutions.place_recognition import VocabularyTree
from solutions.place_recognition.fast.storage import write_arrays
from solutions.place_recognition.fast.vocabulary_tree import _groups

FLOATS = np.random.default_rng(1).normal(size=(60, 16)).astype(np.float32)
BITS = np.random.default_rng(2).integers(0, 256, (60, 2)).astype(np.uint8)  # 16 bits each


def tree_of(descriptors: np.ndarray, seed: int = 0) -> VocabularyTree:
    return VocabularyTree(3, 2).fit(descriptors, np.random.default_rng(seed))


def test_a_tree_has_a_thousand_words_where_nothing_else_is_asked_for():
    tree = VocabularyTree()
    assert (tree.branching, tree.depth, tree.word_count, tree.binary) == (10, 3, 1000, False)


@pytest.mark.parametrize(("branching", "depth"), [(1, 3), (0, 3), (10, 0), (2, -1)])
def test_a_tree_that_does_not_branch_is_refused(branching, depth):
    with pytest.raises(ValueError, match="branching of 2 or more and depth of 1 or more"):
        VocabularyTree(branching, depth)
    assert VocabularyTree(2, 1).word_count == 2


def test_descriptors_of_another_kind_or_length_are_refused_in_one_sentence():
    for tree, others, said in (
        (
            tree_of(BITS),
            FLOATS,
            "are float32 of length 16; the tree was fitted to uint8 of length 2",
        ),
        (
            tree_of(FLOATS),
            BITS,
            "are uint8 of length 2; the tree was fitted to floats of length 16",
        ),
        (tree_of(FLOATS), FLOATS[:, :4], "of length 4; the tree was fitted to floats of length 16"),
    ):
        with pytest.raises(ValueError, match=rf"{said}\.$"):
            tree.words(others)


def test_no_descriptors_have_no_words():
    for none in (None, FLOATS[:0], []):
        words = tree_of(FLOATS).words(none)
        assert (words.shape, words.dtype) == ((0,), np.intp)


def test_bits_are_coordinates_of_0_and_1():
    tree = tree_of(BITS)
    assert tree.binary
    centers = tree.levels[0]
    assert centers.shape == (3, 16)
    assert centers.min() >= 0
    assert 0.3 < centers.max() <= 1
    spread = np.unpackbits(BITS, axis=1).astype(np.float32)
    same = tree_of(spread)
    assert np.array_equal(tree.words(BITS), same.words(spread))
    assert not same.binary


@pytest.mark.parametrize(("count", "decide"), [(511, 511), (512, 512), (513, 512), (2000, 512)])
def test_of_very_many_descriptors_a_sample_of_different_ones_decides(monkeypatch, count, decide):
    asked: list[tuple[np.ndarray, int, int]] = []
    names = VocabularyTree.fit.__globals__
    real = names["k_means"]

    def recorded(points: np.ndarray, k: int, rng: np.random.Generator, iterations: int) -> Any:
        asked.append((points, k, iterations))
        return real(points, k, rng, iterations)

    monkeypatch.setitem(names, "k_means", recorded)
    descriptors = np.arange(2.0 * count).reshape(count, 2).astype(np.float32)
    VocabularyTree(2, 1).fit(descriptors, np.random.default_rng(0))
    ((points, k, iterations),) = asked
    assert (len(np.unique(points, axis=0)), len(points)) == (decide, decide)
    assert (k, iterations) == (2, 10)
    if count <= 512:
        assert np.array_equal(points, descriptors)


def test_trees_with_the_same_centers_have_the_same_fingerprint_and_no_others():
    tree = tree_of(FLOATS)
    print_of = tree.fingerprint()
    assert len(print_of) == 64
    assert tree_of(FLOATS).fingerprint() == print_of
    for level in (0, 1):
        other = tree_of(FLOATS)
        other._centers[level][0, 0, 0] += 1
        assert other.fingerprint() != print_of
    other = tree_of(FLOATS)
    other.binary = True
    assert other.fingerprint() != print_of
    # Centres that stand in another shape are others, although their bytes are the same.
    wide, tall = VocabularyTree(2, 1), VocabularyTree(4, 1)
    wide._centers, wide._offsets = [np.zeros((1, 2, 4), np.float32)], [np.zeros((1, 2), np.float32)]
    tall._centers, tall._offsets = [np.zeros((1, 4, 2), np.float32)], [np.zeros((1, 4), np.float32)]
    assert wide.fingerprint() != tall.fingerprint()


def test_a_tree_that_is_fitted_again_forgets_the_first_words():
    tree = tree_of(FLOATS)
    again = tree.fit(FLOATS[:30], np.random.default_rng(3))
    assert again is tree
    assert len(tree.levels) == 2
    fresh = VocabularyTree(3, 2).fit(FLOATS[:30], np.random.default_rng(3))
    assert tree.fingerprint() == fresh.fingerprint()


@pytest.mark.parametrize("descriptors", [FLOATS, BITS, FLOATS[:4]])
@pytest.mark.parametrize(("branching", "depth"), [(3, 2), (2, 4), (2, 1)])
def test_a_tree_comes_back_from_its_file(tmp_path: Path, descriptors, branching, depth):
    tree = VocabularyTree(branching, depth).fit(descriptors, np.random.default_rng(0))
    tree.save(tmp_path / "tree")
    loaded = VocabularyTree.load(tmp_path / "tree")
    assert (loaded.branching, loaded.depth, loaded.binary) == (branching, depth, tree.binary)
    assert loaded.fingerprint() == tree.fingerprint()
    assert np.array_equal(loaded.words(descriptors), tree.words(descriptors))
    for one, other in zip(loaded._offsets, tree._offsets, strict=True):
        assert np.array_equal(one, other)


LEVEL = np.zeros((2, 3), np.float32)


@pytest.mark.parametrize(
    "levels",
    [
        [np.zeros(3, np.float32)],
        [LEVEL[:1]],
        [LEVEL[:0]],
        [LEVEL.astype(float)],
        [np.full((2, 3), np.nan, np.float32)],
        [LEVEL, LEVEL],
        [LEVEL, np.zeros((4, 2), np.float32)],
        [LEVEL, np.full((4, 3), np.nan, np.float32)],
        [LEVEL, np.zeros((4, 3), np.float64)],
    ],
)
def test_levels_that_make_no_tree_are_refused(tmp_path: Path, levels):
    named = {f"level_{i}": level for i, level in enumerate(levels)}
    write_arrays(tmp_path / "tree", binary=np.array(False), **named)
    with pytest.raises(ValueError, match="is damaged, its levels make no tree: save the tree"):
        VocabularyTree.load(tmp_path / "tree")


def test_nodes_are_grouped_also_where_there_are_more_than_16_bits_of_them():
    node = np.array([65536, 0, 70000, 65535, 65536, 32768, 0])
    found = {parent: members.tolist() for parent, members in _groups(node)}
    assert found == {0: [1, 6], 32768: [5], 65535: [3], 65536: [0, 4], 70000: [2]}
    assert list(found) == sorted(found)
    edge = {parent: members.tolist() for parent, members in _groups(np.array([65536, 0, 65536]))}
    assert edge == {0: [1], 65536: [0, 2]}
    few = {parent: members.tolist() for parent, members in _groups(np.array([3, 1, 3]))}
    assert few == {1: [1], 3: [0, 2]}
