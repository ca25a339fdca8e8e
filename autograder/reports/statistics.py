"""What a class's marks say about its questions and its students. Pure functions of the records."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from autograder.course import Course
from autograder.course.questions import Question
from autograder.gradebook.record import Record
from autograder.kinds.registry import kind_of
from autograder.marking import Mark
from autograder.reports.machine import most_for

FEWEST = 10  # below that, a correlation is chance
LOW_DISCRIMINATION = 0.15
STOPPED = ("error", "timeout", "killed", "unreadable")


@dataclass(frozen=True)
class QuestionStatistics:
    """One question over the class.

    ``difficulty`` is the mean share of its points among those who attempted it (1: everybody has
    all); ``discrimination`` the correlation of a student's points for it with those for all other
    questions, over the whole class. Both are None where they are not defined.
    """

    question: Question
    statuses: Counter[str]
    attempted: int
    difficulty: float | None
    discrimination: float | None
    unnamed: int  # wrong or partly right, and like no known mistake
    troubles: tuple[str, ...]


@dataclass(frozen=True)
class Mistake:
    """A mistake, and who made it; if the key does not name it, it is told by where it fails."""

    question: str
    name: str
    named: bool
    students: tuple[str, ...]


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


def question_statistics(course: Course, records: Sequence[Record]) -> list[QuestionStatistics]:
    """Statistics of every question; submissions that could not be opened are left out."""
    opened = [record for record in records if record.graded.status != "unreadable"]
    points = np.array(
        [[record.points(id) or 0.0 for id in course.questions] for record in opened]
    ).reshape(len(opened), len(course.questions))
    found = []
    for column, question in enumerate(course.questions.values()):
        marks = [record.marks[question.id] for record in opened if question.id in record.marks]
        statuses = Counter(mark.status for mark in marks)
        tried = np.array(
            [
                question.id in record.overrides
                or (
                    question.id in record.marks
                    and record.marks[question.id].status != "not attempted"
                )
                for record in opened
            ],
            dtype=bool,
        )
        difficulty = (
            float(points[tried, column].mean() / question.points)
            if tried.any() and question.points
            else None
        )
        rest = points.sum(axis=1) - points[:, column]
        discrimination = correlation(points[:, column], rest)
        unnamed = sum(_is_unnamed(question, mark) for mark in marks)
        found.append(
            QuestionStatistics(
                question,
                statuses,
                int(tried.sum()),
                difficulty,
                discrimination,
                unnamed,
                tuple(_troubles(statuses, int(tried.sum()), difficulty, discrimination, unnamed)),
            )
        )
    return found


def correlation(a: np.ndarray, b: np.ndarray) -> float | None:
    """Pearson's correlation; None for few values or none that vary."""
    if len(a) < FEWEST or np.ptp(a) == 0 or np.ptp(b) == 0:
        return None
    return float(np.corrcoef(a, b)[0, 1])


def _is_unnamed(question: Question, mark: Mark) -> bool:
    wrong = mark.status in ("wrong", "partial")
    return wrong and mark.alternative is None and not kind_of(question).parts_stand_alone


def _troubles(
    statuses: Counter[str],
    attempted: int,
    difficulty: float | None,
    discrimination: float | None,
    unnamed: int,
) -> list[str]:
    """Why a question looks broken, in sentences."""
    if attempted < FEWEST or difficulty is None:
        return []
    troubles = []
    if discrimination is not None and discrimination < 0:
        troubles.append(
            "Students who do well elsewhere do badly here: check the key and the wording."
        )
    elif discrimination is not None and discrimination < LOW_DISCRIMINATION:
        troubles.append("Doing well here says little about doing well elsewhere: is it ambiguous?")
    if difficulty == 0:
        troubles.append("Nobody earned a point: check the key.")
    elif difficulty < 0.2:
        troubles.append("Very few points are earned: is something missing from the prompt?")
    stopped = sum(statuses[status] for status in STOPPED)
    if stopped >= 0.2 * attempted:
        troubles.append(
            f"{stopped} of {attempted} responses stopped with an exception or at a limit: "
            "is the stub clear, is the limit long enough?"
        )
    if unnamed >= 0.25 * attempted:
        troubles.append(
            f"{unnamed} of {attempted} responses are wrong in ways that no mistake in the key "
            "names: read some, and add the common ones."
        )
    return troubles


def common_mistakes(course: Course, records: Sequence[Record]) -> list[Mistake]:
    """Every mistake that somebody made, those with a name first, and of them the most common."""
    made: dict[tuple[str, str, bool], list[str]] = {}
    for record in records:
        for question in course.questions.values():
            mark = record.marks.get(question.id)
            if mark is None or mark.status not in ("wrong", "partial"):
                continue
            kind = kind_of(question)
            known = kind.known_mistakes(question, mark)
            for name in known or kind.other_mistakes(question, mark):
                made.setdefault((question.id, name, bool(known)), []).append(record.student)
    mistakes = [Mistake(*mistake, tuple(students)) for mistake, students in made.items()]
    order = {id: position for position, id in enumerate(course.questions)}
    return sorted(
        mistakes, key=lambda m: (not m.named, -len(m.students), order[m.question], m.name)
    )


def who_needs_help(course: Course, records: Sequence[Record]) -> list[Needy]:
    """Students with less than half of the points, or whose work could not be run; lowest first."""
    needy = []
    for record in records:
        most = most_for(course, record)
        statuses = Counter(mark.status for mark in record.graded.marks)
        reasons = []
        if record.graded.status == "unreadable":
            reasons.append("the submission could not be opened; ask for it again")
        elif record.total < most / 2:
            reasons.append("less than half of the points")
        if record.graded.status != "unreadable":
            open_ones = statuses["not attempted"]
            if open_ones >= len(course.questions) / 2:
                reasons.append(f"{open_ones} of {len(course.questions)} questions not attempted")
            for status, words in (
                ("error", "with an exception"),
                ("timeout", "at the time limit"),
                ("killed", "with a crash"),
            ):
                if statuses[status] >= 2:
                    reasons.append(f"{statuses[status]} questions ended {words}")
        if reasons:
            needy.append(
                Needy(
                    record.student,
                    record.total,
                    tuple(reasons),
                    section_of(record),
                    _weak_chapters(course, record),
                    _known_mistakes(course, record),
                )
            )
    return sorted(needy, key=lambda entry: (entry.total, entry.student))


def section_of(record: Record) -> str:
    """The section of a student, "" if none is known; of a group, all of theirs."""
    return ", ".join(dict.fromkeys(p.section for p in record.people if p.section))


def _weak_chapters(course: Course, record: Record) -> tuple[str, ...]:
    weak = []
    for chapter in course.chapters:
        possible = sum(question.points for question in chapter.questions)
        earned = sum(record.points(question.id) or 0.0 for question in chapter.questions)
        if possible and earned < possible / 2:
            weak.append(chapter.title)
    return tuple(weak)


def _known_mistakes(course: Course, record: Record) -> tuple[tuple[str, str], ...]:
    marks = record.marks
    return tuple(
        (question.id, name)
        for question in course.questions.values()
        if (mark := marks.get(question.id)) and mark.status in ("wrong", "partial")
        for name in kind_of(question).known_mistakes(question, mark)
    )
