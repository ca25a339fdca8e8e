"""A submission, and what it holds: notebooks by chapter and saved responses, trusting nothing.

Who handed something in follows from the name of the file or folder, never from what is inside it.
"""

from __future__ import annotations

import hashlib
import json
import unicodedata
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from autograder.course import Settings
from autograder.exchange.printable import JOINERS
from autograder.exchange.responses import Entry
from autograder.intake.handout import Handout
from autograder.intake.notebook_reader import (
    Notebook,
    Unreadable,
)
from autograder.intake.origin import Origin, Piece
from autograder.intake.read_files import read_files
from autograder.intake.sidecars import read_sidecars
from autograder.intake.which_notebook_counts import (
    by_chapter,
    first_choice,
    which_was_marked,
    with_earlier_handouts,
)

__all__ = [
    "Contents",
    "Notebook",
    "Submission",
    "Unreadable",
    "read_submission",
]

_MAX_NAME = 100


@dataclass(frozen=True)
class Submission:
    """What one student handed in: a zip, a folder or one notebook, at ``path``.

    ``student`` is the key in the gradebook; ``origin`` says what the download tells about whose it
    is, when it was handed in, and which pieces it has if it is not all at ``path``.
    """

    student: str
    path: Path
    notes: tuple[str, ...] = ()
    origin: Origin = field(default_factory=Origin)

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """Everything that belongs to it."""
        return self.origin.pieces or (Piece(self.path),)


@dataclass(frozen=True)
class Contents:
    """What was read from a submission.

    ``notebooks`` and ``unreadable`` (a sentence) are by chapter; ``sidecars`` are the saved
    responses, chapter -> question id -> entry with a ``response``; ``notes`` say what was odd.
    ``fingerprint`` is the same exactly when everything that can change a mark is the same.
    """

    notebooks: dict[str, Notebook]
    sidecars: dict[str, dict[str, Entry]] = field(default_factory=dict)
    unreadable: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    fingerprint: str = ""


def student_name(name: str) -> str:
    """A student's name from the name of a file or folder, without control characters.

    The marks that join letters and emoji stay; those that turn the direction of writing go.
    """
    text = unicodedata.normalize("NFC", name.encode("utf-8", "replace").decode())
    text = "".join(c for c in text if c in JOINERS or unicodedata.category(c) != "Cf")
    text = "".join(c if c in JOINERS or (c.isprintable() and c not in "/\\") else " " for c in text)
    return " ".join(text.split())[:_MAX_NAME].strip(". " + JOINERS) or "unnamed"


def read_submission(
    submission: Submission, settings: Settings, chapters: Collection[str] = ()
) -> Contents:
    """Read a submission's notebooks and saved responses.

    The chapter is the notebook's name after its number, without a copy's suffix; with the course's
    ``chapters`` given, it is the one whose name the notebook's contains, so that
    ``lovelace_3_RANSAC final.ipynb`` is found too. If ``chapters`` is a `Handout`, a notebook whose
    name says nothing belongs to the chapter whose questions it asks, and of two notebooks for one
    chapter the one that differs from what was handed out counts; then the newest.

    Raises:
        Unreadable: if nothing can be read; the sentence says why.
    """
    files = read_files(submission.pieces, settings)
    notes = [*submission.notes, *files.notes]
    handout = chapters if isinstance(chapters, Handout) else Handout(dict.fromkeys(chapters, ()))
    notebooks: dict[str, Notebook] = {}
    unreadable: dict[str, str] = {}
    for chapter, copies in sorted(by_chapter(files, handout, notes).items()):
        if len(copies) > 1:
            copies = with_earlier_handouts(copies, chapter, handout)
        best, *others = sorted(copies, key=first_choice)
        if others:
            notes.append(which_was_marked(best, others))
        if best.notebook is None:
            unreadable[chapter] = best.reason
        else:
            notebooks[chapter] = best.notebook
            notes += best.notebook.notes
    sidecars = read_sidecars(files, notes)
    if not notebooks and not sidecars:
        raise Unreadable(_nothing(unreadable, files.notes))
    fingerprint = _fingerprint(notebooks, sidecars, unreadable)
    return Contents(notebooks, sidecars, unreadable, list(dict.fromkeys(notes)), fingerprint)


def _nothing(unreadable: dict[str, str], notes: Sequence[str]) -> str:
    if unreadable:
        return next(iter(unreadable.values()))
    why = " ".join(notes[:2])
    return f"It holds no notebook{': ' + why if why else '; hand in the .ipynb files.'}"


def _fingerprint(
    notebooks: dict[str, Notebook], sidecars: Mapping[str, object], unreadable: dict[str, str]
) -> str:
    matter = [
        {name: [book.cells, book.receipts] for name, book in notebooks.items()},
        sidecars,
        unreadable,
    ]
    return hashlib.sha256(json.dumps(matter, sort_keys=True).encode()).hexdigest()
