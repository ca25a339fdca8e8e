"""Reads git repositories that strangers made; a program of its own, with limits on memory.

Nothing of a repository is run, no hook, no filter, no program that its configuration names, since
no git is started. Objects are read by Dulwich, settings not at all. Links and borrowed objects
inside ``.git`` are refused, for they could lead to another student's repository.

Each line of standard input is a request in JSON, each line of standard output its answer.
"""

from __future__ import annotations

import base64
import json
import os
import stat
import sys
from typing import Any

from autograder.exchange.messages import Message

_MEMORY = 2**30
_MOST_COMMITS = 20_000
_MOST_FILES = 100_000
_MOST_ENTRIES = 20_000
_MOST_BYTES = 256 * 2**20


class _Refused(Exception):
    """The repository is not read; the text is the reason."""


def main() -> None:
    """Answer requests until there are no more."""
    try:
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    except ImportError:  # Windows
        pass
    for line in sys.stdin:
        request = json.loads(line)
        try:
            answer = _answer(request)
        except _Refused as refused:
            answer = {"reason": str(refused)}
        except Exception as error:  # whatever a broken repository makes of Dulwich
            answer = {"reason": f"the repository is damaged ({type(error).__name__})"}
        print(json.dumps(answer), flush=True)


def _answer(request: Message) -> Message:
    from dulwich.config import ConfigFile
    from dulwich.repo import Repo

    class Plain(Repo):
        """A repository whose own settings are not read: they may include any file."""

        def get_config(self) -> ConfigFile:
            return ConfigFile()

    path = os.fsdecode(base64.b64decode(request["path"]))
    _check(os.path.join(path, ".git"))
    with Plain(path) as repo:
        if "commit" in request:
            return {"files": _files(repo, request["commit"].encode(), request["suffixes"])}
        return _choose(repo, request["until"])


def _check(folder: str) -> None:
    """Refuse what leads out of the repository."""
    if not stat.S_ISDIR(os.lstat(folder).st_mode):
        raise _Refused("its .git is not a folder")
    count = 0
    for top, folders, files in os.walk(folder):
        for name in (*folders, *files):
            count += 1
            mode = os.lstat(os.path.join(top, name)).st_mode
            if not (stat.S_ISDIR(mode) or stat.S_ISREG(mode)):
                raise _Refused("its .git holds links")
        if count > _MOST_FILES:
            raise _Refused(f"its .git holds more than {_MOST_FILES} files")
    for name in ("objects/info/alternates", "commondir"):
        if os.path.exists(os.path.join(folder, name)):
            raise _Refused("it borrows objects from another repository")


def _choose(repo: Any, until: float | None) -> Message:
    """The last commit of the branch until a time, or the very last if there is none or no time."""
    head = repo[repo.head()]
    commit, later = head, 0
    while until is not None and commit.commit_time > until:
        later += 1
        if not commit.parents or later > _MOST_COMMITS:
            commit, later = head, 0
            break
        commit = repo[commit.parents[0]]
    return {
        "commit": commit.id.decode(),
        "time": commit.commit_time,
        "is_last": commit.id == head.id,
        "later": later,
    }


def _files(repo: Any, commit: bytes, suffixes: list[str]) -> list[Message]:
    found: list[Message] = []
    left = [_MOST_ENTRIES, _MOST_BYTES]
    _collect(repo, repo[commit].tree, "", suffixes, found, left, 0)
    return found


def _collect(
    repo: Any,
    tree: bytes,
    at: str,
    suffixes: list[str],
    found: list[Message],
    left: list[int],
    depth: int,
) -> None:
    for name, mode, sha in repo[tree].items():
        left[0] -= 1
        if left[0] < 0:
            raise _Refused(f"it holds more than {_MOST_ENTRIES} files")
        path = at + name.decode("utf-8", "replace").replace("/", "_")
        if stat.S_ISDIR(mode) and depth < 10:
            _collect(repo, sha, path + "/", suffixes, found, left, depth + 1)
        elif stat.S_ISREG(mode) and path.lower().endswith(tuple(suffixes)):
            data = repo[sha].data
            left[1] -= len(data)
            if left[1] < 0:
                raise _Refused("its notebooks are too large")
            found.append({"path": path, "data": base64.b64encode(data).decode()})


if __name__ == "__main__":
    main()
