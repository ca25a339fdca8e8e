"""Inputs and comparison for the place recognition questions."""

import numpy as np

from solutions.cases.case import Case, Value
from solutions.place_recognition.words import assign_words, descend_tree


def assign_words_cases(rng: np.random.Generator) -> list[Case]:
    """Return (descriptors, words); only the case on ties has two words equally near.

    Two cases have the same shape, so that nothing can be kept from one call to the next.
    """
    by_hand = np.array([[1.0, 0.0], [3.0, 1.0], [5.0, 5.0]]), np.array([[0.0, 0.0], [4.0, 0.0]])
    spread = [[rng.uniform(0.0, 1.0, (60, 8)), rng.uniform(0.0, 1.0, (12, 8))] for _ in "ab"]
    # Words of very different length, so that the dot product misleads.
    words = rng.normal(0.0, 1.0, (9, 16)) * rng.uniform(0.5, 4.0, (9, 1))
    around = words[rng.integers(9, size=40)] + rng.normal(0.0, 0.3, (40, 16))
    # Whole numbers, whose distances every method finds exactly.
    left = rng.integers(-5, 5, (6, 3)).astype(float)
    step = rng.integers(1, 4, 3).astype(float)
    # The first descriptor has the last word, which is one of the two that are halfway for the next.
    ties = left[0] + [0 * step, step], np.vstack([left[0] + 9 * step, left[0] + 2 * step, left[0]])
    # The nearest word is nearer by a few ten-thousandths, and comes last. Exact in float32 as well.
    shorter = np.array([1.5, 1.0, 1 - 2.0**-12, 1 - 2.0**-11])
    nearly = np.zeros((1, 2)), np.outer(shorter, rng.permutation([0.0, 1.0]))
    mirrored = rng.integers(2, 9, (6, 2)).astype(float) * [1, rng.choice([-1, 1])]
    many = rng.normal(0.0, 1.0, (300, 6))
    sift = rng.integers(0, 256, (30, 128)).astype(float), rng.integers(0, 256, (50, 128)) * 1.0
    return [
        {"name": "three descriptors and two words", "args": [*by_hand], "public": True},
        *({"name": "descriptors spread between the words", "args": args} for args in spread),
        {"name": "descriptors around words, long and short", "args": [around, words]},
        {"name": "SIFT descriptors, more words than descriptors", "args": [*sift]},
        {"name": "a descriptor halfway between two words", "args": [*ties]},
        {"name": "words at nearly the same distance", "args": [*nearly]},
        {
            "name": "words on both sides of the origin",
            "args": [-mirrored, np.vstack([mirrored, -mirrored[::-1] - 0.25])],
        },
        {"name": "three hundred words", "args": [many[100:] + 0.01, many]},
        {"name": "a single word", "args": [rng.normal(size=(5, 4)), rng.normal(size=(1, 4))]},
        {"name": "no descriptors", "args": [np.zeros((0, 4)), rng.normal(size=(3, 4))]},
    ]


def descend_tree_cases(rng: np.random.Generator) -> list[Case]:
    """Return (descriptor, levels): one descriptor and the centres of a tree."""
    by_hand = [
        np.array([[0.0, 0.0], [10.0, 0.0]]),
        np.array([[-1.0, 0.0], [1.0, 0.0], [8.0, 0.0], [12.0, 0.0]]),
    ]
    cases = [
        {
            "name": "two levels, two children each",
            "args": [np.array([9.0, 1.0]), by_hand],
            "public": True,
        }
    ]
    for name, branching, depth in (
        ("two levels", 4, 2),
        ("three levels", 3, 3),
        ("three levels", 4, 3),  # in floating point, the third root of 64 is less than 4
        ("five levels", 2, 5),
        ("ten children", 10, 2),
    ):
        cases += [{"name": name, "args": _tree(rng, branching, depth)} for _ in range(2)]
    for _ in range(3):
        descriptor, levels = _tree(rng, 3, 3)
        while assign_words(descriptor[None], levels[-1])[0] == descend_tree(descriptor, levels):
            descriptor, levels = _tree(rng, 3, 3)
        name = "the nearest leaf hangs from another branch"
        cases.append({"name": name, "args": [descriptor, levels]})
    # Right behind the children of a node, and right before them, stand those of its neighbours.
    for side in (-1, 1):
        first = np.array([[-10.0 * side, 0], [0, 0], [10.0 * side, 0]])
        below = np.repeat(first, 3, axis=0) + rng.integers(-1, 2, (9, 2)) * 0.25
        below[[2, 6]] = [[-5.5 * side, 0], [5.5 * side, 0]]
        for x in (-4.5, 4.5):
            cases.append(
                {
                    "name": "the nearest leaf hangs from another branch",
                    "args": [np.array([x, 0.25]), [first, below]],
                }
            )
    row = int(rng.integers(1, 6))
    _, centers = _tree(rng, 6, 1)
    cases.append({"name": "one level only", "args": [centers[0][row] + 0.01, centers]})
    # Nearer by a few ten-thousandths, and last. Exact in float32 as well.
    shorter = np.outer([1.5, 1.0, 1 - 2.0**-12, 1 - 2.0**-11], rng.permutation([0.0, 1.0]))
    place = rng.integers(1, 9, 2).astype(float)
    nearly = [place, [place + shorter]]
    cases.append({"name": "centres at nearly the same distance", "args": nearly})
    halfway = rng.integers(-5, 5, 2).astype(float)
    tie = [halfway + np.array([[3.0, 0.0], [0.0, 3.0], [0.0, 9.0]]), rng.normal(size=(9, 2))]
    cases.append({"name": "halfway between two centres", "args": [halfway, tie]})
    return cases


def build_inverted_file_cases(rng: np.random.Generator) -> list[Case]:
    """Return (words_by_image, word_count)."""
    nothing = np.zeros(0, dtype=int)
    by_hand = [np.array([0, 1, 1]), np.array([2, 0])]

    def random_images(image_count: int, word_count: int, features: int) -> list[np.ndarray]:
        return [rng.integers(0, word_count, features) for _ in range(image_count)]

    unused = [2 * words for words in random_images(5, 4, 6)]  # no image has an odd word
    twice = random_images(3, 9, 5)
    twice = [twice[i].copy() for i in (0, 1, 1, 2, 0)]
    return [
        {"name": "two images and four words", "args": [by_hand, 4], "public": True},
        {"name": "more images than words", "args": [random_images(12, 5, 4), 5]},
        {"name": "more words than images", "args": [random_images(4, 30, 15), 30]},
        {"name": "words that no image has", "args": [unused, 9]},
        {
            "name": "an image without features",
            "args": [[*random_images(2, 6, 5), nothing, *random_images(2, 6, 5)], 6],
        },
        {
            "name": "a word several times in one image",
            "args": [[rng.permutation(np.repeat(rng.permutation(4)[:3], 3)) for _ in "abc"], 4],
        },
        {"name": "images with the same words", "args": [twice, 9]},
        {"name": "hundreds of images", "args": [random_images(300, 40, 4), 40]},
        {"name": "a thousand features", "args": [random_images(2, 3000, 1000), 3000]},
        {"name": "no images", "args": [[], 3]},
    ]


def same_inverted_file(case: Case, expected: Value, actual: Value) -> bool:
    """Tell whether both list the same images at each word, in whatever order."""
    if not isinstance(actual, list | tuple | np.ndarray) or len(actual) != len(expected):
        return False
    for right, given in zip(expected, actual, strict=True):
        try:
            images = np.asarray(given)
        except ValueError:  # lists of unequal length
            return False
        if images.ndim != 1 or (images.size and images.dtype.kind not in "iu"):
            return False
        if sorted(images.tolist()) != sorted(right):
            return False
    return True


def count_votes_cases(rng: np.random.Generator) -> list[Case]:
    """Return (query_words, inverted_file, image_count)."""
    by_hand: list[list[int]] = [[0, 1], [1], [0, 2], []]

    def random_file(word_count: int, image_count: int, share: float) -> list[list[int]]:
        listed = rng.random((word_count, image_count)) < share
        listed[0, 0] = True  # at least one image is listed
        return [np.flatnonzero(row).tolist() for row in listed]

    def query(word_count: int, features: int) -> np.ndarray:
        return np.append(rng.integers(0, word_count, features), 0)

    gaps = [*random_file(6, 5, 0.4), [], [], []]
    everywhere = [*random_file(6, 5, 0.4), [0, 1, 2, 3, 4]]
    return [
        {
            "name": "three features and three images",
            "args": [np.array([0, 1, 2]), by_hand, 3],
            "public": True,
        },
        {"name": "many features", "args": [query(20, 60), random_file(20, 8, 0.3), 8]},
        {"name": "each word once", "args": [rng.permutation(9), random_file(9, 6, 0.4), 6]},
        {
            "name": "a word several times in the test image",
            "args": [
                rng.permutation(np.repeat([0, *range(1, 8, 2)], 3)),
                random_file(8, 5, 0.5),
                5,
            ],
        },
        {"name": "words that no image has", "args": [rng.permutation(9), gaps, 5]},
        {"name": "a word that every image has", "args": [query(7, 0).repeat(2) + 6, everywhere, 5]},
        {"name": "a thousand features", "args": [query(3, 1000), random_file(3, 6, 0.6), 6]},
        {"name": "images that share nothing", "args": [query(6, 12), random_file(6, 4, 0.5), 7]},
        {
            "name": "a test image without features",
            "args": [np.zeros(0, dtype=int), random_file(6, 4, 0.5), 4],
        },
    ]


def idf_weights_cases(rng: np.random.Generator) -> list[Case]:
    """Return (histograms,)."""
    by_hand = np.array([[1, 0, 2, 0], [1, 3, 0, 0], [4, 0, 0, 0], [1, 1, 0, 0]])
    everywhere = rng.integers(0, 3, (6, 8))
    everywhere[:, 3] = rng.integers(1, 5, 6)
    nowhere = rng.integers(0, 3, (6, 8))
    nowhere[:, 5] = 0
    empty = rng.integers(0, 3, (6, 8))
    empty[int(rng.integers(6))] = 0
    often = (rng.random((400, 7)) < np.linspace(0.1, 1.0, 7)).astype(int)
    return [
        {"name": "four images and four words", "args": [by_hand], "public": True},
        {"name": "many words", "args": [rng.poisson(0.5, (15, 60))]},
        {"name": "each word at most once", "args": [rng.integers(0, 2, (9, 20))]},
        {"name": "a word that every image has", "args": [everywhere]},
        {"name": "a word that no image has", "args": [nowhere]},
        {"name": "an image without features", "args": [empty]},
        {"name": "hundreds of images", "args": [often]},
        {"name": "a single image", "args": [rng.integers(0, 3, (1, 12))]},
    ]


def l1_scores_cases(rng: np.random.Generator) -> list[Case]:
    """Return (query, histograms, weights)."""
    by_hand = np.array([2, 1, 1]), np.array([[2, 1, 1], [0, 0, 4], [1, 0, 3]]), np.ones(3)

    def weights(count: int) -> np.ndarray:
        return rng.uniform(0.2, 2.0, count)

    # One feature at least, at a word of weight, except where the case is about that.
    def histograms(image_count: int, word_count: int) -> np.ndarray:
        counts = rng.poisson(1.0, (image_count, word_count))
        counts[:, 0] += 1
        return counts

    same = histograms(5, 12)
    empty = histograms(5, 12)
    empty[2] = 0
    apart = histograms(4, 12)
    apart[1, :6], apart[1, 6] = 0, 3
    first_half = np.append(rng.integers(1, 4, 6), np.zeros(6, dtype=int))
    unweighted = np.append(np.zeros(4), weights(8))
    common = np.append(rng.integers(1, 4, 4), np.zeros(8, dtype=int))
    weightless = histograms(5, 12)
    weightless[3, 4:] = 0
    sizes = histograms(5, 12) * np.array([[1], [2], [5], [10], [30]])
    return [
        {"name": "three images, equal weights", "args": [*by_hand], "public": True},
        {"name": "many words", "args": [histograms(1, 80)[0], histograms(12, 80), weights(80)]},
        {"name": "images of different size", "args": [histograms(1, 12)[0], sizes, weights(12)]},
        {
            "name": "one feature each, light words",
            "args": [np.eye(12, dtype=int)[3], np.eye(12, dtype=int)[:6], 1e-4 * weights(12)],
        },
        {"name": "a single image", "args": [*histograms(2, 9)[[1]], histograms(1, 9), weights(9)]},
        {
            "name": "counts that are floats",
            "args": [histograms(1, 9)[0] * 1.0, histograms(4, 9) * 1.0, weights(9)],
        },
        {"name": "the query itself, twice as often", "args": [2 * same[3], same, weights(12)]},
        {"name": "an image that shares nothing", "args": [first_half, apart, weights(12)]},
        {"name": "an image without features", "args": [histograms(1, 12)[0], empty, weights(12)]},
        {
            "name": "an image whose words weigh nothing",
            "args": [histograms(1, 12)[0] + (np.arange(12) == 11), weightless, unweighted],
        },
        {
            "name": "a query whose words weigh nothing",
            "args": [common, np.vstack([histograms(4, 12), common]), unweighted],
        },
    ]


def _tree(rng: np.random.Generator, branching: int, depth: int) -> list[Value]:
    """Return a descriptor and the levels of a tree, centres scattered about their parents."""
    parents, levels = np.zeros((1, 4)), []
    for level in range(depth):
        parents = np.repeat(parents, branching, axis=0)
        parents = parents + rng.normal(0.0, 2.0 * 0.7**level, parents.shape)
        levels.append(parents)
    return [parents[rng.integers(len(parents))] + rng.normal(0.0, 1.0, 4), levels]
