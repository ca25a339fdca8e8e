"""The vocabulary tree, against descents one by one, brute force and what k-means must satisfy."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solutions.place_recognition import VocabularyTree, descend_tree, k_means
from solutions.place_recognition.fast.storage import write_arrays


def blobs(rng: np.random.Generator, centers: int = 12, each: int = 40, d: int = 16) -> np.ndarray:
    middles = rng.uniform(0, 100, (centers, d))
    points = np.repeat(middles, each, axis=0) + rng.normal(0, 1, (centers * each, d))
    return points.astype(np.float32)


def squared_distances(points: np.ndarray, centers: np.ndarray) -> np.ndarray:
    return ((points[:, None].astype(float) - centers[None]) ** 2).sum(axis=2)


def test_k_means_finds_well_separated_pairs_of_points():
    points = np.array([[0, 0], [0, 2], [50, 0], [50, 2]], np.float32)
    centers = k_means(points, 2, np.random.default_rng(2), iterations=50)
    # Left and right is the best division; above and below is one that k-means may stop at.
    assert sorted(map(tuple, centers.tolist())) in (
        [(0.0, 1.0), (50.0, 1.0)],
        [(25.0, 0.0), (25.0, 2.0)],
    )


@pytest.mark.parametrize("seed", range(5))
def test_k_means_ends_with_every_center_at_the_mean_of_the_points_nearest_to_it(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(300, 3)).astype(np.float32)
    centers = k_means(points, 7, rng, iterations=1000)
    nearest = squared_distances(points, centers).argmin(axis=1)
    for cluster, center in enumerate(centers):
        np.testing.assert_allclose(points[nearest == cluster].mean(axis=0), center, atol=1e-5)


@pytest.mark.parametrize("seed", range(5))
def test_more_iterations_never_make_the_clusters_worse(seed):
    points = blobs(np.random.default_rng(seed))
    errors = [
        squared_distances(points, k_means(points, 8, np.random.default_rng(seed), n))
        .min(axis=1)
        .sum()
        for n in (1, 2, 3, 5, 10, 20)
    ]
    assert all(later <= earlier * (1 + 1e-6) for earlier, later in itertools.pairwise(errors))


@pytest.mark.parametrize(
    ("points", "k", "seed", "different"),
    [
        ([(0,)] * 4 + [(1,)] * 4 + [(2,)] * 5 + [(3,)] * 2 + [(4,)] * 2, 5, 15, 5),
        ([(0, 0), (1, 0), (0, 2), (0, 3), (1, 0), (1, 1), (0, 0), (0, 1), (0, 1)], 6, 220, 6),
        ([(7, 7)] * 9, 4, 0, 1),
    ],
)
def test_clusters_start_anew_at_different_points(points, k, seed, different):
    # The largest errors are at copies of one point; only one of them should get a new centre.
    centers = k_means(np.array(points, np.float32), k, np.random.default_rng(seed))
    assert sorted(map(tuple, centers)) == sorted(set(points))
    assert len(centers) == different


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), min_size=1, max_size=30),
    st.integers(1, 8),
    st.integers(0, 1000),
)
def test_no_cluster_of_k_means_is_empty_however_many_points_coincide(corners, k, seed):
    points = np.array(corners, np.float32)
    centers = k_means(points, k, np.random.default_rng(seed))
    different = len(set(corners))
    assert 1 <= len(centers) <= min(k, different)
    if different <= k:  # then every different point can have a centre of its own
        assert len(centers) == different
    nearest = squared_distances(points, centers).argmin(axis=1)
    assert set(nearest) == set(range(len(centers)))


@pytest.mark.parametrize(("branching", "depth"), [(2, 1), (3, 4), (10, 2), (5, 6)])
def test_words_are_where_each_descriptor_arrives_when_it_descends_alone(branching, depth):
    rng = np.random.default_rng(1)
    tree = VocabularyTree(branching, depth).fit(blobs(rng), rng)
    queries = blobs(rng, centers=30, each=5)
    words = tree.words(queries)
    assert words.tolist() == [descend_tree(query, tree.levels) for query in queries]
    assert words.min() >= 0
    assert words.max() < tree.word_count == branching**depth


def test_a_tree_of_one_level_gives_the_nearest_of_all_centers():
    rng = np.random.default_rng(2)
    points = blobs(rng)
    tree = VocabularyTree(20, 1).fit(points, rng)
    expected = squared_distances(points, tree.levels[0]).argmin(axis=1)
    assert np.array_equal(tree.words(points), expected)


def test_descriptors_of_one_tight_group_share_a_word_and_distant_ones_do_not():
    rng = np.random.default_rng(3)
    groups = rng.uniform(0, 100, (30, 16)).astype(np.float32).repeat(4, axis=0)
    words = VocabularyTree(4, 5).fit(groups, rng).words(groups).reshape(30, 4)
    assert (words == words[:, :1]).all()
    assert len(set(words[:, 0])) == 30


@settings(max_examples=40, deadline=None)
@given(st.integers(1, 12), st.integers(2, 6), st.integers(1, 4), st.integers(0, 1000))
def test_any_descriptor_finds_a_leaf_though_most_branches_are_missing(count, k, depth, seed):
    rng = np.random.default_rng(seed)
    few = rng.integers(0, 3, (count, 4)).astype(np.float32)
    tree = VocabularyTree(k, depth).fit(few, rng)
    others = rng.normal(0, 100, (50, 4)).astype(np.float32)
    words = tree.words(others)
    leaves = tree.levels[-1]
    assert np.isfinite(leaves[words]).all()
    assert words.tolist() == [descend_tree(other, tree.levels) for other in others]


def test_large_nodes_learn_from_a_sample_and_still_place_every_descriptor():
    rng = np.random.default_rng(4)
    points = blobs(rng, centers=2, each=1000)  # a sample is 256 a centre
    tree = VocabularyTree(2, 1).fit(points, rng)
    words = tree.words(points)
    assert words.tolist() == [words[0]] * 1000 + [1 - words[0]] * 1000


def test_bits_are_compared_by_how_many_differ():
    rng = np.random.default_rng(5)
    prototypes = rng.integers(0, 256, (8, 32)).astype(np.uint8)
    tree = VocabularyTree(8, 1).fit(prototypes, rng)
    queries = prototypes[rng.integers(0, 8, 200)] ^ np.uint8(1 << 3)
    queries[:, 5:9] = rng.integers(0, 256, (200, 4))
    hamming = np.bitwise_count(queries[:, None] ^ prototypes[None]).sum(axis=2)
    own_word = tree.words(prototypes)
    assert sorted(own_word) == list(range(8))
    assert np.array_equal(tree.words(queries), own_word[hamming.argmin(axis=1)])


def test_the_same_random_numbers_give_the_same_tree():
    points = blobs(np.random.default_rng(6))
    one, other = (VocabularyTree(3, 3).fit(points, np.random.default_rng(0)) for _ in "ab")
    assert all(map(np.array_equal, one.levels, other.levels))


def test_an_image_without_features_has_no_words():
    tree = VocabularyTree(2, 2).fit(blobs(np.random.default_rng(7)), np.random.default_rng(0))
    assert tree.words(None).tolist() == []  # what OpenCV gives
    assert tree.words(np.zeros((0, 16), np.float32)).tolist() == []


@pytest.mark.parametrize("binary", [False, True])
def test_a_tree_is_the_same_after_saving_and_loading(tmp_path, binary):
    rng = np.random.default_rng(8)
    points = rng.integers(0, 256, (200, 32)).astype(np.uint8 if binary else np.float32)
    tree = VocabularyTree(4, 4).fit(points, rng)
    tree.save(tmp_path / "words.tree")  # whatever the ending
    loaded = VocabularyTree.load(tmp_path / "words.tree")
    assert (loaded.branching, loaded.depth, loaded.binary) == (4, 4, binary)
    assert np.array_equal(loaded.words(points), tree.words(points))
    assert all(map(np.array_equal, loaded.levels, tree.levels))


@pytest.mark.parametrize("content", [b"", b"rubbish", b"PK\x03\x04", b"\x93NUMPY"])
def test_a_damaged_file_is_named(tmp_path, content):
    path = tmp_path / "broken.tree"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=r"broken\.tree does not hold a vocabulary tree"):
        VocabularyTree.load(path)


def test_a_pickle_is_refused(tmp_path):
    path = tmp_path / "evil.tree"
    np.savez(path.open("wb"), level_0=np.array([{"any": "object"}], dtype=object))
    with pytest.raises(ValueError, match=r"evil\.tree does not hold a vocabulary tree"):
        VocabularyTree.load(path)


def test_a_file_that_holds_something_else_is_named(tmp_path):
    write_arrays(tmp_path / "other.tree", numbers=np.arange(3))
    with pytest.raises(ValueError, match=r"binary is missing"):
        VocabularyTree.load(tmp_path / "other.tree")


@pytest.mark.parametrize(
    "change",
    [
        {"anything": np.zeros(3)},
        {"level_1": None},
        {"level_1": None, "level_9": np.zeros((9, 4), np.float32)},
        {"level_0": np.zeros(3, np.float32)},
        {"level_0": np.zeros((1, 4), np.float32)},
        {"level_1": np.zeros((9, 5), np.float32)},
        {"level_1": np.full((9, 4), np.nan, np.float32)},
        {"level_2": np.zeros((26, 4), np.float32)},
        {"level_2": np.zeros((27, 4), complex)},
    ],
)
def test_a_file_whose_levels_make_no_tree_is_named(tmp_path, change):
    rng = np.random.default_rng(0)
    VocabularyTree(3, 3).fit(rng.normal(size=(100, 4)), rng).save(tmp_path / "words.tree")
    arrays = {**np.load(tmp_path / "words.tree"), **change}
    write_arrays(tmp_path / "words.tree", **{n: a for n, a in arrays.items() if a is not None})
    with pytest.raises(ValueError, match=r"words\.tree is damaged, its levels make no tree"):
        VocabularyTree.load(tmp_path / "words.tree")


def test_a_tree_without_words_cannot_be_saved(tmp_path):
    with pytest.raises(ValueError, match="call fit"):
        VocabularyTree(2, 2).save(tmp_path / "words.tree")
    assert not (tmp_path / "words.tree").exists()


def test_descriptors_may_be_lists():
    points = blobs(np.random.default_rng(0))[:40]
    tree = VocabularyTree(3, 2).fit(points.tolist(), np.random.default_rng(0))
    assert tree.words(points.tolist()).tolist() == tree.words(points).tolist()
    assert tree.words([]).tolist() == []


def test_a_tree_stays_as_it_was_if_it_cannot_learn_anew():
    rng = np.random.default_rng(0)
    points = blobs(rng)
    tree = VocabularyTree(3, 2).fit(points, rng)
    words = tree.words(points)
    with pytest.raises(ValueError, match="no descriptors to learn"):
        tree.fit(np.zeros((0, 16), np.uint8), rng)
    assert np.array_equal(tree.words(points), words)


def test_what_cannot_be_clustered_is_said_in_one_sentence():
    rng = np.random.default_rng(9)
    tree = VocabularyTree(2, 2)
    with pytest.raises(ValueError, match="call fit"):
        tree.words(np.zeros((1, 4)))
    with pytest.raises(ValueError, match="no descriptors to learn"):
        tree.fit(np.zeros((0, 4)), rng)
    with pytest.raises(ValueError, match=r"must be an \(N, d\) array"):
        tree.fit(np.zeros(4), rng)
    with pytest.raises(ValueError, match="not finite"):
        tree.fit(np.array([[1.0, np.nan]]), rng)
    tree.fit(np.zeros((3, 4)), rng)
    with pytest.raises(ValueError, match="fitted to floats of length 4"):
        tree.words(np.zeros((3, 5)))
    with pytest.raises(ValueError, match="fitted to floats of length 4"):
        tree.words(np.zeros((3, 32), np.uint8))
    for branching, depth in ((1, 3), (10, 0)):
        with pytest.raises(ValueError, match="branching of 2 or more"):
            VocabularyTree(branching, depth)


def test_sift_kept_as_bytes_is_not_taken_for_bits():
    """SIFT's numbers are whole and below 256; ORB's 32 bytes are 256 bits."""
    rng = np.random.default_rng(5)
    sift = rng.integers(0, 256, (400, 128))
    as_bytes = VocabularyTree(4, 2).fit(sift.astype(np.uint8), np.random.default_rng(1))
    as_floats = VocabularyTree(4, 2).fit(sift.astype(np.float32), np.random.default_rng(1))
    assert not as_bytes.binary
    assert np.array_equal(as_bytes.words(sift.astype(np.uint8)), as_floats.words(sift * 1.0))
    assert np.array_equal(as_floats.words(sift.astype(np.uint8)), as_floats.words(sift * 1.0))
    assert VocabularyTree(4, 2).fit(sift[:, :32].astype(np.uint8), rng).binary
