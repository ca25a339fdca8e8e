"""What a case is: the arguments of one call, and a ``name`` that says what kind of input it is."""

from typing import Any

Value = Any  # what a reference or a student's function gave; the student's may be anything
Case = dict[str, Value]
