"""The values of an expression at the points of a probe. Runs beside the student's code."""

from __future__ import annotations

import numbers

import numpy as np

from autograder.exchange.messages import Message, Value
from autograder.kinds.expression.inside.several_results import several_results
from autograder.kinds.expression.inside.values import values_at
from autograder.kinds.expression.question import MOST_ROOTS
from autograder.sandbox.inside.plain_data import Unusable, is_sympy, only_entry


def evaluate(response: object, probe: Message) -> Message:
    """The values of a response at the probe's points, each an array of them.

    A list of several roots, as ``sympy.solve`` gives them, has one row of values for each.

    Raises:
        Unusable: if it has none.
    """
    points: dict[str, np.ndarray] = probe["points"]
    entries = several_results(response)
    if entries is None:
        return {"values": _values(only_entry(response), points)}
    if not entries:
        raise Unusable("empty")
    if len(entries) == 1:
        return {"values": _values(only_entry(entries[0]), points)}
    if len(entries) > MOST_ROOTS:
        raise Unusable("several")
    return {"values": np.array([_values(only_entry(entry), points) for entry in entries])}


def _values(response: Value, points: dict[str, np.ndarray]) -> np.ndarray:
    """The values of one expression, of shape (number of points,)."""
    count = len(next(iter(points.values())))
    if not is_sympy(response):
        if isinstance(response, str | bytes):
            raise Unusable("text")
        if callable(response):
            raise Unusable("callable")
        if not isinstance(response, numbers.Complex):
            raise Unusable("not an expression")
        return np.full(count, complex(response))
    import sympy as sp

    if isinstance(response, sp.Eq):
        raise Unusable("equation")
    if isinstance(response, sp.Lambda):  # to sympy an expression, to its author a function
        raise Unusable("callable")
    if isinstance(response, sp.Set):
        raise Unusable("set")
    if not isinstance(response, sp.Expr):
        raise Unusable("not an expression")
    response = response.doit()
    symbols = sorted(response.free_symbols, key=lambda symbol: symbol.name)
    if any(symbol.name not in points for symbol in symbols):
        raise Unusable("symbol unknown")
    # By name: Symbol("r") and Symbol("r", real=True) are different symbols to sympy, and the
    # student may have used either, or both.
    try:
        with np.errstate(all="ignore"):
            values = values_at(response, points)
        return np.broadcast_to(np.asarray(values, dtype=complex), (count,)).copy()
    except Exception:  # not in the table: sympy's own way, slower
        pass
    arrays = [np.asarray(points[symbol.name], dtype=float) for symbol in symbols]
    stand_ins = [sp.Dummy() for _ in symbols]
    bare = response.xreplace(dict(zip(symbols, stand_ins, strict=True)))
    try:
        with np.errstate(all="ignore"):
            values = sp.lambdify(stand_ins, bare, modules="numpy")(*arrays)
        values = np.broadcast_to(np.asarray(values, dtype=complex), (count,)).copy()
    except Exception:
        values = np.array(
            [_evalf(bare, stand_ins, [array[i] for array in arrays]) for i in range(count)]
        )
    return values


def _evalf(expression: Value, symbols: list[object], values: list[float]) -> complex:
    """The slow way, for what NumPy has no function for."""
    number = expression.evalf(subs=dict(zip(symbols, values, strict=True)))
    try:
        return complex(number)
    except TypeError:
        raise Unusable("not evaluable") from None
