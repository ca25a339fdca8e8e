"""Submissions for the tests, made of a few cells, and how they are read."""

import io
import json
import zipfile
from pathlib import Path

from autograder.course import Settings
from autograder.intake.submissions import Contents, Submission, read_submission


def notebook(*cells: str, **outputs: object) -> bytes:
    code = [
        {"cell_type": "code", "metadata": {}, "source": cell, "outputs": [], "execution_count": 1}
        for cell in cells
    ]
    return json.dumps({"cells": code, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}).encode()


def zipped(entries: dict[str, bytes]) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in entries.items():
            archive.writestr(name, data)
    return buffer.getvalue()


def read(path: Path, **limits: int) -> Contents:
    return read_submission(Submission("ada", path), Settings(**limits))


def read_zip(folder: Path, entries: dict[str, bytes], **limits: int) -> Contents:
    path = folder / "ada.zip"
    path.write_bytes(zipped(entries))
    return read(path, **limits)
