"""Formulas of the answer key, evaluated on arrays without ``eval``.

A formula is plain arithmetic, such as ``2*a*(b - cos(c))``: numbers, names, ``+ - * / **``,
comparisons and the functions in `FUNCTIONS`. It is parsed by `ast`, which runs nothing, and every
node that is not on the list is refused.
"""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from autograder.errors import CourseError

Term = Any  # a number, an array of them, or an expression of sympy's: operators find out

FUNCTIONS: dict[str, Callable[..., Term]] = {
    "abs": np.abs,
    "acos": np.arccos,
    "asin": np.arcsin,
    "atan": np.arctan,
    "atan2": np.arctan2,
    "ceil": np.ceil,
    "cos": np.cos,
    "exp": np.exp,
    "floor": np.floor,
    "log": np.log,
    "sin": np.sin,
    "sqrt": np.sqrt,
    "tan": np.tan,
    "where": np.where,
}
CONSTANTS = {"pi": np.float64(np.pi), "e": np.float64(np.e)}
MAX_LENGTH = 2000  # characters; nothing longer is written by hand, and Python's parser has limits
_ARGUMENTS = {"atan2": 2, "where": 3}  # of the others: one

_BINARY: dict[type[ast.operator], Callable[[Term, Term], Term]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
_COMPARE: dict[type[ast.cmpop], Callable[[Term, Term], Term]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}


def evaluate_formula(
    text: str, values: Mapping[str, NDArray[np.float64] | float]
) -> NDArray[np.float64]:
    """Evaluate a formula with each name replaced by its array, elementwise.

    Where the result is undefined (a logarithm of a negative number, a division by zero) it is NaN
    or infinite, without a warning.

    Raises:
        CourseError: if the text is no formula or uses a name that has no value.
    """
    if len(text) > MAX_LENGTH:
        raise CourseError(
            f"{text[:40]!r}... is not a formula: it has more than {MAX_LENGTH} characters."
        )
    shown = repr(text if len(text) <= 100 else text[:100] + "...")
    try:
        tree = ast.parse(text.strip(), mode="eval").body
    except SyntaxError as error:
        raise CourseError(f"{shown} is not a formula: {error.msg}.") from None
    except (ValueError, RecursionError, MemoryError):  # a null character; nested too deeply
        raise CourseError(f"{shown} is not a formula: it cannot be parsed.") from None

    def visit(node: ast.expr) -> Term:
        match node:
            case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
                # As NumPy's float, so that 1/0 is infinite instead of an exception.
                return np.float64(number) if abs(number) < 1e308 else np.float64(np.inf)
            case ast.Name(id=name):
                if name in values:
                    return np.asarray(values[name], dtype=np.float64)
                if name in CONSTANTS:
                    return CONSTANTS[name]
                raise CourseError(f"the formula {shown} uses {name!r}, which has no value here.")
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -visit(operand)
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return visit(operand)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _BINARY:
                return _BINARY[type(op)](visit(left), visit(right))
            case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in _COMPARE:
                return _COMPARE[type(op)](visit(left), visit(right))
            case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if name in FUNCTIONS:
                if len(args) != (count := _ARGUMENTS.get(name, 1)):
                    raise CourseError(
                        f"{name} in the formula {shown} takes {count} argument{'s' * (count > 1)}."
                    )
                return FUNCTIONS[name](*(visit(argument) for argument in args))
        raise CourseError(
            f"{_shortened(node)!r} in {shown} is not allowed in a formula; "
            f"use + - * / ** and {', '.join(FUNCTIONS)}."
        )

    try:
        with np.errstate(all="ignore"):
            return np.asarray(visit(tree), dtype=np.float64)
    except RecursionError:
        raise CourseError(f"{shown} is not a formula: it is nested too deeply.") from None
    except TypeError:  # minus a comparison
        raise CourseError(f"{shown} is not a formula: a comparison is not a number.") from None


def _shortened(node: ast.expr) -> str:
    text = ast.unparse(node)
    return text if len(text) <= 60 else text[:60] + "..."
