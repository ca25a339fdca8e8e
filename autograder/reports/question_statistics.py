"""What a class's marks say about its questions and its students. Pure functions of the records."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from autograder.course import Course
from autograder.course.questions import Question
from autograder.gradebook.record import Record
from autograder.marking import Mark
from autograder.questions.registry import kind_of
from autograder.reports.broken_questions import troubles_of
from autograder.reports.correlations import Together


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
            troubles = tuple(troubles_of(statuses, tried, difficulty, discrimination, unnamed))
            found.append(
                QuestionStatistics(
                    *(question, statuses, tried, difficulty, discrimination, unnamed, troubles)
                )
            )
        return found


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
