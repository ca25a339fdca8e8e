"""A field for a formula, which is typeset as it is understood."""

from __future__ import annotations

from autograder.kinds.expression.question import Expression
from autograder.reports.markdown import inline
from autograder.student.widgets.value import ValueWidget


class ExpressionWidget(ValueWidget):
    """An expression question."""

    question: Expression

    def what_is_fixed(self) -> dict[str, object]:
        symbols = self.question.symbols.items() if self._with_prompt else ()
        return {
            **super().what_is_fixed(),
            "symbols": [{"name": name, "meaning": inline(meaning)} for name, meaning in symbols],
        }
