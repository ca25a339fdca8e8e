"""Place recognition with a vocabulary tree, one concept a file.

`words`, `inverted_file` and `scoring` hold the steps as the course explains them.
"""

from solutions.place_recognition.inverted_file import build_inverted_file, count_votes
from solutions.place_recognition.scoring import idf_weights, l1_scores
from solutions.place_recognition.words import assign_words, descend_tree

__all__ = [
    "assign_words",
    "build_inverted_file",
    "count_votes",
    "descend_tree",
    "idf_weights",
    "l1_scores",
]
