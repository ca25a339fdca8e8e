"""Where the parts of a course stand, relative to its root."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

NOTEBOOKS = Path("notebooks")  # as students get them, and the packages that they import
MASTERS = NOTEBOOKS / "source"
QUESTIONS = NOTEBOOKS / "questions"
SOLUTIONS = Path("solutions")  # the references, mistakes and cases
ANSWERS = SOLUTIONS / "answers"
SOLVED = SOLUTIONS / "notebooks"
DATA = Path("data")
# What a notebook needs beside its folders, to say the numbers and the language that students saw.
VISIBLE_FILES = ("pyproject.toml", "places.toml")


def student_notebooks(root: Path) -> list[Path]:
    """The notebooks of a course as students get them, by name."""
    return sorted((root / NOTEBOOKS).glob("*.ipynb"))


def readable_notebooks(paths: Iterable[Path]) -> Iterator[dict[str, Any]]:
    """The notebooks among files, as read: one that a merge has damaged is left out.

    A student's repository holds their own, which are named as unreadable where they are graded.
    """
    for path in paths:
        try:
            notebook = json.loads(path.read_text(encoding="utf-8-sig"))
            cells = [
                {
                    **cell,
                    "cell_type": str(cell["cell_type"]),
                    "metadata": dict(cell.get("metadata") or {}),
                    "source": "".join(cell["source"]),
                }
                for cell in notebook["cells"]
            ]
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            continue
        yield {**notebook, "cells": cells}


def cell_id(question: str, part: str) -> str:
    """The id of one of a question's cells: its ``question``, ``ask``, ``response`` or ``check``."""
    return f"{question.replace('.', '-')}-{part}"
