"""Other right ways to invert the file."""

from collections import defaultdict

import numpy as np


def sets(words_by_image, word_count):
    inverted_file = [[] for _ in range(word_count)]
    for image, words in enumerate(words_by_image):
        for word in {int(word) for word in words}:
            inverted_file[word].append(image)
    return inverted_file


def word_by_word(words_by_image, word_count):
    return [
        [image for image, words in enumerate(words_by_image) if word in words]
        for word in range(word_count)
    ]


def not_yet_listed(words_by_image, word_count):
    lists = [[] for _ in range(word_count)]
    for image in range(len(words_by_image)):
        for word in words_by_image[image]:
            if image not in lists[word]:
                lists[word].append(image)
    return lists


def a_dictionary_first(words_by_image, word_count):
    images = defaultdict(set)
    for image, words in enumerate(words_by_image):
        for word in words.tolist():
            images[word].add(image)
    return [sorted(images[word]) for word in range(word_count)]


def a_table_of_truth(words_by_image, word_count):
    has = np.zeros((len(words_by_image), word_count), dtype=bool)
    for image, words in enumerate(words_by_image):
        has[image, words] = True
    return [np.flatnonzero(column) for column in has.T]
