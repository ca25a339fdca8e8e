"""What a function earns that is right on some kinds of input and matches no known mistake.

The fraction of the kinds of input on which it is right, but never more than the best known mistake
earns, and at most half if it fails an example that students can see. Kinds of which every case is
public do not count: their results can be copied. Kinds that something trivial gets right (zeros, an
empty list, the input untouched, an exception whatever comes) earn nothing of their own, and
failing them loses.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from autograder.exchange.messages import Value, Values

Agrees = Callable[[int, Mapping[str, object]], bool]  # whether an outcome is right for a case


def partial_credit(
    cases: Sequence[Mapping[str, object]],
    right: Sequence[Mapping[str, object]],
    verdicts: Sequence[bool],
    agrees: Agrees,
    most: float,
) -> float:
    """The credit, from 0 to 0.99; ``most`` is that of the best known mistake.

    ``right`` are the right outcomes, ``verdicts`` say which cases the response has right.
    """
    kinds: dict[str, list[int]] = {}
    for index, case in enumerate(cases):
        kinds.setdefault(str(case["name"]), []).append(index)
    hidden = [
        indices for indices in kinds.values() if not all(cases[i].get("public") for i in indices)
    ]
    telling = [indices for indices in hidden if not _is_trivial(indices, cases, right, agrees)]
    if not telling:
        return 0.0
    earned = sum(all(verdicts[i] for i in indices) for indices in telling) / len(telling)
    trivial = [indices for indices in hidden if indices not in telling]
    lost = sum(not all(verdicts[i] for i in indices) for indices in trivial) / len(hidden)
    credit = earned * (1 - lost)
    seen = [i for i, case in enumerate(cases) if case.get("public")]
    if not all(verdicts[i] for i in seen):
        credit = min(credit, 0.5)
    # Rounded down, and never all: only a response that is right everywhere earns everything.
    return min(0.99, most, int(100 * credit + 1e-9) / 100)


def _is_trivial(
    indices: Sequence[int],
    cases: Sequence[Mapping[str, object]],
    right: Sequence[Mapping[str, object]],
    agrees: Agrees,
) -> bool:
    """Whether one and the same trivial function is right on every case of a kind."""
    tried = [list(_trivial(cases[i], right[i])) for i in indices]
    return any(
        all(agrees(i, outcomes[way]) for i, outcomes in zip(indices, tried, strict=True))
        for way in range(min(map(len, tried)))
    )


def _trivial(case: Values, right: Values) -> Iterator[dict[str, object]]:
    """What functions return that look at nothing: always the same ones, in the same order."""
    # As a class: what raises the more general exceptions always is right where one is asked for.
    yield {"raised": right.get("raised", "Exception")}
    constants: tuple[Value, ...] = (None, False, True, 0, 1, 0.0, [], np.zeros(0), np.zeros(0, int))
    for constant in constants:
        yield _as_asked(case, constant)
    expected: Value = right.get("value")
    shape = np.shape(expected) if not isinstance(expected, list) else (len(expected),)
    for kind in (float, int):
        yield _as_asked(case, np.zeros(shape, dtype=kind))
    yield _as_asked(case, [[] for _ in range(len(expected) if isinstance(expected, list) else 0)])
    size = shape[0] if shape else 0
    yield _as_asked(case, np.eye(size) if len(shape) == 2 else np.arange(size))
    for value in case["args"]:
        yield _as_asked(case, value)


def _as_asked(case: Values, value: Value) -> dict[str, object]:
    """The outcome of a value, as if it had taken the random numbers that it should."""
    return {"value": value, "drawn": case["draws"][0]} if "draws" in case else {"value": value}
