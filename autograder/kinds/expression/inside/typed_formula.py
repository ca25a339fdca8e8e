"""A formula typed into a field, as a sympy expression in the declared symbols."""

from __future__ import annotations

import builtins

from autograder.errors import UsageError
from autograder.exchange.messages import Value
from autograder.kinds.expression.question import Expression
from autograder.language import _
from autograder.questions.typed_text import parse, power, value_of

_OF_SYMPY = (
    *("acos", "asin", "atan", "atan2", "cos", "cot", "sin", "tan"),
    *("csc", "sec", "cosh", "sinh", "tanh", "exp", "log", "sign", "sqrt"),
)


def formula_of(id: str, text: str) -> object:
    """The typed formula of a question of the course around, ``...`` where it is none."""
    from autograder.course import load_course

    question = load_course().question(id)
    assert isinstance(question, Expression)
    try:
        return read_expression(question, text)
    except UsageError:
        return ...


def in_a_cell(text: str) -> object:
    """What a cell makes of a text by the course's author: ``sp`` is sympy, other names symbols."""
    import sympy as sp

    class Names(dict[str, object]):
        def __missing__(self, name: str) -> object:
            if hasattr(builtins, name):
                raise KeyError(name)
            return sp.Symbol(name, real=True)

    return eval(text, {}, Names(sp=sp, sympy=sp))


def read_expression(question: Expression, text: str) -> object:
    """What a typed answer means, a sympy expression.

    Raises:
        UsageError: if it is not understood; the sentence says at which point.
    """
    import sympy as sp

    symbols = {symbol: sp.Symbol(symbol, real=True) for symbol in question.symbols}
    constants = {"pi": sp.pi, "e": sp.E, "E": sp.E}
    functions = {name: getattr(sp, name) for name in _OF_SYMPY} | {
        "abs": sp.Abs,
        "pow": power,
    }

    def name(id: str) -> Value:
        if id in symbols:
            return symbols[id]
        if len(same := [symbol for symbol in symbols if symbol.replace("_", "") == id]) == 1:
            return symbols[same[0]]  # Sxx for S_xx
        if id in constants:
            return constants[id]
        sentence = _("{name} is not one of the symbols here: {symbols}.")
        raise UsageError(sentence.format(name=id, symbols=", ".join(symbols)))

    tree = parse(text, functions, name)
    try:
        formula = sp.sympify(value_of(tree, name, functions, number=sp.sympify))
    except UsageError:
        raise
    except (ArithmeticError, ValueError, TypeError) as error:
        sentence = _("This is not a formula: {reason}.").format(reason=str(error).rstrip("."))
        raise UsageError(sentence) from None
    if formula.has(sp.nan, sp.zoo, sp.oo, -sp.oo):
        reason = _("it divides by zero")
        raise UsageError(_("This has no value: {reason}.").format(reason=reason))
    return formula
