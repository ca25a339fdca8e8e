"""What a class's marks say about its questions and its students. Pure functions of the records."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from autograder.course import Course
from autograder.course.questions import Question
from autograder.gradebook.record import Record
from autograder.intake.long_list import LongList
from autograder.language import N_, _
from autograder.marking import Mark
from autograder.questions.registry import kind_of
from autograder.reports.json_output import most_for

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
    students: Sequence[str]


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


def question_statistics(course: Course, records: Iterable[Record]) -> list[QuestionStatistics]:
    """Statistics of every question; submissions that could not be opened are left out."""
    sums = QuestionSums(course)
    for record in records:
        sums.add(record)
    return sums.statistics()


class QuestionSums:
    """Gathers `question_statistics`, one record after the other; nothing of a record is kept."""

    def __init__(self, course: Course) -> None:
        self._questions = list(course.questions.values())
        count = len(self._questions)
        self._statuses: list[Counter[str]] = [Counter() for _ in self._questions]
        self._tried = np.zeros(count, dtype=int)
        self._earned = np.zeros(count)  # by those who tried
        self._unnamed = np.zeros(count, dtype=int)
        self._together = Together(count)

    def add(self, record: Record) -> None:
        """Take in one submission."""
        if record.graded.status == "unreadable":
            return
        marks, waiting = record.marks, set(record.open)
        points = np.array([record.points(question.id) or 0.0 for question in self._questions])
        for column, question in enumerate(self._questions):
            mark = marks.get(question.id)
            if question.id in waiting:
                self._statuses[column]["recorded"] += 1
                continue
            if mark is not None:
                self._statuses[column][_status(mark, question, points[column])] += 1
                self._unnamed[column] += _is_unnamed(question, mark)
            was_tried = mark is not None and mark.status != "not attempted"
            if was_tried or question.id in record.overrides:
                self._tried[column] += 1
                self._earned[column] += points[column]
        self._together.add(points, points.sum() - points)

    def statistics(self) -> list[QuestionStatistics]:
        """What all of them say, question by question."""
        found = []
        discriminations = self._together.correlations()
        for column, question in enumerate(self._questions):
            statuses, discrimination = self._statuses[column], discriminations[column]
            tried, unnamed = int(self._tried[column]), int(self._unnamed[column])
            difficulty = None
            if tried and question.points:
                difficulty = float(self._earned[column] / tried / question.points)
            troubles = tuple(_troubles(statuses, tried, difficulty, discrimination, unnamed))
            found.append(
                QuestionStatistics(
                    *(question, statuses, tried, difficulty, discrimination, unnamed, troubles)
                )
            )
        return found


class Together:
    """Pearson's correlations of ``count`` pairs of numbers, gathered by Welford's method."""

    def __init__(self, count: int) -> None:
        self._seen = 0
        # In the rows: the first of each pair, the second.
        self._mean, self._squares = np.zeros((2, count)), np.zeros((2, count))
        self._products = np.zeros(count)
        self._low, self._high = np.full((2, count), np.inf), np.full((2, count), -np.inf)

    def add(self, first: np.ndarray, second: np.ndarray) -> None:
        """Take in the next of each pair, arrays of ``count`` numbers."""
        pair = np.stack([first, second])
        self._seen += 1
        before = pair - self._mean
        self._mean += before / self._seen
        self._squares += before * (pair - self._mean)
        self._products += before[0] * (pair[1] - self._mean[1])
        self._low, self._high = np.minimum(self._low, pair), np.maximum(self._high, pair)

    def correlations(self) -> list[float | None]:
        """One for each pair; None for few values or none that vary."""
        if self._seen < FEWEST:
            return [None] * len(self._products)
        varies = np.min(self._high - self._low, axis=0) > 0
        scale = np.sqrt(self._squares.prod(axis=0))
        return [
            float(np.clip(product / size, -1, 1)) if is_defined and size > 0 else None
            for product, size, is_defined in zip(self._products, scale, varies, strict=True)
        ]


def _status(mark: Mark, question: Question, points: float) -> str:
    """The status of a mark; what only a person marks has that of its points."""
    if mark.status != "recorded":
        return mark.status
    if points >= question.points:
        return "right"
    return "partial" if points > 0 else "wrong"


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
            _("Students who do well elsewhere do badly here: check the key and the wording.")
        )
    elif discrimination is not None and discrimination < LOW_DISCRIMINATION:
        troubles.append(
            _("Doing well here says little about doing well elsewhere: is it ambiguous?")
        )
    if difficulty == 0:
        troubles.append(_("Nobody earned a point: check the key."))
    elif difficulty < 0.2:
        troubles.append(_("Very few points are earned: is something missing from the prompt?"))
    stopped = sum(statuses[status] for status in STOPPED)
    if stopped >= 0.2 * attempted:
        troubles.append(
            _(
                "{count} of {all} responses stopped with an exception or at a limit: is the stub "
                "clear, is the limit long enough?"
            ).format(count=stopped, all=attempted)
        )
    if unnamed >= 0.25 * attempted:
        troubles.append(
            _(
                "{count} of {all} responses are wrong in ways that no mistake in the key names: "
                "read some, and add the common ones."
            ).format(count=unnamed, all=attempted)
        )
    return troubles


def common_mistakes(course: Course, records: Iterable[Record]) -> list[Mistake]:
    """Every mistake that somebody made, those with a name first, and of them the most common."""
    made = MistakesMade(course)
    for record in records:
        made.add(record)
    return made.mistakes()


class MistakesMade:
    """Gathers `common_mistakes`, one record after the other."""

    def __init__(self, course: Course) -> None:
        self._course = course
        self._made: dict[tuple[str, str, bool], LongList[str]] = {}

    def add(self, record: Record) -> None:
        """Take in one submission."""
        marks = record.marks
        for question in self._course.questions.values():
            mark = marks.get(question.id)
            if mark is None or mark.status not in ("wrong", "partial"):
                continue
            kind = kind_of(question)
            drawn = self._course.entries_of(question.id, record.graded.numbers_of)
            known = kind.known_mistakes(question, mark, drawn)
            for name in known or kind.other_mistakes(question, mark):
                key = (question.id, name, bool(known))
                self._made.setdefault(key, LongList(str)).append(record.student)

    def mistakes(self) -> list[Mistake]:
        """All of them, in the order of `common_mistakes`."""
        order = {id: position for position, id in enumerate(self._course.questions)}
        return sorted(
            (Mistake(*mistake, students) for mistake, students in self._made.items()),
            key=lambda m: (not m.named, -len(m.students), order[m.question], m.name),
        )


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
