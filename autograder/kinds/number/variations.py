"""What else the formula of a number question gives if it is put together in a wrong way.

The key's ``code`` is the formula, in the numbers that the chapter's notebook gives to names. It is
the course's own code; nothing of a student's is run.
"""

from __future__ import annotations

import ast
import copy
import itertools
import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

_MODULES = {"math": math, "np": np}
_MOST_NODES = 60  # of a formula; a longer one is a program
_OTHER_LOGARITHMS = (("log10", "common"), ("log2", "binary"))
_LARGEST_POWER = 1e4

Change = Callable[[ast.AST], ast.expr | None]


def variations(code: str, numbers: Mapping[str, float]) -> Iterator[tuple[str, str, float]]:
    """Each wrong way as its name, what it looks like, and the value that comes out."""
    try:
        tree = ast.parse(code.strip(), mode="eval").body
    except SyntaxError:  # several statements
        return
    nodes = list(ast.walk(tree))
    if len(nodes) > _MOST_NODES:
        return
    used = sorted({n.id for n in nodes if isinstance(n, ast.Name) and n.id in numbers})
    right = _value(tree, numbers)
    if right is None:
        return
    for name, sentence, values in _other_numbers(used, numbers):
        yield from _told(name, sentence, _value(tree, values))
    for name, sentence, change in _CHANGES:
        for position in range(len(nodes)):
            yield from _told(name, sentence, _value(_changed(tree, position, change), numbers))
    for position, node in enumerate(nodes):
        if position == 0 or not isinstance(node, ast.BinOp | ast.Call):
            continue
        part = _value(node, numbers)
        if part is None:
            continue
        yield from _told("part of it", "only a part of the formula was computed", part)
        if part not in (0, 1):
            words = "one was divided by a part of the formula, and the rest left out"
            yield from _told("one over a part", words, 1 / part)
        for digits, how in itertools.product((1, 2, 3), (round, _cut)):
            early = ast.Constant(how(part, digits))
            yield from _told(
                "rounded too early",
                "a number was rounded in the middle of the calculation; round at the end only",
                _value(_changed(tree, position, lambda _, new=early: new), numbers),
            )
    for node in nodes:
        if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
            if node.value not in (0, 1):
                words = f"the result was multiplied by {node.value}"
                yield from _told("multiplied once more", words, right * node.value)


def _told(name: str, sentence: str, value: float | None) -> Iterator[tuple[str, str, float]]:
    if value is not None:
        yield name, sentence, value


def _other_numbers(
    used: list[str], numbers: Mapping[str, float]
) -> Iterator[tuple[str, str, dict[str, float]]]:
    """The numbers with two of them exchanged, or one of them mistaken."""
    given = dict(numbers)
    for one, other in itertools.combinations(used, 2):
        words = f"{one} and {other} have changed places in the formula"
        exchanged = {**given, one: given[other], other: given[one]}
        yield f"{one} and {other} exchanged", words, exchanged
    for name in used:
        value = given[name]
        if 0 < value < 1:
            words = f"1 - {name} stands for {name}, or the other way round"
            yield f"1 - {name} for {name}", words, {**given, name: 1 - value}
        if isinstance(value, int):
            for change, sign in ((-1, "-"), (1, "+")):
                words = f"{name} {sign} 1 was put in for {name}"
                yield f"{name} {sign} 1 for {name}", words, {**given, name: value + change}
            for share, part in given.items():
                if not 0 < part < 1:
                    continue
                for factor, of in ((part, share), (1 - part, f"1 - {share}")):
                    if (count := value * factor) == int(count):
                        words = f"only the share {of} of the {value} was counted"
                        yield "only a share counted", words, {**given, name: int(count)}


# -- changes of one place ------------------------------------------------------------------------


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
                return ast.Call(ast.Attribute(module, other), [argument], [])
        return None

    return change


def _rounding(other: str | None) -> Change:
    def change(node: ast.AST) -> ast.expr | None:
        match node:
            case ast.Call(func=ast.Attribute(value=module, attr="ceil" | "floor"), args=[argument]):
                if other is None:
                    return argument
                if other == "round":
                    return ast.Call(ast.Name("round"), [argument], [])
                return ast.Call(ast.Attribute(module, other), [argument], [])
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
            return ast.Call(ast.Attribute(module, "perm"), args, [])
    return None


_CHANGES: tuple[tuple[str, str, Change], ...] = (
    ("not rounded", "it was not rounded to a whole number", _rounding(None)),
    ("rounded down", "it was rounded down", _rounding("floor")),
    ("rounded up", "it was rounded up", _rounding("ceil")),
    ("rounded to the nearest", "it was rounded to the nearest whole number", _rounding("round")),
    ("order counted", "what differs in its order only was counted more than once", _ordered),
    ("a power for a choice", "the same one may be chosen twice", _power_of_arguments),
    ("one for each", "one was counted for each, and not how many may be chosen", _first_argument),
    ("power left out", "something is there once that must happen several times", _power_left_out),
    ("a product for a power", "a product stands for a power", _product_for_power),
    ("complement left out", "an event stands for its complement", _without_complement),
    ("complement too much", "the complement was taken of what is raised to a power", _complemented),
    ("a number one more", "a number in the formula is one too large", _constant(1)),
    ("a number one less", "a number in the formula is one too small", _constant(-1)),
    *(
        (f"{words} logarithm", f"a {words} logarithm stands beside a natural one", _logarithm(name))
        for name, words in _OTHER_LOGARITHMS
    ),
)


def _changed(tree: ast.expr, position: int, change: Change) -> ast.expr | None:
    clone = copy.deepcopy(tree)
    old = list(ast.walk(clone))[position]
    new = change(old)
    if new is None:
        return None
    if old is clone:
        return new

    class Replace(ast.NodeTransformer):
        def visit(self, node: ast.AST) -> ast.AST:
            return new if node is old else self.generic_visit(node)  # type: ignore[return-value]

    Replace().visit(clone)
    return clone


def _value(tree: ast.AST | None, numbers: Mapping[str, float]) -> float | None:
    if tree is None or _is_huge(tree, numbers):
        return None
    expression = ast.fix_missing_locations(ast.Expression(tree))  # type: ignore[arg-type]
    names: dict[str, Any] = {**_MODULES, **numbers}
    try:
        with np.errstate(all="ignore"):
            value = float(eval(compile(expression, "<formula>", "eval"), names))
    except Exception:  # a formula that was put together wrongly need not have a value
        return None
    return value if math.isfinite(value) else None


def _is_huge(tree: ast.AST, numbers: Mapping[str, float]) -> bool:
    """Whether a whole number in it is raised to so high a power that it would take long."""
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
            exponent = node.right
            known = exponent.value if isinstance(exponent, ast.Constant) else None
            if isinstance(exponent, ast.Name):
                known = numbers.get(exponent.id)
            if isinstance(known, int | float) and abs(known) > _LARGEST_POWER:
                return True
    return False


def _cut(value: float, digits: int) -> float:
    return math.floor(value * 10**digits) / 10**digits
