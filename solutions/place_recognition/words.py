"""From descriptors to visual words, one step at a time, as the course explains it.

`solutions.place_recognition.fast.vocabulary_tree` does the same for many descriptors at once.

Source: Nister and Stewenius, Scalable recognition with a vocabulary tree, CVPR 2006.
"""

import numpy as np


def assign_words(descriptors: np.ndarray, words: np.ndarray) -> np.ndarray:
    """Return for each descriptor the index of the nearest word: (N,) whole numbers from 0 to K - 1.

    `descriptors` is (N, d), `words` is (K, d), both hold floats; K is at least 1. Near means
    the Euclidean distance. Of several words at the same distance the first one counts. No
    descriptors (N = 0) give an empty array.
    """
    if np.ma.is_masked(descriptors) or np.ma.is_masked(words):  # or the mask would be dropped
        raise TypeError("Some descriptors or words are masked; leave them out first.")
    # Bytes and halves overflow when squared.
    descriptors, words = np.asarray(descriptors, dtype=float), np.asarray(words, dtype=float)
    # |x - c|² = |x|² - 2 (x·c - |c|²/2), and |x|² is the same for all words c.
    closeness = descriptors @ words.T - 0.5 * (words**2).sum(axis=1)
    return closeness.argmax(axis=1)


def descend_tree(descriptor: np.ndarray, levels: list[np.ndarray]) -> int:
    """Return the word of one descriptor: the row, in the last level, at which it arrives.

    `descriptor` is (d,). `levels` has an array of centres for each level of the tree, from
    the top: `levels[0]` is (k, d), the k children of the root, `levels[1]` is (k², d), and so
    on. The children of row i are the rows k·i to k·i + k - 1 of the next level. At each level
    the descriptor goes to the nearest child of the node it has reached, by the Euclidean
    distance; of several at the same distance to the first one.
    """
    if any(np.ma.is_masked(entry) for entry in (descriptor, *levels)):  # as in `assign_words`
        raise TypeError("The descriptor or the tree has masked numbers; leave them out first.")
    branching = len(levels[0])
    node = 0
    for centers in levels:
        children = centers[branching * node : branching * (node + 1)].astype(float)
        squared_distances = ((children - descriptor) ** 2).sum(axis=1)
        node = branching * node + int(squared_distances.argmin())
    return node
