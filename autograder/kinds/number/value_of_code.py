"""What the formula in a key's code comes to, by arithmetic alone: nothing is run."""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Mapping

import numpy as np

from autograder.questions.key_formulas import Term

_MODULES = {"math": math, "np": np}
_FUNCTIONS = frozenset(
    [
        "acos",
        "asin",
        "atan",
        "atan2",
        "ceil",
        "comb",
        "cos",
        "degrees",
        "exp",
        "factorial",
        "floor",
        "hypot",
        "log",
        "log10",
        "log1p",
        "log2",
        "perm",
        "pow",
        "radians",
        "sin",
        "sqrt",
        "tan",
        "abs",
        "arccos",
        "arcsin",
        "arctan",
        "arctan2",
        "power",
    ]
)
_BUILTINS: dict[str, Callable[..., Term]] = {"abs": abs, "round": round, "min": min, "max": max}
_ARITHMETIC: dict[type[ast.operator], Callable[[object, object], Term]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
}
_LARGEST_POWER = 1e4


def value_of_code(tree: ast.AST | None, numbers: Mapping[str, float]) -> float | None:
    """What a formula comes to; None for one that has no value, or is more than arithmetic."""
    if tree is None:
        return None
    try:
        with np.errstate(all="ignore"):
            value = float(_evaluated(tree, numbers))
    except (ArithmeticError, ValueError, TypeError, _NoFormula):
        return None
    return value if math.isfinite(value) else None


class _NoFormula(Exception):
    """Code of the key that is more than a formula."""


def _evaluated(node: ast.AST, numbers: Mapping[str, float]) -> float:
    match node:
        case ast.Constant(value=int() | float() as value):
            return value
        case ast.Name(id=name) if name in numbers:
            return numbers[name]
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_evaluated(operand, numbers)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _ARITHMETIC:
            one, other = _evaluated(left, numbers), _evaluated(right, numbers)
            if isinstance(op, ast.Pow) and abs(other) > _LARGEST_POWER:
                raise _NoFormula  # a whole number of so many digits takes long
            found: float = _ARITHMETIC[type(op)](one, other)
            return found
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if name in _BUILTINS:
            return float(_BUILTINS[name](*(_evaluated(a, numbers) for a in args)))
        case ast.Call(
            func=ast.Attribute(value=ast.Name(id=module), attr=name), args=args, keywords=[]
        ) if module in _MODULES and name in _FUNCTIONS:
            given = [_evaluated(a, numbers) for a in args]
            if any(abs(value) > 1e12 for value in given) and name in ("comb", "perm", "factorial"):
                raise _NoFormula
            if name in ("comb", "perm") and max(given[1:], default=0) > _LARGEST_POWER:
                raise _NoFormula
            if name == "factorial" and given[0] > _LARGEST_POWER:
                raise _NoFormula
            result: float = getattr(_MODULES[module], name)(*given)
            return result
        case ast.Attribute(value=ast.Name(id=module), attr="pi" | "e" as name) if module in (
            _MODULES
        ):
            constant: float = getattr(_MODULES[module], name)
            return constant
    raise _NoFormula
