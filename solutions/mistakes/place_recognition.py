"""What students write for the place recognition questions, and what goes wrong."""

import numpy as np

from solutions.place_recognition.inverted_file import build_inverted_file, count_votes


def largest_product(descriptors, words):
    """Takes the word with the largest dot product: long words win, however far away."""
    return (descriptors @ words.T).argmax(axis=1)


def city_block_distance(descriptors, words):
    """Adds up absolute differences instead of squares."""
    differences = descriptors[:, None, :] - words[None, :, :]
    return np.abs(differences).sum(axis=2).argmin(axis=1)


def nearest_descriptor_of_each_word(descriptors, words):
    """Looks along the wrong axis: one index for each word, not for each descriptor."""
    if len(descriptors) == 0:
        return np.zeros(0, dtype=int)
    differences = descriptors[:, None, :] - words[None, :, :]
    return (differences**2).sum(axis=2).argmin(axis=0)


def farthest_word(descriptors, words):
    """Takes the maximum where the minimum is wanted."""
    differences = descriptors[:, None, :] - words[None, :, :]
    return (differences**2).sum(axis=2).argmax(axis=1)


def nearest_leaf_of_all(descriptor, levels):
    """Compares the descriptor with every leaf; the levels above are not used."""
    return int(((levels[-1] - descriptor) ** 2).sum(axis=1).argmin())


def position_among_siblings(descriptor, levels):
    """Descends rightly, but returns which child of its parent the leaf is."""
    branching, node, best = len(levels[0]), 0, 0
    for centers in levels:
        children = centers[branching * node : branching * (node + 1)]
        best = int(((children - descriptor) ** 2).sum(axis=1).argmin())
        node = branching * node + best
    return best


def children_start_at_the_node(descriptor, levels):
    """Looks at the rows node to node + k - 1 of the next level, not k·node to k·node + k - 1."""
    branching, node = len(levels[0]), 0
    for centers in levels:
        children = centers[node : node + branching]
        node += int(((children - descriptor) ** 2).sum(axis=1).argmin())
    return node


def numbers_all_nodes(descriptor, levels):
    """Counts the nodes of the levels above as well, as in an array that holds the whole tree."""
    branching, node = len(levels[0]), 0
    for centers in levels:
        children = centers[branching * node : branching * (node + 1)]
        node = branching * node + int(((children - descriptor) ** 2).sum(axis=1).argmin())
    return node + sum(len(centers) for centers in levels[:-1])


def lists_every_occurrence(words_by_image, word_count):
    """Lists an image once for each feature with the word."""
    inverted_file: list[list[int]] = [[] for _ in range(word_count)]
    for image, words in enumerate(words_by_image):
        for word in words:
            inverted_file[word].append(image)
    return inverted_file


def shares_one_list(words_by_image, word_count):
    """Writes [[]] * word_count: the same list, word_count times."""
    inverted_file: list[list[int]] = [[]] * word_count
    for image, words in enumerate(words_by_image):
        for word in words:
            if image not in inverted_file[word]:
                inverted_file[word].append(image)
    return inverted_file


def keeps_the_last_image(words_by_image, word_count):
    """Assigns where it should append: each word knows only the last image that has it."""
    return [images[-1:] for images in build_inverted_file(words_by_image, word_count)]


def lists_words_of_images(words_by_image, word_count):
    """Lists the words of each image, which is the file that was to be inverted."""
    return [np.unique(words).astype(int).tolist() for words in words_by_image]


def votes_once_for_each_word(query_words, inverted_file, image_count):
    """Goes over the different words of the test image instead of its features."""
    return count_votes(np.unique(query_words).astype(int), inverted_file, image_count)


def adds_all_at_once(query_words, inverted_file, image_count):
    """Adds one at a list of indices: NumPy adds only one where an index is repeated."""
    listed = [image for word in query_words for image in inverted_file[word]]
    votes = np.zeros(image_count, dtype=int)
    votes[np.array(listed, dtype=int)] += 1
    return votes


def forgets_images_at_the_end(query_words, inverted_file, image_count):
    """Leaves minlength out of bincount: the array ends at the last image with a vote."""
    listed = [image for word in query_words for image in inverted_file[word]]
    return np.bincount(np.array(listed, dtype=int))


def returns_the_winner(query_words, inverted_file, image_count):
    """Goes one step further and returns the most voted image."""
    return int(np.argmax(count_votes(query_words, inverted_file, image_count)))


def counts_occurrences(histograms):
    """Divides by how often the word occurs in all images together."""
    occurrences = histograms.sum(axis=0)
    share = np.maximum(occurrences, 1) / len(histograms)
    return np.where(occurrences > 0, -np.log(share), 0.0)


def takes_the_decadic_logarithm(histograms):
    """Uses log10 for the natural logarithm."""
    images_with_word = (histograms > 0).sum(axis=0)
    share = np.maximum(images_with_word, 1) / len(histograms)
    return np.where(images_with_word > 0, -np.log10(share), 0.0)


def turns_the_fraction_round(histograms):
    """Uses ln(M_i / M): every weight has the wrong sign."""
    images_with_word = (histograms > 0).sum(axis=0)
    share = np.maximum(images_with_word, 1) / len(histograms)
    return np.where(images_with_word > 0, np.log(share), 0.0)


def divides_by_no_images(histograms):
    """Lets the weight of a word of no image become infinite."""
    images_with_word = (histograms > 0).sum(axis=0)
    with np.errstate(divide="ignore"):
        return np.log(len(histograms) / images_with_word)


def _weighted(query, histograms, weights):
    return query * weights, histograms * weights


def _normalised(vectors, norms):
    return vectors / np.where(norms > 0, norms, 1.0)


def does_not_normalise(query, histograms, weights):
    """Compares weighted histograms as they are: images with many features seem far away."""
    q, d = _weighted(query, histograms, weights)
    return np.abs(q - d).sum(axis=1)


def uses_the_euclidean_norm(query, histograms, weights):
    """Divides by the Euclidean length and measures the Euclidean distance."""
    q, d = _weighted(query, histograms, weights)
    q = _normalised(q, np.linalg.norm(q))
    d = _normalised(d, np.linalg.norm(d, axis=1, keepdims=True))
    return np.linalg.norm(q - d, axis=1)


def forgets_the_weights(query, histograms, weights):
    """Compares plain histograms, in which a word of all images counts as much as a rare one."""
    q = _normalised(query, query.sum())
    d = _normalised(histograms, histograms.sum(axis=1, keepdims=True))
    return 2.0 - 2.0 * np.minimum(q, d).sum(axis=1)


def prefers_empty_images(query, histograms, weights):
    """Gives 1 where nothing can be shared, half as bad as an image that shares nothing."""
    q, d = _weighted(query, histograms, weights)
    q = _normalised(q, q.sum())
    d = _normalised(d, d.sum(axis=1, keepdims=True))
    return np.abs(q - d).sum(axis=1)


def divides_by_zero(query, histograms, weights):
    """Gives NaN where a sum is 0."""
    q, d = _weighted(query, histograms, weights)
    with np.errstate(invalid="ignore", divide="ignore"):
        q = q / q.sum()
        d = d / d.sum(axis=1, keepdims=True)
    return np.abs(q - d).sum(axis=1)
