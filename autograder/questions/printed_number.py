"""How a number of a variant is printed in a text, and written into a key."""

from __future__ import annotations

from autograder.errors import CourseError

_WHOLE, _OTHER = "d", ".10g"  # the formats where an author gives none
_WRITTEN = ".9g"  # the last bits of a value are those of one order of operations


def printed(value: int | float, form: str, placeholder: str) -> str:
    """A number in the format that an author gave, "" for the usual one.

    Raises:
        CourseError: if it cannot have that format; the sentence begins with the ``placeholder``.
    """
    try:
        return format(value, form or (_WHOLE if isinstance(value, int) else _OTHER))
    except ValueError:
        raise CourseError(f"{placeholder} has a format that a number cannot have.") from None


def as_written_down(value: int | float) -> int | float:
    """A value of a formula as an author would write it down."""
    return value if isinstance(value, int) else float(f"{value:{_WRITTEN}}")
