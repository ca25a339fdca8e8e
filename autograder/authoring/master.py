"""One master: its cells, and what they call, predict and tell."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from autograder.course import Chapter
from autograder.course.folders import MASTERS

_CALL = re.compile(r"(?<![\w.])(\w+)\(")
_TELLS = re.compile(r"""(?<![\w.])numbers\(\s*["']([^"']*)["']""")
_ASKS = re.compile(r"""\bpredict\(\s*["']([^"']*)["']""")


@dataclass(frozen=True)
class MasterCell:
    """A cell of a master: Markdown, code, or an exercise (then ``exercise`` is its id).

    ``demo`` says that the cell only shows something: no response needs it, and the grader leaves
    it out where it is unchanged.
    """

    kind: str
    source: str
    exercise: str | None = None
    demo: bool = False


@dataclass(frozen=True)
class Master:
    """One master; ``chapter`` is None for a notebook without questions."""

    path: Path
    chapter: Chapter | None
    cells: tuple[MasterCell, ...]

    @property
    def stem(self) -> str:
        """The notebook's file name without its ending, such as ``3_ransac``."""
        return self.path.stem

    def where(self, sought: str, further: int = 0) -> str:
        """The file, and the line where a text stands for the first time, or so many lines on."""
        return place_in(self.path, self.path.read_text(encoding="utf-8"), sought, further)

    @property
    def calls(self) -> set[str]:
        """The names of the functions that its cells call."""
        code = (cell.source for cell in self.cells if cell.kind == "code")
        return {name for source in code for name in _CALL.findall(source)}

    @property
    def predictions(self) -> list[str]:
        """The ids of what is to be predicted in it."""
        code = (cell.source for cell in self.cells if cell.kind == "code")
        return [id for source in code for id in _ASKS.findall(source)]

    @property
    def stories(self) -> list[str]:
        """The names of the stories whose numbers it reads."""
        code = (cell.source for cell in self.cells if cell.kind == "code")
        return [name for source in code for name in _TELLS.findall(source)]


def place_in(path: Path, text: str, sought: str, further: int = 0) -> str:
    """A master, and the line in it where a text stands for the first time, if it is there."""
    before, found, _ = text.partition(sought)
    line = f", line {before.count(chr(10)) + 1 + further}" if found else ""
    return f"{MASTERS.as_posix()}/{path.name}{line}"
