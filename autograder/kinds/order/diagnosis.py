"""A name for a wrong order: a stage moved, two exchanged, one reversed, a card out of place.

A stage is a run of steps that follow each other in a right order. A name is given only if the
change makes the whole of the student's order out of a right one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from autograder.diagnosis.relations import Diagnosis
from autograder.language import _

Cards = tuple[str, ...]


def diagnose_order(
    order: Cards, right: Cards, after: dict[str, set[str]], texts: dict[str, str]
) -> Diagnosis | None:
    """The simplest change that makes a wrong order out of a right one.

    ``after`` holds for each card all those that must come later.
    """
    if _respects(order, after):
        return None
    bases = [right, *_others(right, after)]
    for base in bases:
        if found := _one_card(order, base, texts):
            return found
    for base in bases:
        if order == base[::-1]:
            return Diagnosis(
                "everything reversed",
                _("It looks as if the whole order is reversed: the first step stands last."),
            )
    for base in bases:
        if found := _stages(order, base, texts):
            return found
    return None


def _others(right: Cards, after: dict[str, set[str]]) -> Iterator[Cards]:
    """The right orders in which one card stands elsewhere than in the key's."""
    for place, card in enumerate(right):
        rest = right[:place] + right[place + 1 :]
        for new in range(len(right)):
            other = (*rest[:new], card, *rest[new:])
            if other != right and _respects(other, after):
                yield other


def _respects(order: Cards, after: dict[str, set[str]]) -> bool:
    return not any(
        earlier in after.get(later, ())
        for place, later in enumerate(order)
        for earlier in order[:place]
    )


def _differing(order: Cards, base: Cards) -> tuple[int, int] | None:
    """Where two orders begin and cease to differ; None if they do not."""
    places = [i for i, (one, other) in enumerate(zip(order, base, strict=True)) if one != other]
    return (places[0], places[-1] + 1) if places else None


def _one_card(order: Cards, base: Cards, texts: dict[str, str]) -> Diagnosis | None:
    if (span := _differing(order, base)) is None:
        return None
    given, right = order[slice(*span)], base[slice(*span)]
    early = _("It looks as if only “{card}” is out of place: it stands too early.")
    late = _("It looks as if only “{card}” is out of place: it stands too late.")
    for said, card, rest in (
        (early, right[-1], (right[-1], *right[:-1])),
        (late, right[0], (*right[1:], right[0])),
    ):
        if given == rest:
            return Diagnosis("one card misplaced", said.format(card=texts[card]))
    if len(given) > 2 and given == (right[-1], *right[1:-1], right[0]):
        return Diagnosis(
            "two cards exchanged",
            _("It looks as if “{first}” and “{second}” have changed places.").format(
                first=texts[right[0]], second=texts[right[-1]]
            ),
        )
    return None


def _stages(order: Cards, base: Cards, texts: dict[str, str]) -> Diagnosis | None:
    if (span := _differing(order, base)) is None:
        return None
    given, right = order[slice(*span)], base[slice(*span)]
    count = len(right)
    if given == right[::-1]:
        return Diagnosis(
            "reversed within a stage",
            _("It looks as if one stage is reversed, the steps {steps}.").format(
                steps=_run(right, texts)
            ),
        )
    for cut in range(2, count - 1):
        if given == right[cut:] + right[:cut]:
            first, second = right[:cut], right[cut:]
            if len(first) <= len(second):
                moved, said = (
                    first,
                    _(
                        "It looks as if a whole stage stands too late, the steps {steps}; "
                        "within it the order is right."
                    ),
                )
            else:
                moved, said = (
                    second,
                    _(
                        "It looks as if a whole stage stands too early, the steps {steps}; "
                        "within it the order is right."
                    ),
                )
            return Diagnosis("a stage moved", said.format(steps=_run(moved, texts)))
    for first_end in range(2, count - 2):
        for second_begin in range(first_end + 1, count - 1):
            first, second = right[:first_end], right[second_begin:]
            if given == second + right[first_end:second_begin] + first:
                return Diagnosis(
                    "two stages exchanged",
                    _(
                        "It looks as if two stages have changed places, the steps {first} and "
                        "those {second}."
                    ).format(first=_run(first, texts), second=_run(second, texts)),
                )
    return None


def _run(cards: Sequence[str], texts: dict[str, str]) -> str:
    sentence = _("from “{first}” to “{last}”")
    return sentence.format(first=texts[cards[0]], last=texts[cards[-1]])
