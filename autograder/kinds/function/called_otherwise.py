"""The reference itself, called otherwise: arguments exchanged, turned, squared or rooted."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from autograder.exchange.messages import Value
from autograder.mutants.mutant import Mutant

Call = Callable[..., object]


def called_otherwise(
    reference: Call, cases: Sequence[dict[str, Value]]
) -> Iterator[tuple[Mutant, Call]]:
    """The reference with two of its arguments exchanged, or one of them turned."""
    first = cases[0]["args"]
    names = list(inspect.signature(reference).parameters)[: len(first)]
    for one in range(len(first)):
        for other in range(one + 1, len(first)):
            if isinstance(first[one], dict) or isinstance(first[other], dict):
                continue  # the generator
            name = f"{names[one]} and {names[other]} exchanged"
            yield Mutant(name, name, ""), _exchanging(reference, one, other)
    for place, value in enumerate(first):
        if isinstance(value, np.ndarray) and value.ndim == 2:
            for words, change in (
                ("its columns in reverse order", lambda x: x[:, ::-1]),
                ("its rows and columns exchanged", lambda x: x.T),
            ):
                name = f"{names[place]} with {words}"
                yield Mutant(name, name, ""), _changing(reference, place, change)
        if isinstance(value, float) and 0 < value < 1:
            name = f"1 - {names[place]} for {names[place]}"
            yield Mutant(name, name, ""), _changing(reference, place, lambda x: 1 - x)
    yield from _with_others_changed(reference, cases)


def _with_others_changed(
    reference: Call, cases: Sequence[dict[str, Value]]
) -> Iterator[tuple[Mutant, Call]]:
    """What the first case leaves to its default, squared or rooted wherever it is given."""
    signature = inspect.signature(reference)
    names = list(signature.parameters)
    given: dict[str, Value] = {}
    for case in cases:
        given |= dict(zip(names, case["args"], strict=False)) | case.get("kwargs", {})
    first = {*names[: len(cases[0]["args"])], *cases[0].get("kwargs", {})}
    for name, value in given.items():
        if name in first or not isinstance(value, np.ndarray) or value.dtype.kind != "f":
            continue
        for words, change in (("squared", np.square), ("rooted", np.sqrt)):
            operator = f"argument {words}"
            made = _changing_named(reference, signature, name, change)
            yield Mutant(f"begin with {name} = {words} {name}", operator, ""), made


def _changing_named(
    reference: Call, signature: inspect.Signature, name: str, change: Callable[[Value], Value]
) -> Call:
    def called(*args: Value, **kwargs: Value) -> Value:
        bound = signature.bind(*args, **kwargs).arguments
        if bound.get(name) is not None:
            bound[name] = change(bound[name])
        return reference(**bound)

    return called


def _exchanging(reference: Call, one: int, other: int) -> Call:
    def called(*args: Value, **kwargs: Value) -> Value:
        given = list(args)
        given[one], given[other] = given[other], given[one]
        return reference(*given, **kwargs)

    return called


def _changing(reference: Call, place: int, change: Callable[[Value], Value]) -> Call:
    def called(*args: Value, **kwargs: Value) -> Value:
        return reference(*args[:place], change(args[place]), *args[place + 1 :], **kwargs)

    return called
