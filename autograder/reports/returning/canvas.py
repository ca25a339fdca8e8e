"""A zip for Canvas's "Upload submissions" (Gradebook, menu of the assignment).

app/models/abstract_assignment.rb, ``infer_comment_context_from_filename``: without ``LATE`` and the
name of a group, the first two parts between underscores that are all digits are the user and the
file that was handed in (after ``anon_`` it is a code and the file); the file must belong to the
submission. The comment's attachment is then shown under the name of *that* file, whatever is
uploaded. So feedback on a zip is a zip with the page inside, and feedback on a notebook a notebook:
a page called ``submission.zip`` would not open.
"""

from __future__ import annotations

import io
import json
import re
import zipfile
from collections.abc import Iterator, Sequence
from pathlib import PurePath

from autograder.gradebook.record import Record
from autograder.intake.download_names import SystemName, canvas_name
from autograder.reports.returning.parcel import Left, Page, Parcel

FILE = "feedback.html"


def canvas_files(pages: Sequence[Page]) -> Parcel:
    """The files of the zip; work that did not come from Canvas is left out."""
    files: dict[str, bytes] = {}
    left = []
    for page in pages:
        name = _handed_in_as(page.record)
        if name is None:
            left.append(
                Left(
                    page.record,
                    "it has no name that Canvas gave: Canvas finds the student by the numbers in "
                    "it; grade the files as they were downloaded",
                )
            )
            continue
        files[name] = _as_kind(PurePath(name).suffix.casefold(), page.html)
    return Parcel(files, left)


def _handed_in_as(record: Record) -> str | None:
    """The name of the newest file of a submission, as Canvas gave it."""
    found = [
        (parsed.file, name)
        for name in _names(record)
        if (parsed := canvas_name(name)) is not None and _canvas_takes(name, parsed)
    ]
    return max(found)[1] if found else None


def _names(record: Record) -> Iterator[str]:
    for piece in record.origin.pieces:
        yield piece.path.name
        yield from (entry.rstrip("/").rpartition("/")[2] for entry in piece.inside)
    yield record.graded.submission.path.name


def _canvas_takes(name: str, parsed: SystemName) -> bool:
    """Whether Canvas reads the same two numbers out of the name."""
    parts = [part for part in name.split("_") if part != "LATE"]
    if parts[0] == "anon":
        return parts[2] == str(parsed.file)
    numbers = [part for part in parts if re.fullmatch(r"\d+", part)]
    return numbers[:2] == [parsed.claim.id, str(parsed.file)]


def _as_kind(suffix: str, html: str) -> bytes:
    """The page as a file of the kind that was handed in."""
    if suffix == ".zip":
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr(FILE, html)
        return packed.getvalue()
    if suffix == ".ipynb":
        body = html[html.index("<header>") : html.index("</body>")]
        cell = {"cell_type": "markdown", "id": "feedback", "metadata": {}, "source": body}
        notebook = {"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": [cell]}
        return json.dumps(notebook).encode()
    return html.encode()
