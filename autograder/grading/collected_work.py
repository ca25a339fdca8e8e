"""What a student handed in for one chapter, gathered from its notebook and its saved responses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from autograder.course import Chapter, Course
from autograder.course.questions import Question
from autograder.intake.submissions import Contents
from autograder.questions.registry import kind_of


@dataclass(frozen=True)
class Work:
    """What a student handed in for one chapter.

    ``cells`` are run; ``given`` are saved responses and ``receipts`` those in the outputs, both by
    question. ``typed`` are questions whose field was filled in. ``unreadable`` says why the
    notebook could not be opened, and ``is_missing`` that there is none.
    """

    cells: list[str]
    receipts: dict[str, object]
    given: dict[str, object]
    typed: frozenset[str]
    unreadable: str | None
    is_missing: bool


def collect_work(
    chapter: Chapter, asked: Sequence[Question], contents: Contents, course: Course
) -> Work:
    """The cells to run and the responses that were kept, of one chapter."""
    notebook = contents.notebooks.get(chapter.name)
    receipts = notebook.receipts if notebook else {}
    given = {
        id: entry["response"]
        for id, entry in contents.sidecars.get(chapter.name, {}).items()
        if entry.get("response") is not None
    }
    # What was typed into a field counts where the notebook itself assigns nothing.
    kept = {**receipts, **given}
    fillings = {q.id: kind_of(q).typed_cell(q, kept.get(q.id)) for q in asked}
    typed = {id: cell for id, cell in fillings.items() if cell is not None}
    cells = [cell for cell in (notebook.cells if notebook else ()) if cell not in course.demo_cells]
    return Work(
        [*cells, *typed.values()],
        receipts,
        given,
        frozenset(typed),
        contents.unreadable.get(chapter.name),
        notebook is None,
    )
