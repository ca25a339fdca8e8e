"""What a function question expects: cases, and what reference and mistakes make of them."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from pathlib import Path
from typing import overload

import numpy as np

from autograder.course.loading import load_object, place_of
from autograder.course.right_work import right_functions
from autograder.errors import CourseError
from autograder.kinds.function.answer import FunctionAlternative, FunctionAnswer
from autograder.kinds.function.hypotheses import Hypotheses
from autograder.kinds.function.marking import Expected, Outcome, close
from autograder.kinds.function.question import Function
from autograder.questions.drawn import Drawn
from autograder.questions.nearest_name import meant
from autograder.sandbox.inside.evaluate import evaluate

_OF_A_CASE = ("name", "args", "kwargs", "public", "draws", "samples", "may_raise")


def draw(
    question: Function,
    answer: FunctionAnswer,
    rng: np.random.Generator,
    root: Path,
    base: dict[str, object],
) -> Drawn:
    """Draw the cases, and run the reference and the known mistakes on them.

    Raises:
        CourseError: if one of them cannot be loaded or run, or the cases are malformed.
    """
    make_cases = load_object(answer.cases, root)
    cases = make_cases(rng)
    if problem := problem_of_cases(question, cases):
        raise CourseError(f"{problem}{place_of(make_cases, root)}.")
    sent = {**base, "cases": [{"args": c["args"], "kwargs": c.get("kwargs", {})} for c in cases]}
    reference = load_object(answer.reference, root)
    compare = load_object(answer.compare, root) if answer.compare else close
    expected = Expected(
        hypotheses=Hypotheses(
            reference,
            cases,
            compare,
            root,
            lambda: list(right_functions(root, question.function).values()),
        ),
        cases=cases,
        outcomes=_outcomes(answer.reference, sent, root),
        compare=compare,
        mistakes=Behaviours(answer.alternatives, sent, root),
    )
    shows_first = answer.picture is not None and bool(cases[0].get("public"))
    return Drawn(sent, expected=expected, shows_first=shows_first)


class Behaviours(Sequence[tuple[FunctionAlternative, list[Outcome]]]):
    """The known mistakes with their outcomes, found out when a response is first compared to one.

    Work that is right never needs them, and they take most of the time of drawing.

    Raises:
        CourseError: at once, if a mistake cannot be loaded; when it is asked for, if it cannot be
            run.
    """

    def __init__(
        self, mistakes: Sequence[FunctionAlternative], sent: dict[str, object], root: Path
    ) -> None:
        for mistake in mistakes:
            load_object(mistake.function, root)
        self._mistakes, self._sent, self._root = mistakes, sent, root
        self._found: dict[int, list[Outcome]] = {}
        self._lock = threading.Lock()  # threads mark at the same time

    def __len__(self) -> int:
        return len(self._mistakes)

    @overload
    def __getitem__(self, index: int) -> tuple[FunctionAlternative, list[Outcome]]: ...

    @overload
    def __getitem__(self, index: slice) -> list[tuple[FunctionAlternative, list[Outcome]]]: ...

    def __getitem__(
        self, index: int | slice
    ) -> (
        tuple[FunctionAlternative, list[Outcome]] | list[tuple[FunctionAlternative, list[Outcome]]]
    ):
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        mistake = self._mistakes[index]
        with self._lock:
            if index not in self._found:
                self._found[index] = _outcomes(mistake.function, self._sent, self._root)
            return mistake, self._found[index]


def _outcomes(dotted_name: str, sent: dict[str, object], root: Path) -> list[dict[str, object]]:
    with np.errstate(all="ignore"):
        reply = evaluate(load_object(dotted_name, root), sent)
    if reply["state"] != "given":
        raise CourseError(f"{dotted_name} gives no outcomes: {reply}.")
    outcomes = list(reply["outcomes"])
    if {"raised": "NotImplementedError"} in outcomes:
        raise CourseError(f"{dotted_name} gives no outcomes: it raises NotImplementedError.")
    return outcomes


def problem_of_cases(question: Function, cases: object) -> str:
    """Why cases are no list of dictionaries that hold what a case may hold; empty if they are."""
    if not isinstance(cases, list) or not cases:
        return (
            f"The cases of {question.id} must be a list of dictionaries with name and args, and "
            "not empty"
        )
    for number, case in enumerate(cases, 1):
        problem = _problem_of_case(case)
        if problem:
            name = case.get("name", number) if isinstance(case, dict) else number
            return f"Case {name!r} of {question.id}: {problem}"
    return ""


def _problem_of_case(case: object) -> str:
    if not isinstance(case, dict):
        return 'write a dictionary such as {"name": "no weights", "args": [[]]}'
    for key in case:
        if key not in _OF_A_CASE:
            return f"unknown key {key!r}; {meant(str(key), _OF_A_CASE)}"
    if not isinstance(case.get("name"), str):
        return 'it needs a "name", a text that says what kind of input it is'
    if not isinstance(case.get("args"), list):
        return 'it needs "args", the list of the arguments: [12.0] where there is one'
    for key, counts in (("draws", 2), ("samples", 3)):
        if key in case and not _are_counts(case[key], counts):
            pattern = "(low, high)" if key == "draws" else "(2, low, high) for samples of two"
            return f'"{key}" must be {pattern}, not {case[key]!r}'
    return ""


def _are_counts(value: object, length: int) -> bool:
    if not isinstance(value, tuple | list) or len(value) != length:
        return False
    return all(isinstance(count, int | float | np.number) for count in value)
