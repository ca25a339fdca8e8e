"""The course on disk: its chapters and questions, its key and its settings, read and validated."""

from autograder.course.course import DEMO, Chapter, Course
from autograder.course.read_course import find_course_root, load_course
from autograder.course.settings import Settings

__all__ = [
    "DEMO",
    "Chapter",
    "Course",
    "Settings",
    "find_course_root",
    "load_course",
]
