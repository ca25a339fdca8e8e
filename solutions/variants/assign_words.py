"""Other right ways to find the nearest words."""

import math

import numpy as np


def loops(descriptors, words):
    found = []
    for descriptor in descriptors:
        best, least = 0, math.inf
        for k, word in enumerate(words):
            distance = sum((a - b) ** 2 for a, b in zip(descriptor, word, strict=True))
            if distance < least:
                best, least = k, distance
        found.append(best)
    return found


def broadcast(descriptors, words):
    differences = descriptors[:, np.newaxis, :] - words[np.newaxis, :, :]
    return np.linalg.norm(differences, axis=2).argmin(axis=1)


def one_matrix_product(descriptors, words):
    squared = (descriptors**2).sum(1)[:, None] - 2 * descriptors @ words.T + (words**2).sum(1)
    return np.argmin(squared, axis=1).astype(np.int32)


def one_descriptor_at_a_time(descriptors, words):
    nearest = np.zeros(len(descriptors), dtype=int)
    for i, descriptor in enumerate(descriptors):
        nearest[i] = np.argmin(((words - descriptor) ** 2).sum(axis=1))
    return nearest


def sorted_pairs(descriptors, words):
    def distances(x):
        return sorted((float(np.sum((x - word) ** 2)), k) for k, word in enumerate(words))

    return tuple(distances(x)[0][1] for x in descriptors)
