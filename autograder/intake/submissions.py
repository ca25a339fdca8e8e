"""Finds submissions and takes in what they hold, trusting nothing.

Who handed something in follows from the name of the file or folder, never from what is inside it.
"""

from __future__ import annotations

import hashlib
import json
import re
import unicodedata
from collections.abc import Collection
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any

from autograder.course import Settings
from autograder.errors import UsageError
from autograder.exchange.responses import keep_response
from autograder.intake.handed_in import read_files
from autograder.intake.notebook_reader import (
    Notebook,
    Unreadable,
    parse_json,
    read_notebook,
)
from autograder.intake.origin import Origin, Piece

__all__ = [
    "Contents",
    "Notebook",
    "Submission",
    "Unreadable",
    "find_submissions",
    "read_submission",
]

_NUMBERED = re.compile(r"\d{1,2}[ _-]+\w")
# One suffix of a copy, in only one way: with a choice of ways, a name that a student made up could
# take for ever to be found not to match.
_COPY = re.compile(r"(?:\(\d{1,9}\)|[ _-]copy[ _-]?\d{0,9})\Z", re.IGNORECASE)
_MAX_NAME = 100
_MAX_STEM = 255  # what a file system allows; a zip may claim 65,535


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
    sidecars: dict[str, dict[str, Any]] = field(default_factory=dict)
    unreadable: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    fingerprint: str = ""


def find_submissions(paths: Collection[Path], settings: Settings) -> list[Submission]:
    """The submissions at the given paths, each of them a submission or a folder of submissions.

    A folder is one submission if it holds numbered notebooks (``3_ransac.ipynb``) or a folder
    ``notebooks``; otherwise each of its entries is one, except names that start with ``.`` or
    ``_``. Nothing is opened here: a file that is no submission is found out when it is read.

    Raises:
        UsageError: if a path does not exist.
    """
    found: list[Path] = []
    for path in paths:
        if not path.exists():
            raise UsageError(
                f"{path} does not exist; give a submission or a folder of submissions."
            )
        path = path.resolve()
        if path.is_dir() and not _is_submission(path):
            found += sorted(
                entry for entry in path.iterdir() if not entry.name.startswith((".", "_"))
            )
        else:
            found.append(path)
    return _with_unique_names(list(dict.fromkeys(found)))


def student_name(path: Path) -> str:
    """The student's name as the file or folder name gives it, without control characters."""
    stem = path.stem if path.suffix.lower() in (".zip", ".ipynb") or path.is_file() else path.name
    text = unicodedata.normalize("NFC", stem.encode("utf-8", "replace").decode())
    text = "".join(c if c.isprintable() and c not in "/\\" else " " for c in text)
    return " ".join(text.split())[:_MAX_NAME].strip(". ") or "unnamed"


def read_submission(
    submission: Submission, settings: Settings, chapters: Collection[str] = ()
) -> Contents:
    """Read a submission's notebooks and saved responses.

    The chapter is the notebook's name after its number, without a copy's suffix; with the course's
    ``chapters`` given, it is the one whose name the notebook's contains, so that
    ``lovelace_3_RANSAC final.ipynb`` is found too.

    Raises:
        Unreadable: if nothing can be read; the sentence says why.
    """
    files = read_files(submission.path, settings)
    notes = [*submission.notes, *files.notes]
    notebooks: dict[str, Notebook] = {}
    unreadable: dict[str, str] = {}
    sidecars: dict[str, dict[str, Any]] = {}

    by_chapter: dict[str, list[PurePosixPath]] = {}
    for path in files.data:
        if path.suffix.lower() == ".ipynb":
            by_chapter.setdefault(_chapter(path, chapters), []).append(path)
    for chapter, copies in sorted(by_chapter.items()):
        first, *others = sorted(copies, key=_plainest)
        for other in others:
            notes.append(
                f"There are two notebooks for one chapter: {_text(first)} was marked, "
                f"{_text(other)} was not."
            )
        try:
            notebook = read_notebook(files.data[first], _text(first))
        except Unreadable as reason:
            unreadable[chapter] = str(reason)
        else:
            notebooks[chapter] = notebook
            notes += notebook.notes
    for path in sorted(files.data, key=_plainest):
        if path.suffix == ".json" and path.stem not in sidecars:
            try:
                sidecars[path.stem] = _read_sidecar(files.data[path], _text(path))
            except Unreadable as reason:
                notes.append(f"Saved responses were left out: {reason}")

    if not notebooks and not sidecars:
        raise Unreadable(
            next(iter(unreadable.values()), "It holds no notebook; hand in the .ipynb files.")
        )
    fingerprint = _fingerprint(notebooks, sidecars, unreadable)
    return Contents(notebooks, sidecars, unreadable, list(dict.fromkeys(notes)), fingerprint)


def _is_submission(folder: Path) -> bool:
    if any(_NUMBERED.match(path.name) for path in folder.glob("*.ipynb")):
        return True
    return any((folder / "notebooks").glob("*.ipynb"))


def _with_unique_names(paths: list[Path]) -> list[Submission]:
    """A second entry with a student's name becomes ``ada (2)``, and both say so."""
    by_name: dict[str, list[Path]] = {}
    for path in paths:
        by_name.setdefault(student_name(path).casefold(), []).append(path)
    submissions: list[Submission] = []
    taken = set(by_name)
    for path in paths:
        name = student_name(path)
        same = by_name[name.casefold()]
        notes: tuple[str, ...] = ()
        if len(same) > 1:
            names = ", ".join(_text(PurePosixPath(other.name)) for other in same)
            notes = (f"Several submissions are named {name} ({names}); each is marked by itself.",)
            number = same.index(path) + 1
            while number > 1 and f"{name} ({number})".casefold() in taken:
                number += 1
            if number > 1:
                name = f"{name} ({number})"
                taken.add(name.casefold())
        submissions.append(Submission(name, path, notes))
    return submissions


def _chapter(path: PurePosixPath, chapters: Collection[str]) -> str:
    plain = re.sub(r"\W+", "_", path.stem[:_MAX_STEM].casefold())
    for chapter in sorted(chapters, key=len, reverse=True):
        if chapter.casefold() in plain:
            return chapter
    stem = _without_copy(path.stem)
    return _text(PurePosixPath(re.sub(r"^(copy of )?\d+[ _-]+", "", stem, flags=re.IGNORECASE)))


def _plainest(path: PurePosixPath) -> tuple[bool, int, int, str]:
    """Sort key: the original before its copies, the outermost first, then by name."""
    stem = path.stem.casefold()
    is_copy = _without_copy(stem) != stem[:_MAX_STEM] or stem.startswith("copy of ")
    return (is_copy, len(path.parts), len(stem), str(path))


def _without_copy(stem: str) -> str:
    """The name without what file managers add to a copy: `` (1)``, ``-Copy2``, `` - Copy``."""
    stem = stem[:_MAX_STEM]
    while suffix := _COPY.search(stem):
        stem = stem[: suffix.start()].rstrip(" _-")
    return stem


def _read_sidecar(data: bytes, name: str) -> dict[str, Any]:
    document = parse_json(data, name)
    responses = document.get("responses") if isinstance(document, dict) else None
    if not isinstance(responses, dict):
        raise Unreadable(f"{name} holds no responses.")
    entries: dict[str, Any] = {}
    for id, entry in responses.items():
        if isinstance(entry, dict) and "response" in entry:
            entries |= keep_response(id, entry)
    return entries


def _fingerprint(
    notebooks: dict[str, Notebook], sidecars: dict[str, Any], unreadable: dict[str, str]
) -> str:
    matter = [
        {name: [book.cells, book.receipts] for name, book in notebooks.items()},
        sidecars,
        unreadable,
    ]
    return hashlib.sha256(json.dumps(matter, sort_keys=True).encode()).hexdigest()


def _text(path: PurePosixPath) -> str:
    clean = "".join(c if c.isprintable() else "?" for c in path.name)
    return clean if len(clean) <= _MAX_NAME else clean[: _MAX_NAME - 1] + "…"
