"""Every variant of a question is proven like the sheet's own numbers.

For all variants, or for 500 drawn where there are more: the solved cell's value earns everything,
each mistake is told apart from what is right and from the other mistakes, no value lies so near a
rounding that an honest float loses, none is trivial, and each is of the kind and size of the
sheet's. What fails is named with its numbers.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import numpy as np

from autograder.authoring.line_in_key import with_line
from autograder.course import Course
from autograder.course.placeholders import value_of
from autograder.course.questions import Question
from autograder.errors import CourseError
from autograder.marking.draw import draw
from autograder.questions.answer import Answer
from autograder.questions.registry import kind_of
from autograder.questions.variables import Variables

MOST = 500  # variants that are tried; more are drawn from
_TRIVIAL = (0, 1)
_NUDGE = 1e-12  # relative; more than an honest order of operations makes of float64
_SEED = 1

Numbers = dict[str, int | float]  # of a variant, by their names


def prove_variants(course: Course) -> Iterator[str]:
    """One sentence for each problem, with the question and the numbers of the first variant."""
    for id, written in course.varied.items():
        assert written.variables is not None
        told: dict[str, tuple[Numbers, int]] = {}
        for variant in _chosen(written.variables):
            numbers = written.variables.numbers(variant)
            for problem in _problems(course, id, variant, numbers):
                first, count = told.get(problem, (numbers, 0))
                told[problem] = first, count + 1
        for problem, (numbers, count) in told.items():
            shown = ", ".join(f"{name} = {value}" for name, value in numbers.items())
            more = f" (and {count - 1} more variants)" if count > 1 else ""
            yield with_line(course, course.question(id), f"{id} with {shown}{more}: {problem}")


def _chosen(variables: Variables) -> list[int]:
    if variables.count <= MOST:
        return list(range(variables.count))
    drawn = np.random.default_rng(_SEED).choice(variables.count, MOST, replace=False)
    return sorted({0, *map(int, drawn)})


def _problems(course: Course, id: str, variant: int, numbers: Numbers) -> Iterator[str]:
    try:
        own = course.with_variants({id: variant})
        question, answer = own.question(id), own.key[id]
    except CourseError as error:
        yield str(error)
        return
    kind = kind_of(question)
    if kind.varies_in_words:
        return  # what its key is worth is proven with many seeds anyway
    drawn = draw(question, answer, _SEED, course.root)
    for alternative in answer.alternatives:
        response = kind.response_like(question, alternative, drawn)
        if response is None:
            continue
        mark = kind.mark(question, answer, drawn, response)
        if mark.alternative != alternative.name:
            yield (
                f"the alternative {alternative.name!r} is taken for {mark.alternative!r}; "
                "leave these numbers out, or correct it."
            )
    if variant:  # the sheet's own is what it is
        yield from kind.poor_draw(question, answer)
    if kind.formulas:
        written = course.varied[id].variables
        assert written is not None
        yield from _weak_numbers(course, question, answer, numbers, written.numbers(0))


def _weak_numbers(
    course: Course, question: Question, answer: Answer, numbers: Numbers, sheets: Numbers
) -> Iterator[str]:
    """What is wrong with the right values, as numbers."""
    _, tables = course.answer_tables[question.chapter]
    table = tables[question.id]
    right = [entry for entry in table["alternative"] if entry["credit"] == 1]
    for entry in right:
        for field in kind_of(question).formulas:
            if not isinstance(formula := entry.get(field), str) or field != "value":
                continue
            value = value_of(formula, numbers)
            if value in _TRIVIAL:
                yield f"the right answer is {value}, which is guessed; leave these numbers out."
            if numbers != sheets:
                theirs = value_of(formula, sheets)
                yield from kind_of(question).poor_value(question, value, theirs)
            if _jumps(formula, numbers, value):
                yield (
                    f"the right answer {value:g} lies so near a rounding that an honest "
                    "computation may miss it; leave these numbers out."
                )
    if right and (solved := _solved(answer.code, numbers)) is not None:
        wanted = value_of(str(right[0]["value"]), numbers)
        if not math.isclose(solved, wanted, rel_tol=1e-4, abs_tol=1e-9):
            yield f"the solved cell gives {solved:g}, and the key says {wanted:g}."


def _jumps(formula: str, numbers: Numbers, value: float) -> bool:
    """Whether the value is another by much when a number is another by next to nothing."""
    for name, number in numbers.items():
        if isinstance(number, int):
            continue
        for nudged in (number * (1 - _NUDGE), number * (1 + _NUDGE)):
            other = value_of(formula, {**numbers, name: nudged})
            if abs(other - value) > 1e-6 * max(1.0, abs(value)):
                return True
    return False


def _solved(code: str, numbers: Numbers) -> float | None:
    """The value of the author's code, as far as it is a formula of the variables alone."""
    try:
        return value_of(re.sub(r"\b(math|np)\.", "", code), numbers)
    except CourseError:
        return None
