"""A table that an author wrote, read field by field: nothing unknown, nothing of a wrong type."""

from __future__ import annotations

import keyword
import re
from typing import Any

from autograder.errors import CourseError

_NAME = re.compile(r"[A-Za-z_]\w*")


class Table:
    """A TOML table whose every field must be known and of the right type."""

    def __init__(self, table: dict[str, Any], where: str) -> None:
        self._table, self._where, self._seen = table, where, set[str]()

    def take(self, key: str, types: Any, default: Any = ...) -> Any:
        self._seen.add(key)
        value = self._table.get(key, default)
        if value is ...:
            raise CourseError(f"{self._where}: the field {key!r} is missing.")
        if value is default:
            return value
        # To Python a truth value is an int.
        if not isinstance(value, types) or (isinstance(value, bool) and types is not bool):
            raise self.error(f"{key} is {value!r}, which has the wrong type")
        return value

    def number(self, key: str, default: Any = ...) -> Any:
        value = self.take(key, (int, float), default)
        if value is not default and not abs(value) < float("inf"):
            raise self.error(f"{key} is {value}; give a finite number")
        return value

    def texts(self, key: str, default: Any = ...) -> tuple[str, ...]:
        values = self.take(key, list, default)
        if not all(isinstance(value, str) for value in values):
            raise self.error(f"{key} must be a list of texts")
        return tuple(values)

    def some_texts(self, key: str) -> tuple[str, ...]:
        """At least one text, none of them empty."""
        values = self.take(key, list)
        if not values:
            raise self.error(f"{key} is empty; give at least one")
        if not all(isinstance(value, str) and value.strip() for value in values):
            raise self.error(f"one of the {key} is empty; write it or remove it")
        return tuple(values)

    def python_name(self, key: str) -> str:
        """The name of a variable or a function."""
        name = str(self.take(key, str))
        self.check_name(key, name)
        return name

    def check_name(self, what: str, name: str) -> None:
        if not _NAME.fullmatch(name) or keyword.iskeyword(name):
            raise self.error(f"{what} is {name!r}, which is not a Python name")

    def points(self) -> float:
        """What the question is worth."""
        points = float(self.take("points", (int, float)))
        if not 0 <= points < float("inf"):
            raise self.error("points must be a number of at least 0 (0: it is ungraded)")
        return points

    def groups(self, key: str, default: Any = ...) -> tuple[tuple[str, ...], ...]:
        values = self.take(key, list, default)
        for group in values:
            if not isinstance(group, list) or not all(isinstance(name, str) for name in group):
                raise self.error(f"{key} must be a list of lists of card ids")
        return tuple(tuple(group) for group in values)

    def tables(self, key: str, what: str, default: Any = ...) -> list[Table]:
        entries = self.take(key, list, default)
        if not all(isinstance(entry, dict) for entry in entries):
            raise self.error(f"each {key} must be a table")
        return [
            Table(entry, f"{what} {entry.get('name', position)!r} of {self._where}")
            for position, entry in enumerate(entries, 1)
        ]

    def error(self, problem: str) -> CourseError:
        return CourseError(f"{self._where}: {problem}.")

    def text(self, key: str, default: Any = ...) -> str:
        value = str(self.take(key, str, default)).strip()
        if not value and default is ...:
            raise self.error(f"{key} is empty; write it")
        return value

    def done(self) -> None:
        unknown = set(self._table) - self._seen
        if unknown:
            raise CourseError(
                f"{self._where}: unknown field {sorted(unknown)[0]!r}; remove or correct it."
            )
