"""Reading ``grading.toml``; see `autograder.gradebook.grading_scheme` for what it may say."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from itertools import pairwise
from typing import Annotated, Literal

from msgspec import Meta, field

from autograder.course import Course
from autograder.errors import CourseError, UsageError
from autograder.gradebook.find_student import find_record
from autograder.gradebook.grading_scheme import Curve, Scheme, plain_scheme
from autograder.gradebook.record import Record
from autograder.questions.author_tables import Text, Written
from autograder.questions.strict_reader import Place, read_table

Rule = Literal["newest", "best", "mean"]
NotNegative = Annotated[float, Meta(ge=0)]


class WrittenExcuse(Written, frozen=True, kw_only=True):
    """A student whom some questions are not asked of."""

    student: Text
    questions: tuple[str, ...] = ()
    chapters: tuple[str, ...] = ()
    reason: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (self.questions or self.chapters):
            raise ValueError("write questions or chapters")


class WrittenCurve(Written, frozen=True, kw_only=True):
    """A factor and points, or straight lines between points."""

    add: float = 0.0
    factor: Annotated[float, Meta(gt=0)] = 1.0
    table: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.table and (self.add, self.factor) != (0.0, 1.0):
            raise ValueError("a table stands alone; remove add and factor")
        for (low, low_value), (high, high_value) in pairwise(self.table):
            if not (low < high and low_value <= high_value):
                raise ValueError("the table must rise, or more work would earn less")


class WrittenResubmission(Written, frozen=True):
    """Which of several attempts counts."""

    points: Rule = "newest"


class WrittenScheme(Written, frozen=True, kw_only=True):
    """The whole file."""

    dropped: tuple[str, ...] = ()
    given: tuple[str, ...] = ()
    bonus: tuple[str, ...] = ()
    excused: tuple[WrittenExcuse, ...] = ()
    weights: dict[str, NotNegative] = field(default_factory=dict)
    curve: WrittenCurve | None = None
    resubmission: WrittenResubmission = WrittenResubmission()


def read_scheme(text: str, course: Course, records: Sequence[Record], where: str) -> Scheme:
    """The scheme that a text in TOML describes; ``records`` are those of the class.

    Raises:
        CourseError: if it says something unclear, or names what is not there.
    """
    text = text.removeprefix("\ufeff")
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise CourseError(f"{where} cannot be read: {error}.") from None
    place = Place(where, text)
    written = read_table(table, WrittenScheme, place)
    plain = plain_scheme(course)
    chosen = {"dropped": written.dropped, "given": written.given, "bonus": written.bonus}
    for key, ids in chosen.items():
        for id in ids:
            if id not in plain.questions:
                raise place.error(f"{key} names {id!r}, and there is no such question", (key,))
    for first, second in (("dropped", "given"), ("dropped", "bonus")):
        for id in sorted({*chosen[first]} & {*chosen[second]}):
            raise place.error(f"{id} is both {first} and {second}; choose one", (second,))
    curve = written.curve
    return Scheme(
        plain.questions,
        **{key: frozenset(ids) for key, ids in chosen.items()},
        excused=_excused(written.excused, course, records, place),
        weights=_weights(written, course, place),
        curve=None if curve is None else Curve(curve.add, curve.factor, curve.table),
        resubmission=written.resubmission.points,
    )


def _excused(
    entries: Sequence[WrittenExcuse], course: Course, records: Sequence[Record], place: Place
) -> dict[str, dict[str, str]]:
    excused: dict[str, dict[str, str]] = {}
    for n, entry in enumerate(entries):
        at = ("excused", n)
        try:
            student = find_record(records, entry.student).student
        except UsageError as error:
            raise place.error(str(error).rstrip("."), at) from None
        questions = [*entry.questions]
        for name in entry.chapters:
            chapters = [chapter for chapter in course.chapters if chapter.name == name]
            if not chapters:
                raise place.error(f"there is no chapter {name!r}", at)
            questions += [question.id for question in chapters[0].questions]
        for id in questions:
            if id not in course.questions:
                raise place.error(f"there is no question {id!r}", at)
        excused.setdefault(student, {}).update(dict.fromkeys(questions, entry.reason))
    return excused


def _weights(written: WrittenScheme, course: Course, place: Place) -> dict[str, float]:
    weights, at = written.weights, ("weights",)
    if not weights:
        return {}
    names = {chapter.name for chapter in course.chapters}
    for name in weights.keys() - names:
        raise place.error(f"[weights] names {name!r}, and the chapters are {sorted(names)}", at)
    not_counted = {*written.dropped, *written.bonus}
    for chapter in course.chapters:
        counted = sum(q.points for q in chapter.questions if q.id not in not_counted)
        if counted and chapter.name not in weights:
            raise place.error(f"[weights] has nothing for {chapter.name}; give it points, or 0", at)
        if not counted and weights.get(chapter.name):
            problem = f"[weights] gives {chapter.name} points, and nothing of it counts"
            raise place.error(problem, at)
    if not sum(weights.values()):
        raise place.error("all [weights] are 0", at)
    return {chapter.name: weights.get(chapter.name, 0.0) for chapter in course.chapters}
