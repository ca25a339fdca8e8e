"""Place recognition with a vocabulary tree, one concept a file.

As the course explains it: `words`, `inverted_file`, `scoring`. For many images: `k_means`,
`vocabulary_tree`, `postings`, `index`, `database`. What comes before and after: `features`
and `verification`.
"""

from solutions.place_recognition.database import Candidate, ImageDatabase
from solutions.place_recognition.index import InvertedIndex
from solutions.place_recognition.inverted_file import build_inverted_file, count_votes
from solutions.place_recognition.k_means import k_means
from solutions.place_recognition.scoring import idf_weights, l1_scores
from solutions.place_recognition.vocabulary_tree import VocabularyTree
from solutions.place_recognition.words import assign_words, descend_tree

__all__ = [
    "Candidate",
    "ImageDatabase",
    "InvertedIndex",
    "VocabularyTree",
    "assign_words",
    "build_inverted_file",
    "count_votes",
    "descend_tree",
    "idf_weights",
    "k_means",
    "l1_scores",
]
