"""A number, or arithmetic that gives one, typed into a field."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping

from autograder.errors import UsageError
from autograder.language import _
from autograder.questions.key_formulas import Term
from autograder.questions.nearest_name import nearest
from autograder.questions.typed_text import parse, power, value_of

MAX_COUNT = 100_000
MAX_FACTORIAL = 2000
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
    functions |= {"factorial": _factorial, "pow": power}

    def name(id: str) -> Term:
        if id in ("pi", "e"):
            return getattr(math, id)
        value = variables.get(id)
        if isinstance(value, int | float) and not isinstance(value, bool):
            return value
        raise UsageError(_no_number(id, [*functions, *variables]))

    tree = parse(text, functions, name)
    try:
        value = value_of(tree, name, functions)
    except UsageError:
        raise
    except (ArithmeticError, ValueError, TypeError) as error:
        sentence = _("This has no value: {reason}.").format(reason=str(error).rstrip("."))
        raise UsageError(sentence) from None
    if isinstance(value, bool | complex) or not isinstance(value, int | float):
        raise UsageError(_("This is not a number."))
    if isinstance(value, int) and value.bit_length() > 1000:
        raise UsageError(_("That number is too large."))
    if not math.isfinite(value):
        raise UsageError(_("This is not a finite number."))
    return value


def _no_number(name: str, known: Collection[str]) -> str:
    same = (other for other in known if other.lower() == name.lower() or nearest(name, [other]))
    if near := next(same, ""):
        sentence = _("{name} is not a number here; perhaps {near} is meant.")
        return sentence.format(name=name, near=near)
    return _("{name} is not a number here; write digits, without words and units.").format(
        name=name
    )


def _factorial(number: Term) -> int:
    if number != round(number) or number < 0:
        raise ValueError(_("! stands behind whole numbers only"))
    if number > MAX_FACTORIAL:
        raise UsageError(_("Those numbers are too large to count with."))
    return math.factorial(round(number))


def _count(function: Callable[[int, int], int]) -> Callable[[object, object], int]:
    """``comb`` or ``perm`` for numbers that are not absurd."""

    def counted(n: Term, k: Term) -> int:
        if max(n, k) > MAX_COUNT:
            raise UsageError(_("Those numbers are too large to count with."))
        return function(n, k)

    return counted
