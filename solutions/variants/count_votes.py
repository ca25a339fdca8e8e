"""Other right ways to count votes."""

from collections import Counter
from itertools import chain

import numpy as np


def counter(query_words, inverted_file, image_count):
    votes = Counter(chain.from_iterable(inverted_file[word] for word in query_words))
    return [votes[image] for image in range(image_count)]


def bincount(query_words, inverted_file, image_count):
    listed = [image for word in query_words for image in inverted_file[word]]
    return np.bincount(np.array(listed, dtype=int), minlength=image_count)


def add_at(query_words, inverted_file, image_count):
    votes = np.zeros(image_count, dtype=np.uint16)
    for word in query_words:
        np.add.at(votes, np.array(inverted_file[word], dtype=int), 1)
    return votes


def whole_lists(query_words, inverted_file, image_count):
    votes = np.zeros(image_count)  # floats, all whole
    for word in query_words:
        votes[inverted_file[word]] += 1  # an image stands in a list once
    return votes


def matrix(query_words, inverted_file, image_count):
    listed = np.array(
        [[image in images for image in range(image_count)] for images in inverted_file], dtype=int
    ).reshape(len(inverted_file), image_count)
    return np.bincount(query_words, minlength=len(inverted_file)) @ listed
