"""Looks through a finished bundle for anything of the key."""

from __future__ import annotations

import ast
import inspect
import json
import re
import textwrap
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path

from autograder.course import Course
from autograder.course.answers import Answer
from autograder.course.loading import load_object
from autograder.course.questions import Question
from autograder.questions.registry import kind_of

_SHORTEST = 12  # characters; shorter strings turn up by chance
_SHORTEST_CODE = 40
_READABLE = re.compile(rb"[\x20-\x7e\t\r\n]{12,}")  # in a file that is not text


def leaks(course: Course, bundle: Path, except_chapters: Iterable[str] = ()) -> Iterator[str]:
    """A sentence for each part of the key that stands in a file of the bundle.

    White space is ignored, so that text is found however it was wrapped; code is compared statement
    by statement, without its comments and layout.
    """
    allowed = set(except_chapters)
    texts: dict[Path, str] = {}
    code: dict[Path, frozenset[str]] = {}
    for path in sorted(bundle.rglob("*")):
        name = path.relative_to(bundle)
        if not path.is_file() or name.parts[0] == "practice":
            continue
        content = _text(path)
        texts[name] = _bare(content)
        code[name] = _pairs(content) if path.suffix == ".py" else frozenset()
        if path.suffix == ".ipynb":
            code[name] = frozenset().union(*map(_pairs, _code_cells(content)))
    for id, answer in course.key.items():
        question = course.question(id)
        if question.chapter in allowed:
            continue
        for secret in kind_of(question).secrets(question, answer):
            bare = _bare(secret)
            for name, text in texts.items():
                if len(bare) >= _SHORTEST and bare in text:
                    yield f"{name} holds {secret[:60]!r} of the key to {id}."
        pairs = set().union(*(_pairs(source) for source in bodies(course, question, answer)))
        for name, found in code.items():
            if pairs & found:
                yield f"{name} holds {min(pairs & found)[:60]!r} of the reference for {id}."


def bodies(course: Course, question: Question, answer: Answer) -> Iterator[str]:
    """The sources of the solutions, right and wrong, that a key names."""
    for name in kind_of(question).solutions(answer):
        yield textwrap.dedent(inspect.getsource(load_object(name, course.root)))


def _text(path: Path) -> str:
    """What a file says, whatever its ending; of one that is not text, what can be read of it."""
    content = path.read_bytes()
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError:
        return b"\n".join(_READABLE.findall(content)).decode("ascii")


@cache  # a module of references is in the key of many questions
def _pairs(source: str) -> frozenset[str]:
    """Every two neighbouring statements of some length, at any depth; docstrings do not count."""
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError):
        return frozenset()
    found: set[str] = set()
    for node in ast.walk(tree):
        for block in (getattr(node, name, None) for name in ("body", "orelse", "finalbody")):
            if not isinstance(block, list):
                continue
            statements = [statement for statement in block if not _is_constant(statement)]
            if len(statements) < 2:  # to write out one takes long, and it has no neighbour
                continue
            said = [ast.unparse(statement) for statement in statements]
            found |= {f"{a}\n{b}" for a, b in pairwise(said) if len(a) + len(b) >= _SHORTEST_CODE}
    return frozenset(found)


def _is_constant(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)


def _code_cells(notebook: str) -> Iterator[str]:
    for cell in json.loads(notebook).get("cells", []):
        if cell.get("cell_type") == "code":
            yield "".join(cell["source"])


def _bare(text: str) -> str:
    # In JSON, notebooks above all, a line break and a quotation mark are written out.
    return re.sub(r'\\n|\\"|[\s"\\,]+', "", text)
