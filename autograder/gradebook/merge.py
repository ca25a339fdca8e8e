"""Joining gradebooks in which several people marked: everything is kept, nothing is decided."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field

from autograder.gradebook.book import Gradebook
from autograder.gradebook.record import Override
from autograder.gradebook.view import SCHEME


@dataclass
class Merged:
    """What a merge did: counts, and what people have to decide, a sentence each."""

    decisions: int = 0
    notes: int = 0
    students: int = 0
    conflicts: list[str] = field(default_factory=list)


def merge(into: Gradebook, other: Gradebook) -> Merged:
    """Add to one gradebook what another one has more: marks by hand, overrides, notes, students.

    Where both have something new for the same question and it differs, neither counts until
    somebody decides. Merging the same again changes nothing.
    """
    done = Merged()
    _students(into, other, done)
    _decisions(into, other, done)
    here = {(note.student, note.text, note.made_at) for note in into.notes()}
    notes = [n for n in other.notes() if (n.student, n.text, n.made_at) not in here]
    into.add([], notes)
    done.notes = len(notes)
    ours, theirs = into.setting(SCHEME) or "", other.setting(SCHEME) or ""
    if theirs and not ours:
        into.set(SCHEME, theirs)
    elif theirs and ours != theirs:
        done.conflicts.append("The two accepted grading.toml files differ; the first one is kept.")
    return done


def _students(into: Gradebook, other: Gradebook, done: Merged) -> None:
    here = {record.student: record for record in into.records()}
    for record in other.records():
        known = here.get(record.student)
        if known is None:
            into.adopt(record)
            done.students += 1
        elif known.graded.fingerprint != record.graded.fingerprint:
            done.conflicts.append(
                f"{record.student}: the two gradebooks hold different work; the first one is kept."
            )


def _decisions(into: Gradebook, other: Gradebook, done: Merged) -> None:
    ours, theirs = into.decisions(), other.decisions()
    known = {_same(entry) for entry, _ in ours}
    shared = {_same(entry) for entry, _ in theirs}
    last_of_ours: dict[tuple[str, str], Override] = {}
    for entry, _ in ours:
        if _same(entry) not in shared:
            last_of_ours[entry.student, entry.question] = entry
    new: dict[tuple[str, str], list[tuple[Override, bool]]] = defaultdict(list)
    for entry, disputed in theirs:
        if _same(entry) not in known:
            new[entry.student, entry.question].append((entry, disputed))
    for place, entries in new.items():
        done.decisions += len(entries)
        mine, last = last_of_ours.get(place), entries[-1][0]
        if mine is None or last.says_the_same(mine):
            for entry, disputed in entries:
                into.add([] if disputed else [entry], [], [entry] if disputed else [])
            continue
        into.add([], [], [entry for entry, _ in entries])
        done.conflicts.append(
            f"{place[0]} {place[1]}: {_told(mine)}, {_told(last)}; decide with `autograder mark` "
            "or `override`."
        )


def _same(entry: Override) -> tuple[object, ...]:
    levels = tuple(sorted(entry.levels.items()))
    decided = (entry.student, entry.question, entry.points, entry.reason)
    return (*decided, entry.made_at, entry.author, levels)


def _told(entry: Override) -> str:
    points = "withdrew it" if entry.points is None else f"gave {entry.points:g}"
    return f"{entry.author or 'somebody'} {points}"
