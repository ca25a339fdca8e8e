"""What stands in a result that may hold several, as sympy's solvers give them.

Runs beside the student's code.
"""

from __future__ import annotations

import sys

import numpy as np

from autograder.exchange.messages import Value

_TURNS = (0, 1, -1, 2)  # which of the whole numbers stand for all of them


def several_results(response: Value) -> list[Value] | None:
    """The results that a list or a set holds; None for what holds one at most.

    A polynomial (``sp.Poly``) is one. That a set is cut out of the real numbers, or holds under a
    condition, is left out: what is compared are expressions.
    """
    sp = sys.modules.get("sympy")
    if isinstance(response, list | tuple):
        if sp is not None and _is_names_and_solutions(response):
            response = response[1]
        return list(response)
    if isinstance(response, set | frozenset):
        return list(response)
    if isinstance(response, np.ndarray) and response.dtype == object and response.size > 1:
        return list(response.flat)
    if sp is None:
        return None
    if isinstance(response, sp.Poly):
        return [response.as_expr()]
    if isinstance(response, sp.Tuple):
        return list(response.args)
    return _of_set(response) if isinstance(response, sp.Set) else None


def _of_set(given: Value) -> list[Value] | None:
    """What a set of sympy's holds, None if that is not said one by one."""
    sp = sys.modules["sympy"]
    if isinstance(given, sp.FiniteSet):
        return list(given.args)
    if given is sp.S.EmptySet:
        return []
    if isinstance(given, sp.Union):
        parts = [_of_set(part) for part in given.args]
        return None if None in parts else [entry for part in parts for entry in part or ()]
    if isinstance(given, sp.Complement):
        return _of_set(given.args[0])
    if isinstance(given, sp.ConditionSet):
        return _of_set(given.base_set)
    if isinstance(given, sp.Intersection):
        ranges = [part is sp.S.Reals or isinstance(part, sp.Interval) for part in given.args]
        parts = [part for part, is_range in zip(given.args, ranges, strict=True) if not is_range]
        return _of_set(parts[0]) if len(parts) == 1 else None
    if isinstance(given, sp.ImageSet) and given.base_sets == (sp.S.Integers,):
        # Every whole number is right or none, if it stands for the turns of an angle.
        return [given.lamda(turn) for turn in _TURNS]
    return None


def _is_names_and_solutions(given: list[Value] | tuple[Value, ...]) -> bool:
    """Whether it is what ``solve(..., set=True)`` gives: ``([x], {(x1,), (x2,)})``."""
    sp = sys.modules["sympy"]
    if len(given) != 2:
        return False
    names, solutions = given
    return (
        isinstance(names, list)
        and isinstance(solutions, set)
        and all(isinstance(name, sp.Symbol) for name in names)
        and all(isinstance(solution, tuple) for solution in solutions)
    )
