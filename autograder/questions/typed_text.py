"""Answers typed into a field, read without running any code.

Only arithmetic, the names and the functions that a kind allows are understood. The text is taken
apart by `ast`, so that neither a notebook nor a file of responses can run anything by it.
"""

from __future__ import annotations

import ast
import warnings
from collections.abc import Callable, Collection, Mapping

from autograder.errors import UsageError
from autograder.language import _
from autograder.questions.key_formulas import Term
from autograder.questions.math_spelling import CheckName, is_code, spelt
from autograder.questions.typed_characters import bare

MAX_LENGTH = 500
MAX_BITS = 10_000


def assign_if_open(variable: str, value: str) -> str:
    """A cell that gives a variable a value, unless the notebook has given it one."""
    return f"if globals().get({variable!r}, ...) is ...:\n    {variable} = {value}"


def parse(text: str, functions: Collection[str], check_name: CheckName) -> ast.expr:
    """The tree of a typed formula, in which these functions may be called.

    Raises:
        UsageError: if it is none; the sentence says why.
    """
    text = bare(text)
    if len(text) > MAX_LENGTH:
        sentence = _("That is longer than {count} characters.")
        raise UsageError(sentence.format(count=MAX_LENGTH))
    if not is_code(text):
        text = spelt(text, functions, check_name)
    try:
        with warnings.catch_warnings(action="ignore"):  # of Python's, about 1if
            tree = ast.parse(text, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        if "=" not in text:
            spelt(text, functions, check_name)  # names the sign at fault, if it finds one
        raise UsageError(_why_no_formula(text)) from None
    if isinstance(tree, ast.Tuple):
        raise UsageError(_("Write one value: “,” makes several of it."))
    return tree


def _why_no_formula(text: str) -> str:
    if (missing := text.count("(") - text.count(")")) != 0:
        return _("A bracket is missing: add “{sign}”.").format(sign=")" if missing > 0 else "(")
    if "=" in text:
        return _("Give only the right-hand side, without an equals sign.")
    return _(
        "This is not finished, or not a formula: write 2*x for a product and x**2 for a power."
    )


def power(base: Term, exponent: Term) -> Term:
    """A power, unless it would keep the computer busy for longer than anybody waits."""
    if isinstance(exponent, int | float) or getattr(exponent, "is_number", False):
        size = int(base).bit_length() if getattr(base, "is_integer", isinstance(base, int)) else 1
        if abs(exponent) * max(size, 1) > MAX_BITS:
            raise UsageError(_("That power is too large."))
    return base**exponent


def _called(name: str, function: Callable[..., object], arguments: list[Term]) -> Term:
    try:
        return function(*arguments)
    except TypeError:
        sentence = _("{name} takes other arguments; write {call}.")
        call = f"{name}(y, x)" if name in ("atan2", "comb", "perm", "pow") else f"{name}(x)"
        raise UsageError(sentence.format(name=name, call=call)) from None


def value_of(
    tree: ast.expr,
    name: Callable[[str], object],
    functions: Mapping[str, Callable[..., object]],
    number: Callable[[object], object] = lambda value: value,
) -> Term:
    """The value of a formula's tree.

    Raises:
        UsageError: at anything that is not arithmetic.
    """

    def visit(node: ast.expr) -> Term:
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
                return power(visit(left), visit(right))
            case ast.Call(func=function, args=arguments, keywords=[]):
                called = ast.unparse(function).removeprefix("sp.").removeprefix("math.")
                if called not in functions:
                    sentence = _("{name} is not understood; use {functions}.").format(
                        name=ast.unparse(function), functions=", ".join(functions)
                    )
                    raise UsageError(sentence)
                return _called(called, functions[called], [visit(one) for one in arguments])
            case ast.Attribute(value=ast.Name(id="sp" | "sympy" | "np" | "math"), attr=attribute):
                return name(attribute)
        sentence = _("{part} is not understood in a formula.")
        raise UsageError(sentence.format(part=ast.unparse(node)))

    return visit(tree)
