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

from autograder.kinds.number.slips import SLIPS, Change
from autograder.kinds.number.value_of_code import value_of_code
from autograder.language import _

_MOST_NODES = 60  # of a formula; a longer one is a program


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
    right = value_of_code(tree, numbers)
    if right is None:
        return
    for name, sentence, values in _other_numbers(used, numbers):
        yield from _told(name, sentence, value_of_code(tree, values))
    for name, sentence, change in SLIPS:
        for position in range(len(nodes)):
            yield from _told(
                name, _(sentence), value_of_code(_changed(tree, position, change), numbers)
            )
    for position, node in enumerate(nodes):
        if position == 0 or not isinstance(node, ast.BinOp | ast.Call):
            continue
        part = value_of_code(node, numbers)
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
                value_of_code(_changed(tree, position, _always(early)), numbers),
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


def _cut(value: float, digits: int) -> float:
    cut: float = math.floor(value * 10**digits) / 10**digits
    return cut


_SHORTER: tuple[Callable[[float, int], float], ...] = (round, _cut)


def _always(new: ast.expr) -> Change:
    return lambda _: new
