"""The numbers of a question: what an author lets vary, and one choice of it.

A story belongs to a chapter, and the questions that tell it share its numbers::

    [story.cloud]
    N = [1000, 500, 800]                                 # the first are the sheet's
    w = {sheet = 0.2, from = 0.15, to = 0.4, step = 0.05}

    [[question]]
    story = "cloud"

or a question has numbers of its own, under ``[question.variables]``. Variant 0 has the sheet's
numbers; the others follow in a fixed order, so that a variant's number means the same everywhere.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal

import msgspec

from autograder.questions.author_tables import Written, check_python_name
from autograder.questions.strict_reader import Place

Number = int | float
MOST = 100_000  # variants; more would only make the proof choose among more


class Steps(Written, frozen=True, kw_only=True, rename={"first": "from", "last": "to"}):
    """Values at equal distances, and the sheet's, which need not be one of them."""

    sheet: Number
    first: Number
    last: Number
    step: Number

    def values(self) -> tuple[Number, ...]:
        """The sheet's value, then the others, without the error of binary fractions."""
        first, last, step = (Decimal(repr(v)) for v in (self.first, self.last, self.step))
        count = int((last - first) / step) + 1 if last >= first and step > 0 else 0
        if not 0 < count <= MOST:
            raise ValueError("from must not be above to, and step must be above 0, not too small")
        whole = all(isinstance(v, int) for v in (self.first, self.step))
        made = [first + i * step for i in range(count)]
        rest = [int(v) if whole else float(v) for v in made]
        return (self.sheet, *(v for v in rest if v != self.sheet))


@dataclass(frozen=True)
class Variables:
    """What varies: for each name its values, the sheet's first. ``name`` tells stories apart."""

    name: str
    values: Mapping[str, tuple[Number, ...]]

    @property
    def count(self) -> int:
        """How many variants there are."""
        return math.prod(len(values) for values in self.values.values())

    def numbers(self, variant: int) -> dict[str, Number]:
        """The numbers of a variant, from 0 to `count` - 1."""
        chosen = {}
        for name, values in self.values.items():
            variant, at = divmod(variant, len(values))
            chosen[name] = values[at]
        return chosen

    def variant_of(self, chapter: str, student: str, place: int | None = None) -> int:
        """The variant of a student: the same on every machine and after every reinstall.

        Of two who have neighbouring places in a class list both have another one. Without a place
        the name alone decides.
        """
        if place is None:
            return _hash(chapter, self.name, canonical(student)) % self.count
        # A walk through all variants by equal steps, another one in each story.
        step = 1 + _hash(chapter, self.name, "step") % max(1, self.count - 1)
        while math.gcd(step, self.count) > 1:
            step -= 1
        return (_hash(chapter, self.name, "start") + place * step) % self.count


def _hash(*words: str) -> int:
    matter = "\0".join(words).encode("utf-8", "surrogatepass")
    return int.from_bytes(hashlib.sha256(matter).digest()[:8], "big")


def canonical(student: str) -> str:
    """A name or number as it is compared: without capitals and without needless blanks."""
    return " ".join(student.casefold().split())


def read_variables(table: object, name: str, place: Place) -> Variables:
    """The variables in an author's table.

    Raises:
        CourseError: if it holds something else than lists of numbers and steps.
    """
    values: dict[str, tuple[Number, ...]] = {}
    if not isinstance(table, dict) or not table:
        raise place.error("variables are a table such as {w = [0.2, 0.3]}")
    for key, given in table.items():
        try:
            check_python_name("a variable", key)
            if isinstance(given, list):
                values[key] = msgspec.convert(given, tuple[Number, ...])
            else:
                values[key] = msgspec.convert(given, Steps).values()
            if not values[key] or not all(math.isfinite(value) for value in values[key]):
                raise ValueError("give at least one value, and finite ones")
            if len(set(values[key])) != len(values[key]):
                raise ValueError("a value stands twice")
        except msgspec.ValidationError:
            raise place.error(
                f"the variable {key!r}: write its values as numbers, such as [3, 4, 5], or as "
                "{sheet = 3, from = 4, to = 6, step = 1}",
                (key,),
            ) from None
        except ValueError as error:
            raise place.error(f"the variable {key!r}: {error}", (key,)) from None
    variables = Variables(name, values)
    if variables.count > MOST:
        raise place.error(f"there are {variables.count:,} variants; give at most {MOST:,}")
    return variables
