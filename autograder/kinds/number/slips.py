"""What people do wrong at one place of a formula for a number, and what they are told of it."""

from __future__ import annotations

import ast
from collections.abc import Callable

from autograder.language import N_

_OTHER_LOGARITHMS = (
    ("log10", "common", N_("a common logarithm stands beside a natural one")),
    ("log2", "binary", N_("a binary logarithm stands beside a natural one")),
)
Change = Callable[[ast.AST], ast.expr | None]


def _power_left_out(node: ast.AST) -> ast.expr | None:
    return node.left if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow) else None


def _product_for_power(node: ast.AST) -> ast.expr | None:
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
        return ast.BinOp(node.left, ast.Mult(), node.right)
    return None


def _without_complement(node: ast.AST) -> ast.expr | None:
    match node:
        case ast.BinOp(left=ast.Constant(value=1), op=ast.Sub(), right=right):
            return right
    return None


def _complemented(node: ast.AST) -> ast.expr | None:
    match node:
        case ast.BinOp(op=ast.Pow(), left=left, right=right):
            inside = ast.BinOp(ast.Constant(1), ast.Sub(), left)
            return ast.BinOp(inside, ast.Pow(), right)
    return None


def _constant(by: int) -> Change:
    def change(node: ast.AST) -> ast.expr | None:
        match node:
            case ast.Constant(value=int() as value) if value > 1:
                return ast.Constant(value + by)
        return None

    return change


def _logarithm(other: str) -> Change:
    def change(node: ast.AST) -> ast.expr | None:
        match node:
            case ast.Call(func=ast.Attribute(value=module, attr="log"), args=[argument]):
                return ast.Call(ast.Attribute(module, other, ast.Load()), [argument], [])
        return None

    return change


def _rounding(other: str | None) -> Change:
    def change(node: ast.AST) -> ast.expr | None:
        match node:
            case ast.Call(func=ast.Attribute(value=module, attr="ceil" | "floor"), args=[argument]):
                if other is None:
                    return argument
                if other == "round":
                    return ast.Call(ast.Name("round", ast.Load()), [argument], [])
                return ast.Call(ast.Attribute(module, other, ast.Load()), [argument], [])
        return None

    return change


def _first_argument(node: ast.AST) -> ast.expr | None:
    match node:
        case ast.Call(args=[first, _]):
            return first
    return None


def _power_of_arguments(node: ast.AST) -> ast.expr | None:
    match node:
        case ast.Call(func=ast.Attribute(attr="comb" | "perm"), args=[first, second]):
            return ast.BinOp(first, ast.Pow(), second)
    return None


def _ordered(node: ast.AST) -> ast.expr | None:
    match node:
        case ast.Call(func=ast.Attribute(value=module, attr="comb"), args=args):
            return ast.Call(ast.Attribute(module, "perm", ast.Load()), args, [])
    return None


SLIPS: tuple[tuple[str, str, Change], ...] = (
    ("not rounded", N_("it was not rounded to a whole number"), _rounding(None)),
    ("rounded down", N_("it was rounded down"), _rounding("floor")),
    ("rounded up", N_("it was rounded up"), _rounding("ceil")),
    (
        "rounded to the nearest",
        N_("it was rounded to the nearest whole number"),
        _rounding("round"),
    ),
    ("order counted", N_("what differs in its order only was counted more than once"), _ordered),
    ("a power for a choice", N_("the same one may be chosen twice"), _power_of_arguments),
    (
        "one for each",
        N_("one was counted for each, and not how many may be chosen"),
        _first_argument,
    ),
    (
        "power left out",
        N_("something is there once that must happen several times"),
        _power_left_out,
    ),
    ("a product for a power", N_("a product stands for a power"), _product_for_power),
    ("complement left out", N_("an event stands for its complement"), _without_complement),
    (
        "complement too much",
        N_("the complement was taken of what is raised to a power"),
        _complemented,
    ),
    ("a number one more", N_("a number in the formula is one too large"), _constant(1)),
    ("a number one less", N_("a number in the formula is one too small"), _constant(-1)),
    *((f"{kind} logarithm", words, _logarithm(name)) for name, kind, words in _OTHER_LOGARITHMS),
)
