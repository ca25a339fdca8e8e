"""What crosses a course's functions, by name: the engine looks into it, and knows no more of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

Value = Any  # an argument or a result: numbers, texts, lists, dictionaries and arrays of any shape
Values = Mapping[str, Value]  # a case by its arguments' names, or an outcome by what it is
