"""Lists of which a student gets some entries, or all in another order: statements and cards.

An author writes which, by numbers from 1, and each draw is a variant::

    statements = ["the sheet's first", "the sheet's second", "a third", "a fourth"]
    draws = [[1, 2], [3, 1], [4, 2]]

The first draw is the sheet's: the first entries, in their order. If there are as many hints as
entries, each entry's own hint is drawn with it. What is drawn follows from the
question alone, so that it is the same where no key is at hand; `autograder check`, which has the
key, proves each draw.
"""

from __future__ import annotations

from autograder.questions.strict_reader import Place, Table
from autograder.questions.variables import Variables

FIELD = "draws"
DRAW = "draw"  # the variable that says which draw a variant has


def read_draws(table: Table, listed: str, place: Place) -> Variables:
    """The draws of a question as its variables; ``listed`` is the field that they draw from.

    Raises:
        CourseError: if they do not fit the list.
    """
    draws, entries = table[FIELD], table.get(listed)
    if not listed:
        raise place.error(f"its kind has nothing to draw from; remove {FIELD}", (FIELD,))
    if not isinstance(entries, list):
        raise place.error(f"{FIELD} draw from {listed}, which must be a list", (FIELD,))
    if not (isinstance(draws, list) and draws and all(isinstance(one, list) for one in draws)):
        raise place.error(f"{FIELD} are lists such as [[1, 2], [3, 1]]", (FIELD,))
    for at, one in enumerate(draws):
        if not all(type(n) is int and 1 <= n <= len(entries) for n in one):
            raise place.error(
                f"draw {at} must hold numbers from 1 to {len(entries)}, one for each of {listed}",
                (FIELD, at),
            )
        if len(set(one)) != len(one) or len(one) != len(draws[0]):
            raise place.error(
                f"draw {at} must name {len(draws[0])} different {listed}, as the first does",
                (FIELD, at),
            )
        if one in draws[:at]:
            raise place.error(f"draw {at} is the same as another; remove it", (FIELD, at))
    if draws[0] != list(range(1, len(draws[0]) + 1)):
        raise place.error(f"the first draw is the sheet's: the first {listed} in order", (FIELD, 0))
    if unused := set(range(1, len(entries) + 1)) - {n for one in draws for n in one}:
        raise place.error(f"no draw has number {min(unused)} of {listed}", (FIELD,))
    return Variables(str(table.get("id")), {DRAW: tuple(range(len(draws)))})


def drawn(table: Table, field: str, draws: list[list[int]], numbers: Table) -> Table:
    """A question's or a key's table with only those entries of a list that a variant has."""
    entries = table.get(field)
    rest = {key: value for key, value in table.items() if key != FIELD}
    if not isinstance(entries, list):
        return rest  # its reader says what is wrong
    chosen = draws[int(numbers[DRAW])]
    rest[field] = [entries[n - 1] for n in chosen if n <= len(entries)]
    hints = table.get("hints")
    if isinstance(hints, list) and len(hints) == len(entries):  # one for each entry
        rest["hints"] = [hints[n - 1] for n in chosen]
    return rest
