"""Docstrings have the form that CONTRIBUTING states: a sentence, prose, ``Args:``, ``Raises:``."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FOLDERS = ("autograder", "benchmarks", "data", "docs", "notebooks", "solutions", "tests", ".ci")
LEFT_OUT = {
    "source",  # masters: their cells are a student's
    "variants",  # written as students write
    "__pycache__",
}
SECTIONS = ("Args", "Raises")  # in this order
_ENDS = (".", "?", "!")
# What another dialect would begin a section or a field with.
OTHERS = {
    "Sphinx's fields": re.compile(r"^\s*:(param|type|returns?|rtype|raises?)\b[^:\n]*:", re.M),
    "numpydoc's underlines": re.compile(r"^[ ]*[A-Z][A-Za-z ]+\n[ ]*-{3,}$", re.M),
    "another section": re.compile(
        r"^[ ]*(Arguments|Parameters|Params|Returns?|Yields?|Attributes|Throws|Raise|Notes?|"
        r"Examples?|References):[ ]*$",
        re.M,
    ),
    "a section on the line of its heading": re.compile(r"^[ ]*(Args|Raises|Returns?): \S", re.M),
    "what is raised, as prose": re.compile(
        r"(?<=[.\n] )[ ]*Raises? (an? )?`*\w*(Error|Exception)\b"
    ),
    "what is raised, as a paragraph": re.compile(r"\n[ ]*Raises? (an? )?`*\w*(Error|Exception)\b"),
    "what is returned, as a paragraph": re.compile(r"\n\n[ ]*Returns? "),
}


def problems_of(text: str) -> Iterator[str]:
    """What is not in the house's form in a docstring whose indentation was removed."""
    if not text.partition("\n")[0].endswith(_ENDS):
        yield "its first line is not a sentence"
    for name, pattern in OTHERS.items():
        if found := pattern.search(text):
            yield f"{name}: {found[0].strip()!r}"
    headings = re.findall(rf"^({'|'.join(SECTIONS)}):$", text, re.M)
    if headings != [name for name in SECTIONS if name in headings]:
        yield f"its sections are {headings}"
    if headings:
        lines = text[text.index(f"\n{headings[0]}:") :].splitlines()
        for line in filter(None, lines):
            heading, entry = line[:-1] in SECTIONS, re.match(r" {4}[\w.*]+: \S", line)
            if not (heading or entry or line.startswith(" " * 8)):
                yield f"a line of a section that is neither 'name: text' nor goes on: {line!r}"


def docstrings(path: Path) -> Iterator[tuple[int, str]]:
    """The line and the text of each docstring in a file."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, documented) and (text := ast.get_docstring(node)):
            yield getattr(node, "lineno", 1), text


@pytest.mark.parametrize("folder", FOLDERS)
def test_docstrings_have_the_form_of_the_house(folder: str):
    wrong = [
        f"{path.relative_to(ROOT)}:{line}: {problem}"
        for path in sorted((ROOT / folder).rglob("*.py"))
        if not LEFT_OUT & {*path.relative_to(ROOT).parts}
        for line, text in docstrings(path)
        for problem in problems_of(text)
    ]
    assert wrong == []


# What students read asks them to write it: "Return the line". All else names it: "The line".
READ_BY_STUDENTS = ("solutions/", "notebooks/", "autograder/student/api.py", "tests/courses/")
READ_BY_STUDENTS += ("tests/toy/course/",)


def test_only_what_students_read_says_return():
    wrong = [
        f"{path.relative_to(ROOT)}:{line}"
        for folder in FOLDERS
        for path in sorted((ROOT / folder).rglob("*.py"))
        if not path.relative_to(ROOT).as_posix().startswith(READ_BY_STUDENTS)
        for line, text in docstrings(path)
        if re.match(r"Returns?\b", text)
    ]
    assert wrong == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("The mean.\n\n:param x: numbers", "Sphinx's fields"),
        ("The mean.\n\n:raises ValueError: if there are none", "Sphinx's fields"),
        ("The mean.\n\nParameters\n----------\nx : array", "numpydoc's underlines"),
        ("The mean.\n\nReturns:\n    A number.", "another section"),
        ("The mean.\n\nParameters:\n    x: numbers.", "another section"),
        ("The mean.\n\nRaises: ValueError if there are none.", "on the line of its heading"),
        ("The mean.\n\nRaises ValueError if there are none.", "as a paragraph"),
        ("The mean.\n\nOf numbers. Raises ValueError if there are none.", "as prose"),
        ("The mean.\n\nReturns a number.", "what is returned"),
        ("The mean", "not a sentence"),
        ("The mean.\n\nRaises:\n    ValueError: none.\n\nArgs:\n    x: x.", "its sections are"),
        ("The mean.\n\nRaises:\n    if there are none.", "neither 'name: text'"),
        ("The mean.\n\nArgs:\n    x: numbers.\n\nThey stay as they are.", "neither 'name: text'"),
    ],
)
def test_another_dialect_is_found(text: str, said: str):
    assert any(said in problem for problem in problems_of(text)), list(problems_of(text))


def test_the_form_of_the_house_is_let_pass():
    text = (
        "Return the mean of (N,) numbers, in metres.\n\nThey stay as they are.\n\n"
        "Args:\n    x: numbers,\n        all finite.\n\nRaises:\n    ValueError: if there are none."
    )
    assert list(problems_of(text)) == []
