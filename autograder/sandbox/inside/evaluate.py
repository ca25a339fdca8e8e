"""Runs where the student's code runs: turns a response into plain data.

A *probe* says what is to be found out about a response; it carries hidden points or inputs but no
answer. What comes back is one of::

    {"state": "not attempted"}
    {"state": "given", ...}             value, values or outcomes
    {"state": "unusable", "reason": ..} one of REASONS
    {"state": "raised", "error": ..}    the class of the exception, never its text

An outcome of a function is {"value": ..}, {"unusable": ..} or {"raised": ..}. With a value comes
"changed": true if an argument was changed in place, and "drawn", how many random numbers were
taken, if an argument was a generator of them.

The trusted side decides what it is worth. The same code serves the grader's sandbox and a
student's own notebook.
"""

from __future__ import annotations

import builtins
import math
import numbers
import sys
from typing import Any

import numpy as np

from autograder.exchange.wire import MAX_DEPTH
from autograder.sandbox.inside.counted_draws import CountedDraws
from autograder.sandbox.inside.expression_values import values_at

REASONS = {
    "text": "it is text; write it without quotes",
    "equation": "it is an equation; give only its right-hand side",
    "callable": "it is a function; give the value or expression itself",
    "not a number": "it is not a number",
    "not finite": "it is not a finite number",
    "several": "it holds several values; give the one that is asked for",
    "symbols left": "it still contains symbols; put the numbers in",
    "symbol unknown": "it contains a symbol that this question does not declare",
    "not an expression": "it is not a sympy expression",
    "not evaluable": "it has no value at the points where it was tried",
    "not a function": "it is not a function",
    "not plain": "it returned something that is not a number, text, list, dictionary or array",
    "missing": "nothing of that name is there",
}


class _Unusable(Exception):
    """A response that cannot be turned into plain data; the argument is one of REASONS."""


def evaluate(response: Any, probe: dict[str, Any]) -> dict[str, Any]:
    """Turn a response into plain data, as the probe's kind asks."""
    if response is ...:
        return {"state": "not attempted"}
    try:
        return {"state": "given", **_BY_KIND[probe["kind"]](response, probe)}
    except NotImplementedError:
        return {"state": "not attempted"}
    except _Unusable as unusable:
        return {"state": "unusable", "reason": str(unusable)}
    except Exception as error:
        return {"state": "raised", "error": public_name(error)}


def public_name(error: BaseException) -> str:
    """The nearest class of an exception that Python or NumPy defines: a name without secrets."""
    for kind in type(error).__mro__:
        if getattr(builtins, kind.__name__, None) is kind or kind.__name__ == "LinAlgError":
            return kind.__name__
    return "Exception"


def describe(response: Any, limit: int = 200) -> str:
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


def _number(response: Any, probe: dict[str, Any]) -> dict[str, Any]:
    return {"value": _plain_number(_only_entry(response))}


def _plain_number(response: Any) -> int | float:
    if isinstance(response, str | bytes):
        raise _Unusable("text")
    if callable(response) and not _is_sympy(response):
        raise _Unusable("callable")
    if isinstance(response, bool | np.bool_):
        raise _Unusable("not a number")
    if isinstance(response, np.generic):
        response = response.item()
    if _is_sympy(response):
        if response.free_symbols:
            raise _Unusable("symbols left")
        response = int(response) if response.is_Integer else complex(response.evalf())
    if isinstance(response, numbers.Integral):
        integer = int(response)
        if integer.bit_length() > 1000:
            raise _Unusable("not finite")
        return integer
    if isinstance(response, numbers.Complex) or hasattr(response, "__float__"):
        number = complex(response)
        if abs(number.imag) > 1e-12 * max(1.0, abs(number.real)) or math.isnan(number.imag):
            raise _Unusable("not a number")
        if not math.isfinite(number.real):
            raise _Unusable("not finite")
        return number.real
    raise _Unusable("not a number")


def _only_entry(response: Any) -> Any:
    """The one entry of ``[x]``, ``{x}`` or a one-element array, as ``sympy.solve`` returns it."""
    if isinstance(response, np.ndarray):
        if response.size != 1:
            raise _Unusable("several")
        return response.reshape(-1)[0]
    if isinstance(response, list | tuple | set | frozenset):
        if len(response) != 1:
            raise _Unusable("several")
        return next(iter(response))
    return response


def _is_sympy(response: Any) -> bool:
    sympy = sys.modules.get("sympy")
    return sympy is not None and isinstance(response, sympy.Basic)


def _expression(response: Any, probe: dict[str, Any]) -> dict[str, Any]:
    response = _only_entry(response)
    points: dict[str, np.ndarray] = probe["points"]
    count = len(next(iter(points.values())))
    if not _is_sympy(response):
        if isinstance(response, str | bytes):
            raise _Unusable("text")
        if callable(response):
            raise _Unusable("callable")
        if not isinstance(response, numbers.Complex):
            raise _Unusable("not an expression")
        return {"values": np.full(count, complex(response))}
    import sympy as sp

    if isinstance(response, sp.Eq):
        raise _Unusable("equation")
    if not isinstance(response, sp.Expr):
        raise _Unusable("not an expression")
    response = response.doit()
    symbols = sorted(response.free_symbols, key=lambda symbol: symbol.name)
    if any(symbol.name not in points for symbol in symbols):
        raise _Unusable("symbol unknown")
    # By name: Symbol("r") and Symbol("r", real=True) are different symbols to sympy, and the
    # student may have used either, or both.
    try:
        with np.errstate(all="ignore"):
            values = values_at(response, points)
        return {"values": np.broadcast_to(np.asarray(values, dtype=complex), (count,)).copy()}
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
    return {"values": values}


def _evalf(expression: Any, symbols: list[Any], values: list[float]) -> complex:
    """The slow way, for what NumPy has no function for."""
    number = expression.evalf(subs=dict(zip(symbols, values, strict=True)))
    try:
        return complex(number)
    except TypeError:
        raise _Unusable("not evaluable") from None


def _function(response: Any, probe: dict[str, Any]) -> dict[str, Any]:
    if not callable(response):
        raise _Unusable("not a function")
    outcomes: list[dict[str, Any]] = []
    for case in probe["cases"]:
        arguments = [_argument(argument) for argument in case["args"]]
        keywords = {name: _argument(value) for name, value in case.get("kwargs", {}).items()}
        try:
            outcome = {"value": to_plain(response(*arguments, **keywords))}
            given = [*arguments, *keywords.values()]
            if not _same(given, [*case["args"], *case.get("kwargs", {}).values()]):
                outcome["changed"] = True
            generators = [value for value in given if isinstance(value, CountedDraws)]
            if generators:
                outcome["drawn"] = sum(generator.drawn for generator in generators)
            outcomes.append(outcome)
        except NotImplementedError:
            raise
        except _Unusable as unusable:
            outcomes.append({"unusable": str(unusable)})
        except Exception as error:
            outcomes.append({"raised": public_name(error)})
    return {"outcomes": outcomes}


def _argument(value: Any) -> Any:
    """A fresh copy of an argument, so that changing it in place cannot reach the next case."""
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, dict):
        if value.keys() == {"rng"}:
            return CountedDraws(value["rng"])
        return {key: _argument(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [_argument(entry) for entry in value]
    return value


def _same(given: Any, sent: Any) -> bool:
    """Whether an argument is still what was sent; a generator may have been used."""
    if isinstance(sent, np.ndarray):
        # Compared as bytes: NaN is equal to itself, and a zero that lost its sign is not.
        return isinstance(given, np.ndarray) and (
            (given.dtype, given.shape) == (sent.dtype, sent.shape)
            and given.tobytes() == sent.tobytes()
        )
    if type(given) is CountedDraws:
        return True
    if isinstance(sent, list):
        same_length = isinstance(given, list) and len(given) == len(sent)
        return same_length and all(map(_same, given, sent))
    if isinstance(sent, dict):
        same_keys = isinstance(given, dict) and given.keys() == sent.keys()
        return same_keys and all(_same(given[key], sent[key]) for key in sent)
    return bool(given is sent or given == sent or sent != sent)


def to_plain(value: Any, depth: int = 0) -> Any:
    """A returned value as plain data: subclasses lose their class, named tuples become lists.

    Raises:
        _Unusable: if it holds anything that is not plain.
    """
    if depth > MAX_DEPTH:  # a list that contains itself
        raise _Unusable("not plain")
    if value is None or isinstance(value, bool | str):
        return value if value is None else (str(value) if isinstance(value, str) else bool(value))
    if isinstance(value, np.ndarray):
        array = np.array(value, subok=False)
        if array.dtype in (np.longdouble, np.clongdouble):
            array = array.astype(complex if array.dtype.kind == "c" else float)
        if array.dtype.kind in "biufc":
            return array
        return [to_plain(entry, depth + 1) for entry in array.tolist()]
    if isinstance(value, np.generic):
        return to_plain(value.item(), depth + 1)
    if isinstance(value, numbers.Integral):
        number = int(value)
        if number.bit_length() > 1000:
            raise _Unusable("not finite")
        return number
    if isinstance(value, numbers.Real):
        return float(value)
    if isinstance(value, complex):
        return complex(value)
    if _is_sympy(value) and getattr(value, "is_number", False):
        return _plain_number(value)
    if isinstance(value, dict):
        return {_key(key): to_plain(entry, depth + 1) for key, entry in value.items()}
    if isinstance(value, list | tuple | set | frozenset):
        entries = sorted(value) if isinstance(value, set | frozenset) else value
        return [to_plain(entry, depth + 1) for entry in entries]
    raise _Unusable("not plain")


def _key(key: Any) -> str:
    """JSON's keys are strings; a number as a key is written as one."""
    if isinstance(key, str):
        return key
    if isinstance(key, numbers.Integral):
        return str(int(key))
    return describe(key)


_BY_KIND = {"number": _number, "expression": _expression, "function": _function}
