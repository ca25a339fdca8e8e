"""The image database: how many candidates, in how many parts, and what its file must hold."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from solutions.place_recognition import ImageDatabase, InvertedIndex, VocabularyTree
from solutions.place_recognition.fast import index as index_module
from solutions.place_recognition.fast import postings as postings_module
from solutions.place_recognition.fast.postings import merged, postings_of
from solutions.place_recognition.fast.storage import read_arrays, write_arrays

SPOTS = 10.0 * np.array([[x, y] for x in range(3) for y in range(3)], np.float32)  # one a word
TREE = VocabularyTree(9, 1).fit(SPOTS, np.random.default_rng(0))
WORDS = TREE.words(SPOTS)


@pytest.fixture
def database() -> ImageDatabase:
    """Image n has the first n + 1 spots; the last one sees nothing."""
    made = ImageDatabase(TREE)
    for n in range(8):
        made.add(f"image {n}", SPOTS[: n + 1])
    made.add("blank", None)
    return made


def test_five_candidates_are_given_where_no_number_is_asked_for(database):
    assert len(database.query(SPOTS)) == 5
    votes = database.query(SPOTS, scoring="votes")
    assert [(c.name, c.score) for c in votes] == [(f"image {n}", n + 1) for n in (7, 6, 5, 4, 3)]


@pytest.mark.parametrize("top", range(1, 12))
def test_the_best_so_many_are_given_and_of_equal_ones_the_first(database, top):
    found = database.query(SPOTS, top, "votes")
    assert [c.name for c in found] == [f"image {n}" for n in range(7, -1, -1)][:top]
    equal = database.query(SPOTS[:1], np.int64(top), "votes")
    assert [(c.name, c.score) for c in equal] == [(f"image {n}", 1) for n in range(8)][:top]


@pytest.mark.parametrize("seed", range(5))
def test_of_many_images_the_best_are_those_of_a_whole_sort(seed):
    made = ImageDatabase(TREE)
    made.names = [str(n) for n in range(400)]
    order = np.random.default_rng(seed).permutation(400)
    for top in (1, 2, 7, 40, 399, 400):
        found = made._best(order, -order, order % 3 > 0, top)
        eligible = sorted((entry, n) for n, entry in enumerate(order.tolist()) if entry % 3)
        assert [(-int(c.score), int(c.name)) for c in found] == eligible[:top]


@pytest.mark.parametrize("top", [0, -1, 1.5, 2.0, "3", None])
def test_a_number_of_candidates_is_whole_and_positive(database, top):
    with pytest.raises(ValueError, match="Ask for a whole number of candidates, 1 or more"):
        database.query(SPOTS, top)


def test_a_database_from_a_file_still_knows_its_names(database, tmp_path: Path):
    database.save(tmp_path / "places")
    loaded = ImageDatabase.load(tmp_path / "places", TREE)
    with pytest.raises(ValueError, match="an image named 'image 3' already"):
        loaded.add("image 3", SPOTS)
    loaded.add("image 9", SPOTS)
    assert len(loaded) == 10


@pytest.mark.parametrize("name", ["names", "tree", "word_count"])
def test_a_file_without_one_of_its_parts_is_no_database(database, tmp_path: Path, name):
    database.save(tmp_path / "places")
    with np.load(tmp_path / "places") as stored:
        arrays = {key: stored[key] for key in stored.files if key != name}
    write_arrays(tmp_path / "places", **arrays)
    with pytest.raises(ValueError, match=f"does not hold an image database: {name} is missing"):
        ImageDatabase.load(tmp_path / "places", TREE)


def test_a_file_that_is_not_there_is_not_called_damaged(tmp_path: Path):
    with pytest.raises(FileNotFoundError):
        read_arrays(tmp_path / "nowhere", "anything")


def test_nothing_but_numbers_and_texts_is_written(tmp_path: Path):
    with pytest.raises(ValueError, match="allow_pickle"):
        write_arrays(tmp_path / "file", objects=np.array([{}], dtype=object))


def many(count: int) -> list[np.ndarray]:
    return [np.arange(n + 1) % 9 for n in range(count)]


def test_more_images_than_a_part_may_have_are_kept_in_several(monkeypatch):
    monkeypatch.setattr(index_module, "MOST_IMAGES", 2)
    index = InvertedIndex(9)
    index.extend(many(5))
    assert [part.image_count for part in index._parts] == [2, 2, 1]
    assert index.votes(np.arange(9)).tolist() == [1, 2, 3, 4, 5]
    again = InvertedIndex.from_arrays(index.arrays())
    assert again.image_count == 5
    assert again.votes(np.arange(9)).tolist() == [1, 2, 3, 4, 5]
    assert np.array_equal(again.scores(np.arange(3)), index.scores(np.arange(3)))
    with pytest.raises(ValueError, match="Words must be from 0 to 8"):
        index.extend([*many(4), np.array([9])])
    assert index.image_count == 5  # nothing of it was added


def test_weights_are_computed_once_until_images_are_added(monkeypatch):
    index = InvertedIndex(9)
    index.extend(many(3))
    counted: list[int] = []
    real = InvertedIndex.weights

    def weights(self: InvertedIndex) -> np.ndarray:
        counted.append(1)
        return real(self)

    monkeypatch.setattr(InvertedIndex, "weights", weights)
    for _ in range(3):
        index.scores(np.arange(3))
    assert len(counted) == 1
    index.extend(many(1))
    index.scores(np.arange(3))
    assert len(counted) == 2


def test_a_query_whose_words_weigh_nothing_shares_nothing():
    index = InvertedIndex(2)
    index.extend([np.array([0]), np.array([0, 1])])
    with np.errstate(all="raise"):
        assert index.scores(np.array([0])).tolist() == [2.0, 2.0]


def test_words_weigh_nothing_where_there_are_no_images():
    with np.errstate(all="raise"):
        assert InvertedIndex(3).weights().tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("at_once", [1, 2, 5, 100])
def test_sizes_add_up_all_words_in_whatever_portions(monkeypatch, at_once):
    monkeypatch.setattr(postings_module, "WORDS_AT_ONCE", at_once)
    part = postings_of([np.array([0, 0, 4]), np.array([1, 2, 3, 3, 3])])
    weights = np.array([1.0, 0.5, 2.0, 0.25, 4.0])
    assert part.weighted_sizes(weights).tolist() == [2 + 4, 0.5 + 2 + 0.75]


def test_two_parts_become_one_with_the_counts_of_both():
    one, other = postings_of([np.array([1, 1, 3])]), postings_of([np.array([1, 2, 2, 2])])
    both = merged(one, other)
    whole = postings_of([np.array([1, 1, 3]), np.array([1, 2, 2, 2])])
    for found, expected in zip(both, whole, strict=True):
        assert np.array_equal(found, expected)
