"""Makes a question ready to be put: hidden points drawn, references and mistakes run."""

from __future__ import annotations

import importlib
import sys
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from autograder.course import answers as a
from autograder.course import questions as q
from autograder.errors import CourseError
from autograder.kinds.expression.marking import hidden_points
from autograder.kinds.function.marking import Expected, close
from autograder.marking.probe import Probe
from autograder.sandbox.inside.evaluate import evaluate


def make_probe(question: q.Question, answer: a.Answer, seed: int, root: Path) -> Probe:
    """Draw the hidden points or inputs of a question; the same seed draws the same ones.

    Raises:
        CourseError: if the reference, cases or a mistake cannot be loaded, or the cases are
            malformed.
    """
    rng = np.random.default_rng([seed, zlib.crc32(question.id.encode())])
    if isinstance(answer, a.ExpressionAnswer):
        points = hidden_points(answer, rng)
        return Probe({"kind": question.kind, "points": points}, points=points)
    if isinstance(answer, a.FunctionAnswer):
        cases = load_object(answer.cases, root)(rng)
        _check_cases(question, cases)
        sent = {
            "kind": question.kind,
            "cases": [{"args": c["args"], "kwargs": c.get("kwargs", {})} for c in cases],
        }
        compare = load_object(answer.compare, root) if answer.compare else close
        expected = Expected(
            cases=cases,
            outcomes=_outcomes(answer.reference, sent, root),
            compare=compare,
            mistakes=[
                (mistake, _outcomes(mistake.function, sent, root))
                for mistake in answer.alternatives
            ],
        )
        shows_first = answer.picture is not None and bool(cases[0].get("public"))
        return Probe(sent, expected=expected, shows_first=shows_first)
    return Probe({"kind": question.kind})


def load_object(dotted_name: str, root: Path) -> Callable[..., Any]:
    """The function that a dotted name such as ``solutions.module:function`` stands for.

    This is the only way by which the autograder reaches a course's own code.

    Raises:
        CourseError: if there is no such module or function.
    """
    module_name, _, name = dotted_name.partition(":")
    if str(root) not in sys.path:
        sys.path.insert(0, str(root))
    try:
        loaded: Callable[..., Any] = getattr(importlib.import_module(module_name), name)
        return loaded
    except (ImportError, AttributeError, ValueError) as error:
        raise CourseError(
            f"The key names {dotted_name!r}, which cannot be loaded: {error}."
        ) from error


def _outcomes(dotted_name: str, sent: dict[str, Any], root: Path) -> list[dict[str, Any]]:
    with np.errstate(all="ignore"):
        reply = evaluate(load_object(dotted_name, root), sent)
    if reply["state"] != "given":
        raise CourseError(f"{dotted_name} gives no outcomes: {reply}.")
    return list(reply["outcomes"])


def _check_cases(question: q.Question, cases: Any) -> None:
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
