"""What else the formula of a number question gives if it is put together in a wrong way.

The key's ``code`` is the formula, in the numbers that the chapter's notebook gives to names. It is
the course's own code; nothing of a student's is run.
"""

from __future__ import annotations

import ast
import copy
import itertools
import math
import operator
from collections.abc import Callable, Iterator, Mapping

import numpy as np

from autograder.language import N_, _
from autograder.questions.key_formulas import Term

_MODULES = {"math": math, "np": np}
_MOST_NODES = 60  # of a formula; a longer one is a program
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
        "log1p",
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
_OTHER_LOGARITHMS = (
    ("log10", "common", N_("a common logarithm stands beside a natural one")),
    ("log2", "binary", N_("a binary logarithm stands beside a natural one")),
)
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
            yield from _told(name, _(sentence), _value(_changed(tree, position, change), numbers))
    for position, node in enumerate(nodes):
        if position == 0 or not isinstance(node, ast.BinOp | ast.Call):
            continue
        part = _value(node, numbers)
        if part is None:
            continue
        yield from _told("part of it", _("only a part of the formula was computed"), part)
        if part not in (0, 1):
            words = _("one was divided by a part of the formula, and the rest left out")
            yield from _told("one over a part", words, 1 / part)
        for digits, how in itertools.product((1, 2, 3), _SHORTER):
            early = ast.Constant(how(part, digits))
            yield from _told(
                "rounded too early",
                _("a number was rounded in the middle of the calculation; round at the end only"),
                _value(_changed(tree, position, _always(early)), numbers),
            )
    for node in nodes:
        match node:
            case ast.Constant(value=int() | float() as factor) if factor not in (0, 1):
                words = _("the result was multiplied by {factor}").format(factor=factor)
                yield from _told("multiplied once more", words, right * factor)


def _told(name: str, sentence: str, value: float | None) -> Iterator[tuple[str, str, float]]:
    if value is not None:
        yield name, sentence, value


def _other_numbers(
    used: list[str], numbers: Mapping[str, float]
) -> Iterator[tuple[str, str, dict[str, float]]]:
    """The numbers with two of them exchanged, or one of them mistaken."""
    given = dict(numbers)
    for one, other in itertools.combinations(used, 2):
        words = _("{one} and {other} have changed places in the formula")
        words = words.format(one=one, other=other)
        exchanged = {**given, one: given[other], other: given[one]}
        yield f"{one} and {other} exchanged", words, exchanged
    for name in used:
        value = given[name]
        if 0 < value < 1:
            words = _("1 - {name} stands for {name}, or the other way round").format(name=name)
            yield f"1 - {name} for {name}", words, {**given, name: 1 - value}
        if isinstance(value, int):
            for change, sign in ((-1, "-"), (1, "+")):
                words = _("{changed} was put in for {name}").format(
                    changed=f"{name} {sign} 1", name=name
                )
                yield f"{name} {sign} 1 for {name}", words, {**given, name: value + change}
            for share, part in given.items():
                if not 0 < part < 1:
                    continue
                for factor, of in ((part, share), (1 - part, f"1 - {share}")):
                    if (count := value * factor) == int(count):
                        words = _("only the share {share} of the {count} was counted").format(
                            share=of, count=value
                        )
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


_CHANGES: tuple[tuple[str, str, Change], ...] = (
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


def _cut(value: float, digits: int) -> float:
    cut: float = math.floor(value * 10**digits) / 10**digits
    return cut


_SHORTER: tuple[Callable[[float, int], float], ...] = (round, _cut)


def _always(new: ast.expr) -> Change:
    return lambda _: new
