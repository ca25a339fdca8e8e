"""A response as plain data: what the kinds' own parts have in common. Runs beside the student."""

from __future__ import annotations

import builtins
import itertools
import math
import numbers
import sys
from collections.abc import Collection
from decimal import Decimal
from typing import Any

import numpy as np

from autograder.exchange.wire import MAX_DEPTH

_MOST_NODES = 2000


class Unusable(Exception):
    """A response that cannot be turned into plain data.

    The argument is one of `autograder.exchange.why_unusable.REASONS`.
    """


def public_name(error: BaseException) -> str:
    """The nearest class of an exception that Python or NumPy defines: a name without secrets."""
    for kind in type(error).__mro__:
        if getattr(builtins, kind.__name__, None) is kind or kind.__name__ == "LinAlgError":
            return kind.__name__
    return "Exception"


def describe(response: object, limit: int = 200) -> str:
    """How a response was understood, as one short printable line."""
    if callable(response) and hasattr(response, "__name__"):
        text = f"function {response.__name__}"
    else:
        try:
            text = str(response)
        except Exception:
            text = f"a {type(response).__name__}"
    text = "".join(c if c.isprintable() else " " for c in text[: 2 * limit])
    text = " ".join(text.split())
    return text if len(text) <= limit else text[: limit - 1] + "…"


def plain_number(response: Any) -> int | float:
    """A number of any library as Python's own.

    Raises:
        Unusable: if it is none, or not finite.
    """
    if isinstance(response, str | bytes):
        raise Unusable("text")
    if callable(response) and not is_sympy(response):
        raise Unusable("callable")
    if isinstance(response, bool | np.bool_):
        raise Unusable("not a number")
    if isinstance(response, np.floating):
        response = float(str(response))  # 0.18 of single precision is 0.18, as it was written
    elif isinstance(response, np.generic):
        response = response.item()
    if is_sympy(response):
        response = _number_of_sympy(response)
    if isinstance(response, numbers.Integral):
        integer = int(response)
        if integer.bit_length() > 1000:
            raise Unusable("not finite")
        return integer
    if isinstance(response, numbers.Complex) or hasattr(response, "__float__"):
        number = complex(response)
        if abs(number.imag) > 1e-12 * max(1.0, abs(number.real)) or math.isnan(number.imag):
            raise Unusable("not a number")
        if not math.isfinite(number.real):
            raise Unusable("not finite")
        return number.real
    raise Unusable("not a number")


def _number_of_sympy(response: Any) -> int | complex:
    import sympy as sp

    if isinstance(response, sp.Eq):
        raise Unusable("equation")
    if isinstance(response, sp.Lambda):  # to sympy an expression, to its author a function
        raise Unusable("callable")
    if response.free_symbols:
        raise Unusable("symbols left")
    if not isinstance(response, sp.Expr):  # a set, a condition
        raise Unusable("not a number")
    if isinstance(response, sp.Float):
        return float(str(response))  # `N(x, 2)` shows two digits and holds more of another number
    return int(response) if response.is_Integer else complex(response.evalf())


def _number_or_infinity(value: Any) -> int | float:
    """What sympy computed: to a function of numbers its infinity is as good as Python's."""
    return float(value) if value.is_infinite and value.is_extended_real else plain_number(value)


def only_entry(response: object) -> object:
    """The ``x`` of ``[x]``, ``{x}``, a 1 × 1 matrix, or whatever else sympy's solvers return.

    Raises:
        Unusable: if there are several, or none.
    """
    for _ in range(MAX_DEPTH):
        held = _entries(response)
        if held is None:
            return response
        if len(held) != 1:
            raise Unusable("several" if held else "empty")
        response = next(iter(held))
    raise Unusable("not plain")  # a list that contains itself


def _entries(response: Any) -> Collection[object] | None:
    """What a response holds: ``x`` of a solution ``{name: x}``; None if it is a single value."""
    if isinstance(response, np.ndarray):
        return list(itertools.islice(response.flat, 2))
    if isinstance(response, list | tuple | set | frozenset):
        return response
    sp = sys.modules.get("sympy")
    if sp is None:
        return None
    if isinstance(response, sp.FiniteSet | sp.Tuple):
        return response.args  # type: ignore[no-any-return]
    if isinstance(response, sp.MatrixBase):
        return list(response)
    if isinstance(response, dict) and all(
        isinstance(name, sp.Symbol) and name not in getattr(value, "free_symbols", ())
        for name, value in response.items()
    ):
        return response.values()
    return None


def is_sympy(response: object) -> bool:
    """Whether it is something of sympy's. Sympy is not imported for it."""
    sympy = sys.modules.get("sympy")
    return sympy is not None and isinstance(response, sympy.Basic)


def is_plain(expression: object) -> bool:
    """Whether every part is sympy's own, so that evaluating it runs none of the student's code."""
    import sympy as sp

    if not isinstance(expression, sp.Basic):
        return False
    for seen, node in enumerate(sp.preorder_traversal(expression)):
        if seen > _MOST_NODES or not isinstance(node, sp.Basic) or not _is_of_sympy(type(node)):
            return False
    return True


def _is_of_sympy(kind: type) -> bool:
    return kind.__module__.partition(".")[0] == "sympy"


def to_plain(value: object, depth: int = 0) -> object:
    """A returned value as plain data: subclasses lose their class, named tuples become lists.

    Raises:
        Unusable: if it holds anything that is not plain.
    """
    if depth > MAX_DEPTH:  # a list that contains itself
        raise Unusable("not plain")
    if value is None or isinstance(value, bool | str):
        return value if value is None else (str(value) if isinstance(value, str) else bool(value))
    if isinstance(value, np.ndarray):
        array = np.array(value, subok=False)
        if array.dtype in (np.longdouble, np.clongdouble):
            array = array.astype(complex if array.dtype.kind == "c" else float)
        if array.dtype.kind == "c" and not array.imag.any():
            return array.real  # what a solver of any equation gives for real roots
        if array.dtype.kind in "biufc":
            return array
        return [to_plain(entry, depth + 1) for entry in array.tolist()]
    if isinstance(value, np.longdouble | np.clongdouble):  # whose `item` is no number of Python's
        return complex(value) if isinstance(value, np.clongdouble) else float(value)
    if isinstance(value, np.generic):
        return to_plain(value.item(), depth + 1)
    if isinstance(value, numbers.Integral):
        number = int(value)
        if number.bit_length() > 1000:
            raise Unusable("not finite")
        return number
    if isinstance(value, numbers.Real | Decimal):
        return float(value)
    if isinstance(value, complex):
        return complex(value) if value.imag else float(value.real)
    if is_sympy(value) and getattr(value, "is_number", False):
        return _number_or_infinity(value)
    if isinstance(value, dict):
        return {_key(key): to_plain(entry, depth + 1) for key, entry in value.items()}
    if isinstance(value, list | tuple | set | frozenset):
        entries = sorted(value) if isinstance(value, set | frozenset) else value
        return [to_plain(entry, depth + 1) for entry in entries]
    raise Unusable("not plain")


def _key(key: object) -> str:
    """JSON's keys are strings; a number as a key is written as one."""
    if isinstance(key, str):
        return key
    if isinstance(key, numbers.Integral):
        return str(int(key))
    return describe(key)
