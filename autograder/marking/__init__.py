"""Marking: a response and the answer to a question make a mark. Pure functions, one kind a file."""

from autograder.marking.mark import STATUSES, Mark, Part, not_attempted, stopped
from autograder.marking.mark_response import mark_response

__all__ = ["STATUSES", "Mark", "Part", "mark_response", "not_attempted", "stopped"]
