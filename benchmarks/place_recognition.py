"""Visual words and image retrieval against scikit-learn, faiss, SciPy and a naive tree."""

from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np

from benchmarks import million_images, peers
from benchmarks.report import OURS, Curve, Row, Section
from benchmarks.retrieval import Words, campus_descriptors, quality
from benchmarks.timing import measure
from solutions.place_recognition import (
    ImageDatabase,
    InvertedIndex,
    VocabularyTree,
    assign_words,
    descend_tree,
    idf_weights,
    l1_scores,
)
from solutions.place_recognition.fast.vocabulary_tree import POINTS_PER_CENTER

SEEDS = 5
SMALL = "SIFT, 1000 words"
LOOP = "the course's loop"
SKLEARN = "MiniBatchKMeans"
SKLEARN_RANDOM = "MiniBatchKMeans, random start"
FAISS = "faiss"
# A trainer takes (N, d) descriptors and a seed and returns what gives descriptors their words.
Trainer = Callable[[np.ndarray, int], Words]

SETUP = f"""
SIFT descriptors of the 25 campus photographs, all that OpenCV finds (ORB, in one row of the
quality: 1000 a photograph, as it comes). The tree has ten children a node; three levels make 1000
words, as many as the peers get. Beside the time of training stands what it is worth: the mean
average precision (mAP) of the vocabulary, see below.

- this project: where a node has more than {POINTS_PER_CENTER * 10:,} descriptors, its centres are
  trained on a sample of so many; faiss and the loop use all.

- scikit-learn: `MiniBatchKMeans(1000)` as it comes, and with `init="random"`, which is faster.
- faiss: `Kmeans(niter=10)` for training, as many iterations as we allow; `IndexFlatL2` over the
  words for quantisation, the exact nearest word. One thread.
- {LOOP}: hierarchical k-means over all descriptors with `assign_words`, and `descend_tree` for
  one descriptor after the other, as students write it.
- a query is: descriptors in, ranked photographs out, over all 25. Peers compare dense tf-idf
  vectors (`l1_scores`; faiss with an L1 index).

Quality: every photograph with a verified partner is the query once and ranks the other 24. The
vocabularies are trained on all 25, the query included, for all contenders alike; mean
and standard deviation over {SEEDS} seeds. There are 16 such queries, so differences below 0.03 mean
little. All vocabularies are scored alike, with tf-idf and the L1 norm, except where it says votes.

Growth: synthetic images of 300 to 1000 features, {million_images.WORD_COUNT:,} words, Zipf 0.5.
SciPy multiplies sparse L2-normalised tf-idf vectors (cosine), stored word by word, in float32.
From 100,000 images on only this project runs, in a process of its own. There the words of the query
are given: a query is voting or scoring, without quantisation and ranking. The peak is that of the
whole process with the synthetic images that are being added, but without a tree; the leaves of one
with a million words take another half a gigabyte.
"""


def run() -> Section:
    """Compare vocabularies, queries and growth."""
    missing: list[str] = []
    photographs = campus_descriptors()
    trainers = _trainers(missing)
    ranked = _quality(photographs, trainers)
    precision = {row.contender: row.extra["mAP"] for row in ranked if row.task == SMALL}
    rows = [
        *_vocabulary(photographs, trainers, precision),
        *_large_vocabulary(photographs, missing),
        *_queries(photographs, trainers),
        *ranked,
    ]
    growth_rows, curves = _growth(missing)
    return Section("Place recognition", SETUP, [*rows, *growth_rows], curves, _once(missing))


def _trainers(missing: list[str]) -> dict[str, Trainer]:
    def ours(descriptors: np.ndarray, seed: int) -> Words:
        return VocabularyTree(10, 3).fit(descriptors, np.random.default_rng(seed)).words

    trainers: dict[str, Trainer] = {OURS: ours}
    sklearn = peers.load("sklearn.cluster", missing)
    if sklearn:
        for name, start in ((SKLEARN, "k-means++"), (SKLEARN_RANDOM, "random")):

            def mini_batch(descriptors: np.ndarray, seed: int, start: str = start) -> Words:
                model = sklearn.MiniBatchKMeans(1000, init=start, random_state=seed)
                return model.fit(descriptors).predict

            trainers[name] = mini_batch
    faiss = _faiss(missing)
    if faiss:

        def flat(descriptors: np.ndarray, seed: int) -> Words:
            model = faiss.Kmeans(descriptors.shape[1], 1000, niter=10, seed=seed + 1)
            model.train(descriptors)
            return _flat_words(faiss, model.centroids)

        trainers[FAISS] = flat
    trainers[LOOP] = _naive_tree
    return trainers


def _vocabulary(
    photographs: dict[str, np.ndarray],
    trainers: dict[str, Trainer],
    precision: dict[str, float | str],
) -> list[Row]:
    group = "A vocabulary of 1000 words"
    everything = np.concatenate(list(photographs.values()))
    typical = sorted(photographs.values(), key=len)[len(photographs) // 2]
    words = {name: train(everything, 0) for name, train in trainers.items()}
    training = {name: _call(train, everything, 0) for name, train in trainers.items()}
    worth: dict[str, dict[str, float | str]] = {n: {"mAP": p} for n, p in precision.items()}
    words.pop(SKLEARN_RANDOM, None)  # as fast as the other one, once it is trained
    all_at_once = {name: function for name, function in words.items() if name != LOOP}
    return [
        *measure(group, f"training, {len(everything):,} descriptors", training, 5, worth),
        *measure(
            group,
            f"words of {len(everything):,} descriptors",
            {name: _call(function, everything) for name, function in all_at_once.items()},
        ),
        *measure(
            group,
            f"words of one photograph, {len(typical):,} descriptors",
            {name: _call(function, typical) for name, function in words.items()},
        ),
    ]


def _large_vocabulary(photographs: dict[str, np.ndarray], missing: list[str]) -> list[Row]:
    everything = np.concatenate(list(photographs.values()))
    tree = VocabularyTree(10, 4).fit(everything, np.random.default_rng(0))
    contenders = {OURS: _call(tree.words, everything)}
    faiss = _faiss(missing)
    if faiss:
        leaves = tree.levels[-1]
        flat = _flat_words(faiss, leaves[np.isfinite(leaves[:, 0])])
        contenders[FAISS] = _call(flat, everything)
    task = f"words of {len(everything):,} descriptors"
    return measure("A vocabulary of 10,000 words", task, contenders, 3)


def _queries(photographs: dict[str, np.ndarray], trainers: dict[str, Trainer]) -> list[Row]:
    everything = np.concatenate(list(photographs.values()))
    query = sorted(photographs.values(), key=len)[len(photographs) // 2]
    tree = VocabularyTree(10, 3).fit(everything, np.random.default_rng(0))
    database = ImageDatabase(tree)
    for name, descriptors in photographs.items():
        database.add(name, descriptors)
    contenders: dict[str, Callable[[], object]] = {OURS: _call(database.query, query, 25)}
    for name, train in trainers.items():
        if name in (SKLEARN, FAISS, LOOP):
            words = train(everything, 0)
            ask = _dense_database(words, list(photographs.values()), with_faiss=name == FAISS)
            contenders[name] = _call(ask, query)
    return measure("A query", f"25 photographs, {len(query):,} descriptors", contenders)


def _dense_database(
    words: Words, photographs: list[np.ndarray], with_faiss: bool
) -> Callable[[np.ndarray], np.ndarray]:
    """A function that ranks photographs by comparing whole tf-idf vectors."""

    def histogram(descriptors: np.ndarray) -> np.ndarray:
        return np.bincount(words(descriptors), minlength=1000)

    histograms = np.array([histogram(descriptors) for descriptors in photographs])
    weights = idf_weights(histograms)
    if not with_faiss:
        return lambda query: np.argsort(l1_scores(histogram(query), histograms, weights))
    import faiss

    vectors = (histograms * weights).astype(np.float32)
    index = faiss.IndexFlat(1000, faiss.METRIC_L1)
    index.add(vectors / vectors.sum(axis=1, keepdims=True))

    def ask(query: np.ndarray) -> np.ndarray:
        vector = (histogram(query) * weights).astype(np.float32)
        return index.search(vector[None] / vector.sum(), len(photographs))[1][0]

    return ask


def _quality(photographs: dict[str, np.ndarray], trainers: dict[str, Trainer]) -> list[Row]:
    rows = []
    for name, train in trainers.items():
        rows.append(_quality_row(SMALL, name, photographs, train, 1000))
    for depth in (4, 5):
        word_count = 10**depth
        task = f"SIFT, {word_count:,} words"
        rows.append(_quality_row(task, OURS, photographs, _tree_trainer(depth), word_count))
    rows.append(
        _quality_row("SIFT, 100,000 words", f"{OURS}, votes", photographs, _tree_trainer(5), 10**5)
    )
    orb = campus_descriptors("orb")
    rows.append(_quality_row("ORB, 10,000 words", OURS, orb, _tree_trainer(4), 10**4))
    return rows


def _quality_row(
    task: str, name: str, photographs: dict[str, np.ndarray], train: Trainer, word_count: int
) -> Row:
    everything = np.concatenate(list(photographs.values()))
    results = np.array(
        [
            quality(photographs, train(everything, seed), word_count, votes="votes" in name)
            for seed in range(SEEDS)
        ]
    )
    precision, recall = (f"{m:.2f} ± {s:.2f}" for m, s in zip(*_moments(results), strict=True))
    extra: dict[str, float | str] = {"mAP": precision, "recall at 1": recall}
    return Row("Retrieval quality", task, name, extra=extra)


def _growth(missing: list[str]) -> tuple[list[Row], list[Curve]]:
    """Ask databases of more and more synthetic images."""
    sparse = peers.load("scipy.sparse", missing)
    times: dict[str, dict[int, float]] = {OURS: {}, "SciPy, cosine": {}}
    for size in (1000, 3000, 10_000, 30_000):
        rng = np.random.default_rng(0)
        query, *images = million_images.synthetic_images(rng, size + 1)
        index = InvertedIndex(million_images.WORD_COUNT)
        index.extend(images)
        contenders = {OURS: _call(index.scores, query)}
        if sparse:
            contenders["SciPy, cosine"] = _sparse_database(sparse, images, query)
        for row in measure("growth", str(size), contenders, 5):
            times[row.contender][size] = row.seconds or 0.0
    rows = []
    for result in million_images.measured():
        size = int(result["images"])
        times[OURS][size] = result["tf-idf"]
        extra: dict[str, float | str] = {
            "slowest": f"{1e3 * result['slowest tf-idf']:.3g} ms",
            "votes": f"{1e3 * result['votes']:.3g} ms",
            "peak memory": f"{result['peak'] / 1e9:.2f} GB" if "peak" in result else "",
            "building": f"{result['building']:.3g} s",
            "new weights": f"{result['weighting']:.3g} s",
        }
        task = f"query of {size:,} images"
        rows.append(Row("A million synthetic images", task, OURS, result["tf-idf"], None, extra))
    curves = [
        Curve(
            "Query of a growing database",
            name,
            "images",
            "seconds",
            tuple(map(float, seconds)),
            tuple(seconds.values()),
        )
        for name, seconds in times.items()
        if seconds
    ]
    return rows, curves


def _sparse_database(
    sparse: ModuleType, images: list[np.ndarray], query: np.ndarray
) -> Callable[..., object]:
    """A call that multiplies the query with all images, as sparse tf-idf vectors."""
    ends = np.cumsum([0, *map(len, images)])
    shape = (len(images), million_images.WORD_COUNT)
    words = np.concatenate(images)
    matrix = sparse.csr_matrix((np.ones(len(words), np.float32), words, ends), shape)
    matrix.sum_duplicates()
    images_with_word = np.bincount(matrix.indices, minlength=shape[1])
    weights = np.log(len(images) / np.maximum(images_with_word, 1)).astype(np.float32)
    matrix.data *= weights[matrix.indices]
    lengths = np.sqrt(np.asarray(matrix.multiply(matrix).sum(axis=1)).ravel())
    matrix.data /= np.repeat(lengths, np.diff(matrix.indptr))
    by_word = matrix.T.tocsr()

    def ask() -> np.ndarray:
        different, times = np.unique(query, return_counts=True)
        values = (times * weights[different]).astype(np.float32)
        row = sparse.csr_matrix((values, different, [0, len(values)]), (1, shape[1]))
        return (row @ by_word).toarray()[0]

    return ask


def _naive_tree(descriptors: np.ndarray, seed: int) -> Words:
    """Hierarchical k-means as a student may write it: ten children, three levels."""
    rng = np.random.default_rng(seed)
    levels = [np.full((10**depth, descriptors.shape[1]), np.inf) for depth in (1, 2, 3)]

    def divide(own: np.ndarray, level: int, node: int) -> None:
        if level == len(levels) or len(own) == 0:
            return
        centers = own[rng.choice(len(own), size=min(10, len(own)), replace=False)]
        for _ in range(10):
            nearest = assign_words(own, centers)
            groups = [own[nearest == i] for i in range(len(centers))]
            centers = np.array([g.mean(axis=0) for g in groups if len(g)])
        levels[level][10 * node : 10 * node + len(centers)] = centers
        nearest = assign_words(own, centers)
        for i in range(len(centers)):
            divide(own[nearest == i], level + 1, 10 * node + i)

    divide(descriptors, 0, 0)
    return lambda many: np.array([descend_tree(one, levels) for one in many])


def _tree_trainer(depth: int) -> Trainer:
    return lambda descriptors, seed: (
        VocabularyTree(10, depth).fit(descriptors, np.random.default_rng(seed)).words
    )


def _flat_words(faiss: ModuleType, words: np.ndarray) -> Words:
    index = faiss.IndexFlatL2(words.shape[1])
    index.add(np.ascontiguousarray(words, np.float32))
    return lambda descriptors: index.search(descriptors, 1)[1][:, 0]


def _faiss(missing: list[str]) -> Any:
    faiss = peers.load("faiss", missing)
    if faiss:
        faiss.omp_set_num_threads(1)
    return faiss


def _call(function: Callable[..., object], *arguments: object) -> Callable[[], object]:
    return lambda: function(*arguments)


def _moments(results: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return results.mean(axis=0), results.std(axis=0)


def _once(sentences: list[str]) -> list[str]:
    return list(dict.fromkeys(sentences))
