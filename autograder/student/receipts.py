"""Receipts: what was answered, readable in the saved outputs of a notebook.

The file beside the notebook is the truth. A receipt stands in for it where that is lost.
"""

from __future__ import annotations

import os
from pathlib import Path

from autograder.course import Chapter, Course
from autograder.exchange.responses import RECEIPT, Entry
from autograder.intake.notebook_reader import Unreadable, read_notebook
from autograder.questions.registry import kind_of
from autograder.student.course_path import notebooks_folder

__all__ = ["RECEIPT", "receipt", "rescued_entries"]


def receipt(id: str, response: object) -> dict[str, object]:
    """The output that stands for a response."""
    return {"question": id, "response": response}


def rescued_entries(course: Course, chapter: Chapter) -> dict[str, Entry]:
    """What the chapter's notebooks show as answered.

    Nothing where ``AUTOGRADER_RESPONSES`` names a folder: whoever sets it wants to start empty.
    """
    if os.environ.get("AUTOGRADER_RESPONSES"):
        return {}
    found: dict[str, object] = {}
    for path in _notebooks(notebooks_folder(course.root), chapter):
        try:
            found |= read_notebook(path.read_bytes()).receipts
        except (Unreadable, OSError):
            continue
    entries: dict[str, Entry] = {}
    for question in chapter.questions:
        response = found.get(question.id)
        kind = kind_of(question)
        if kind.fits(question, response):
            untouched = kind.is_untouched(question, response)
            status = "not attempted" if untouched else "recorded"
            entries[question.id] = {
                "kind": question.kind,
                "response": response,
                "understood": "",
                "status": status,
                "points": 0.0,
                "attempts": 0,
            }
    for prediction in chapter.predictions:
        if prediction.fits(found.get(prediction.id)):
            entries[prediction.id] = {
                "kind": "prediction",
                "response": found[prediction.id],
                "status": "recorded",
            }
    return entries


def _notebooks(folder: Path, chapter: Chapter) -> list[Path]:
    """The chapter's notebooks, the one that was saved last at the end."""
    paths = [path for path in folder.glob("*.ipynb") if chapter.name in path.stem]
    return sorted(paths, key=lambda path: path.stat().st_mtime)
