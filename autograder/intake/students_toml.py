"""``students.toml``: lines by which a person settles whose a submission is."""

from __future__ import annotations

from pathlib import Path

from autograder.errors import CourseError
from autograder.exchange.printable import printable
from autograder.intake.class_list_tables import (
    parse_toml,
)
from autograder.intake.spreadsheets import read_text

NOBODY = "nobody"  # this submission is not to be graded for anybody


def read_settled(path: Path) -> dict[str, str]:
    """The lines of ``students.toml``: a submission's name and whose it is.

    Raises:
        CourseError: if it says anything else.
    """
    settled = {}
    for name, value in parse_toml(read_text(path), path).items():
        if not isinstance(value, str | int):
            raise CourseError(
                f'{path}: write each line as "the submission\'s name" = "login or e-mail".'
            )
        settled[name] = str(value)
    return settled


def quoted(text: str) -> str:
    """A TOML string."""
    plain = printable(text, "?")
    return '"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"'
