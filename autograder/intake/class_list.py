"""The class list and the late policy, from one small TOML file.

::

    [assignment]
    title = "Exercise 3"          # the column's name in Canvas and Moodle
    canvas_id = 4711              # optional: the number in the assignment's address

    [late]
    due = 2026-11-20T23:59:00
    zone = "Europe/Zurich"
    grace_minutes = 15            # later than that, every begun day since the due time counts
    percent_a_day = 10            # of the points earned
    most_percent = 50

    [[student]]
    name = "Ada Lovelace"
    id = "98765"                  # the learning system's own number
    sis_id = "S-1815"
    login = "ada"
    email = "ada@example.org"
    section = "Tuesday"
    submission = "ada_final"      # only if the file is called none of the above
    extension_days = 3
    handed_in = 2026-11-21T08:00:00   # only if the file's own time is wrong

A submission belongs to the student whose ``submission``, ``login``, ``email``, ``id``, ``sis_id``
or ``name`` it is called, or whose number or name stands where Canvas and Moodle put it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime, timedelta, tzinfo
from pathlib import Path
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from autograder.intake.class_list_tables import (
    WrittenClass,
    WrittenLate,
    WrittenStudent,
    parse_toml,
)
from autograder.intake.join_people import join_people
from autograder.intake.lateness import LatePolicy
from autograder.intake.match_people import Match, match_all
from autograder.intake.origin import Origin, as_utc_text
from autograder.intake.person import Person
from autograder.intake.roster_exports import read_people
from autograder.intake.spreadsheets import read_text
from autograder.intake.students_toml import read_settled
from autograder.questions import toml_lines
from autograder.questions.strict_reader import Place, read_table


@dataclass(frozen=True)
class ClassList:
    """Who is in the class, what the assignment is called, and what lateness costs."""

    students: tuple[Person, ...] = ()
    title: str = "Autograder"
    canvas_id: str = ""
    late: LatePolicy | None = None
    settled: Mapping[str, str] = field(default_factory=dict)

    @property
    def zone(self) -> tzinfo | None:
        """The zone of times that name none: that of the due time."""
        return None if self.late is None else self.late.due.tzinfo

    def match_all(self, origins: Mapping[str, Origin]) -> dict[str, Match]:
        """Whose each submission is, by the student's key; see `autograder.intake.match_people`."""
        return match_all(self.students, origins, self.settled)

    def find(self, submission: str) -> Person | None:
        """The student to whom a submission of this name belongs, if that is certain."""
        return self.match_all({submission: Origin()})[submission].person

    def days_late(self, handed_in: datetime, people: Sequence[Person]) -> int:
        """The days late, with the longest extension among those who handed in together."""
        if self.late is None:
            return 0
        extension = max((person.extension_days for person in people), default=0.0)
        return self.late.days_late(handed_in, extension)

    def lateness(self, submission: str, found: datetime | None) -> tuple[str | None, int, float]:
        """When it was handed in (UTC), the days late, and the percent they cost.

        ``found`` is the time of the file; a time in the class list goes before.
        """
        student = self.find(submission) or Person(submission)
        handed_in = student.handed_in or found
        if handed_in is None:
            return None, 0, 0.0
        days = self.days_late(handed_in, [student])
        percent = self.late.percent(days) if self.late else 0.0
        return as_utc_text(handed_in), days, percent


def read_class_list(path: Path) -> ClassList:
    """Read the file.

    Raises:
        CourseError: if it cannot be read or says something unclear; the sentence names the place.
    """
    text = read_text(path)
    if path.suffix.lower() != ".toml" and not text.lstrip().startswith("["):
        return ClassList(read_people(text, path, None))
    place = Place(str(path), text)
    written = read_table(parse_toml(text, path), WrittenClass, place)
    zone = _zone(written.late, place)
    return ClassList(
        _students(written.student, zone, place),
        written.assignment.title,
        str(written.assignment.canvas_id),
        None if written.late is None else _policy(written.late, zone, place),
    )


def read_class_lists(paths: Sequence[Path], settled: Path | None = None) -> ClassList:
    """Several lists as one: each person once, title and late policy from the one that has them.

    ``settled`` is ``students.toml``, if there is one: the lines that say whose a submission is.

    Raises:
        CourseError: as `read_class_list`.
    """
    tables = [path for path in paths if path.suffix.lower() == ".toml"]
    lists = [read_class_list(path) for path in tables]
    base = next((found for found in lists if found.late), lists[0] if lists else ClassList())
    zone = base.zone
    for path in paths:
        if path not in tables:
            text = read_text(path)
            if text.lstrip().startswith("["):
                lists.append(read_class_list(path))
            else:
                lists.append(ClassList(read_people(text, path, zone)))
    base = next((found for found in lists if found.late), base)
    titled = next((found for found in lists if found.title != "Autograder"), base)
    return replace(
        base,
        students=join_people([found.students for found in lists]),
        title=titled.title,
        canvas_id=titled.canvas_id,
        settled=read_settled(settled) if settled is not None else {},
    )


def _policy(late: WrittenLate, zone: tzinfo | None, place: Place) -> LatePolicy:
    return LatePolicy(
        _in_zone(late.due, zone, place, ("late", "due")),
        timedelta(minutes=late.grace_minutes),
        late.percent_a_day,
        late.most_percent,
    )


def _students(
    entries: Sequence[WrittenStudent], zone: tzinfo | None, place: Place
) -> tuple[Person, ...]:
    students = []
    taken: dict[str, str] = {}
    for position, entry in enumerate(entries):
        handed_in = entry.handed_in
        if handed_in is not None:
            at = ("student", position, "handed_in")
            handed_in = _in_zone(handed_in, zone, place, at)
        student = Person(
            entry.name,
            id=_text(entry.id),
            sis_id=_text(entry.sis_id),
            login=_text(entry.login),
            email=entry.email,
            section=_text(entry.section),
            submission=_text(entry.submission),
            extension_days=entry.extension_days,
            handed_in=handed_in,
            github=_text(entry.github),
            number=_text(entry.number),
        )
        for key in ("submission", "login", "email", "id", "sis_id"):
            called = getattr(student, key).casefold()
            if called and taken.setdefault(called, student.name) != student.name:
                raise place.error(
                    f"{student.name} and {taken[called]} share {called!r}; "
                    "so a submission under it could be either's",
                    ("student", position, key),
                )
        students.append(student)
    return tuple(students)


def _text(value: str | int) -> str:
    return str(value).strip()


def _zone(late: WrittenLate | None, place: Place) -> tzinfo | None:
    if late is None or not late.zone:
        return None
    try:
        return ZoneInfo(late.zone)
    except (ZoneInfoNotFoundError, ValueError, OSError):
        raise place.error(
            f"{late.zone!r} is not a known time zone; write one such as "
            '"Europe/Zurich" (on Windows, `pip install tzdata` first)',
            ("late", "zone"),
        ) from None


def _in_zone(time: datetime, zone: tzinfo | None, place: Place, at: toml_lines.Path) -> datetime:
    if time.tzinfo is not None:
        return time
    if zone is None:
        raise place.error(f'{at[-1]} has no time zone; add zone = "Europe/Zurich" to [late]', at)
    return time.replace(tzinfo=zone)
