"""Answers typed into a field: a number or a formula, read without running any code.

Only arithmetic, the declared symbols and the functions listed here are understood. The text is
taken apart by `ast`, so that neither a notebook nor a file of responses can run anything by it.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Mapping
from typing import Any

from autograder.course.questions import Expression, Number, Question
from autograder.errors import UsageError

MAX_LENGTH = 500
MAX_BITS = 10_000
MAX_COUNT = 100_000
_OF_MATH = (
    *("acos", "asin", "atan", "atan2", "cos", "sin", "tan", "radians"),
    *("exp", "log", "log10", "log1p", "log2", "sqrt", "ceil", "floor"),
)
_OF_SYMPY = (
    *("acos", "asin", "atan", "atan2", "cos", "cot", "sin", "tan"),
    *("cosh", "sinh", "tanh", "exp", "log", "sign", "sqrt"),
)


def read_typed(
    question: Number | Expression, text: str, variables: Mapping[str, Any] | None = None
) -> Any:
    """What a typed answer means: a number, or a sympy expression in the declared symbols.

    Args:
        variables: names whose numbers may be used in a number's formula.

    Raises:
        UsageError: if it is not understood; the sentence says at which point.
    """
    tree = _parse(text)
    if isinstance(question, Number):
        return _read_number(tree, variables or {})
    return _read_expression(tree, question)


def typed_cell(question: Question, response: Any) -> str | None:
    """A cell that gives a typed answer to the question's variable, for whoever runs the notebook.

    None if nothing was typed. A value that the notebook itself assigns is left alone: the cell is
    to be run after all others.
    """
    if isinstance(question, Number):
        if isinstance(response, bool) or not isinstance(response, int | float):
            return None
        value = repr(response)
    elif isinstance(question, Expression) and isinstance(response, str):
        value = (
            f"__import__({__name__!r}, fromlist=['_']).formula_of({question.id!r}, {response!r})"
        )
    else:
        return None
    return f"if globals().get({question.name!r}, ...) is ...:\n    {question.name} = {value}"


def formula_of(id: str, text: str) -> Any:
    """The typed formula of a question of the course around, ``...`` where it is none."""
    from autograder.course import load_course

    question = load_course().question(id)
    assert isinstance(question, Expression)
    try:
        return read_typed(question, text)
    except UsageError:
        return ...


def _parse(text: str) -> ast.expr:
    text = text.strip().replace("^", "**").replace("−", "-").replace("·", "*")
    if len(text) > MAX_LENGTH:
        raise UsageError(f"That is longer than {MAX_LENGTH} characters.")
    try:
        return ast.parse(text, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise UsageError(_why_no_formula(text)) from None


def _why_no_formula(text: str) -> str:
    if text.count("(") != text.count(")"):
        return "A bracket is missing."
    if "=" in text:
        return "Give only the right-hand side, without an equals sign."
    return "This is not finished, or not a formula: write 2*x for a product and x**2 for a power."


def _read_number(tree: ast.expr, variables: Mapping[str, Any]) -> int | float:
    if isinstance(tree, ast.Tuple):
        raise UsageError("Write one number, with a point for the decimals: 0.5, not 0,5.")

    functions: dict[str, Callable[..., Any]] = {name: getattr(math, name) for name in _OF_MATH}
    functions |= {"abs": abs, "round": round}
    functions |= {"comb": _count(math.comb), "perm": _count(math.perm)}

    def name(id: str) -> Any:
        if id in ("pi", "e"):
            return getattr(math, id)
        value = variables.get(id)
        if isinstance(value, int | float) and not isinstance(value, bool):
            return value
        raise UsageError(f"{id} is no number here.")

    try:
        value = _visit(tree, name, functions)
    except (ArithmeticError, ValueError, TypeError) as error:
        raise UsageError(f"This has no value: {error}.") from None
    if isinstance(value, bool | complex) or not isinstance(value, int | float):
        raise UsageError("This is not a number.")
    if (isinstance(value, int) and value.bit_length() > 1000) or not math.isfinite(value):
        raise UsageError("This is not a finite number.")
    return value


def _read_expression(tree: ast.expr, question: Expression) -> Any:
    import sympy as sp

    symbols = {symbol: sp.Symbol(symbol, real=True) for symbol, _ in question.symbols}
    constants = {"pi": sp.pi, "e": sp.E, "E": sp.E}
    functions = {name: getattr(sp, name) for name in _OF_SYMPY} | {
        "abs": sp.Abs,
        "Abs": sp.Abs,
        "ln": sp.log,
        "arctan": sp.atan,
        "arctan2": sp.atan2,
    }
    functions |= {"arcsin": sp.asin, "arccos": sp.acos}

    def name(id: str) -> Any:
        if id in symbols:
            return symbols[id]
        if id in constants:
            return constants[id]
        raise UsageError(f"{id} is not one of the symbols here: {', '.join(symbols)}.")

    try:
        return sp.sympify(_visit(tree, name, functions, number=sp.sympify))
    except (ArithmeticError, ValueError, TypeError) as error:
        raise UsageError(f"This is not a formula: {error}.") from None


def _power(base: Any, exponent: Any) -> Any:
    """A power, unless it would keep the computer busy for longer than anybody waits."""
    if isinstance(exponent, int | float) or getattr(exponent, "is_number", False):
        size = int(base).bit_length() if getattr(base, "is_integer", isinstance(base, int)) else 1
        if abs(exponent) * max(size, 1) > MAX_BITS:
            raise UsageError("That power is too large.")
    return base**exponent


def _count(function: Callable[[int, int], int]) -> Callable[[Any, Any], int]:
    """``comb`` or ``perm`` for numbers that are not absurd."""

    def counted(n: Any, k: Any) -> int:
        if max(n, k) > MAX_COUNT:
            raise UsageError("Those numbers are too large to count with.")
        return function(n, k)

    return counted


def _visit(
    tree: ast.expr,
    name: Callable[[str], Any],
    functions: Mapping[str, Callable[..., Any]],
    number: Callable[[Any], Any] = lambda value: value,
) -> Any:
    """The value of a formula's tree.

    Raises:
        UsageError: at anything that is not arithmetic.
    """

    def visit(node: ast.expr) -> Any:
        match node:
            case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
                return number(value)
            case ast.Name(id=id):
                return name(id)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -visit(operand)
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return visit(operand)
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                return visit(left) + visit(right)
            case ast.BinOp(left=left, op=ast.Sub(), right=right):
                return visit(left) - visit(right)
            case ast.BinOp(left=left, op=ast.Mult(), right=right):
                return visit(left) * visit(right)
            case ast.BinOp(left=left, op=ast.Div(), right=right):
                return visit(left) / visit(right)
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                return _power(visit(left), visit(right))
            case ast.Call(func=function, args=arguments, keywords=[]):
                called = ast.unparse(function).removeprefix("sp.").removeprefix("math.")
                if called not in functions:
                    raise UsageError(
                        f"{ast.unparse(function)} is not understood; use {', '.join(functions)}."
                    )
                return functions[called](*(visit(argument) for argument in arguments))
            case ast.Attribute(value=ast.Name(id="sp" | "sympy" | "np" | "math"), attr=attribute):
                return name(attribute)
        raise UsageError(f"{ast.unparse(node)} is not understood in a formula.")

    return visit(tree)
