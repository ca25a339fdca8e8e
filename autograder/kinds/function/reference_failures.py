"""Exceptions of a reference that nobody meant: a case would ask students for the same one."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator

import numpy as np

from autograder.kinds.function.draws import asked_in_vain
from autograder.kinds.function.marking import Expected

# What a name, an attribute or a module that is not there raises: a slip of the author's.
_SLIPS = frozenset(
    {"AttributeError", "ImportError", "ModuleNotFoundError", "NameError", "UnboundLocalError"}
)


def reference_failures(reference: Callable[..., object], expected: Expected) -> Iterator[str]:
    """One sentence for each exception that is no contract: it is not in the docstring either."""
    promised = inspect.getdoc(reference) or ""
    raised = [outcome.get("raised") for outcome in expected.outcomes]
    slips: dict[str, list[str]] = {}
    for case, error in zip(expected.cases, raised, strict=True):
        misfit = _misfit(reference, case) if error == "TypeError" else ""
        if misfit:
            yield (
                f"the case {case['name']!r} cannot be given to the reference: {misfit}; "
                "correct its args."
            )
        elif error in _SLIPS and str(error) not in promised:
            slips.setdefault(str(error), []).append(repr(case["name"]))
    for error, names in slips.items():
        yield (
            f"the reference raises {error} for {', '.join(names)}, and would ask students for the "
            "same; correct it, or promise that exception in its docstring."
        )
    if all(raised) and not slips and len(set(raised) - {None}) == 1:
        yield (
            f"the reference raises {raised[0]} in every case; add one for which it returns a value."
        )


def returns_nothing(expected: Expected) -> bool:
    """Whether None is the right value of every case: an empty function would earn everything."""
    values = [outcome["value"] for outcome in expected.outcomes if "value" in outcome]
    return bool(values) and all(value is None for value in values)


def problem_of_the_generator(
    make_cases: Callable[[np.random.Generator], object], takes_nothing: bool
) -> str:
    """Why cases are not drawn from the generator they are given; empty if they are.

    With other random numbers the same work would not earn the same marks in the next run; with
    none all the inputs that should be hidden are the same in every draw.
    """
    one, again, other = (repr_of(make_cases(np.random.default_rng(seed))) for seed in (1, 1, 2))
    if one != again:
        return (
            "differ between two draws of one seed; draw from the generator that the function is "
            "given, and from no other"
        )
    if one == other and not takes_nothing:
        return (
            "are the same in every draw, so that nothing stays hidden; draw from the generator "
            "that the function is given"
        )
    return ""


def repr_of(value: object) -> str:
    """All that a case holds, as text: each number of an array too."""
    if isinstance(value, np.ndarray):
        return f"array {value.dtype} {value.tolist()!r}"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {repr_of(entry)}" for key, entry in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(repr_of, value)) + "]"
    return repr(value)


def other_counts(expected: Expected) -> Iterator[str]:
    """One sentence for each way in which the reference draws otherwise than its cases ask for.

    Marking asks for what the reference did, so that such a case would count nobody's draws.
    """
    found: dict[str, str] = {}  # by what is said: the first case
    for case, outcome in zip(expected.cases, expected.outcomes, strict=True):
        if "value" in outcome and (said := asked_in_vain(case, outcome)):
            found.setdefault(said, str(case["name"]))
    for said, name in found.items():
        yield f"for the case {name!r} the reference {said}; correct either of them"


def _misfit(reference: Callable[..., object], case: dict[str, object]) -> str:
    """Why a function cannot be called with the arguments of a case; empty if it can."""
    arguments, keywords = case["args"], case.get("kwargs", {})
    assert isinstance(arguments, list)
    assert isinstance(keywords, dict)
    try:
        inspect.signature(reference).bind(*arguments, **keywords)
    except TypeError as error:
        return str(error)
    except ValueError:  # of a function that tells no signature
        return ""
    return ""
