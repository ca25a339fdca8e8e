"""One folder a student, for systems that take no zip of feedback."""

from __future__ import annotations

import re
from collections.abc import Sequence

from autograder.gradebook.record import Record
from autograder.gradebook.student_names import names_of
from autograder.reports.returning.parcel import Page, Parcel
from autograder.reports.whole_files import file_name

FILE = "feedback.html"


def plain_files(pages: Sequence[Page]) -> Parcel:
    """``Ada Lovelace (ada)/feedback.html``; nobody is left out."""
    called = names_of([page.record for page in pages])
    files: dict[str, bytes] = {}
    taken: set[str] = set()
    for page in pages:
        folder = file_name(_folder(page.record, called[page.record.student]))
        if folder.casefold() in taken:
            folder = file_name(f"{folder} {page.record.student}")
        taken.add(folder.casefold())
        files[f"{folder}/{FILE}"] = page.html.encode()
    return Parcel(files)


def _folder(record: Record, name: str) -> str:
    logins = [person.login or person.sis_id or person.id for person in record.people]
    apart = ", ".join(filter(None, logins))
    whole = f"{record.name} ({apart})" if apart else name
    return re.sub(r'[<>:"/\\|?*]', "_", whole)
