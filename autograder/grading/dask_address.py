"""What ``--cluster`` names: a scheduler that runs somewhere, or workers to start here."""

from __future__ import annotations

import importlib.util
import re
from dataclasses import dataclass

from autograder.errors import UsageError

_LOCAL = re.compile(r"local:(\d+)")
_SCHEDULER = re.compile(r"(?:(tcp|tls|ws|wss)://)?[\w.\-\[\]:]+:\d+")


@dataclass(frozen=True)
class ClusterAddress:
    """``local`` workers to start here, or, if that is 0, the address of a scheduler."""

    text: str
    local: int = 0


def parse_address(text: str) -> ClusterAddress:
    """Read what was given to ``--cluster``.

    Raises:
        UsageError: if it is neither, or if Dask is not installed.
    """
    local = _LOCAL.fullmatch(text)
    if local and int(local[1]) < 1:
        raise UsageError("--cluster local:N needs at least one worker, such as local:2.")
    if not local and not _SCHEDULER.fullmatch(text):
        raise UsageError(
            f"--cluster takes local:N or a scheduler's address such as tcp://lab-1:8786, "
            f"not {text!r}."
        )
    if importlib.util.find_spec("distributed") is None:
        raise UsageError(
            "--cluster needs Dask, which is not installed: "
            "pip install 'course-autograder[cluster]', or in the course's folder "
            "uv run --extra cluster autograder grade ..."
        )
    return ClusterAddress(text, int(local[1]) if local else 0)
