"""Reading ``grading.toml``; see `autograder.gradebook.scheme` for what it may say."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

from autograder.course import Course
from autograder.errors import CourseError, UsageError
from autograder.gradebook.lookup import find_record
from autograder.gradebook.record import Record
from autograder.gradebook.scheme import Curve, Scheme, plain_scheme
from autograder.kinds.toml_table import Table

RESUBMISSION = ("newest", "best", "mean")


def read_scheme(text: str, course: Course, records: Sequence[Record], where: str) -> Scheme:
    """The scheme that a text in TOML describes; ``records`` are those of the class.

    Raises:
        CourseError: if it says something unclear, or names what is not there.
    """
    try:
        table = Table(tomllib.loads(text.removeprefix("\ufeff")), where)
    except tomllib.TOMLDecodeError as error:
        raise CourseError(f"{where} cannot be read: {error}.") from None
    plain = plain_scheme(course)
    chosen = {key: _questions(table, key, plain) for key in ("dropped", "given", "bonus")}
    for first, second in (("dropped", "given"), ("dropped", "bonus")):
        for question in sorted(chosen[first] & chosen[second]):
            raise table.error(f"{question} is both {first} and {second}; choose one")
    scheme = Scheme(
        plain.questions,
        **chosen,
        excused=_excused(table, course, records),
        weights=_weights(table, course, chosen["dropped"] | chosen["bonus"]),
        curve=_curve(table),
        resubmission=_resubmission(table),
    )
    table.done()
    return scheme


def _questions(table: Table, key: str, plain: Scheme) -> frozenset[str]:
    ids = table.texts(key, ())
    for id in ids:
        if id not in plain.questions:
            raise table.error(f"{key} names {id!r}, and there is no such question")
    return frozenset(ids)


def _excused(table: Table, course: Course, records: Sequence[Record]) -> dict[str, dict[str, str]]:
    excused: dict[str, dict[str, str]] = {}
    for entry in table.tables("excused", "entry", []):
        said = entry.text("student")
        try:
            student = find_record(records, said).student
        except UsageError as error:
            raise entry.error(str(error).rstrip(".")) from None
        questions = list(entry.texts("questions", ()))
        for name in entry.texts("chapters", ()):
            chapters = [chapter for chapter in course.chapters if chapter.name == name]
            if not chapters:
                raise entry.error(f"there is no chapter {name!r}")
            questions += [question.id for question in chapters[0].questions]
        for id in questions:
            if id not in course.questions:
                raise entry.error(f"there is no question {id!r}")
        if not questions:
            raise entry.error("write questions or chapters")
        reason = entry.text("reason", "")
        excused.setdefault(student, {}).update(dict.fromkeys(questions, reason))
        entry.done()
    return excused


def _weights(table: Table, course: Course, not_counted: frozenset[str]) -> dict[str, float]:
    weights = _numbers(table, "weights")
    if not weights:
        return {}
    names = {chapter.name for chapter in course.chapters}
    for name in weights.keys() - names:
        raise table.error(f"[weights] names {name!r}, and the chapters are {sorted(names)}")
    for chapter in course.chapters:
        counted = sum(q.points for q in chapter.questions if q.id not in not_counted)
        if counted and chapter.name not in weights:
            raise table.error(f"[weights] has nothing for {chapter.name}; give it its points, or 0")
        if not counted and weights.get(chapter.name):
            raise table.error(f"[weights] gives {chapter.name} points, and nothing of it counts")
    if not sum(weights.values()):
        raise table.error("all [weights] are 0")
    return {chapter.name: weights.get(chapter.name, 0.0) for chapter in course.chapters}


def _numbers(table: Table, key: str) -> dict[str, float]:
    entries: dict[str, Any] = table.take(key, dict, {})
    inner = Table(entries, f"[{key}] of the grading scheme")
    values = {name: float(inner.number(name)) for name in entries}
    for name, value in values.items():
        if value < 0:
            raise inner.error(f"{name} is {value:g}; give a number of at least 0")
    return values


def _curve(table: Table) -> Curve | None:
    entries: dict[str, Any] = table.take("curve", dict, {})
    if not entries:
        return None
    inner = Table(entries, "[curve] of the grading scheme")
    curve = Curve(float(inner.number("add", 0.0)), float(inner.number("factor", 1.0)), _rows(inner))
    inner.done()
    if curve.factor <= 0:
        raise inner.error("factor must be above 0, or more work would earn less")
    if curve.table and len(entries) > 1:
        raise inner.error("a table stands alone; remove add and factor")
    return curve


def _rows(inner: Table) -> tuple[tuple[float, float], ...]:
    rows = inner.take("table", list, [])
    for row in rows:
        if not isinstance(row, list) or len(row) != 2:
            raise inner.error("each row of the table is [points before, points after]")
        if not all(isinstance(v, int | float) and abs(v) < 1e9 for v in row):
            raise inner.error("the table holds numbers only")
    table = tuple((float(before), float(after)) for before, after in rows)
    for (low, low_value), (high, high_value) in pairwise(table):
        if not (low < high and low_value <= high_value):
            raise inner.error("the table must rise, or more work would earn less")
    return table


def _resubmission(table: Table) -> str:
    inner = Table(table.take("resubmission", dict, {}), "[resubmission] of the grading scheme")
    rule = inner.text("points", "newest")
    inner.done()
    if rule not in RESUBMISSION:
        raise inner.error(f"points is {rule!r}; write {', '.join(RESUBMISSION)}")
    return rule
