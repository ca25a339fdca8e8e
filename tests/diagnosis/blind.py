"""The blind set: wrong responses written before the key was read, marked as a student's are.

``uv run python -m tests.diagnosis.blind`` prints what each is called, and the three shares.
"""

from __future__ import annotations

import ast
import io
import json
import math
import sys
import tomllib
from contextlib import redirect_stdout, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np
import sympy as sp

from autograder.course import load_course
from autograder.marking.marker import Marker
from autograder.questions.mark import Mark
from autograder.questions.registry import kind_of
from autograder.sandbox.inside.evaluate import evaluate

ROOT = Path(__file__).parents[2]
_FOLDER = Path(__file__).parent / "blind_set"


@dataclass(frozen=True)
class Blind:
    """A wrong response: ``error`` in a reader's words, ``expect`` the names that say the same."""

    question: str
    error: str
    given: str
    expect: tuple[str, ...]


def read_blind_set() -> list[Blind]:
    """Every response of the blind set, functions as their whole text."""
    found, base = [], read_base()
    for path in sorted(_FOLDER.glob("*.toml")):
        for entry in tomllib.loads(path.read_text(encoding="utf-8"))["response"]:
            given = entry.get("given") or entry.get("code") or base[entry["question"]]
            for old, new in entry.get("change", ()):
                given = given.replace(old, new)
            expect = tuple(entry.get("expect", ()))
            found.append(Blind(entry["question"], entry["error"], given, expect))
    return found


def read_base() -> dict[str, str]:
    """A right function for each question that asks for one."""
    files = [tomllib.loads(path.read_text(encoding="utf-8")) for path in _FOLDER.glob("*.toml")]
    return {id: text for file in files for id, text in file.get("base", {}).items()}


class BlindMarker:
    """Marks texts as students write them, with one seed."""

    def __init__(self, seed: int = 5) -> None:
        self.marker = Marker(load_course(ROOT), seed)
        self._chapters: dict[str, dict[str, Any]] = {}

    def mark(self, question: str, given: str) -> Mark:
        """The mark of what somebody wrote, as the notebook or the grader would give it."""
        asked = self.marker.course.question(question)
        kind = kind_of(asked).name
        if kind == "order":
            return self.marker.mark(question, given.split())
        if kind == "true_false":
            return self.marker.mark(question, [word == "T" for word in given.split()])
        names = self._names_of(question)
        if kind == "function":
            exec(given, names)
            value = names[asked.name or ""]
        else:
            names |= {name: sp.Symbol(name, real=True) for name in getattr(asked, "symbols", {})}
            value = eval(given, names)
        with redirect_stdout(io.StringIO()):
            response = evaluate(value, self.marker.drawn(question).probe)
        return self.marker.mark(question, response)

    def _names_of(self, question: str) -> dict[str, Any]:
        """What a chapter has defined: its own helpers, and right work for the questions before."""
        chapter = question[1]
        if chapter not in self._chapters:
            names: dict[str, Any] = {"cv2": cv2, "np": np, "math": math, "sp": sp}
            names["NamedTuple"] = NamedTuple
            names |= {"r": sp.Symbol("r", real=True), "alpha": sp.Symbol("alpha", real=True)}
            (path,) = (ROOT / "notebooks").glob(f"{chapter}_*.ipynb")
            for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
                if cell["cell_type"] == "code":
                    tree = ast.parse("".join(cell["source"]))
                    kinds = (ast.ClassDef, ast.FunctionDef)
                    if all(isinstance(s, kinds) and not s.decorator_list for s in tree.body):
                        with suppress(NameError):  # what needs the chapter's data
                            exec(compile(tree, str(path), "exec"), names)
            for id, text in read_base().items():
                if id[1] == chapter:
                    exec(text, names)
            self._chapters[chapter] = names
        return dict(self._chapters[chapter])


def main() -> None:
    """Print what every response is called."""
    marker = BlindMarker()
    counts = {"rightly": 0, "wrongly": 0, "nameless": 0}
    for response in read_blind_set():
        if not response.question.startswith(tuple(sys.argv[1:]) or ("",)):
            continue
        mark = marker.mark(response.question, response.given)
        named = name_of(mark)
        how = "nameless" if named is None else "rightly" if named in response.expect else "wrongly"
        counts[how] += 1
        print(f"{how:9} {response.question:7} {response.error}: {named}")
    total = sum(counts.values())
    print(", ".join(f"{how} {count} ({count / total:.0%})" for how, count in counts.items()))


def name_of(mark: Mark) -> str | None:
    """What a response is called; of statements, those that are called wrong."""
    if mark.credit == 1:
        return "RIGHT"
    wrong = [part.label for part in mark.parts if part.label.startswith("Statement")]
    if wrong:
        return ", ".join(part.label for part in mark.parts if part.right is False)
    return mark.alternative


if __name__ == "__main__":
    main()
