"""Place recognition with a vocabulary tree, one concept a file.

As the course explains it: `words`, `inverted_file`, `scoring`. For many images: `k_means`,
`vocabulary_tree`, `postings`, `index`, `database`. Before it come `features`, after it
`verification` with the `fundamental_matrix`.
"""

from solutions.place_recognition.fast.database import Candidate, ImageDatabase
from solutions.place_recognition.fast.index import InvertedIndex
from solutions.place_recognition.fast.vocabulary_tree import VocabularyTree
from solutions.place_recognition.features import Features, extract_features
from solutions.place_recognition.fundamental_matrix import Epipolar, ransac_fundamental
from solutions.place_recognition.inverted_file import build_inverted_file, count_votes
from solutions.place_recognition.k_means import k_means
from solutions.place_recognition.scoring import idf_weights, l1_scores
from solutions.place_recognition.verification import (
    Verified,
    match_features,
    verify_candidates,
)
from solutions.place_recognition.words import assign_words, descend_tree

__all__ = [
    "Candidate",
    "Epipolar",
    "Features",
    "ImageDatabase",
    "InvertedIndex",
    "Verified",
    "VocabularyTree",
    "assign_words",
    "build_inverted_file",
    "count_votes",
    "descend_tree",
    "extract_features",
    "idf_weights",
    "k_means",
    "l1_scores",
    "match_features",
    "ransac_fundamental",
    "verify_candidates",
]
