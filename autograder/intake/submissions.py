"""A submission, and what it holds: notebooks by chapter and saved responses, trusting nothing.

Who handed something in follows from the name of the file or folder, never from what is inside it.
"""

from __future__ import annotations

import hashlib
import json
import re
import unicodedata
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path, PurePosixPath

from autograder.course import Settings
from autograder.exchange.printable import JOINERS
from autograder.exchange.responses import Entry, keep_response
from autograder.intake.archive import shown
from autograder.intake.file_or_zip import is_notebook_name
from autograder.intake.handout import Handout, is_filled_in_by
from autograder.intake.notebook_reader import (
    Notebook,
    Unreadable,
    parse_json,
    read_notebook,
)
from autograder.intake.origin import Origin, Piece
from autograder.intake.read_files import read_files
from autograder.intake.wanted_files import Files, Kept

__all__ = [
    "Contents",
    "Notebook",
    "Submission",
    "Unreadable",
    "read_submission",
]

# One suffix of a copy, in only one way: with a choice of ways, a name that a student made up could
# take for ever to be found not to match.
_COPY = re.compile(r"(?:\(\d{1,9}\)|[ _-]copy[ _-]?\d{0,9})\Z", re.IGNORECASE)
_MAX_NAME = 100
_MAX_STEM = 255  # what a file system allows; a zip may claim 65,535
_MOST_NAMES = 4  # in one sentence
_MOST_COMPARED = 50  # copies of one notebook
_NO_TIME = datetime(1980, 1, 1, tzinfo=UTC)


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


@dataclass(frozen=True)
class _Copy:
    """One notebook of a chapter, of which there may be several."""

    path: PurePosixPath
    kept: Kept
    notebook: Notebook | None
    reason: str = ""
    untouched: bool = False


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
    for chapter, copies in sorted(_by_chapter(files, handout, notes).items()):
        if len(copies) > 1:
            copies = _with_earlier_handouts(copies, chapter, handout)
        best, *others = sorted(copies, key=_first_choice)
        if others:
            notes.append(_which_was_marked(best, others))
        if best.notebook is None:
            unreadable[chapter] = best.reason
        else:
            notebooks[chapter] = best.notebook
            notes += best.notebook.notes
    sidecars = _read_sidecars(files, notes)
    if not notebooks and not sidecars:
        raise Unreadable(_nothing(unreadable, files.notes))
    fingerprint = _fingerprint(notebooks, sidecars, unreadable)
    return Contents(notebooks, sidecars, unreadable, list(dict.fromkeys(notes)), fingerprint)


def _by_chapter(files: Files, handout: Handout, notes: list[str]) -> dict[str, list[_Copy]]:
    """The notebooks by chapter; those that count for nothing are named in a note."""
    by_chapter: dict[str, list[_Copy]] = {}
    useless = []
    for path in sorted(files.kept, key=_plainest):
        if not is_notebook_name(path.name):
            continue
        kept = files.kept[path]
        chapter, is_known = _chapter(path, handout)
        notebook, reason = None, ""
        try:
            notebook = read_notebook(kept.data, _text(path))
        except Unreadable as unreadable:
            reason = str(unreadable)
        if not is_known and notebook is not None and handout.questions:
            asked = handout.chapter_asked_in(notebook)
            if asked is not None:
                chapter = asked
            elif _stem(path).casefold() not in handout.stems and any(handout.questions.values()):
                useless.append(path)
        untouched = notebook is not None and handout.is_untouched(chapter, notebook)
        copy = _Copy(path, kept, notebook, reason, untouched)
        by_chapter.setdefault(chapter, []).append(copy)
    if useless:
        verb = "names" if len(useless) == 1 else "name"
        notes.append(
            f"{_list(useless)} {verb} no chapter and no question of the course; "
            "nothing in there counts."
        )
    return by_chapter


def _with_earlier_handouts(copies: list[_Copy], chapter: str, handout: Handout) -> list[_Copy]:
    """The copies, where those that another one fills in are known as untouched."""
    own = {
        copy.path: handout.own_cells(chapter, copy.notebook)
        for copy in copies[:_MOST_COMPARED]
        if copy.notebook is not None and not copy.untouched
    }
    answered = {copy.path for copy in copies if copy.notebook and copy.notebook.receipts}
    stale = {
        path
        for path in own.keys() - answered
        if any(is_filled_in_by(own[path], other) for other in own.values())
    }
    return [replace(copy, untouched=copy.untouched or copy.path in stale) for copy in copies]


def _first_choice(copy: _Copy) -> tuple[object, ...]:
    """Sort key: what can be read, what is the student's own, the newest, the plainest name."""
    time = copy.kept.time or _NO_TIME
    return (
        copy.notebook is None,
        copy.untouched,
        -copy.kept.order,
        -time.timestamp(),
        *_plainest(copy.path),
    )


def _which_was_marked(best: _Copy, others: Sequence[_Copy]) -> str:
    same = best.notebook is not None and all(
        other.notebook is not None and other.notebook.cells == best.notebook.cells
        for other in others
    )
    count = "two" if len(others) == 1 else f"{len(others) + 1:,}"
    was = "was" if len(others) == 1 else "were"
    why = "; they are the same" if same else ""
    if not same and any(other.untouched for other in others):
        left = "it is" if len(others) == 1 else "some are"
        why = f" ({left} as handed out)"
    return (
        f"There are {count} notebooks for one chapter: {_text(best.path)} was marked, "
        f"{_list([other.path for other in others])} {was} not{why}."
    )


def _list(paths: Sequence[PurePosixPath]) -> str:
    named = [_text(path) for path in paths[:_MOST_NAMES]]
    more = len(paths) - len(named)
    if more:
        return f"{', '.join(named)} and {more:,} more"
    return " and ".join([", ".join(named[:-1]), named[-1]] if len(named) > 1 else named)


def _nothing(unreadable: dict[str, str], notes: Sequence[str]) -> str:
    if unreadable:
        return next(iter(unreadable.values()))
    why = " ".join(notes[:2])
    return f"It holds no notebook{': ' + why if why else '; hand in the .ipynb files.'}"


def _chapter(path: PurePosixPath, handout: Handout) -> tuple[str, bool]:
    """The chapter that a notebook's name says, and whether the course has it."""
    stem = _stem(path)
    plain = re.sub(r"\W+", "_", stem.casefold())
    for chapter in sorted(handout, key=len, reverse=True):
        if chapter.casefold() in plain:
            return chapter, True
    name = re.sub(r"^(copy of )?\d+[ _-]+", "", _without_copy(stem), flags=re.IGNORECASE)
    return _text(PurePosixPath(name or "unnamed")), False


def _stem(path: PurePosixPath) -> str:
    """The name without ``.ipynb`` and what browsers add behind it."""
    name = path.name[:_MAX_STEM]
    cut = name.lower().rfind(".ipynb")
    return name[:cut] if cut >= 0 else path.stem[:_MAX_STEM]


def _plainest(path: PurePosixPath) -> tuple[bool, int, int, str]:
    """Sort key: the original before its copies, the outermost first, then by name."""
    stem = _stem(path).casefold()
    is_copy = _without_copy(stem) != stem or stem.startswith("copy of ")
    return (is_copy, len(path.parts), len(stem), str(path))


def _without_copy(stem: str) -> str:
    """The name without what file managers add to a copy: `` (1)``, ``-Copy2``, `` - Copy``."""
    stem = stem[:_MAX_STEM]
    while suffix := _COPY.search(stem):
        stem = stem[: suffix.start()].rstrip(" _-")
    return stem


def _read_sidecars(files: Files, notes: list[str]) -> dict[str, dict[str, Entry]]:
    """The saved responses by chapter: of the newest piece, the outermost first."""
    sidecars: dict[str, dict[str, Entry]] = {}
    left_out = []
    paths = [path for path in files.kept if not is_notebook_name(path.name)]
    for path in sorted(paths, key=lambda path: (-files.kept[path].order, *_plainest(path))):
        if path.stem in sidecars:
            continue
        try:
            sidecars[path.stem] = _read_sidecar(files.kept[path].data, _text(path))
        except Unreadable as reason:
            left_out.append(f"Saved responses were left out: {reason}")
    notes += left_out[:_MOST_NAMES]
    if len(left_out) > _MOST_NAMES:
        notes.append(f"So were {len(left_out) - _MOST_NAMES:,} more files of saved responses.")
    return sidecars


def _read_sidecar(data: bytes, name: str) -> dict[str, Entry]:
    document = parse_json(data, name)
    responses = document.get("responses") if isinstance(document, dict) else None
    if not isinstance(responses, dict):
        raise Unreadable(f"{name} holds no responses.")
    entries: dict[str, Entry] = {}
    for id, entry in responses.items():
        if isinstance(entry, dict) and "response" in entry:
            kept = keep_response(id, entry)
            entries |= {id: plain for id, plain in kept.items() if isinstance(plain, dict)}
    return entries


def _fingerprint(
    notebooks: dict[str, Notebook], sidecars: Mapping[str, object], unreadable: dict[str, str]
) -> str:
    matter = [
        {name: [book.cells, book.receipts] for name, book in notebooks.items()},
        sidecars,
        unreadable,
    ]
    return hashlib.sha256(json.dumps(matter, sort_keys=True).encode()).hexdigest()


def _text(path: PurePosixPath) -> str:
    return shown(str(path))
