"""Feedback on its way back to students: packed as each learning system wants it."""

from autograder.reports.returning.canvas import canvas_files
from autograder.reports.returning.mail import messages
from autograder.reports.returning.moodle import moodle_files
from autograder.reports.returning.parcel import Left, Page, Parcel
from autograder.reports.returning.plain import plain_files

__all__ = ["Left", "Page", "Parcel", "canvas_files", "messages", "moodle_files", "plain_files"]
