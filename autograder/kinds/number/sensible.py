"""Whether the right value of a variant is of the kind and size of the sheet's own."""

from __future__ import annotations

from collections.abc import Iterator

from autograder.kinds.number.question import Number

_MOST_TIMES = 1000.0  # as large or as small as the sheet's: another order of things altogether
_GUESSED = (0.0, 1.0)


def not_sensible(question: Number, value: float, sheets: float) -> Iterator[str]:
    """A sentence for each way in which a right value is none that this question would have.

    Args:
        question: what is asked, whose unit and number of decimals are the same in all variants.
        value: the right value of the variant.
        sheets: the right value with the sheet's numbers.
    """
    if question.integer and not float(value).is_integer():
        yield f"the right answer {value:g} is not whole, and the question asks for a whole number."
    if 0 < sheets < 1 and not 0 < value < 1:
        yield f"the right answer is {value:g}, and the sheet's is a share of one, {sheets:g}."
    elif (value < 0) != (sheets < 0):
        yield f"the right answer {value:g} has another sign than the sheet's, {sheets:g}."
    elif value and sheets and not 1 / _MOST_TIMES <= abs(value / sheets) <= _MOST_TIMES:
        yield f"the right answer {value:g} is of another size than the sheet's, {sheets:g}."
    if question.decimals is not None and value not in _GUESSED:
        rounded = round(float(value), question.decimals)
        if rounded in _GUESSED:
            yield (
                f"the right answer {value:g} is {rounded:g} to {question.decimals} decimals, "
                "which is guessed; leave these numbers out."
            )
