"""Marking: a response and the answer to a question make a mark. Pure functions."""

from autograder.questions.mark import STATUSES, Mark, Part, not_attempted, stopped

__all__ = ["STATUSES", "Mark", "Part", "not_attempted", "stopped"]
