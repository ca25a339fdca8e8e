"""Pairs of submissions whose code is suspiciously alike, by their fingerprints.

What the handout gave to everybody, and what a large part of the class shares anyway, do not count.
Students are compared with each other and with what is public: the solved notebooks and the
references. A pair is a reason to read both, no verdict.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from autograder.reports.code_fingerprints import Code

COMMON_SHARE = 0.2  # of the class; what more students have is how one does it
FEWEST = 8  # fingerprints of a student's own, below which nothing can be said


@dataclass(frozen=True)
class Pair:
    """Two students, or a student and a public source, whose code is alike.

    ``share`` is that of the one whose own code is shorter, or of the student; ``first_share`` and
    ``second_share`` are how much of each one's own work the other has too (None for a public
    source), and ``fingerprints`` how many places that are. ``lines`` are one such place in each.
    """

    first: str
    second: str
    share: float
    fingerprints: int
    lines: tuple[str, str]
    first_share: float = 0.0
    second_share: float | None = None


def similar_pairs(
    students: Mapping[str, Code],
    handout: Code,
    least: float = 0.5,
    progress: Callable[[], None] = lambda: None,
    public: Mapping[str, Code] | None = None,
) -> list[Pair]:
    """The pairs that share at least ``least`` of the shorter one's own code, most alike first.

    With a source of ``public`` it is that share of the student's own code.
    """
    own = _own(students, handout)
    by_mark: dict[int, list[str]] = {}
    for student, marks in own.items():
        for mark in marks:
            by_mark.setdefault(mark, []).append(student)
    shared: Counter[tuple[str, str]] = Counter()
    example: dict[tuple[str, str], int] = {}
    for student in sorted(own):
        for mark in own[student]:
            for other in by_mark[mark]:
                if student < other:
                    shared[student, other] += 1
                    example.setdefault((student, other), mark)
        progress()
    pairs = []
    for (first, second), count in shared.items():
        shorter = min(len(own[first]), len(own[second]))
        if shorter >= FEWEST and count >= least * shorter:
            mark = example[first, second]
            lines = (students[first].places[mark], students[second].places[mark])
            shares = count / len(own[first]), count / len(own[second])
            pairs.append(Pair(first, second, count / shorter, count, lines, *shares))
    for student, marks in own.items():
        for name, source in (public or {}).items():
            both = marks & source.places.keys()
            if len(marks) >= FEWEST and len(both) >= least * len(marks):
                share, mark = len(both) / len(marks), min(both)
                lines = (students[student].places[mark], source.places[mark])
                pairs.append(Pair(student, name, share, len(both), lines, share))
    return sorted(pairs, key=lambda pair: (-pair.share, -pair.fingerprints, pair.first))


def shared_by_many(students: Mapping[str, Code], handout: Code) -> list[str]:
    """Those of whom nothing can be said: what they wrote is that of a large part of the class.

    So it is where there is one way to write something, and where a solution has gone round.
    """
    own = _own(students, handout)
    return [
        student
        for student, code in students.items()
        if len(own[student]) < FEWEST <= len(code.places.keys() - handout.places.keys())
    ]


def _own(students: Mapping[str, Code], handout: Code) -> dict[str, set[int]]:
    """The fingerprints of each student that neither the handout nor many others have."""
    owners = Counter(mark for code in students.values() for mark in code.places)
    # Two may always share something, however small the class is.
    common = max(2, COMMON_SHARE * len(students))
    return {
        student: {
            mark for mark in code.places if mark not in handout.places and owners[mark] <= common
        }
        for student, code in students.items()
    }


def handout_cells(notebooks: Sequence[Mapping[str, object]]) -> list[str]:
    """The code cells of the untouched notebooks, as parsed from their JSON."""
    cells = []
    for notebook in notebooks:
        entries = notebook.get("cells", [])
        assert isinstance(entries, list)
        cells += ["".join(cell["source"]) for cell in entries if cell.get("cell_type") == "code"]
    return cells
