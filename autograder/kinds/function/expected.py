"""What a function question expects: cases, and what reference and mistakes make of them."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from pathlib import Path
from typing import overload

import numpy as np

from autograder.course.loading import load_object
from autograder.course.right_work import right_functions
from autograder.errors import CourseError
from autograder.kinds.drawn import Drawn
from autograder.kinds.function.answer import FunctionAlternative, FunctionAnswer
from autograder.kinds.function.hypotheses import Hypotheses
from autograder.kinds.function.marking import Expected, Outcome, close
from autograder.kinds.function.question import Function
from autograder.sandbox.inside.evaluate import evaluate


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
    cases = load_object(answer.cases, root)(rng)
    _check_cases(question, cases)
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
    return list(reply["outcomes"])


def _check_cases(question: Function, cases: object) -> None:
    well_formed = isinstance(cases, list) and all(
        isinstance(case, dict)
        and isinstance(case.get("name"), str)
        and isinstance(case.get("args"), list)
        and case.keys() <= {"name", "args", "kwargs", "public", "draws", "may_raise"}
        for case in cases
    )
    if not cases or not well_formed:
        raise CourseError(
            f"The cases of {question.id} must be a list of dictionaries with name and args."
        )
