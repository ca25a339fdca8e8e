"""Three short functions to read: the reference, and two known mistakes, without what gives away."""

from __future__ import annotations

import ast
import builtins
import inspect
import textwrap
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from autograder.course.loading import load_object
from autograder.exchange.messages import Value
from autograder.kinds.function.answer import FunctionAnswer
from autograder.kinds.function.drawn_outcomes import shown_value
from autograder.kinds.function.question import Function
from autograder.questions.drawn import Drawn
from autograder.questions.functions_to_read import Reading

MOST_LINES = 16
MOST_IN_A_CALL = 100  # characters
MOST_NUMBERS = 8  # in a value
_KNOWN = {"np", "math", "cv2", "sp", *dir(builtins)}


def draw_reading(
    question: Function,
    answer: FunctionAnswer,
    drawn: Drawn,
    rng: np.random.Generator,
    root: Path,
    names: Sequence[str],
) -> Reading | None:
    """Two mistakes and an input on which all three functions return something else.

    None if the functions are long, or no input that can be written in a line tells them apart.
    """
    expected = drawn.expected
    reference = _code(load_object(answer.reference, root), question.function)
    known = {*_KNOWN, *names, *_free_names(reference)}
    wrong = [
        (alternative, code, outcomes)
        for alternative, outcomes in expected.mistakes
        if _is_readable(code := _code(load_object(alternative.function, root), "f"), known)
    ]
    if len(reference.splitlines()) > MOST_LINES:
        return None
    chances = [
        (first, second, at)
        for at in _short_calls(expected.cases)
        for n, first in enumerate(wrong)
        for second in wrong[n + 1 :]
        if _differ(expected.outcomes[at], first[2][at], second[2][at])
    ]
    if not chances:
        return None
    first, second, at = chances[int(rng.integers(len(chances)))]
    pieces = [
        (reference, "", expected.outcomes[at]),
        *((code, entry.feedback, outcomes[at]) for entry, code, outcomes in (first, second)),
    ]
    order = [int(n) for n in rng.permutation(3)]
    placed = [pieces[n] for n in order]
    called = order.index(int(rng.integers(1, 3)))
    values = [_value(outcome) for _, _, outcome in placed]
    shuffled = [int(n) for n in rng.permutation(3)]
    return Reading(
        codes=tuple(
            _renamed(code, letter) for (code, _, _), letter in zip(placed, "ABC", strict=True)
        ),
        right=order.index(0),
        called=called,
        call=_call("ABC"[called], expected.cases[at]),
        values=tuple(values[n] for n in shuffled),
        returned=shuffled.index(called),
        remarks=tuple(remark for _, remark, _ in placed),
    )


def _code(function: Value, name: str) -> str:
    """The source without its docstring and comments, which tell what is wrong with a mistake."""
    tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
    definition = tree.body[0]
    assert isinstance(definition, ast.FunctionDef)
    if ast.get_docstring(definition) is not None:
        definition.body = definition.body[1:] or [ast.Pass()]
    definition.name, definition.decorator_list = name, []
    definition.returns = None
    for argument in [*definition.args.args, *definition.args.kwonlyargs]:
        argument.annotation = None
    return ast.unparse(tree)


def _renamed(code: str, name: str) -> str:
    tree = ast.parse(code)
    definition = tree.body[0]
    assert isinstance(definition, ast.FunctionDef)
    definition.name = name
    return ast.unparse(tree)


def _free_names(code: str) -> set[str]:
    """The names that a function reads and does not make itself."""
    tree = ast.parse(code)
    made = {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}
    names = [node for node in ast.walk(tree) if isinstance(node, ast.Name)]
    made |= {node.id for node in names if isinstance(node.ctx, ast.Store)}
    return {node.id for node in names} - made


def _is_readable(code: str, known: set[str]) -> bool:
    """Whether it is short, and calls nothing that a reader has never seen."""
    return len(code.splitlines()) <= MOST_LINES and _free_names(code) <= known


def _short_calls(cases: Sequence[dict[str, Value]]) -> Iterator[int]:
    """The cases that can be written down in a line; a generator of random numbers cannot."""
    for at, case in enumerate(cases):
        values = [*case["args"], *case.get("kwargs", {}).values()]
        plain = not any(isinstance(value, dict) for value in values)
        few = plain and all(shown_value(value, 3 * MOST_NUMBERS) is not None for value in values)
        if few and len(_call("A", case)) <= MOST_IN_A_CALL:
            yield at


def _call(name: str, case: dict[str, Value]) -> str:
    given = [_written(value) for value in case["args"]]
    given += [f"{key}={_written(value)}" for key, value in case.get("kwargs", {}).items()]
    return f"{name}({', '.join(given)})"


def _differ(*outcomes: Value) -> bool:
    """Whether each can be written down, and no two look alike."""
    written = [_value(outcome) for outcome in outcomes]
    return "" not in written and len(set(written)) == len(written)


def _value(outcome: dict[str, Value]) -> str:
    """What a call gave, to be read; empty if it gave nothing that can be shown in a line."""
    if "value" not in outcome:
        return ""
    text = _written(outcome["value"], MOST_NUMBERS)
    return text if len(text) <= MOST_IN_A_CALL else ""


def _written(value: Value, most: int = 3 * MOST_NUMBERS) -> str:
    """A value in plain lists, with four digits; empty if it is anything else."""
    plain = shown_value(value, most)
    return "" if plain is None else _digits(plain)


def _digits(value: Value) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_digits, value))}]"
    return f"{value + 0.0:.4g}" if isinstance(value, float) else str(value)
