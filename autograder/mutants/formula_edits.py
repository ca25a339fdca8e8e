"""Mutants of a formula of the key: a sign, a factor, a power, a term, a function, a symbol."""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator, Sequence

from autograder.mutants.mutant import Mutant

_OTHER_FUNCTION = {"sin": "cos", "cos": "sin", "log": "exp", "exp": "log", "floor": "ceil"}


def edited_formulas(formula: str, symbols: Sequence[str]) -> Iterator[tuple[Mutant, str]]:
    """Every mutant of a formula in these symbols, and its text."""
    tree = ast.parse(formula.strip(), mode="eval").body
    original = ast.unparse(tree)
    seen = {original}
    for position, node in enumerate(list(ast.walk(tree))):
        for operator, new in _replacements(node, symbols):
            text = ast.unparse(_replaced(tree, position, new))
            if text not in seen:
                seen.add(text)
                diff = f"-{original}\n+{text}"
                yield Mutant(f"{original} -> {text}", operator, diff), text


def _replacements(node: ast.AST, symbols: Sequence[str]) -> Iterator[tuple[str, ast.expr]]:
    match node:
        case ast.Name(id=name) if name in symbols:
            for other in symbols:
                if other != name:
                    yield f"{other} for {name}", ast.Name(other)
            for operator, text in (
                ("doubled", f"2*{name}"),
                ("halved", f"{name}/2"),
                ("squared", f"{name}**2"),
                ("its root", f"sqrt({name})"),
                ("sign turned", f"-{name}"),
                ("left out", "1"),
                ("left out", "0"),
            ):
                yield f"{name} {operator}", ast.parse(text, mode="eval").body
        case ast.Constant(value=int() | float() as number):
            yield "constant one more", ast.Constant(number + 1)
            yield "constant one less", ast.parse(str(number - 1), mode="eval").body
        case ast.BinOp(left=left, op=ast.Add() | ast.Sub() as op, right=right):
            turned = ast.Sub() if isinstance(op, ast.Add) else ast.Add()
            yield "sign turned", ast.BinOp(left, turned, right)
            yield "term left out", left
            right = right if isinstance(op, ast.Add) else ast.UnaryOp(ast.USub(), right)
            yield "term left out", right
        case ast.BinOp(left=left, op=ast.Mult() | ast.Div(), right=right):
            yield "factor left out", left
            yield "factor left out", right
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            yield "power left out", left
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            yield "sign left out", operand
        case ast.Call(func=ast.Name(id=name), args=args):
            if name in _OTHER_FUNCTION:
                yield "another function", ast.Call(ast.Name(_OTHER_FUNCTION[name]), args, [])
            if len(args) == 2:
                yield "arguments exchanged", ast.Call(ast.Name(name), args[::-1], [])
            if len(args) == 1:
                yield "function left out", args[0]


def _replaced(tree: ast.expr, position: int, new: ast.expr) -> ast.expr:
    clone = copy.deepcopy(tree)
    old = list(ast.walk(clone))[position]
    if old is clone:
        return new

    class Replace(ast.NodeTransformer):
        def visit(self, node: ast.AST) -> ast.AST:
            return new if node is old else self.generic_visit(node)

    Replace().visit(clone)
    return clone
