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

import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from datetime import UTC, datetime, timedelta, tzinfo
from pathlib import Path
from typing import Any
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from autograder.errors import CourseError
from autograder.intake.matching import Match, match_all
from autograder.intake.origin import Origin, as_utc_text
from autograder.intake.people import join_people, read_people
from autograder.intake.person import Person
from autograder.intake.tables import read_text


@dataclass(frozen=True)
class LatePolicy:
    """What lateness costs; all times know their zone."""

    due: datetime
    grace: timedelta
    percent_a_day: float
    most_percent: float

    def days_late(self, handed_in: datetime, extension_days: float = 0.0) -> int:
        """The days that have begun since the due time; none within the grace."""
        # In the zone's own clock: three days later is the same hour, also when summer time ends.
        due = (self.due + timedelta(days=extension_days)).astimezone(UTC)
        late = handed_in.astimezone(UTC) - due
        return 0 if late <= self.grace else math.ceil(late / timedelta(days=1))

    def percent(self, days: int) -> float:
        """What that many days cost, in percent of the points earned."""
        return min(self.most_percent, days * self.percent_a_day)


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
        """Whose each submission is, by the student's key; see `autograder.intake.matching`."""
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
    tables = _toml(text, path)
    _only(tables, {"assignment", "late", "student"}, str(path))
    assignment = _table(tables, "assignment", path)
    _only(assignment, {"title", "canvas_id"}, f"[assignment] in {path}")
    late = _table(tables, "late", path)
    zone = _zone(late, path)
    return ClassList(
        _students(tables.get("student", []), zone, path),
        str(assignment.get("title", "Autograder")),
        str(assignment.get("canvas_id", "")),
        _policy(late, zone, path) if late else None,
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


def read_settled(path: Path) -> dict[str, str]:
    """The lines of ``students.toml``: a submission's name and whose it is.

    Raises:
        CourseError: if it says anything else.
    """
    settled = {}
    for name, value in _toml(read_text(path), path).items():
        if not isinstance(value, str | int):
            raise CourseError(
                f'{path}: write each line as "the submission\'s name" = "login or e-mail".'
            )
        settled[name] = str(value)
    return settled


def _toml(text: str, path: Path) -> dict[str, object]:
    try:
        return tomllib.loads(text.replace("\r\n", "\n"))
    except tomllib.TOMLDecodeError as error:
        raise CourseError(f"{path} cannot be read: {error}.") from None


def _policy(late: dict[str, object], zone: tzinfo | None, path: Path) -> LatePolicy:
    known = {"due", "zone", "grace_minutes", "percent_a_day", "most_percent"}
    _only(late, known, f"[late] in {path}")
    if "due" not in late:
        raise CourseError(f"[late] in {path} has no `due`; write due = 2026-11-20T23:59:00.")
    grace = _number(late, "grace_minutes", 0, path)
    return LatePolicy(
        _time(late["due"], zone, f"due in [late] of {path}"),
        timedelta(minutes=grace),
        _number(late, "percent_a_day", 0, path, 100),
        _number(late, "most_percent", 100, path, 100),
    )


def _students(entries: Any, zone: tzinfo | None, path: Path) -> tuple[Person, ...]:
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise CourseError(f"{path}: write each student as a [[student]] table.")
    known = {known.name for known in fields(Person)} - {"noted_time"}
    students = []
    taken: dict[str, str] = {}
    for entry in entries:
        where = f"the student {entry.get('name', '?')!r} in {path}"
        _only(entry, known, where)
        if not str(entry.get("name", "")).strip():
            raise CourseError(f"A student in {path} has no name.")
        values: dict[str, Any] = {
            key: str(value).strip()
            for key, value in entry.items()
            if key not in ("extension_days", "handed_in")
        }
        values["extension_days"] = _number(entry, "extension_days", 0, path)
        if "handed_in" in entry:
            values["handed_in"] = _time(entry["handed_in"], zone, f"handed_in of {where}")
        student = Person(**values)
        for key in ("submission", "login", "email", "id", "sis_id"):
            called = getattr(student, key).casefold()
            if called and taken.setdefault(called, student.name) != student.name:
                raise CourseError(
                    f"{student.name} and {taken[called]} in {path} share {called!r}; "
                    "so a submission under it could be either's."
                )
        students.append(student)
    return tuple(students)


def _zone(late: dict[str, object], path: Path) -> tzinfo | None:
    if "zone" not in late:
        return None
    try:
        return ZoneInfo(str(late["zone"]))
    except (ZoneInfoNotFoundError, ValueError, OSError):
        raise CourseError(
            f"{late['zone']!r} in {path} is not a known time zone; write one such as "
            '"Europe/Zurich" (on Windows, `pip install tzdata` first).'
        ) from None


def _time(value: object, zone: tzinfo | None, where: str) -> datetime:
    if not isinstance(value, datetime):
        raise CourseError(f"{where} is not a date and time; write 2026-11-20T23:59:00.")
    if value.tzinfo is not None:
        return value
    if zone is None:
        raise CourseError(f'{where} has no time zone; add zone = "Europe/Zurich" to [late].')
    return value.replace(tzinfo=zone)


def _number(
    table: dict[str, object], key: str, default: float, path: Path, most: float = math.inf
) -> float:
    value = table.get(key, default)
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value <= most:
        limit = "" if math.isinf(most) else f" to {most:g}"
        raise CourseError(f"{key} = {value!r} in {path} must be a number from 0{limit}.")
    return float(value)


def _table(tables: dict[str, object], name: str, path: Path) -> dict[str, object]:
    table = tables.get(name, {})
    if not isinstance(table, dict):
        raise CourseError(f"{path}: [{name}] must be a table.")
    return table


def _only(table: dict[str, object], known: set[str], where: str) -> None:
    for key in sorted(table.keys() - known):
        raise CourseError(f"{where} has an unknown entry {key!r}; known are {sorted(known)}.")
