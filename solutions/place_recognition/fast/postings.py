"""The inverted file of some images in flat arrays: a part of a larger one.

`inverted_file.build_inverted_file` makes the same lists, one Python list a word.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

MOST_IMAGES = 2**16  # in one part, so that two bytes hold an image's number
WORDS_AT_ONCE = 4096  # keeps temporary arrays small


class Postings(NamedTuple):
    """Which of M images have which word, and how often, sorted by word and image.

    The list of `words[i]` is at `starts[i]` to `starts[i + 1]` of `images` and `counts`.
    """

    image_count: int
    words: np.ndarray  # (W,) the different words, in rising order
    starts: np.ndarray  # (W + 1,)
    images: np.ndarray  # (P,) uint16, from 0 to image_count - 1
    counts: np.ndarray  # (P,) the smallest unsigned integers that hold them, at least 1

    @property
    def lengths(self) -> np.ndarray:
        """How many images have each of the words."""
        return np.diff(self.starts)

    def lists_of(self, words: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Look words up: return the images of all lists, end to end, the counts, and the lengths.

        The lengths are (len(words),); a word that no image has gets an empty list.
        """
        at = np.searchsorted(self.words, words)
        found = at < len(self.words)
        found[found] = self.words[at[found]] == words[found]
        starts, lengths = np.zeros((2, len(words)), dtype=np.intp)
        starts[found] = self.starts[at[found]]
        lengths[found] = self.starts[at[found] + 1] - starts[found]
        # Where each list begins here, less where it begins in the result.
        places = np.repeat(starts - (np.cumsum(lengths) - lengths), lengths)
        places += np.arange(len(places))
        return self.images.take(places), self.counts.take(places), lengths

    def weighted_sizes(self, weights: np.ndarray) -> np.ndarray:
        """Return what each image's histogram, times the weights, adds up to: (M,) float32."""
        sizes = np.zeros(self.image_count)
        lengths = self.lengths
        for start in range(0, len(self.words), WORDS_AT_ONCE):
            here = slice(start, start + WORDS_AT_ONCE)
            weighted = np.repeat(weights[self.words[here]], lengths[here])
            lists = slice(self.starts[start], self.starts[start] + len(weighted))
            weighted *= self.counts[lists]
            sizes += np.bincount(self.images[lists], weighted, self.image_count)
        return sizes.astype(np.float32)


def postings_of(words_by_image: Sequence[np.ndarray]) -> Postings:
    """Return the inverted file of images, given the words of the features of each."""
    sizes = [len(words) for words in words_by_image]
    # One number for word and image, which sorts by word first.
    occurrences = np.concatenate(words_by_image, dtype=np.int64, casting="unsafe")
    occurrences *= MOST_IMAGES
    occurrences += np.repeat(np.arange(len(sizes)), sizes)
    occurrences.sort()
    first = _run_starts(occurrences)
    counts = np.diff(first, append=len(occurrences))
    pairs = occurrences[first]
    word = pairs // MOST_IMAGES
    first = _run_starts(word)
    return Postings(
        len(sizes),
        word[first].astype(np.int32),
        np.append(first, len(word)),
        (pairs % MOST_IMAGES).astype(np.uint16),
        counts.astype(np.min_scalar_type(counts.max(initial=0))),
    )


def merged(one: Postings, other: Postings) -> Postings:
    """Return the inverted file of both; the images of `other` come after those of `one`."""
    words = np.sort(np.concatenate([one.words, other.words]))
    words = words[_run_starts(words)]
    # A row for each word: how long its list is in one and in the other.
    lengths = np.zeros((len(words), 2), dtype=np.intp)
    lengths[np.searchsorted(words, one.words), 0] = one.lengths
    lengths[np.searchsorted(words, other.words), 1] = other.lengths
    # In the merged list of a word come first those of one, then those of the other.
    from_other = np.repeat(np.tile([False, True], len(words)), lengths.ravel())
    images = np.empty(len(from_other), np.uint16)
    np.place(images, ~from_other, one.images)
    np.place(images, from_other, other.images + np.uint16(one.image_count))
    counts = np.empty(len(from_other), np.result_type(one.counts, other.counts))
    np.place(counts, ~from_other, one.counts)
    np.place(counts, from_other, other.counts)
    image_count = one.image_count + other.image_count
    starts = np.append(0, np.cumsum(lengths.sum(axis=1)))
    return Postings(image_count, words, starts, images, counts)


def _run_starts(ordered: np.ndarray) -> np.ndarray:
    """Return where in a sorted array a new value begins."""
    new = np.ones(len(ordered), dtype=bool)
    np.not_equal(ordered[1:], ordered[:-1], out=new[1:])
    return np.flatnonzero(new)
