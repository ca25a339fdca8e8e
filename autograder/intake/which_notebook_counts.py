"""Which notebook counts for which chapter, where names say little or there are copies."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import PurePosixPath

from autograder.intake.file_kinds import is_notebook_name
from autograder.intake.handout import Handout, is_filled_in_by
from autograder.intake.limits_on_files import Files, Kept
from autograder.intake.names_in_sentences import MOST_NAMES, shown_path
from autograder.intake.notebook_reader import (
    Notebook,
    Unreadable,
    read_notebook,
)

# One suffix of a copy, in only one way: with a choice of ways, a name that a student made up could
# take for ever to be found not to match.
_COPY = re.compile(r"(?:\(\d{1,9}\)|[ _-]copy[ _-]?\d{0,9})\Z", re.IGNORECASE)
_MAX_STEM = 255  # what a file system allows; a zip may claim 65,535
_MOST_COMPARED = 50  # copies of one notebook
_NO_TIME = datetime(1980, 1, 1, tzinfo=UTC)


@dataclass(frozen=True)
class Copy:
    """One notebook of a chapter, of which there may be several."""

    path: PurePosixPath
    kept: Kept
    notebook: Notebook | None
    reason: str = ""
    untouched: bool = False


def by_chapter(files: Files, handout: Handout, notes: list[str]) -> dict[str, list[Copy]]:
    """The notebooks by chapter; those that count for nothing are named in a note."""
    by_chapter: dict[str, list[Copy]] = {}
    useless = []
    for path in sorted(files.kept, key=plainest_name):
        if not is_notebook_name(path.name):
            continue
        kept = files.kept[path]
        chapter, is_known = _chapter(path, handout)
        notebook, reason = None, ""
        try:
            notebook = read_notebook(kept.data, shown_path(path))
        except Unreadable as unreadable:
            reason = str(unreadable)
        if not is_known and notebook is not None and handout.questions:
            asked = handout.chapter_asked_in(notebook)
            if asked is not None:
                chapter = asked
            elif _stem(path).casefold() not in handout.stems and any(handout.questions.values()):
                useless.append(path)
        untouched = notebook is not None and handout.is_untouched(chapter, notebook)
        copy = Copy(path, kept, notebook, reason, untouched)
        by_chapter.setdefault(chapter, []).append(copy)
    if useless:
        verb = "names" if len(useless) == 1 else "name"
        notes.append(
            f"{_list(useless)} {verb} no chapter and no question of the course; "
            "nothing in there counts."
        )
    return by_chapter


def with_earlier_handouts(copies: list[Copy], chapter: str, handout: Handout) -> list[Copy]:
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


def first_choice(copy: Copy) -> tuple[object, ...]:
    """Sort key: what can be read, what is the student's own, the newest, the plainest name."""
    time = copy.kept.time or _NO_TIME
    return (
        copy.notebook is None,
        copy.untouched,
        -copy.kept.order,
        -time.timestamp(),
        *plainest_name(copy.path),
    )


def which_was_marked(best: Copy, others: Sequence[Copy]) -> str:
    """The sentence that says which of several notebooks for one chapter counts."""
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
        f"There are {count} notebooks for one chapter: {shown_path(best.path)} was marked, "
        f"{_list([other.path for other in others])} {was} not{why}."
    )


def _list(paths: Sequence[PurePosixPath]) -> str:
    named = [shown_path(path) for path in paths[:MOST_NAMES]]
    more = len(paths) - len(named)
    if more:
        return f"{', '.join(named)} and {more:,} more"
    return " and ".join([", ".join(named[:-1]), named[-1]] if len(named) > 1 else named)


def _chapter(path: PurePosixPath, handout: Handout) -> tuple[str, bool]:
    """The chapter that a notebook's name says, and whether the course has it."""
    stem = _stem(path)
    plain = re.sub(r"\W+", "_", stem.casefold())
    for chapter in sorted(handout, key=len, reverse=True):
        if chapter.casefold() in plain:
            return chapter, True
    name = re.sub(r"^(copy of )?\d+[ _-]+", "", _without_copy(stem), flags=re.IGNORECASE)
    return shown_path(PurePosixPath(name or "unnamed")), False


def _stem(path: PurePosixPath) -> str:
    """The name without ``.ipynb`` and what browsers add behind it."""
    name = path.name[:_MAX_STEM]
    cut = name.lower().rfind(".ipynb")
    return name[:cut] if cut >= 0 else path.stem[:_MAX_STEM]


def plainest_name(path: PurePosixPath) -> tuple[bool, int, int, str]:
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
