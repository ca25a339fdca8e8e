"""A field for a number, with its unit."""

from __future__ import annotations

from autograder.kinds.number.question import Number
from autograder.reports.markdown import inline
from autograder.student.widgets.value import ValueWidget


class NumberWidget(ValueWidget):
    """A number question."""

    question: Number

    def what_is_fixed(self) -> dict[str, object]:
        return {**super().what_is_fixed(), "unit": self.question.unit}

    def understood(self, value: object) -> str:
        shown = super().understood(value)
        return f"{shown} {inline(self.question.unit)}" if shown else ""
