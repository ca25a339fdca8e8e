"""The growing inverted file and the image database, against the course's plain functions."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solutions.place_recognition import (
    ImageDatabase,
    InvertedIndex,
    VocabularyTree,
    build_inverted_file,
    count_votes,
    idf_weights,
    l1_scores,
)
from solutions.place_recognition.fast import index as index_module
from solutions.place_recognition.fast.postings import postings_of
from solutions.place_recognition.fast.storage import write_arrays

images = st.lists(st.lists(st.integers(0, 8), max_size=12), max_size=12)


def histograms(words_by_image: list, word_count: int) -> np.ndarray:
    counts = [np.bincount(np.array(w, int), minlength=word_count) for w in words_by_image]
    return np.array(counts).reshape(-1, word_count)


def test_postings_of_two_images_by_hand():
    # Image 0 has the words 5, 2, 5 and image 1 the words 5, 9.
    part = postings_of([np.array([5, 2, 5]), np.array([5, 9])])
    assert part.image_count == 2
    assert part.words.tolist() == [2, 5, 9]
    assert part.starts.tolist() == [0, 1, 3, 4]
    assert part.images.tolist() == [0, 0, 1, 1]
    assert part.counts.tolist() == [1, 2, 1, 1]
    found, counts, lengths = part.lists_of(np.array([0, 5, 9, 100]))
    assert found.tolist() == [0, 1, 1]
    assert counts.tolist() == [2, 1, 1]
    assert lengths.tolist() == [0, 2, 1, 0]


@settings(max_examples=80, deadline=None)
@given(images, st.lists(st.integers(0, 8), max_size=12), st.data())
def test_votes_and_scores_are_those_of_the_plain_functions_in_whatever_portions(
    words_by_image, query, data
):
    index = InvertedIndex(9)
    rest = [np.array(words, dtype=int) for words in words_by_image]
    while rest:
        portion = data.draw(st.integers(1, len(rest)))
        index.extend(rest[:portion])
        rest = rest[portion:]
        if data.draw(st.booleans()):
            index.scores(np.array(query, dtype=int))  # must not be remembered for longer
    assert index.image_count == len(words_by_image)
    query_words = np.array(query, dtype=int)
    inverted_file = build_inverted_file([np.array(w, int) for w in words_by_image], 9)
    expected = count_votes(query_words, inverted_file, len(words_by_image))
    assert index.votes(query_words).tolist() == expected.tolist()
    if words_by_image:
        counts = histograms(words_by_image, 9)
        # The one difference: a word that no image has weighs as if one had it.
        unseen = counts.sum(axis=0) == 0
        weights = np.where(unseen, np.log(len(counts)), idf_weights(counts))
        np.testing.assert_allclose(index.weights(), weights, atol=1e-12)
        expected = l1_scores(histograms([query], 9)[0], counts, weights)
        np.testing.assert_allclose(index.scores(query_words), expected, atol=1e-5)


def test_a_score_by_hand():
    # Three images; word 0 in all, word 1 in two, word 2 in one: weights 0, ln 1.5, ln 3.
    index = InvertedIndex(4)
    index.extend([np.array([0, 1]), np.array([0, 1, 2]), np.array([0])])
    share = np.log(3) / (np.log(1.5) + np.log(3))  # of word 2 in image 1, 0.73
    # Nobody has word 3, which weighs ln 3 as well: q = (0, 1 - share, 0, share). Images 0 and 1
    # share word 1 with it: |1 - share - 1| + share, and share + share.
    scores = index.scores(np.array([1, 0, 3]))
    np.testing.assert_allclose(scores, [2 * share, 2 * share, 2.0], atol=1e-6)


def test_scores_stay_between_0_and_2_in_single_precision():
    rng = np.random.default_rng(0)
    words_by_image = [rng.integers(0, 500, rng.integers(50, 900)) for _ in range(200)]
    index = InvertedIndex(500)
    index.extend(words_by_image)
    scores = np.array([index.scores(words) for words in words_by_image])
    assert scores.min() >= 0.0
    assert scores.max() <= 2.0
    np.testing.assert_allclose(scores.diagonal(), 0.0, atol=1e-5)


def test_parts_are_few_and_images_keep_their_numbers(monkeypatch):
    monkeypatch.setattr(index_module, "MOST_IMAGES", 16)
    rng = np.random.default_rng(0)
    words_by_image = [rng.integers(0, 50, 20) for _ in range(75)]
    index = InvertedIndex(50)
    for words in words_by_image:
        index.extend([words])
    assert [part.image_count for part in index._parts] == [16, 16, 16, 16, 8, 2, 1]
    inverted_file = build_inverted_file(words_by_image, 50)
    query = rng.integers(0, 50, 30)
    assert index.votes(query).tolist() == count_votes(query, inverted_file, 75).tolist()


def test_an_image_may_have_a_word_thousands_of_times():
    index = InvertedIndex(3)
    index.extend([np.zeros(70_000, dtype=int), np.array([1, 1])])
    index.extend([np.repeat([0, 1], [300, 100]), np.array([2])])
    counts = np.array([[70_000, 0, 0], [0, 2, 0], [300, 100, 0], [0, 0, 1]])
    query = np.array([0, 0, 0, 1])
    expected = l1_scores(np.array([3, 1, 0]), counts, idf_weights(counts))
    np.testing.assert_allclose(index.scores(query), expected, atol=1e-5)


@pytest.mark.parametrize("words", [[-1], [0, 9]])
def test_words_of_another_tree_are_refused(words):
    index = InvertedIndex(9)
    for use in (index.votes, index.scores, lambda w: index.extend([w])):
        with pytest.raises(ValueError, match="from 0 to 8"):
            use(np.array(words))
    assert index.image_count == 0


@pytest.fixture(scope="module")
def places() -> dict[str, np.ndarray]:
    """Descriptors of eight places, each quite its own."""
    rng = np.random.default_rng(0)
    return {f"place {i}": rng.uniform(0, 100, (60, 16)).astype(np.float32) for i in range(8)}


@pytest.fixture(scope="module")
def tree(places) -> VocabularyTree:
    collection = np.concatenate(list(places.values()))
    return VocabularyTree(6, 3).fit(collection, np.random.default_rng(1))


def again(descriptors: np.ndarray, seed: int) -> np.ndarray:
    """The same place seen again: half of the features, a little changed, and other ones."""
    rng = np.random.default_rng(seed)
    seen = descriptors[::2] + rng.normal(0, 1.0, descriptors[::2].shape)
    return np.concatenate([seen, rng.uniform(0, 100, (20, 16))]).astype(np.float32)


@pytest.mark.parametrize("scoring", ["votes", "tf-idf"])
def test_a_place_is_recognised_when_seen_again(places, tree, scoring):
    database = ImageDatabase(tree)
    for name, descriptors in places.items():
        database.add(name, descriptors)
    for seed, (name, descriptors) in enumerate(places.items()):
        candidates = database.query(again(descriptors, seed), top=3, scoring=scoring)
        assert candidates[0].name == name
        assert len(candidates) == 3


def test_candidates_come_best_first_and_equal_ones_as_they_were_added(places, tree):
    database = ImageDatabase(tree)
    for name in ("first", "second", "third"):
        database.add(name, places["place 0"])
    database.add("other", places["place 1"])
    votes = database.query(places["place 0"], scoring="votes")
    assert [candidate.name for candidate in votes][:3] == ["first", "second", "third"]
    assert [candidate.score for candidate in votes][:3] == [60, 60, 60]
    assert [c.name for c in database.query(places["place 0"], top=2)] == ["first", "second"]


def test_an_image_added_after_a_query_is_found_by_the_next(places, tree):
    database = ImageDatabase(tree)
    database.add("place 0", places["place 0"])
    database.add("place 1", places["place 1"])
    assert database.query(places["place 2"], top=1)[0].name != "place 2"
    database.add("place 2", places["place 2"])
    best = database.query(places["place 2"], top=1)[0]
    assert best.name == "place 2"
    assert best.score == pytest.approx(0.0, abs=1e-5)


def test_what_shares_nothing_is_no_candidate(places, tree):
    database = ImageDatabase(tree)
    assert database.query(places["place 0"]) == []
    database.add("empty", None)
    database.add("place 0", places["place 0"])
    database.add("place 1", places["place 1"])
    assert len(database) == 3
    for scoring in ("votes", "tf-idf"):
        names = [c.name for c in database.query(places["place 0"], scoring=scoring)]
        assert "empty" not in names
        assert database.query(None, scoring=scoring) == []


def test_a_database_is_the_same_after_saving_and_loading(tmp_path, places, tree):
    database = ImageDatabase(tree)
    names = ["Ümlaut", "two\nlines", "", *list(places)[3:]]
    for name, descriptors in zip(names, places.values(), strict=True):
        database.add(name, descriptors)
    database.save(tmp_path / "places.db")
    loaded = ImageDatabase.load(tmp_path / "places.db", tree)
    assert loaded.names == names
    query = again(places["place 4"], 0)
    for scoring in ("votes", "tf-idf"):
        assert loaded.query(query, 8, scoring) == database.query(query, 8, scoring)
    loaded.add("one more", places["place 0"])
    assert loaded.query(places["place 0"], scoring="votes")[1].name == "one more"


def test_a_database_knows_its_tree_after_that_was_saved_and_loaded(tmp_path, places, tree):
    few = VocabularyTree(6, 4).fit(
        places["place 0"], np.random.default_rng(0)
    )  # some children lack
    for own in (tree, few):
        ImageDatabase(own).save(tmp_path / "places.db")
        own.save(tmp_path / "tree")
        ImageDatabase.load(tmp_path / "places.db", VocabularyTree.load(tmp_path / "tree"))


def test_an_empty_database_can_be_saved(tmp_path, tree, places):
    ImageDatabase(tree).save(tmp_path / "empty.db")
    loaded = ImageDatabase.load(tmp_path / "empty.db", tree)
    assert len(loaded) == 0
    assert loaded.query(places["place 0"]) == []


def test_a_database_needs_its_own_tree(tmp_path, tree, places):
    ImageDatabase(tree).save(tmp_path / "places.db")
    other = VocabularyTree(2, 2).fit(places["place 0"], np.random.default_rng(0))
    with pytest.raises(ValueError, match=r"216 words, the tree has 4"):
        ImageDatabase.load(tmp_path / "places.db", other)
    collection = np.concatenate(list(places.values()))
    of_another_seed = VocabularyTree(6, 3).fit(collection, np.random.default_rng(2))
    of_bits = VocabularyTree(6, 3).fit(collection.astype(np.uint8), np.random.default_rng(1))
    for other in (of_another_seed, of_bits, VocabularyTree(6, 3)):
        with pytest.raises(ValueError, match="another tree of as many words"):
            ImageDatabase.load(tmp_path / "places.db", other)
    tree.save(tmp_path / "tree")
    with pytest.raises(ValueError, match="does not hold an image database"):
        ImageDatabase.load(tmp_path / "tree", tree)


@pytest.mark.parametrize(
    "damage", [{"starts_0": None}, {"names": b"[]"}, {"names": b"{"}, {"words_0": b"x"}]
)
def test_a_database_with_a_part_missing_or_wrong_is_named(tmp_path, tree, places, damage):
    database = ImageDatabase(tree)
    database.add("place", places["place 0"])
    database.save(tmp_path / "places.db")
    arrays = dict(np.load(tmp_path / "places.db", allow_pickle=False))
    for name, content in damage.items():
        if content is None:
            del arrays[name]
        else:
            arrays[name] = np.frombuffer(content, np.uint8)
    write_arrays(tmp_path / "places.db", **arrays)
    with pytest.raises(ValueError, match=r"places\.db is damaged"):
        ImageDatabase.load(tmp_path / "places.db", tree)


def test_wrong_use_is_said_in_one_sentence(places, tree):
    database = ImageDatabase(tree)
    database.add("twice", places["place 0"])
    with pytest.raises(ValueError, match="named 'twice' already"):
        database.add("twice", places["place 1"])
    assert len(database) == 1
    with pytest.raises(ValueError, match="top=0"):
        database.query(places["place 0"], top=0)
    with pytest.raises(ValueError, match='"tf-idf" or "votes"'):
        database.query(places["place 0"], scoring="cosine")  # type: ignore[arg-type]
