"""Changes of a reference that say what somebody did wrong, beyond those that prove a key.

A key need not tell each of them from what is right; a response may be one of them all the same.
"""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator
from itertools import combinations

from autograder.mutants.code_edits import Edit

_FEW_NAMES = 4  # in one line
_RELATIVES: dict[str, tuple[str, ...]] = {
    "min": ("max",), "max": ("min",), "argmin": ("argmax",), "argmax": ("argmin",),
    "sum": ("mean", "max"), "mean": ("sum", "median"), "any": ("all",), "all": ("any",),
    "minimum": ("maximum",), "maximum": ("minimum",),
    "sin": ("cos",), "cos": ("sin",), "ceil": ("floor", "round"), "floor": ("ceil", "round"),
    "log": ("log10", "log2"), "log1p": ("log",), "arctan2": ("arctan",),
    "abs": ("square", "sqrt"), "zeros": ("ones",), "ones": ("zeros",), "sqrt": ("square",),
    "delete": ("take",), "vstack": ("hstack",), "append": ("insert",),
}  # fmt: skip
# What says little of a thought: named only where no other change gives the same.
VAGUE = frozenset(
    {
        "constant one more",
        "constant one less",
        "one more in a result",
        "one less in a result",
        "slice one shorter",
        "slice one longer",
        "always the first",
        "always the second",
        "part of a condition left out",
    }
)
# What lets an input pass that asks for an error.
NO_ERROR = "a value for an error"
GUARDS = frozenset(
    {
        NO_ERROR,
        "raise left out",
        "branch left out",
        "statement left out",
        "part of a condition left out",
        "and for or",
        "comparison strict",
        "comparison loose",
        "comparison turned round",
        "nothing returned",
    }
)
_LEFT_OUT = frozenset(
    {"abs", "sqrt", "log", "exp", "ceil", "floor", "unique", "sorted", "sort", "round", "set"}
)


def slips(node: ast.AST) -> Iterator[tuple[str, Edit]]:
    """The further changes of one node, each with the kind of change."""
    match node:
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            yield "power left out", lambda _: left
            yield "a product for a power", lambda _: ast.BinOp(left, ast.Mult(), right)
            complement = ast.BinOp(ast.Constant(1), ast.Sub(), left)
            yield "a complement in a power", lambda _: ast.BinOp(complement, ast.Pow(), right)
            if isinstance(right, ast.Constant) and right.value == 2:
                yield "an absolute value for a square", lambda _: _call_of("abs", left)
        case ast.BinOp(left=left, op=ast.Mult(), right=right):
            yield "factor left out", lambda _: left
            yield "factor left out", lambda _: right
            for factor in (left, right):
                if not isinstance(factor, ast.Constant):
                    yield "a factor once more", _times(ast.BinOp(left, ast.Mult(), right), factor)
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            yield "not divided", lambda _: left
            yield "fraction upside down", lambda _: ast.BinOp(right, ast.Div(), left)
            if (length := _length_for_sum(right)) is not None:
                yield "divided by a length", lambda _: ast.BinOp(left, ast.Div(), length)
        case ast.BinOp(
            left=ast.BinOp(left=one, op=ast.Div()),
            op=ast.Add() | ast.Sub() as op,
            right=ast.BinOp(left=other, op=ast.Div()),
        ):
            yield "not divided", lambda _: ast.BinOp(one, op, other)
            yield "term left out", lambda _: one
        case ast.BinOp(left=ast.Constant(value=1) as one, op=ast.Sub(), right=right):
            yield "a complement left out", lambda _: right
            yield "term left out", lambda _: one
            yield "term left out", lambda _: ast.UnaryOp(ast.USub(), right)
        case ast.BinOp(left=left, op=ast.Add() | ast.Sub() as op, right=right):
            yield "term left out", lambda _: left
            other = right if isinstance(op, ast.Add) else ast.UnaryOp(ast.USub(), right)
            yield "term left out", lambda _: other
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            if number not in (0, 1):
                yield "zero for a number", lambda _: ast.Constant(0)
                yield "one for a number", lambda _: ast.Constant(1)
                yield "infinity for a number", lambda _: ast.parse("float('inf')").body[0].value  # type: ignore[attr-defined]
        case ast.Attribute(value=ast.Name(id="math" | "np"), attr="inf"):
            yield "nothing for infinity", lambda _: ast.Constant(None)
            yield "zero for infinity", lambda _: ast.Constant(0)
        case ast.Slice(upper=ast.expr() as upper, lower=lower, step=None):
            for words, op in (("slice one shorter", ast.Sub()), ("slice one longer", ast.Add())):
                yield words, _sliced(lower, ast.BinOp(upper, op, ast.Constant(1)))
        case ast.keyword(arg="axis", value=ast.Constant(value=0 | 1 as axis)):
            yield "another axis", lambda _: ast.keyword("axis", ast.Constant(1 - axis))
        case ast.Return(value=ast.Constant(value=int())):
            yield "nothing returned", lambda _: ast.Return(ast.Constant(None))
        case ast.Return(value=ast.Call() | ast.BinOp() as result):
            for words, op in (
                ("one more in a result", ast.Add()),
                ("one less in a result", ast.Sub()),
            ):
                yield words, _returning(ast.BinOp(result, op, ast.Constant(1)))
            names = sorted(_variables(result))
            for a, b in combinations(names, 2) if len(names) <= _FEW_NAMES else ():
                exchanged = _Exchanged(a, b).visit(copy.deepcopy(result))
                yield f"{a} and {b} exchanged", _returning(exchanged)
        case ast.Raise():
            for value in (None, 0, 1):
                yield NO_ERROR, _returned(value)
        case ast.Call(func=ast.Attribute(value=of, attr=name), args=args, keywords=keywords):
            for relative in _RELATIVES.get(name, ()):
                near: ast.expr = ast.Attribute(of, relative, ast.Load())
                if relative == "round":  # which math has not
                    near = ast.Name(relative, ast.Load())
                yield f"{relative} for {name}", _call(near, args, keywords)
            if name in _LEFT_OUT and len(args) == 1:
                yield f"{name} left out", lambda _: args[0]
            if name in ("sum", "mean"):
                half = ast.BinOp(
                    ast.Constant(0.5),
                    ast.Mult(),
                    ast.Call(ast.Attribute(of, name, ast.Load()), args, keywords),
                )
                yield "halved", lambda _: half
                if (inside := _inside_abs(of)) is not None:
                    squares = ast.BinOp(inside, ast.Pow(), ast.Constant(2))
                    total = ast.Call(ast.Attribute(squares, name, ast.Load()), args, keywords)
                    yield (
                        "a length for a sum",
                        lambda _: ast.BinOp(total, ast.Pow(), ast.Constant(0.5)),
                    )
            if name == "log" and len(args) == 1:
                more = ast.BinOp(ast.Constant(1), ast.Add(), args[0])
                yield (
                    "one added inside a logarithm",
                    _call(ast.Attribute(of, name, ast.Load()), [more], keywords),
                )
                if isinstance(args[0], ast.BinOp) and isinstance(args[0].op, ast.Div):
                    turned = ast.BinOp(args[0].right, ast.Div(), args[0].left)
                    yield "a share for its logarithm", lambda _: turned
            if name in ("atan2", "arctan2") and len(args) == 2:
                opposite: list[ast.expr] = [ast.UnaryOp(ast.USub(), entry) for entry in args]
                yield (
                    "the opposite direction",
                    _call(ast.Attribute(of, name, ast.Load()), opposite, keywords),
                )
            if name == "abs" and len(args) == 1:
                yield (
                    "a square for an absolute value",
                    lambda _: ast.BinOp(args[0], ast.Pow(), ast.Constant(2)),
                )
            if name == "log1p" and len(args) == 1:
                inside = ast.BinOp(ast.Constant(1), ast.Add(), args[0])
                for relative in ("log", "log10", "log2"):
                    yield (
                        f"{relative} for log1p",
                        _call(ast.Attribute(of, relative, ast.Load()), [inside], keywords),
                    )
                match args[0]:
                    case ast.UnaryOp(op=ast.USub(), operand=inner):
                        yield (
                            "an event for its complement",
                            _call(ast.Attribute(of, "log", ast.Load()), [inner], []),
                        )
        case ast.Call(func=ast.Name(id=name), args=args, keywords=keywords):
            for relative in _RELATIVES.get(name, ()):
                yield (
                    f"{relative} for {name}",
                    _call(ast.Name(relative, ast.Load()), args, keywords),
                )
            if name in _LEFT_OUT and len(args) == 1:
                yield f"{name} left out", lambda _: args[0]


def _returning(value: ast.expr) -> Edit:
    return lambda _: ast.Return(value)


def _times(product: ast.expr, factor: ast.expr) -> Edit:
    return lambda _: ast.BinOp(product, ast.Mult(), factor)


def _variables(node: ast.AST) -> set[str]:
    """The names in an expression, but those of what is called."""
    called = {id(call.func) for call in ast.walk(node) if isinstance(call, ast.Call)}
    owners = {id(entry.value) for entry in ast.walk(node) if isinstance(entry, ast.Attribute)}
    return {
        entry.id
        for entry in ast.walk(node)
        if isinstance(entry, ast.Name) and id(entry) not in called | owners
    }


class _Exchanged(ast.NodeTransformer):
    """Two names in each other's place."""

    def __init__(self, one: str, other: str) -> None:
        self._instead = {one: other, other: one}

    def visit_Name(self, node: ast.Name) -> ast.Name:
        return ast.Name(self._instead.get(node.id, node.id), node.ctx)


def _call_of(name: str, argument: ast.expr) -> ast.expr:
    return ast.Call(ast.Name(name, ast.Load()), [argument], [])


def _sliced(lower: ast.expr | None, upper: ast.expr) -> Edit:
    return lambda _: ast.Slice(lower, upper)


def _inside_abs(node: ast.expr) -> ast.expr | None:
    """What an absolute value is taken of."""
    match node:
        case ast.Call(
            func=ast.Name(id="abs") | ast.Attribute(attr="abs" | "fabs" | "absolute"), args=[inside]
        ):
            return inside
    return None


def _length_for_sum(node: ast.expr) -> ast.expr | None:
    """The root of the sum of squares, where a sum stands: ``x.sum()`` or ``sum(x)``."""
    match node:
        case ast.Call(func=ast.Attribute(value=of, attr="sum"), args=args, keywords=keywords):
            squares = ast.BinOp(of, ast.Pow(), ast.Constant(2))
            total: ast.expr = ast.Call(ast.Attribute(squares, "sum", ast.Load()), args, keywords)
            return ast.BinOp(total, ast.Pow(), ast.Constant(0.5))
    return None


def _returned(value: object) -> Edit:
    return lambda _: ast.Return(ast.Constant(value))  # type: ignore[arg-type]


def _call(func: ast.expr, args: list[ast.expr], keywords: list[ast.keyword]) -> Edit:
    def edit(_: ast.AST) -> ast.AST:
        return ast.Call(func, args, keywords)

    return edit
