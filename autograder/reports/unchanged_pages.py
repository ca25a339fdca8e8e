"""Whether a page of feedback would say anything new: told by its last line, not by writing it."""

from __future__ import annotations

import hashlib
import secrets
from dataclasses import replace
from functools import cache
from pathlib import Path

from autograder.gradebook import Gradebook, Record
from autograder.intake.submissions import Submission
from autograder.reports.feedback_html import Feedback

_KEY = "page key"


class Fingerprints:
    """The last lines of pages: a digest of everything that their text depends on.

    The digest is keyed by a number that only the gradebook has. A student who reads it learns
    nothing, not even whether a guess of what else went into it is right.
    """

    def __init__(self, shared: Feedback, book: Gradebook) -> None:
        key = book.setting(_KEY)
        if key is None:
            key = secrets.token_hex(32)
            book.set(_KEY, key)
        said = f"{shared.course.version}\0{shared.explanations}\0{_pages_code()}"
        self._start = hashlib.blake2b(said.encode(), key=bytes.fromhex(key), digest_size=16)

    def of(self, record: Record) -> str:
        """The line for a student's page."""
        # Where the work lies and how long it took are not told; nor is how it was isolated, but
        # that it was not.
        graded = replace(
            record.graded,
            submission=Submission(record.student, Path(), origin=replace(record.origin, pieces=())),
            seconds=0.0,
            isolation="",
        )
        isolation = record.isolation if record.isolation.startswith("none") else ""
        told = replace(record, graded=graded, isolation=isolation, run=0)
        digest = self._start.copy()
        digest.update(repr(told).encode("utf-8", "replace"))
        return f"<!-- {digest.hexdigest()} -->\n"


def has_fingerprint(path: Path, line: str) -> bool:
    """Whether the file ends in the line, so that all of it was written with it."""
    end = line.encode()
    try:
        with path.open("rb") as file:
            file.seek(-len(end), 2)
            return file.read() == end
    except OSError:  # there is none, or it is shorter
        return False


@cache
def _pages_code() -> str:
    """A digest of what makes pages of records: another version may say it otherwise."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()
