"""The inverted file and the votes, as the course explains them.

`solutions.place_recognition.fast.database` keeps the same lists in flat arrays.
"""

import numpy as np


def build_inverted_file(words_by_image: list[np.ndarray], word_count: int) -> list[list[int]]:
    """Return for each word the images in which it occurs: a list of `word_count` lists.

    `words_by_image[i]` holds the words of image i, one for each of its features: integers
    from 0 to word_count - 1, in any order, any of them several times. An image stands in the
    list of a word once, however often it has the word; the order within a list does not matter.
    A word that no image has gets an empty list; an image without features stands in no list.
    """
    inverted_file: list[list[int]] = [[] for _ in range(word_count)]
    for image, words in enumerate(words_by_image):
        for word in np.unique(words):
            if not 0 <= word < word_count:  # -1 would be the last word
                raise ValueError(f"Image {image} has the word {word}, not 0 to {word_count - 1}.")
            inverted_file[word].append(image)
    return inverted_file


def count_votes(
    query_words: np.ndarray, inverted_file: list[list[int]], image_count: int
) -> np.ndarray:
    """Return the voting array: (image_count,) whole numbers, one entry for each model image.

    `query_words` holds the word of each feature of the test image. Each feature gives one
    vote to every image that the inverted file lists at its word; so a word that the test
    image has three times votes three times. Images without a vote, and all images if there
    are no query words, have 0.
    """
    votes = np.zeros(image_count, dtype=int)
    for word in query_words:
        if not 0 <= word < len(inverted_file):  # -1 would be the last word
            raise ValueError(f"The word {word} is not in the file, 0 to {len(inverted_file) - 1}.")
        for image in inverted_file[word]:
            votes[image] += 1
    return votes
