"""The notebooks as they were handed out, to tell a student's own work from an untouched copy."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import PurePosixPath

from autograder.course import Course
from autograder.intake.notebook_reader import Notebook, Unreadable, read_notebook

_STUBS = (" = ...", "raise NotImplementedError")  # the last words of a cell that is to be filled in


@dataclass(frozen=True)
class Handout(Collection[str]):
    """The chapters of a course, the questions of each, and the code that it was handed out with.

    As a collection it holds the names of the chapters. ``stems`` are the names of all notebooks,
    also of those that ask nothing.
    """

    questions: Mapping[str, tuple[str, ...]]
    cells: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    stems: frozenset[str] = frozenset()

    def __contains__(self, name: object) -> bool:
        return name in self.questions

    def __iter__(self) -> Iterator[str]:
        return iter(self.questions)

    def __len__(self) -> int:
        return len(self.questions)

    def is_untouched(self, chapter: str, notebook: Notebook) -> bool:
        """Whether a notebook holds nothing but what was handed out.

        Imports do not count: a later edition of the handout may have others.
        """
        handed_out = self.cells.get(chapter)
        if handed_out is None or notebook.receipts:
            return False
        return set(_words(notebook.cells)) <= set(_words(handed_out))

    def own_cells(self, chapter: str, notebook: Notebook) -> frozenset[str]:
        """The code that was not handed out with this edition, cell by cell."""
        return frozenset(_words(notebook.cells)) - set(_words(self.cells.get(chapter, ())))

    def chapter_asked_in(self, notebook: Notebook) -> str | None:
        """The chapter most of whose questions a notebook names, None if it names none."""
        code = "\n".join(notebook.cells)
        asked = {
            chapter: sum(f'"{id}"' in code or f"'{id}'" in code for id in ids)
            for chapter, ids in self.questions.items()
        }
        likeliest = max(asked, key=lambda chapter: asked[chapter], default=None)
        return likeliest if likeliest is not None and asked[likeliest] > 0 else None


def handout_of(course: Course) -> Handout:
    """The handout of a course; a notebook that cannot be read is only known by its name."""
    questions = {
        chapter.name: tuple(q.id for q in chapter.questions) for chapter in course.chapters
    }
    cells: dict[str, tuple[str, ...]] = {}
    stems = set()
    for path in sorted((course.root / "notebooks").glob("*.ipynb")):
        stems.add(path.stem.casefold())
        chapter = PurePosixPath(path.stem.casefold()).name.partition("_")[2]
        if chapter not in questions:
            continue
        try:
            cells[chapter] = tuple(read_notebook(path.read_bytes(), path.name).cells)
        except (Unreadable, OSError):
            continue
    return Handout(questions, cells, frozenset(stems))


def is_filled_in_by(own: frozenset[str], other: frozenset[str]) -> bool:
    """Whether a notebook is of an earlier edition of the handout, which another one fills in.

    Both are given by their own cells: what only the first one has are then stubs.
    """
    alone = own - other
    return bool(alone) and all(cell.endswith(_STUBS) for cell in alone)


def _words(cells: Collection[str]) -> list[str]:
    return [" ".join(cell.split()) for cell in cells if cell.strip() and not _only_imports(cell)]


def _only_imports(cell: str) -> bool:
    lines = [line for line in cell.splitlines() if line.strip()]
    return all(line.startswith(("import ", "from ", "#", " ", ")")) for line in lines) and any(
        line.startswith(("import ", "from ")) for line in lines
    )
