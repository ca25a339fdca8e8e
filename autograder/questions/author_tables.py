"""What an author writes: the base of every table, and the types of its fields.

A table is a `msgspec.Struct`. Its fields say what may stand in the file, and both the strict reader
(`autograder.questions.strict_reader`) and the schema for editors (`autograder.authoring.schema`)
follow from them. What no type can say is checked in ``__post_init__``, which raises a `FieldError`
with the problem alone and the field; the reader adds the file and the line.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable
from typing import Annotated, ClassVar

import msgspec
from msgspec import Meta

BLANK = r"\S"  # what a text must match that may not be blank
ID = r"^Q\d+(\.\d+)*[a-z]?\d?$"
NAME = r"^[A-Za-z_][A-Za-z0-9_]*$"

Text = Annotated[str, Meta(pattern=BLANK)]
PythonName = Annotated[str, Meta(pattern=NAME)]
Points = Annotated[
    float, Meta(ge=0, le=1e9, description="what a right response earns; 0: ungraded")
]
Credit = Annotated[float, Meta(ge=0, le=1, description="the share of the points it earns, 0 to 1")]


class FieldError(ValueError):
    """What is wrong with a table that no type can say, and the path to the field that says it."""

    def __init__(self, problem: str, *path: str | int) -> None:
        super().__init__(problem)
        self.path = path


class Written(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A table with known fields, all of the right type; texts have no blanks around them."""

    refused: ClassVar[dict[str, str]] = {}  # fields that one may expect, and why there are none

    def __post_init__(self) -> None:
        for field in self.__struct_fields__:
            value = getattr(self, field)
            if isinstance(value, str) and value != value.strip():
                msgspec.structs.force_setattr(self, field, value.strip())


def second_of(names: Iterable[str]) -> int | None:
    """Where a name stands that stood before; None if each stands once."""
    seen: set[str] = set()
    for position, name in enumerate(names):
        if name in seen:
            return position
        seen.add(name)
    return None


def check_python_name(what: str, name: str, *path: str | int) -> None:
    """Whether a variable, a function or a symbol may be called so; ``path`` leads to its field.

    Raises:
        FieldError: if not.
    """
    if not re.fullmatch(NAME, name) or keyword.iskeyword(name):
        raise FieldError(f"{what} is {name!r}, which is not a Python name", *path)
