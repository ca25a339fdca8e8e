"""Changes of a reference that say what somebody did wrong, beyond those that prove a key.

A key need not tell each of them from what is right; a response may be one of them all the same.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.marking.mutants.edits import Edit

_RELATIVES: dict[str, tuple[str, ...]] = {
    "min": ("max",), "max": ("min",), "argmin": ("argmax",), "argmax": ("argmin",),
    "sum": ("mean",), "mean": ("sum", "median"), "any": ("all",), "all": ("any",),
    "minimum": ("maximum",), "maximum": ("minimum",),
    "sin": ("cos",), "cos": ("sin",), "ceil": ("floor", "round"), "floor": ("ceil", "round"),
    "log": ("log10", "log2"), "log1p": ("log",), "arctan2": ("arctan",),
    "abs": ("square", "sqrt"), "zeros": ("ones",), "ones": ("zeros",), "sqrt": ("square",),
    "delete": ("take",), "vstack": ("hstack",), "append": ("insert",),
}  # fmt: skip
_LEFT_OUT = frozenset(
    {"abs", "sqrt", "log", "exp", "ceil", "floor", "unique", "sorted", "sort", "round", "set"}
)


def slips(node: ast.AST) -> Iterator[tuple[str, Edit]]:
    """The further changes of one node, each with the kind of change."""
    match node:
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            yield "power left out", lambda _: left
            yield "a product for a power", lambda _: ast.BinOp(left, ast.Mult(), right)
        case ast.BinOp(left=left, op=ast.Mult(), right=right):
            yield "factor left out", lambda _: left
            yield "factor left out", lambda _: right
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            yield "not divided", lambda _: left
            yield "fraction upside down", lambda _: ast.BinOp(right, ast.Div(), left)
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
        case ast.keyword(arg="axis", value=ast.Constant(value=0 | 1 as axis)):
            yield "another axis", lambda _: ast.keyword("axis", ast.Constant(1 - axis))
        case ast.Return(value=ast.Constant(value=int())):
            yield "nothing returned", lambda _: ast.Return(ast.Constant(None))
        case ast.Raise():
            for value in (None, 0, 1):
                yield "a value for an error", _returned(value)
        case ast.Call(func=ast.Attribute(value=of, attr=name), args=args, keywords=keywords):
            for relative in _RELATIVES.get(name, ()):
                yield (
                    f"{relative} for {name}",
                    _call(ast.Attribute(of, relative, ast.Load()), args, keywords),
                )
            if name in _LEFT_OUT and len(args) == 1:
                yield f"{name} left out", lambda _: args[0]
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


def _returned(value: object) -> Edit:
    return lambda _: ast.Return(ast.Constant(value))  # type: ignore[arg-type]


def _call(func: ast.expr, args: list[ast.expr], keywords: list[ast.keyword]) -> Edit:
    def edit(_: ast.AST) -> ast.AST:
        return ast.Call(func, args, keywords)

    return edit


_WORDS = {
    "comparison strict": "a comparison leaves out the case of equality, as `<` does for `<=`",
    "comparison loose": "a comparison lets in the case of equality, as `<=` does for `<`",
    "comparison turned round": "a condition is the wrong way round",
    "truth value turned round": "a true stands for a false, or the other way round",
    "constant one more": "a number in it is one too large",
    "constant one less": "a number in it is one too small",
    "sign turned": "a plus stands for a minus, or the other way round",
    "sign left out": "a minus sign was lost",
    "not left out": "a “not” is missing in a condition",
    "or for and": "one of two conditions is enough where both are needed",
    "and for or": "two conditions are needed where one is enough",
    "part of a condition left out": "a condition lacks one of its parts",
    "arguments exchanged": "two arguments of a call have changed places",
    "always the first": "of two cases one is treated like the other",
    "always the second": "of two cases one is treated like the other",
    "branch left out": "a special case is not treated",
    "branch always taken": "what is meant for a special case is done always",
    "other branch left out": "what is to be done otherwise is missing",
    "raise left out": "an error is not raised that is asked for",
    "statement left out": "one step is left out",
    "early break": "a loop ends after its first turn",
    "loop one short": "a loop leaves out its last turn",
    "first turn left out": "a loop leaves out its first turn",
    "returned element changed": "one of the results is twice what it should be",
    "result changed": "the result is twice what it should be",
    "returned elements exchanged": "two results have changed places",
    "random numbers that are always the same": "the random numbers do not come from the generator "
    "that was given",
    "input changed in place": "an input is changed in place; work on a copy",
    "power left out": "a power is missing, such as a square",
    "a product for a power": "a product stands for a power",
    "factor left out": "a factor is missing",
    "not divided": "a division is missing",
    "fraction upside down": "a fraction is upside down",
    "term left out": "a term is missing",
    "zero for a number": "a zero stands where another number is asked for",
    "one for a number": "a factor or a number is missing",
    "nothing for infinity": "nothing is returned where infinity is asked for",
    "zero for infinity": "a zero is returned where infinity is asked for",
    "infinity for a number": "infinity is returned where a number is asked for",
    "nothing returned": "nothing is returned in a special case",
    "a value for an error": "something is returned where an error is to be raised",
    "another axis": "it runs along the other axis of the array",
    "an event for its complement": "the probability of an event stands for that of its complement",
}


def in_words(operator: str, argument: str = "") -> str:
    """A kind of change as a student may read it: nothing of the reference's text is in it."""
    if argument:
        return f"the {operator.replace('argument', f'argument `{argument}` is', 1)}"
    if operator in _WORDS:
        return _WORDS[operator]
    if " exchanged" in operator or " with " in operator:
        return f"the function works with {operator.replace(' with', ',', 1)}"
    other, between, name = operator.partition(" for ")
    if between:
        return f"`{other}` stands for `{name}`"
    name, between, _ = operator.partition(" left out")
    return f"a `{name}` is missing" if between else f"there is a change: {operator}"
