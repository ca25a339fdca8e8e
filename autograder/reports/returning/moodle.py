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
from autograder.intake.download_names import claim_of
from autograder.intake.find_person import groups_of
from autograder.intake.name_spellings import plain_name
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
        unknown = [person.name for person in page.record.people if not person.number.isdigit()]
        if owners and unknown and _is_team(page.record):
            left.append(
                Left(page.record, f"no participant number of {' and '.join(unknown)} is known")
            )
        for name, number in owners:
            files[f"{name}_{number}_assignsubmission_file_{FILE}"] = page.html.encode()
    return Parcel(files, left)


def _participants(record: Record) -> list[tuple[str, str]]:
    """Names and participant numbers of those who handed in, as Moodle's file names hold them."""
    claims = record.origin.claims or (claim_of(record.student),)
    known = [(p.name, p.number) for p in record.people if p.number.isdigit()]
    if _is_team(record):  # the number in the name is the group's, and may be somebody else's
        return [(_plain(name), number) for name, number in known]
    claimed = [(claim.name, claim.number) for claim in claims if claim.number.isdigit()]
    found = known if len(known) > len(claimed) else claimed
    return [(_plain(name), number) for name, number in found]


def _is_team(record: Record) -> bool:
    """Whether Moodle named one piece of work by a group, not by one person."""
    claims = record.origin.claims
    groups = {group for person in record.people for group in groups_of(person)}
    return (
        len(claims) == 1
        and bool(claims[0].number)
        and (
            len(record.people) > 1 or (bool(record.people) and plain_name(claims[0].name) in groups)
        )
    )


def _plain(name: str) -> str:
    """A name in which no underscore moves the number, and that is not taken for a hidden file."""
    plain = re.sub(r'[_/\\<>:"|?*\x00-\x1f\x7f]+', " ", name)
    return " ".join(plain.split()).lstrip(".~ ") or "student"
