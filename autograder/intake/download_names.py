"""The names that learning systems give to files and folders, and what they say.

Moodle: mod/assign/classes/downloader.php (``clean_filename`` of ``First Last_NUMBER``, underscores
in names become spaces; a group's name and ``-`` may come first), then ``_assignsubmission_PLUGIN_``
as a folder or as the beginning of a file's name, without the last ``_`` from 4.1.
Canvas: lib/content_zipper.rb (``lastfirst[_LATE]_USER_FILE_name``, letters of any script and
underscores, ``anon_CODE`` in place of name and number for an anonymous assignment).
Blackboard: "Download submissions" (``ASSIGNMENT_login_attempt_2026-11-01-12-30-05_name``).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from autograder.intake.origin import Claim


@dataclass(frozen=True)
class SystemName:
    """What a name says: whose, the part that is one's own, and the rest, the student's file name.

    ``prefix`` is the same for everything that one student handed in at one time.
    """

    system: str
    prefix: str
    claim: Claim
    rest: str = ""
    plugin: str = ""  # Moodle: file, onlinetext, comments
    late: bool = False
    attempt: str = ""  # Blackboard: the time as it is written
    file: int = 0  # Canvas: the file's number; a later file has a larger one


_MOODLE = re.compile(
    r"(?P<name>[^/]+?)(?:_(?P<number>\d+))?_assignsubmission_(?P<plugin>[a-z]+)(?:_(?P<rest>.*))?",
    re.DOTALL,
)
_CANVAS = re.compile(
    r"(?P<name>[^\W_](?:\w*?))(?P<late>_LATE)?_(?P<id>\d+)"
    r"_(?:(?P<file>\d+)_(?P<rest>.+)|(?P<text>text|link)\.html)",
    re.DOTALL,
)
_CANVAS_ANONYMOUS = re.compile(
    r"(?P<late>LATE_)?anon_(?P<code>[A-Za-z0-9]{2,20})_(?:(?P<file>\d+)_(?P<rest>.+)|(?:text|link)\.html)",
    re.DOTALL,
)
_BLACKBOARD = re.compile(
    r"(?P<assignment>.+)_(?P<login>[^_]+)_attempt_"
    r"(?P<time>\d{4}-\d\d-\d\d-\d\d-\d\d-\d\d)(?:_(?P<rest>.+)|(?P<side>\.txt))?",
    re.DOTALL,
)


def moodle_name(name: str) -> SystemName | None:
    """``Ada Lovelace_12345_assignsubmission_file_submission.zip`` or such a folder."""
    found = _MOODLE.fullmatch(name)
    if found is None:
        return None
    number = found["number"] or ""
    claim = Claim(name=found["name"], number=number)
    prefix = f"{found['name']}_{number}" if number else found["name"]
    return SystemName("moodle", prefix, claim, found["rest"] or "", found["plugin"])


def canvas_name(name: str) -> SystemName | None:
    """``lovelaceada_LATE_98765_4711_submission-1.zip`` or ``anon_x7Yz3_4711_submission.zip``."""
    found = _CANVAS_ANONYMOUS.fullmatch(name)
    if found is not None:
        claim, prefix = Claim(called=f"anon_{found['code']}"), f"anon_{found['code']}"
    else:
        found = _CANVAS.fullmatch(name)
        if found is None:
            return None
        claim = Claim(name=found["name"], id=found["id"])
        prefix = f"{found['name']}_{found['id']}"
    file = int(found["file"] or 0) if len(found["file"] or "") < 20 else 0
    rest = found["rest"] or "text.html"
    return SystemName("canvas", prefix, claim, rest, late=bool(found["late"]), file=file)


def blackboard_name(name: str) -> SystemName | None:
    """``Exercise 3_ada_attempt_2026-11-01-12-30-05_submission.zip``, or its ``.txt``."""
    found = _BLACKBOARD.fullmatch(name)
    if found is None:
        return None
    claim = Claim(login=found["login"])
    prefix = f"{found['assignment']}_{found['login']}"
    return SystemName("blackboard", prefix, claim, found["rest"] or "", attempt=found["time"])


def claim_of(name: str) -> Claim:
    """What the name of a submission says of whose it is, whatever system gave it."""
    for read in (moodle_name, canvas_name, blackboard_name):
        if found := read(name):
            return found.claim
    return Claim(called=name)


def rest_of(name: str) -> str:
    """The student's own file name, without what the system put before it."""
    for read in (moodle_name, canvas_name, blackboard_name):
        found = read(name)
        if found is not None and found.rest:
            return found.rest
    return name
