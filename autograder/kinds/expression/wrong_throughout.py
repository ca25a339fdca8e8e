"""The right formula with one thing wrong throughout, as by somebody who has it wrong in the head.

Mutants change one place; here sine stands for cosine wherever there is one of them, or one symbol
for another.
"""

from __future__ import annotations

import ast
import copy
import itertools
from collections.abc import Callable, Iterator, Sequence

from autograder.language import N_, _

_ANGLES = ("sin", "cos", "tan")
_TURNED = {"sin": "cos", "cos": "sin"}
Change = Callable[[ast.AST], ast.expr | None]


def wholes(formula: str, symbols: Sequence[str]) -> Iterator[tuple[str, str, str]]:
    """Each wrong formula as its name, what it looks like, and its text."""
    tree = ast.parse(formula.strip(), mode="eval").body
    original = ast.unparse(tree)
    seen = {original}
    used = [
        s for s in symbols if any(isinstance(n, ast.Name) and n.id == s for n in ast.walk(tree))
    ]
    changes = [(name, _(words), change) for name, words, change in _CHANGES]
    for one, other in itertools.combinations(used, 2):
        name = f"{one} and {other} exchanged"
        words = _("{one} and {other} have changed places").format(one=one, other=other)
        changes.append((name, words, _exchanged(one, other)))
    for name, words, change in changes:
        text = ast.unparse(_throughout(tree, change))
        if text not in seen:
            seen.add(text)
            yield name, words, text


def terms(formula: str) -> list[str]:
    """The terms of a formula, with what stands outside of a bracket multiplied in."""
    return [ast.unparse(term) for term in _terms(ast.parse(formula.strip(), mode="eval").body)]


def _terms(node: ast.expr) -> list[ast.expr]:
    match node:
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            return [*_terms(left), *_terms(right)]
        case ast.BinOp(left=left, op=ast.Sub(), right=right):
            return [*_terms(left), *(ast.UnaryOp(ast.USub(), term) for term in _terms(right))]
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return [ast.UnaryOp(ast.USub(), term) for term in _terms(operand)]
        case ast.BinOp(left=left, op=ast.Mult(), right=right):
            return [
                ast.BinOp(one, ast.Mult(), other) for one in _terms(left) for other in _terms(right)
            ]
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            return [ast.BinOp(term, ast.Div(), right) for term in _terms(left)]
    return [node]


def _throughout(tree: ast.expr, change: Change) -> ast.expr:
    class Everywhere(ast.NodeTransformer):
        def visit(self, node: ast.AST) -> ast.AST:
            changed = change(node)
            return changed if changed is not None else self.generic_visit(node)

    found = Everywhere().visit(copy.deepcopy(tree))
    assert isinstance(found, ast.expr)
    return found


def _exchanged(one: str, other: str) -> Change:
    names = {one: other, other: one}
    return lambda node: (
        ast.Name(names[node.id]) if isinstance(node, ast.Name) and node.id in names else None
    )


def _of_angle(build: Callable[[str, ast.expr], ast.expr | None]) -> Change:
    """A change of every sine, cosine and tangent, by its name and its argument."""

    def change(node: ast.AST) -> ast.expr | None:
        match node:
            case ast.Call(func=ast.Name(id=name), args=[argument]) if name in _ANGLES:
                return build(name, argument)
        return None

    return change


def _call(name: str, argument: ast.expr) -> ast.expr:
    return ast.Call(ast.Name(name), [argument], [])


def _scaled(text: str) -> Change:
    factor = ast.parse(text, mode="eval").body
    return _of_angle(lambda name, x: _call(name, ast.BinOp(factor, ast.Mult(), x)))


def _single(name: str, argument: ast.expr) -> ast.expr | None:
    match argument:
        case ast.BinOp(left=ast.Constant(value=2), op=ast.Mult(), right=right):
            return _call(name, right)
    return None


def _without_power(node: ast.AST) -> ast.expr | None:
    match node:
        case ast.BinOp(left=left, op=ast.Pow(), right=ast.Constant()):
            return left
    return None


def _fraction(node: ast.AST) -> ast.expr | None:
    match node:
        case ast.Call(func=ast.Name(id="atan2"), args=[over, under]):
            return ast.BinOp(over, ast.Div(), under)
    return None


def _inner(node: ast.AST) -> ast.expr | None:
    """An angle of which only the tangent was found: what stands around it is left out, too."""
    match node:
        case ast.BinOp(left=ast.Call(func=ast.Name(id="atan2")) as call, op=ast.Div() | ast.Mult()):
            return _fraction(call)
    return None


def _of_inner(function: str) -> Change:
    def change(node: ast.AST) -> ast.expr | None:
        fraction = _fraction(node)
        return None if fraction is None else _call(function, fraction)

    return change


_CHANGES: tuple[tuple[str, str, Change], ...] = (
    (
        "sine and cosine exchanged",
        N_("sine and cosine have changed places"),
        _of_angle(lambda name, x: _call(_TURNED[name], x) if name in _TURNED else None),
    ),
    (
        "the single angle",
        N_("a function of the single angle stands for that of the double"),
        _of_angle(_single),
    ),
    (
        "the double angle",
        N_("a function of the double angle stands for that of the single"),
        _scaled("2"),
    ),
    (
        "an angle in degrees",
        N_("an angle was converted to degrees; radians are asked for"),
        _scaled("180/pi"),
    ),
    (
        "an angle taken for degrees",
        N_("an angle in radians was taken for one in degrees"),
        _scaled("pi/180"),
    ),
    (
        "sine and cosine left out",
        N_("the sines and cosines were left out"),
        _of_angle(lambda name, x: ast.Constant(1)),
    ),
    ("powers left out", N_("the squares were left out"), _without_power),
    (
        "not solved for the angle",
        N_("this is the tangent; one step more leads to the angle"),
        _inner,
    ),
    (
        "not solved for the angle",
        N_("this is the tangent; one step more leads to the angle"),
        _fraction,
    ),
    ("the tangent for its inverse", N_("the tangent stands for its inverse"), _of_inner("tan")),
)
