"""The course on disk: its chapters and questions, its key and its settings, read and validated."""

from autograder.course.course import (
    ANSWERS,
    DEMO,
    QUESTIONS,
    Chapter,
    Course,
    find_course_root,
    load_course,
)
from autograder.course.settings import Settings

__all__ = [
    "ANSWERS",
    "DEMO",
    "QUESTIONS",
    "Chapter",
    "Course",
    "Settings",
    "find_course_root",
    "load_course",
]
