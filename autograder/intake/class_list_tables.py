"""What an instructor writes in a class list: the tables of the TOML file, field by field."""

from __future__ import annotations

import tomllib
from datetime import datetime
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from autograder.errors import CourseError
from autograder.questions.author_tables import Text, Written

NotNegative = Annotated[float, Meta(ge=0)]
Percent = Annotated[float, Meta(ge=0, le=100)]
Number = str | int  # a number or a name of another system, with quotes or without


class WrittenAssignment(Written, frozen=True, kw_only=True):
    """What the assignment is called."""

    title: Annotated[str, Meta(description="the column's name in Canvas and Moodle")] = "Autograder"
    canvas_id: Annotated[Number, Meta(description="the number in the assignment's address")] = ""


class WrittenLate(Written, frozen=True, kw_only=True):
    """What lateness costs."""

    due: datetime
    zone: Annotated[str, Meta(description='such as "Europe/Zurich"')] = ""
    grace_minutes: NotNegative = 0.0
    percent_a_day: Annotated[Percent, Meta(description="of the points earned")] = 0.0
    most_percent: Percent = 100.0


class WrittenStudent(Written, frozen=True, kw_only=True):
    """One student of the class; see `autograder.intake.person.Person`."""

    name: Text
    id: Annotated[Number, Meta(description="the learning system's own number")] = ""
    sis_id: Annotated[Number, Meta(description="the university's number")] = ""
    login: Number = ""
    email: str = ""
    section: Number = ""
    submission: Annotated[
        Number, Meta(description="what the file is called, if it is called none of these")
    ] = ""
    extension_days: NotNegative = 0.0
    handed_in: Annotated[
        datetime | None, Meta(description="only if the file's own time is wrong")
    ] = None
    github: Number = ""
    number: Annotated[Number, Meta(description="Moodle's participant number")] = ""


class WrittenClass(Written, frozen=True, kw_only=True):
    """The whole file."""

    assignment: WrittenAssignment = WrittenAssignment()
    late: WrittenLate | None = None
    student: tuple[WrittenStudent, ...] = ()


def parse_toml(text: str, path: Path) -> dict[str, object]:
    """The tables in the text of a file.

    Raises:
        CourseError: if it is no TOML.
    """
    try:
        return tomllib.loads(text.replace("\r\n", "\n"))
    except tomllib.TOMLDecodeError as error:
        raise CourseError(f"{path} cannot be read: {error}.") from None
