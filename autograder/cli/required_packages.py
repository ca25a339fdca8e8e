"""The packages that a course allows must be there before anything is marked."""

from __future__ import annotations

from importlib.util import find_spec

from autograder.course import Course
from autograder.errors import CourseError


def require_packages(course: Course) -> None:
    """Refuse to mark where what the course allows is not there: nobody's import may fail for it."""
    missing = [name for name in course.settings.packages if not find_spec(name.partition(".")[0])]
    if missing:
        raise CourseError(
            f"The course allows {', '.join(missing)} (packages in [tool.autograder]), and this "
            f"Python has no such module; install what provides it, then grade."
        )
