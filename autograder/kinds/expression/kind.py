"""Expression, as the engine sees it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from autograder.errors import UsageError
from autograder.exchange.messages import Message, Value
from autograder.kinds.expression import snapshot as examples
from autograder.kinds.expression.answer import (
    ExpressionAlternative,
    ExpressionAnswer,
    check_expression,
)
from autograder.kinds.expression.marking import hidden_points, mark_expression
from autograder.kinds.expression.question import Expression
from autograder.kinds.expression.trial import ExpressionTrial
from autograder.language import _
from autograder.mutants.mutant import Trial
from autograder.questions.answer import Alternative
from autograder.questions.code_kinds import CodeKind
from autograder.questions.drawn import Drawn
from autograder.questions.key_formulas import evaluate_formula
from autograder.questions.mark import Mark
from autograder.questions.typed_text import assign_if_open

if TYPE_CHECKING:
    from autograder.kinds.expression.widget import ExpressionWidget
    from autograder.student.desk import Desk


class ExpressionKind(CodeKind[Expression, ExpressionAnswer]):
    """A formula; what is ``expected`` are the points at which it is compared."""

    name = "expression"
    has_field = True
    fewest_variants = 6
    question_type = Expression
    answer_type = ExpressionAnswer

    def check_answer(self, question: Expression, answer: ExpressionAnswer) -> None:
        check_expression(question, answer)

    def fits(self, question: Expression, response: object) -> bool:
        return isinstance(response, str)

    def read_typed(
        self, question: Expression, text: str, variables: Mapping[str, object]
    ) -> tuple[object, object]:
        from autograder.kinds.expression.inside.typed_formula import read_expression

        return read_expression(question, text), text.strip()

    def typed_value(self, question: Expression, response: Value) -> object:
        from autograder.kinds.expression.inside.typed_formula import read_expression

        try:
            return read_expression(question, response)
        except UsageError:
            return ...

    def typed_cell(self, question: Expression, response: object) -> str | None:
        if not isinstance(response, str):
            return None
        # Read where the notebook runs: only there is sympy, which executes what it reads.
        module = "autograder.kinds.expression.inside.typed_formula"
        call = f"__import__({module!r}, fromlist=['_']).formula_of({question.id!r}, {response!r})"
        return assign_if_open(question.variable, call)

    def draw(
        self,
        question: Expression,
        answer: ExpressionAnswer,
        rng: np.random.Generator,
        root: Path,
    ) -> Drawn:
        points = hidden_points(answer, rng)
        return Drawn({**self.base_probe(), "points": points}, expected=points)

    def mark_given(
        self,
        question: Expression,
        answer: ExpressionAnswer,
        drawn: Drawn,
        response: dict[str, object],
        understood: str,
    ) -> Mark | None:
        points, values = drawn.expected, response.get("values")
        return mark_expression(question, answer, points, values, drawn.around)

    def why_unusable(self, question: Expression, reason: str) -> str:
        why = super().why_unusable(question, reason)
        if reason == "symbol unknown":
            declared = _("(it declares {symbols})").format(symbols=", ".join(question.symbols))
            why += f" {declared}"
        return why

    def lines(self, question: Expression, response: object) -> list[str]:
        symbols = [f"- `{name}`: {meaning}" for name, meaning in question.symbols.items()]
        return [*symbols, "", *super().lines(question, response)]

    def right_in_words(self, question: Expression, answer: ExpressionAnswer) -> list[str]:
        return [entry.expression for entry in answer.alternatives if entry.credit == 1]

    def widget(
        self, desk: Desk, question: Expression, value: object = ..., mark: Mark | None = None
    ) -> ExpressionWidget:
        from autograder.kinds.expression.widget import ExpressionWidget

        return ExpressionWidget(desk, question, value, mark)

    def more_heading(self, question: Expression) -> list[str]:
        rows = [f"| `{name}` | {meaning} |" for name, meaning in question.symbols.items()]
        return ["", "| symbol | meaning |", "|:--|:--|", *rows]

    def response_like(self, question: Expression, alternative: Alternative, drawn: Drawn) -> object:
        assert isinstance(alternative, ExpressionAlternative)
        count = len(next(iter(drawn.expected.values())))
        values = evaluate_formula(alternative.expression, drawn.expected)
        return {"state": "given", "values": np.broadcast_to(values, (count,)).astype(complex)}

    def trial(
        self,
        question: Expression,
        answer: ExpressionAnswer,
        proven: Sequence[str],
        root: Path,
        draw: Callable[[int], np.random.Generator],
    ) -> Trial:
        return ExpressionTrial(question, answer, draw)

    def variant(self, question: Expression, written: Value) -> Value:
        from autograder.kinds.expression.inside.typed_formula import in_a_cell

        return in_a_cell(written)

    def right_texts(self, answer: ExpressionAnswer) -> tuple[str, ...]:
        right = (entry.expression for entry in answer.alternatives if not entry.is_mistake)
        return (*super().right_texts(answer), *right)

    def secrets(self, question: Expression, answer: ExpressionAnswer) -> Iterator[str]:
        yield from super().secrets(question, answer)
        for entry in answer.alternatives:
            if not entry.is_mistake:
                yield entry.expression

    def take_snapshot(
        self, question: Expression, answer: ExpressionAnswer, drawn: Drawn, again: Drawn
    ) -> tuple[Message, list[str]]:
        return examples.take_snapshot(answer, drawn.expected), []

    def snapshot_probe(
        self, question: Expression, snapshot: dict[str, object] | None
    ) -> dict[str, object]:
        points = snapshot["points"] if snapshot else {}
        return {**super().snapshot_probe(question, snapshot), "points": points}

    def mark_snapshot(
        self, question: Expression, snapshot: dict[str, object], response: dict[str, object]
    ) -> Mark:
        return examples.mark_snapshot(question, snapshot, response.get("values"))


KIND = ExpressionKind()
