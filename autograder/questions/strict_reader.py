"""The one strict reader of what authors write: nothing unknown, nothing of a wrong type.

msgspec finds what is wrong; here it becomes one sentence with the file, the line and what to write.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any, TypeVar

import msgspec

from autograder.errors import CourseError
from autograder.questions import toml_lines
from autograder.questions.author_tables import (
    BLANK,
    ID,
    NAME,
    FieldError,
    Written,
    check_python_name,
)
from autograder.questions.nearest_name import meant

Table = dict[str, Any]  # of TOML, before this reader has seen it

W = TypeVar("W", bound=Written)

_WORDS = {
    "str": "a text in quotes",
    "int": "a whole number",
    "float": "a number",
    "bool": "true or false",
    "array": "a list in [...]",
    "object": "a table",
    "datetime": "a date and time such as 2026-11-20T23:59:00",
}
_AT = re.compile(r"^(?P<problem>.*?)(?: - at `\$(?P<path>[^`]*)`)?$", re.DOTALL)
_EXPECTED = re.compile(r"Expected `(?P<wanted>[^`]*)`(?P<rest>.*)", re.DOTALL)
_FIELD = re.compile(r"Object (?P<what>missing required|contains unknown) field `(?P<name>.*)`")
_STEP = re.compile(r"\.([^.\[\]]+)|\[(\d+|\.\.\.)\]")


@dataclass(frozen=True)
class Place:
    """Where a table stands: in words, and for its line the file's text and the path to it."""

    words: str
    text: str = ""
    path: toml_lines.Path = ()

    def error(self, problem: str, inside: toml_lines.Path = ()) -> CourseError:
        """One sentence that says where the problem is, with its line if that is known."""
        line = toml_lines.line_of(self.text, self.path + inside) if self.text else None
        at = f", line {line}" if line else ""
        return CourseError(f"{self.words}{at}: {problem}.")


def read_table(table: object, kind: type[W], place: Place, **given: str) -> W:
    """The table as a struct of that kind; ``given`` are fields that no author writes.

    Raises:
        CourseError: if it does not fit.
    """
    if not isinstance(table, dict):
        raise place.error("it must be a table")
    for field in given.keys() & table.keys():
        raise place.error(f"unknown field {field!r}; remove or correct it", (field,))
    for path in _not_finite(table):
        raise place.error(f"{_trail(table, path)} is not a finite number; correct it", path)
    try:
        return msgspec.convert({**table, **given}, kind)
    except msgspec.ValidationError as error:
        problem, inside = _explained(str(error), table, kind)
        raise place.error(problem, inside + path_of(error.__cause__)) from None


def path_of(error: BaseException | None) -> toml_lines.Path:
    """The field that an error is about, within the table that it was found in."""
    return error.path if isinstance(error, FieldError) else ()


def _explained(
    message: str, table: dict[str, object], kind: type[Written]
) -> tuple[str, toml_lines.Path]:
    """What is wrong, in an author's words, and where in the table."""
    found = _AT.match(message)
    assert found is not None
    problem, path = found["problem"], tuple(_steps(found["path"] or ""))
    if field := _FIELD.match(problem):
        owner = _trail(table, path)
        inside = f"in {owner}, " if path else ""
        if field["what"] == "missing required":
            return f"{inside}the field {field['name']!r} is missing", path
        refused = {} if path else kind.refused
        cure = refused.get(field["name"]) or meant(field["name"], _known(kind, path))
        return f"{inside}unknown field {field['name']!r}; {cure}", (*path, field["name"])
    if problem.startswith("Invalid enum value"):
        return f"{_trail(table, path)} is {_at(table, path)!r}; write {_choices(kind, path)}", path
    if problem.startswith("Invalid RFC3339"):
        what, value = _trail(table, path), _at(table, path)
        return f"{what} is {value!r}, and must be {_WORDS['datetime']}", path
    if expected := _EXPECTED.match(problem):
        return _expected(expected["wanted"], expected["rest"], table, path), path
    return (f"in {_trail(table, path)}, {problem}" if path else problem), path


def _expected(wanted: str, rest: str, table: dict[str, object], path: toml_lines.Path) -> str:
    what, value = _trail(table, path), _at(table, path)
    if rest.startswith(" matching regex"):
        if rest.endswith(repr(BLANK)):
            return f"{what} is empty; write it"
        if rest.endswith(repr(NAME)):
            try:
                check_python_name(what, value)
            except ValueError as error:
                return str(error)
        form = (
            "; an id looks like Q3.2.1 or Q2.2a"
            if rest.endswith(repr(ID))
            else ", in no known form"
        )
        return f"{what} is {value!r}{form}"
    if rest.startswith(" of length >= "):
        return f"{what} is empty; give at least {rest.removeprefix(' of length >= ')}"
    if rest.startswith(" of length "):
        number = rest.removeprefix(" of length ").partition(",")[0]
        return f"{what} must be a list of {number}"
    for sign, words in ((" >= ", "at least"), (" <= ", "at most"), (" > ", "more than")):
        if rest.startswith(sign):
            return f"{what} is {value!r}; give a number of {words} {float(rest[len(sign) :]):g}"
    names = " or ".join(_WORDS.get(name, name) for name in wanted.split(" | ") if name != "null")
    return f"{what} is {value!r}, and must be {names}"


def _steps(path: str) -> Iterator[str | int]:
    for name, index in _STEP.findall(path):
        yield name if name else (int(index) if index != "..." else "...")


def _at(table: Any, path: toml_lines.Path) -> Any:
    """What stands at a path; at a key that msgspec does not name, the whole table."""
    for step in path:
        if step == "...":
            return table
        table = table[step]
    return table


def _trail(table: dict[str, object], path: toml_lines.Path) -> str:
    """A path in words: ``credit of alternative 'rounded down'``."""
    words: list[str] = []
    for depth, step in enumerate(path):
        if step == "...":
            break
        if isinstance(step, int):
            entry = _at(table, path[: depth + 1])
            name = entry.get("name", entry.get("id")) if isinstance(entry, dict) else None
            number = repr(name) if isinstance(name, str) else str(step + 1)
            words[-1] = f"{words[-1]} {number}"
        else:
            words.append(str(step))
    return " of ".join(reversed(words)) or "the table"


def _known(kind: type[Written], path: toml_lines.Path) -> list[str]:
    """The fields that a table at this path may have, as far as the types tell."""
    here = _type_at(kind, path)
    fields = here.fields if isinstance(here, msgspec.inspect.StructType) else ()
    return [field.encode_name for field in fields]


def _choices(kind: type[Written], path: toml_lines.Path) -> str:
    """The values that a field may have."""
    return " or ".join(repr(value) for value in getattr(_type_at(kind, path), "values", ()))


def _type_at(kind: type[Written], path: toml_lines.Path) -> object:
    here: object = msgspec.inspect.type_info(kind)
    for step in path:
        if isinstance(here, msgspec.inspect.StructType) and isinstance(step, str):
            here = next(f.type for f in here.fields if f.encode_name == step)
        else:
            here = getattr(here, "item_type", getattr(here, "value_type", here))
        if isinstance(here, msgspec.inspect.UnionType):  # or None
            here = here.types[0]
    return here


def _not_finite(value: object, path: toml_lines.Path = ()) -> Iterator[toml_lines.Path]:
    if isinstance(value, float) and not isfinite(value):
        yield path
    elif isinstance(value, Mapping):
        for key, inner in value.items():
            yield from _not_finite(inner, (*path, key))
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            yield from _not_finite(inner, (*path, index))
