"""What a run says of what was handed in: whose, when, late or not, and what needs a person."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from autograder.intake.class_list import ClassList
from autograder.intake.layouts.layout import PassedOver
from autograder.intake.match_people import Match
from autograder.intake.origin import (
    INSIDE,
    Origin,
    as_utc_text,
)
from autograder.intake.person import Person
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

    @property
    def only_called_late(self) -> bool:
        """Whether the layout calls it late, and no time that students cannot change says more."""
        if self.days or not self.origin.called_late:
            return False
        return not has_time(self) or self.origin.time_from == INSIDE

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
        return [row for row in self.rows if row.days or row.only_called_late]

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


def has_time(row: Row) -> bool:
    """Whether it is known when it was handed in."""
    return row.origin.handed_in is not None
