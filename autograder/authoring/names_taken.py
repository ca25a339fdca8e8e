"""Names that a notebook needs for itself, which no question may ask for."""

from __future__ import annotations

import ast

from autograder import __all__
from autograder.authoring.masters import read_masters
from autograder.course import Course


def names_taken(course: Course) -> dict[str, dict[str, str]]:
    """For each chapter the names that its notebook has from elsewhere, and what brings them."""
    names: dict[str, dict[str, str]] = {}
    for master in read_masters(course):
        if master.chapter is not None:
            brought = dict.fromkeys(__all__, "the notebook calls it to ask and to check")
            for cell in master.cells:
                brought |= _imported(cell.source) if cell.kind == "code" else {}
            names[master.chapter.name] = brought
    return names


def _imported(source: str) -> dict[str, str]:
    try:
        tree = ast.parse(source)
    except SyntaxError:  # a line for IPython
        return {}
    return {
        (alias.asname or alias.name).partition(".")[0]: f"its cells import it: {ast.unparse(node)}"
        for node in ast.walk(tree)
        if isinstance(node, ast.Import | ast.ImportFrom) and _module(node) != "autograder"
        for alias in node.names
    }


def _module(node: ast.Import | ast.ImportFrom) -> str | None:
    return node.module if isinstance(node, ast.ImportFrom) else None
