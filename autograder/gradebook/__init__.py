"""The gradebook: one SQLite file with runs, submissions, marks, overrides and notes."""

from autograder.gradebook.book import Gradebook
from autograder.gradebook.find_student import find_record
from autograder.gradebook.grading_scheme import Scheme
from autograder.gradebook.record import Attempt, Note, Override, Record
from autograder.gradebook.runs import Run
from autograder.gradebook.schema import SCHEMA_VERSION
from autograder.gradebook.unusable_gradebook import GradebookError
from autograder.gradebook.view import ClassView, view_class

__all__ = [
    "SCHEMA_VERSION",
    "Attempt",
    "ClassView",
    "Gradebook",
    "GradebookError",
    "Note",
    "Override",
    "Record",
    "Run",
    "Scheme",
    "find_record",
    "view_class",
]
