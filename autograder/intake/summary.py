"""What a run says of what was handed in: whose, when, late or not, and what needs a person."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime

from autograder.intake.class_list import ClassList
from autograder.intake.file_or_zip import DiskPlace
from autograder.intake.layouts.layout import PassedOver
from autograder.intake.long_list import LongList
from autograder.intake.match_people import Match
from autograder.intake.origin import (
    CLASS_LIST,
    FILE,
    INSIDE,
    LAYOUT,
    TIMES_FILE,
    Origin,
    as_utc_text,
)
from autograder.intake.packed_time import hinted_time
from autograder.intake.person import Person
from autograder.intake.submission_times import doubt, snapshot
from autograder.intake.submissions import Submission
from autograder.language import _, n_

_NAMED = 8


@dataclass(frozen=True)
class Row:
    """One submission with its people, its time and what lateness costs.

    ``percent`` is what is taken off; nothing is while the times are in doubt.
    """

    submission: Submission
    match: Match
    days: int = 0
    percent: float = 0.0

    @property
    def origin(self) -> Origin:
        """Where it comes from, with the time that was decided on."""
        return self.submission.origin

    def lateness(self) -> tuple[str | None, int, float]:
        """As the gradebook keeps it."""
        return as_utc_text(self.origin.handed_in), self.days, self.percent


@dataclass
class Summary:
    """Everything that was handed in, and everything that was not taken in."""

    class_list: ClassList
    rows: Sequence[Row]
    passed_over: list[PassedOver] = field(default_factory=list)
    rules: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    unreadable: frozenset[str] = frozenset()
    missing: tuple[Person, ...] = ()

    @property
    def nobodys(self) -> list[Row]:
        """What belongs to nobody in the class list, where there is one."""
        return [row for row in self.rows if self.class_list.students and not row.match.people]

    @property
    def late(self) -> list[Row]:
        """What is late by the class list's due time, or by the word of the layout."""
        return [
            row for row in self.rows if row.days or (row.origin.called_late and not _timed(row))
        ]

    @property
    def needs_person(self) -> bool:
        """Whether somebody should look at it before grades go out."""
        passed_over = any(entry.needs_person for entry in self.passed_over)
        return bool(passed_over or self.unreadable or self.nobodys or self.warnings)

    def sentence(self) -> str:
        """The truth in one line."""
        parts = [
            _("{count} handed in").format(count=len(self.rows)),
            _("{count} unreadable").format(count=len(self.unreadable)),
        ]
        if self.class_list.students:
            count = len(self.nobodys)
            sentence = n_("{count} belongs to nobody", "{count} belong to nobody", count)
            parts.append(sentence.format(count=count))
        if self.class_list.late is not None or self.late:
            parts.append(_("{count} late").format(count=len(self.late)))
        if self.class_list.students:
            count = len(self.missing)
            sentence = n_(
                "{count} of the list handed in nothing",
                "{count} of the list handed in nothing",
                count,
            )
            parts.append(sentence.format(count=count))
        count = sum(entry.needs_person for entry in self.passed_over)
        if count:
            parts.append(_("{count} passed over").format(count=count))
        return ", ".join(parts)

    def remarks(self) -> list[str]:
        """What a person should read, a sentence each."""
        said = list(self.warnings)
        for row in self.nobodys[:_NAMED]:
            said.append(
                _(
                    "{student} belongs to nobody: {reason}. "
                    "In students.toml beside the class list: {line}"
                ).format(
                    student=row.submission.student, reason=row.match.reason, line=row.match.line
                )
            )
        if len(self.nobodys) > _NAMED:
            left = len(self.nobodys) - _NAMED
            more = n_(
                "{count} more belongs to nobody; see --json.",
                "{count} more belong to nobody; see --json.",
                left,
            )
            said.append(more.format(count=left))
        needed = [entry for entry in self.passed_over if entry.needs_person]
        passed = _("{path} was passed over: {reason}.")
        said += [passed.format(path=entry.place, reason=entry.reason) for entry in needed[:_NAMED]]
        if len(needed) > _NAMED:
            left = len(needed) - _NAMED
            more = n_(
                "{count} more was passed over; see --json.",
                "{count} more were passed over; see --json.",
                left,
            )
            said.append(more.format(count=left))
        return said

    def to_dict(self) -> dict[str, object]:
        """As plain data, for ``--json``."""
        return {
            "summary": self.sentence(),
            "handed_in": len(self.rows),
            "unreadable": len(self.unreadable),
            "belong_to_nobody": len(self.nobodys),
            "late": len(self.late),
            "handed_in_nothing": [person.name for person in self.missing],
            "needs_person": self.needs_person,
            "read_as": self.rules,
            "warnings": self.warnings,
            "submissions": [self._fields(row) for row in self.rows],
            "passed_over": [
                {"path": p.place, "reason": p.reason, "needs_person": p.needs_person}
                for p in self.passed_over
            ],
        }

    def _fields(self, row: Row) -> dict[str, object]:
        origin = row.origin
        people = [person_fields(person) for person in row.match.people]
        return {
            "student": row.submission.student,
            "person": people[0] if people else None,
            "people": people,
            "candidates": [person_fields(person) for person in row.match.candidates],
            "reason": row.match.reason if self.class_list.students else "",
            "settle": row.match.line if self.class_list.students else "",
            "layout": origin.layout,
            "attempt": origin.attempt,
            "handed_in": as_utc_text(origin.handed_in),
            "time_from": origin.time_from,
            "days_late": row.days,
            "percent_off": row.percent,
            "called_late": origin.called_late,
            "unreadable": row.submission.student in self.unreadable,
            "files": ["/".join((str(p.path), *p.inside)) for p in row.submission.pieces],
            "notes": list(row.submission.notes),
        }


def person_fields(person: Person) -> dict[str, str]:
    """A person as plain data."""
    keys = ("name", "id", "sis_id", "login", "email", "section", "github", "number")
    return {key: getattr(person, key) for key in keys}


def summarise(
    submissions: Sequence[Submission],
    class_list: ClassList,
    times: Mapping[str, datetime] | None = None,
    trust_times: bool = False,
) -> Summary:
    """Whose each submission is and when it was handed in; `Summary.rows` has the times.

    ``times`` is what a ``times.csv`` says; with ``trust_times`` the times of files count where
    nothing better is known, and penalties are taken whatever the times look like.
    """
    matches = {}
    if class_list.students:  # whose one is depends on whose the others may be
        matches = class_list.match_all({entry.student: entry.origin for entry in submissions})
    rows: LongList[Row] = LongList(Row)
    called: set[str] = set()
    for submission in submissions:
        key = submission.student
        match = matches.get(key) or class_list.match_all({key: submission.origin})[key]
        origin = _timed_origin(submission, match, times or {}, trust_times)
        called |= {name.casefold() for name in _called(submission, match)}
        days = 0
        if origin.handed_in is not None:
            days = class_list.days_late(origin.handed_in, match.people)
        percent = class_list.late.percent(days) if class_list.late else 0.0
        rows.append(Row(replace(submission, origin=origin), match, days, percent))
    summary = Summary(class_list, rows)
    found = {person for row in rows for person in row.match.people}
    summary.missing = tuple(person for person in class_list.students if person not in found)
    called |= {
        name.casefold()
        for person in summary.missing
        for name in (*person.identifiers(), person.name)
    }
    strange = sorted(set(times or {}) - called)
    if strange:
        more = f" and {len(strange) - 5} more" if len(strange) > 5 else ""
        summary.warnings.append(
            f"The table of times names {', '.join(strange[:5])}{more}, from whom nothing was "
            "handed in. Correct the names there, or take the lines out."
        )
    _look_at_times(summary, trust_times)
    return summary


def _look_at_times(summary: Summary, trust_times: bool) -> None:
    """Say what is odd about the times, and take nothing off for what is not sure."""
    if summary.class_list.late is None:
        return
    # What a person wrote into the class list, or said to trust, is not doubted.
    watched = [row for row in summary.rows if _timed(row) and row.origin.time_from != CLASS_LIST]
    doubted = doubt([(row.origin.handed_in, bool(row.days)) for row in watched if _timed(row)])  # type: ignore[misc]
    if doubted and not trust_times:
        summary.warnings.append(doubted.sentence)
    hints = [row for row in watched if row.origin.time_from == INSIDE and row.days]
    if hints and not trust_times:
        summary.warnings.append(
            f"{_some(hints)} may be late, but only the submission itself says when, which students "
            "can change; no penalty is taken. Give --times FILE, or --trust-times."
        )
    if not trust_times:
        withheld = watched if doubted else hints
        students = {row.submission.student for row in withheld}
        withheld_rows = (
            replace(row, percent=0.0) if row.submission.student in students else row
            for row in summary.rows
        )
        summary.rows = LongList(Row, withheld_rows)
    marked = [row for row in summary.rows if row.origin.called_late and not _timed(row)]
    if marked:
        summary.warnings.append(
            f"{_some(marked)}: the download calls this late and does not say when it was handed "
            "in, so no penalty is taken. Give --times FILE."
        )
    unknown = [row for row in summary.rows if not _timed(row) and not row.origin.called_late]
    if unknown:
        summary.warnings.append(
            f"Nothing says when {_some(unknown)} handed in, so nothing is late there. Give --times "
            "FILE, or --trust-times to take the times of the files."
        )


def _some(rows: Sequence[Row]) -> str:
    names = [row.submission.student for row in rows[:4]]
    more = f" and {len(rows) - 4} more" if len(rows) > 4 else ""
    return ", ".join(names) + more


def _timed(row: Row) -> bool:
    return row.origin.handed_in is not None


def _timed_origin(
    submission: Submission,
    match: Match,
    times: Mapping[str, datetime],
    trust_times: bool,
) -> Origin:
    """The origin with the first time that is known, in the order that the times module gives."""
    origin = submission.origin
    for person in match.people:
        if person.handed_in is not None:
            return origin.at(person.handed_in, CLASS_LIST)
    if origin.time_from == LAYOUT:
        return origin
    for person in match.people:
        if person.noted_time is not None:
            return origin.at(person.noted_time, LAYOUT)
    for name in _called(submission, match):
        if name.casefold() in times:
            return origin.at(times[name.casefold()], TIMES_FILE)
    if origin.time_from == TIMES_FILE and not times:
        return origin  # as an earlier run was told
    if origin.time_from == INSIDE:
        return origin
    hint = hinted_time(submission.pieces)
    if hint is not None:
        return origin.at(hint, INSIDE)
    if trust_times:
        return origin.at(_file_time(submission), FILE)
    return origin.at(None, "")


def _called(submission: Submission, match: Match) -> list[str]:
    """Everything that a row of times.csv may call a submission."""
    names = [submission.student, submission.origin.prefix]
    for piece in submission.pieces:
        names += [piece.name, piece.name.rpartition(".")[0]]
    for claim in submission.origin.claims:
        names += [claim.login, claim.email, claim.id, claim.number, claim.called]
    for person in match.people:
        names += [*person.identifiers(), person.number]
    if match.people:
        names.append(match.people[0].name)
    return [name for name in dict.fromkeys(names) if name]


def _file_time(submission: Submission) -> datetime | None:
    """The newest file of a submission; a zip's entries have no zone, so the zip's own time."""
    seen = snapshot([piece.path for piece in submission.pieces])
    times = [DiskPlace(path).time for path in seen]
    return max((time for time in times if time is not None), default=None)
