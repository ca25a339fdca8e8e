"""A number, or arithmetic that gives one, typed into a field."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from autograder.errors import UsageError
from autograder.language import _
from autograder.questions.key_formulas import Term
from autograder.questions.typed_text import parse, value_of

MAX_COUNT = 100_000
_OF_MATH = (
    *("acos", "asin", "atan", "atan2", "cos", "sin", "tan", "radians"),
    *("exp", "log", "log10", "log1p", "log2", "sqrt", "ceil", "floor"),
)


def read_number(text: str, variables: Mapping[str, object]) -> int | float:
    """What a typed answer means.

    Args:
        text: as typed.
        variables: names whose numbers may be used in a formula.

    Raises:
        UsageError: if it is not understood; the sentence says at which point.
    """
    functions: dict[str, Callable[..., object]] = {name: getattr(math, name) for name in _OF_MATH}
    functions |= {"abs": abs, "round": round}
    functions |= {"comb": _count(math.comb), "perm": _count(math.perm)}
    tree = parse(text, functions)

    def name(id: str) -> Term:
        if id in ("pi", "e"):
            return getattr(math, id)
        value = variables.get(id)
        if isinstance(value, int | float) and not isinstance(value, bool):
            return value
        raise UsageError(_("{name} is not a number here.").format(name=id))

    try:
        value = value_of(tree, name, functions)
    except (ArithmeticError, ValueError, TypeError) as error:
        sentence = _("This has no value: {reason}.").format(reason=str(error).rstrip("."))
        raise UsageError(sentence) from None
    if isinstance(value, bool | complex) or not isinstance(value, int | float):
        raise UsageError(_("This is not a number."))
    if (isinstance(value, int) and value.bit_length() > 1000) or not math.isfinite(value):
        raise UsageError(_("This is not a finite number."))
    return value


def _count(function: Callable[[int, int], int]) -> Callable[[object, object], int]:
    """``comb`` or ``perm`` for numbers that are not absurd."""

    def counted(n: Term, k: Term) -> int:
        if max(n, k) > MAX_COUNT:
            raise UsageError(_("Those numbers are too large to count with."))
        return function(n, k)

    return counted
