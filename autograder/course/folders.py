"""Where the parts of a course stand, relative to its root."""

from __future__ import annotations

from pathlib import Path

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


def cell_id(question: str, part: str) -> str:
    """The id of one of a question's cells: its ``question``, ``ask``, ``response`` or ``check``."""
    return f"{question.replace('.', '-')}-{part}"
