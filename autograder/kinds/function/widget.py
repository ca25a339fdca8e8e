"""What became of a function: there is no field, since it is written in its cell."""

from __future__ import annotations

from autograder.kinds.function.question import Function
from autograder.student.widgets.value import ValueWidget


class FunctionWidget(ValueWidget):
    """A function question."""

    question: Function

    def understood(self, value: object) -> str:
        return ""
