"""The functions and classes that a chapter's notebook gives, as a student finds them there."""

from __future__ import annotations

import ast
import math
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np

MASTERS = Path(__file__).parents[2] / "notebooks/source"


def what_a_chapter_gives(master: str, *given: str) -> dict[str, Any]:
    """These names as the master defines them, and the modules that they need."""
    source = MASTERS / f"{master}.py"
    tree = ast.parse(source.read_text(encoding="utf-8"))
    nodes = [
        node
        for node in tree.body
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name in given
    ]
    assert len(nodes) == len(given)
    names: dict[str, Any] = {"np": np, "cv2": cv2, "math": math, "NamedTuple": NamedTuple}
    names["__name__"] = "chapter"
    exec(compile(ast.Module(nodes, []), str(source), "exec"), names)
    return names
