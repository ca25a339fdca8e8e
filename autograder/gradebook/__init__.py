"""The gradebook: one SQLite file with runs, submissions, marks, overrides and notes."""

from autograder.gradebook.book import Gradebook, Run
from autograder.gradebook.record import Note, Override, Record
from autograder.gradebook.schema import SCHEMA_VERSION, GradebookError

__all__ = ["SCHEMA_VERSION", "Gradebook", "GradebookError", "Note", "Override", "Record", "Run"]
