"""Number, as the engine sees it."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, TypeGuard

from autograder.kinds.number.answer import NumberAlternative, NumberAnswer
from autograder.kinds.number.marking import mark_number
from autograder.kinds.number.question import Number
from autograder.kinds.number.sensible import not_sensible
from autograder.language import _
from autograder.questions.answer import Alternative
from autograder.questions.code_kinds import CodeKind
from autograder.questions.drawn import Drawn
from autograder.questions.mark import Mark
from autograder.questions.typed_number import read_number
from autograder.questions.typed_text import assign_if_open

if TYPE_CHECKING:
    from autograder.kinds.number.widget import NumberWidget
    from autograder.student.desk import Desk


class NumberKind(CodeKind[Number, NumberAnswer]):
    """A value."""

    name = "number"
    has_field = True
    formulas = ("value", "tolerance")
    question_type = Number
    answer_type = NumberAnswer

    def fits(self, question: Number, response: object) -> bool:
        return _is_finite_number(response)

    def read_typed(
        self, question: Number, text: str, variables: Mapping[str, object]
    ) -> tuple[object, object]:
        value = read_number(without_unit(text, question), variables)
        return value, value

    def typed_value(self, question: Number, response: object) -> object:
        return response

    def typed_cell(self, question: Number, response: object) -> str | None:
        if isinstance(response, bool) or not isinstance(response, int | float):
            return None
        return assign_if_open(question.variable, repr(response))

    def mark_given(
        self,
        question: Number,
        answer: NumberAnswer,
        drawn: Drawn,
        response: dict[str, object],
        understood: str,
    ) -> Mark | None:
        value = response.get("value")
        if not _is_finite_number(value):
            return None
        return mark_number(question, answer, value, understood, drawn.around)

    def remark(self, question: Number, response: dict[str, object]) -> str:
        value = response.get("value")
        if not _is_finite_number(value):
            return ""
        said = []
        if question.integer and value != round(value):
            said = [_("But a whole number is asked for, and this is not one."), question.rounding]
        if question.between is not None and not question.between[0] <= value <= question.between[1]:
            low, high = (f"{bound:.10g}" for bound in question.between)
            said.append(
                _("But a number from {low} to {high} is asked for.").format(low=low, high=high)
            )
        return " ".join(filter(None, said))

    def widget(
        self, desk: Desk, question: Number, value: object = ..., mark: Mark | None = None
    ) -> NumberWidget:
        from autograder.kinds.number.widget import NumberWidget

        return NumberWidget(desk, question, value, mark)

    def poor_value(self, question: Number, value: float, sheets: float) -> Iterator[str]:
        yield from not_sensible(question, value, sheets)

    def response_like(self, question: Number, alternative: Alternative, drawn: Drawn) -> object:
        assert isinstance(alternative, NumberAlternative)
        return {"state": "given", "value": alternative.value}

    def right_in_words(self, question: Number, answer: NumberAnswer) -> list[str]:
        values = [entry.value for entry in answer.alternatives if entry.credit == 1]
        return [f"{question.printed(value)} {question.unit}".strip() for value in values]

    def secret_numbers(self, question: Number, answer: NumberAnswer) -> Iterator[str]:
        for entry in answer.alternatives:
            if not entry.is_mistake:
                yield question.printed(entry.value)


def without_unit(text: str, question: Number) -> str:
    """What was typed, without the question's own unit behind the number."""
    for unit in filter(None, (question.unit, question.unit_of_one)):
        behind = rf"(?<=[\d)])\s*{re.escape(unit)}\s*\.?\s*$"
        text = re.sub(behind, "", text, flags=re.IGNORECASE)
    return text


def _is_finite_number(value: object) -> TypeGuard[int | float]:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:  # an integer of 400 digits
        return False


KIND = NumberKind()
