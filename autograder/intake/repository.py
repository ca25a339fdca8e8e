"""The commit of a repository that counts, and the files that it held then.

GitHub Classroom takes the last commit before the due time, so contents and time are that commit's;
where all are later it is the very last one. Repositories are read by `repository_reader`, in a
process of its own.
"""

from __future__ import annotations

import base64
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path, PurePosixPath

from autograder.exchange.messages import Message
from autograder.intake import repository_reader
from autograder.intake.file_kinds import is_wanted
from autograder.intake.file_or_zip import DiskPlace, Place, place_of
from autograder.intake.limits_on_files import Files, Kept
from autograder.intake.notebook_reader import Unreadable
from autograder.intake.origin import Piece

_SECONDS = 120
_SUFFIXES = (".ipynb", ".json", ".txt")
_MOST_FILES = 50_000
_MOST_BYTES = 512 * 2**20


@dataclass(frozen=True)
class Commit:
    """The commit that counts: ``time`` in UTC, and how many of the branch came ``later``."""

    id: str
    time: datetime
    is_last: bool
    later: int


def choose_commits(
    repositories: Sequence[tuple[Place, datetime | None]],
) -> list[Commit | str]:
    """For each repository and due time its commit that counts, or why there is none."""
    with tempfile.TemporaryDirectory(prefix="autograder-git-") as folder:
        requests = []
        for number, (place, until) in enumerate(repositories):
            path = _on_disk(place, Path(folder) / str(number))
            limit = None if until is None else until.timestamp()
            requests.append({"path": _coded(path), "until": limit})
        answers = _ask(requests)
    chosen: list[Commit | str] = []
    for answer in answers:
        try:
            time = datetime.fromtimestamp(answer["time"], UTC)
            chosen.append(Commit(answer["commit"], time, answer["is_last"], answer["later"]))
        except (KeyError, ValueError, OverflowError, OSError):
            chosen.append(str(answer.get("reason", "its last commit has no time")))
    return chosen


def read_commit(piece: Piece, files: Files, order: int) -> None:
    """Add the wanted files of a commit.

    Raises:
        Unreadable: if the repository cannot be read any more.
        OSError: if it has gone.
    """
    place = place_of(Piece(piece.path, piece.inside))
    with tempfile.TemporaryDirectory(prefix="autograder-git-") as folder:
        path = _on_disk(place, Path(folder) / "0")
        request = {"path": _coded(path), "commit": piece.commit, "suffixes": _SUFFIXES}
        (answer,) = _ask([request])
    if "files" not in answer:
        raise Unreadable(f"The repository {piece.name} cannot be read: {answer['reason']}.")
    for entry in answer["files"]:
        path_inside = PurePosixPath(entry["path"])
        files.count()
        if is_wanted(path_inside):
            files.add(path_inside, Kept(base64.b64decode(entry["data"]), order))


def _on_disk(place: Place, folder: Path) -> Path:
    """The repository's folder; one in a zip is written out, its ``.git`` and nothing else."""
    if isinstance(place, DiskPlace):
        return place.path
    left = [_MOST_FILES, _MOST_BYTES]
    for child in place.children():
        if child.name == ".git" and child.is_folder:
            _write_out(child, folder / ".git", left)
    return folder


def _write_out(place: Place, target: Path, left: list[int]) -> None:
    target.mkdir(parents=True, exist_ok=True)
    for child in place.children():
        left[0] -= 1
        if left[0] < 0 or left[1] < 0 or child.name in (".", "..") or "\0" in child.name:
            return
        if child.is_folder:
            _write_out(child, target / child.name, left)
        elif not child.is_link:
            data = child.read(left[1])
            left[1] -= len(data)
            (target / child.name).write_bytes(data)


def _coded(path: Path) -> str:
    return base64.b64encode(os.fsencode(path)).decode()


def _ask(requests: Sequence[Message]) -> list[Message]:
    """The answer to each; a repository at which the reader dies is passed by."""
    answers: list[Message] = []
    while len(answers) < len(requests):
        rest = requests[len(answers) :]
        lines = "".join(json.dumps(request) + "\n" for request in rest)
        try:
            done = subprocess.run(
                [sys.executable, "-I", "-B", repository_reader.__file__],
                input=lines.encode(),
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                timeout=_SECONDS + len(rest),
                check=False,
            )
            told = done.stdout
        except subprocess.TimeoutExpired as late:
            told = late.stdout or b""
        answers += [
            json.loads(line) for line in told.splitlines(keepends=True) if line.endswith(b"\n")
        ]
        if len(answers) < len(requests):
            answers.append({"reason": "the repository is too large to be read"})
    return answers
