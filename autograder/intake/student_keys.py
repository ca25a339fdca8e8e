"""The key of each student in the gradebook: of several with one name each gets one of its own."""

from __future__ import annotations

from array import array
from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path

from autograder.exchange.printable import JOINERS
from autograder.intake.layouts.layout import Entry
from autograder.intake.long_list import LongList
from autograder.intake.names_in_sentences import shown
from autograder.intake.origin import Origin
from autograder.intake.submissions import Submission, student_name


def with_unique_keys(
    entries: Sequence[Entry], known: Mapping[tuple[str, str], str]
) -> LongList[Submission]:
    """Each entry with a key of its own: that of the gradebook, the name, or the name and a number.

    Of several with one name those that a system tells apart get its number behind the name; of the
    others the second becomes ``ada (2)``, and all say so.
    """
    # Of the names of a large class only digests are kept: all of them would take much room.
    names = array("q", (_digest(student_name(entry.key)) for entry in entries))
    namesakes = _namesakes(entries, names)
    every_name = set(names) if namesakes or known else set()
    taken = {_digest(key) for key in known.values()}
    used: set[str] = set()
    submissions: LongList[Submission] = LongList(Submission)
    for number, entry in enumerate(entries):
        name = student_name(entry.key)
        same = namesakes.get(_alike(name), {number: entry})
        notes = entry.notes
        key = known.get((entry.origin.layout, entry.origin.prefix))
        if key in used:
            key = None
        elif key is not None:
            used.add(key)
        if len(same) > 1 and not entry.apart:
            called = ", ".join(shown(other.origin.prefix) for other in list(same.values())[:5])
            notes = (
                f"Several submissions are named {name} ({called}); each is marked by itself.",
                *notes,
            )
        if key is None:
            place = list(same).index(number) + 1
            first = place == 1 and not entry.apart
            key = name if len(same) == 1 or first else f"{name} ({entry.apart or place})"
            another = 2
            wanted = key
            while _digest(key) in taken or (key != name and _digest(key) in every_name):
                key = f"{wanted} ({another})"
                another += 1
            taken.add(_digest(key))
        submissions.append(Submission(key, _path(entry.origin), notes, entry.origin))
    return submissions


def _namesakes(entries: Sequence[Entry], names: Sequence[int]) -> dict[str, dict[int, Entry]]:
    """The entries that share a name with another, by that name and by their number."""
    repeated = {a for a, b in pairwise(sorted(names)) if a == b}
    by_name: dict[str, dict[int, Entry]] = {}
    for number, entry in enumerate(entries) if repeated else ():
        if names[number] in repeated:
            by_name.setdefault(_alike(student_name(entry.key)), {})[number] = entry
    return by_name


def _digest(name: str) -> int:
    """A number in place of a name, the same for names that are alike."""
    return hash(_alike(name))


def _alike(name: str) -> str:
    return "".join(c for c in name if c not in JOINERS).casefold()


def _path(origin: Origin) -> Path:
    return origin.pieces[0].path
