"""A zip for Moodle's "Upload multiple feedback files in a zip".

mod/assign/feedback/file/importziplib.php, ``is_valid_filename_for_import``: each part of a path is
cut at its first four underscores into full name, participant number, plugin type, plugin and the
rest; the number decides whose it is, the plugin must exist, and the rest is what the file will be
called. Names that begin with ``.`` or ``~`` are passed over. The number belongs to one assignment:
it stands in the names of the download and in the offline grading worksheet.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from autograder.gradebook.record import Record
from autograder.intake.names import claim_of
from autograder.reports.returning.parcel import Left, Page, Parcel

FILE = "feedback.html"


def moodle_files(pages: Sequence[Page]) -> Parcel:
    """The files of the zip; a student without a participant number is left out."""
    files: dict[str, bytes] = {}
    left = []
    for page in pages:
        owners = _participants(page.record)
        if not owners:
            left.append(
                Left(
                    page.record,
                    "no participant number is known; give Moodle's offline grading worksheet as "
                    "the class list, or grade the folder as Moodle gave it",
                )
            )
        for name, number in owners:
            files[f"{name}_{number}_assignsubmission_file_{FILE}"] = page.html.encode()
    return Parcel(files, left)


def _participants(record: Record) -> list[tuple[str, str]]:
    """Names and participant numbers of those who handed in, as Moodle's file names hold them."""
    claims = record.origin.claims or (claim_of(record.student),)
    claimed = [(claim.name, claim.number) for claim in claims if claim.number.isdigit()]
    known = [(p.name, p.number) for p in record.people if p.number.isdigit()]
    found = known if len(known) > len(claimed) else claimed
    return [(_plain(name), number) for name, number in found]


def _plain(name: str) -> str:
    """A name in which no underscore moves the number, and that is not taken for a hidden file."""
    plain = re.sub(r'[_/\\<>:"|?*\x00-\x1f\x7f]+', " ", name)
    return " ".join(plain.split()).lstrip(".~ ") or "student"
