"""Which submissions were at work when the grader died, kept in a file beside the gradebook.

Whatever one submission does to the process that grades it, the run goes on at the next start: what
was at work then is graded last and alone. If the grader dies of it once more, it is known which
submission that was, and it is passed by for a person to mark.

Each line of the file is a list in JSON: ``["begun", key]``, ``["ended", key]`` or ``["died", key,
times]``. A line is on its way to the disk before the submission is read.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections import Counter
from pathlib import Path
from typing import Protocol

from autograder.errors import machine_error, refuse_link
from autograder.intake.changed_files import snapshot
from autograder.intake.submissions import Submission
from autograder.language import N_

try:
    import fcntl
except ImportError:  # Windows: there two graders of one gradebook may suspect each other's work
    fcntl = None  # type: ignore[assignment]

PASSED_BY = 2  # deaths, the last of them with nothing else at work
STOPPED_THE_GRADER = N_(  # as it is in the gradebook; translated where it is shown
    "This submission stopped the grader itself, and it was passed by; the points say nothing about "
    "the work. Mark it by hand, and report the failure."
)


class Watch(Protocol):
    """Told what is at work; says what was at work when the grader died before."""

    def deaths(self, submission: Submission) -> int:
        """How often the grader died while the submission was at work."""

    def begin(self, submission: Submission) -> None:
        """It is about to be read and graded."""

    def end(self, submission: Submission) -> None:
        """It was graded, and the grader lives."""


class Journal:
    """The file; use it as a context manager, or what was at work counts as a death.

    ``forget`` gives every submission another chance.

    Raises:
        MachineError: if the file cannot be written.
    """

    def __init__(self, path: Path, forget: bool = False) -> None:
        self._path = path
        self._at_work: set[str] = set()
        self._keys: dict[str, str] = {}
        self._deaths: Counter[str] = Counter()
        refuse_link(path)
        try:
            path.parent.mkdir(0o700, parents=True, exist_ok=True)  # others read no grades
            flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | getattr(os, "O_NOFOLLOW", 0)
            self._file = os.open(path, flags, 0o600)
            if not self._is_ours():
                return
            if not forget:
                self._deaths = _read(path)
            os.ftruncate(self._file, 0)
            for key, times in self._deaths.items():
                self._write(["died", key, times])
        except OSError as error:
            raise machine_error(error, str(path)) or error from None

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, *exception: object) -> None:
        for key in sorted(self._at_work):  # stopped, but not dead
            self._write(["ended", key])
        os.close(self._file)
        if not self._deaths:
            self._path.unlink(missing_ok=True)

    def deaths(self, submission: Submission) -> int:
        # No key is made, and kept for later, of each in a large class of which none ever died.
        return self._deaths[self._key(submission)] if self._deaths else 0

    def begin(self, submission: Submission) -> None:
        key = self._key(submission)
        self._at_work.add(key)
        self._write(["begun", key])

    def end(self, submission: Submission) -> None:
        key = self._key(submission)
        self._at_work.discard(key)
        if self._deaths[key] < PASSED_BY:
            del self._deaths[key]
            self._write(["died", key, 0])
        self._write(["ended", key])
        del self._keys[submission.student]

    def _key(self, submission: Submission) -> str:
        """The key of a submission, as its files were when it was asked for first."""
        if submission.student not in self._keys:
            self._keys[submission.student] = _key_of(submission)
        return self._keys[submission.student]

    def _write(self, line: list[str | int]) -> None:
        try:
            os.write(self._file, json.dumps(line).encode() + b"\n")
        except OSError as error:
            raise machine_error(error, str(self._path)) or error from None

    def _is_ours(self) -> bool:
        """Whether no other grader writes here now, whose work is not dead but under way."""
        if fcntl is None:
            return True
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return False
        return True


def _read(path: Path) -> Counter[str]:
    """The deaths that a journal knows, those of the last run included."""
    deaths: Counter[str] = Counter()
    begun: set[str] = set()
    for line in path.read_bytes().splitlines():
        try:
            word, key, *times = json.loads(line)
            if word == "begun":
                begun.add(key)
            elif word == "ended":
                begun.discard(key)
            else:
                deaths[key] = int(times[0])
        except (ValueError, TypeError, LookupError):  # the last line, half written
            continue
    deaths.update(begun)
    return +deaths


def _key_of(submission: Submission) -> str:
    """Names a student and the files handed in, without opening them."""
    seen = [submission.student]
    for path, state in snapshot([piece.path for piece in submission.pieces]).items():
        seen += [str(path), *map(str, state)]
    for piece in submission.pieces:
        seen += piece.inside
    return hashlib.sha256("\0".join(seen).encode("utf-8", "surrogateescape")).hexdigest()
