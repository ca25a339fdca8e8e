"""Students somebody should look after, and why."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from autograder.course import Course
from autograder.gradebook.record import Record
from autograder.language import N_, _
from autograder.questions.registry import kind_of
from autograder.reports.json_output import most_for


@dataclass(frozen=True)
class Needy:
    """A student somebody should look after, and why.

    ``chapters`` are those in which less than half was earned, by title, and ``mistakes`` the known
    ones, as question and name.
    """

    student: str
    total: float
    reasons: tuple[str, ...]
    section: str = ""
    chapters: tuple[str, ...] = ()
    mistakes: tuple[tuple[str, str], ...] = ()


def who_needs_help(course: Course, records: Iterable[Record]) -> list[Needy]:
    """Students with less than half of the points, or whose work could not be run; lowest first."""
    needy = [found for record in records if (found := needs_help(course, record))]
    return sorted(needy, key=lambda entry: (entry.total, entry.student))


def needs_help(course: Course, record: Record) -> Needy | None:
    """Why somebody should look after a student, or None."""
    most = most_for(course, record)
    statuses = Counter(mark.status for mark in record.graded.marks)
    reasons = []
    if record.graded.status == "unreadable":
        reasons.append(_("the submission could not be opened; ask for it again"))
    elif record.total < (most - _waiting(course, record, most)) / 2:
        reasons.append(_("less than half of the points"))
    if record.graded.status != "unreadable":
        open_ones = statuses["not attempted"]
        if open_ones >= len(course.questions) / 2:
            sentence = _("{count} of {all} questions not attempted")
            reasons.append(sentence.format(count=open_ones, all=len(course.questions)))
        for status, words in (
            ("error", N_("{count} questions ended with an exception")),
            ("timeout", N_("{count} questions ended at the time limit")),
            ("killed", N_("{count} questions ended with a crash")),
        ):
            if statuses[status] >= 2:
                reasons.append(_(words).format(count=statuses[status]))
    if not reasons:
        return None
    return Needy(
        record.student,
        record.total,
        tuple(reasons),
        section_of(record),
        _weak_chapters(course, record),
        _known_mistakes(course, record),
    )


def section_of(record: Record) -> str:
    """The section of a student, "" if none is known; of a group, all of theirs."""
    return ", ".join(dict.fromkeys(p.section for p in record.people if p.section))


def _waiting(course: Course, record: Record, most: float) -> float:
    """The part of ``most`` that waits for a person: nobody has earned it, or missed it, yet."""
    whole = sum(question.points for question in course.questions.values())
    open_ones = sum(course.questions[id].points for id in record.open if id in course.questions)
    return most * open_ones / whole if whole else 0.0


def _weak_chapters(course: Course, record: Record) -> tuple[str, ...]:
    weak = []
    waiting, scheme = set(record.open), record.scheme
    for chapter in course.chapters:
        counted = [
            question
            for question in chapter.questions
            if question.id not in waiting and (scheme is None or scheme.counts(question.id, record))
        ]
        possible = sum(question.points for question in counted)
        earned = sum(record.points(question.id) or 0.0 for question in counted)
        if possible and earned < possible / 2:
            weak.append(chapter.title)
    return tuple(weak)


def _known_mistakes(course: Course, record: Record) -> tuple[tuple[str, str], ...]:
    marks = record.marks
    return tuple(
        (question.id, name)
        for question in course.questions.values()
        if (mark := marks.get(question.id)) and mark.status in ("wrong", "partial")
        for name in kind_of(question).known_mistakes(
            question, mark, course.entries_of(question.id, record.graded.numbers_of)
        )
    )
