"""Mutants of an expression question's right formula, marked as a student's would be."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from autograder.errors import CourseError
from autograder.kinds.expression.answer import ExpressionAnswer
from autograder.kinds.expression.formula import evaluate_formula
from autograder.kinds.expression.marking import hidden_points, mark_expression, same_values
from autograder.kinds.expression.question import Expression
from autograder.marking.mutants.formula_edits import edited_formulas
from autograder.marking.mutants.mutant import Trial


class ExpressionTrial(Trial):
    """The mutants of the first formula that has full credit.

    One that equals the formula as it is anywhere at all is no mutant: that the values agree at the
    hidden points is how two formulas are proven equal. So the formulas are also compared at points
    drawn from ranges twice as wide, and only a difference that shows there is asked for.
    """

    def __init__(
        self,
        question: Expression,
        answer: ExpressionAnswer,
        draw: Callable[[int], np.random.Generator],
    ) -> None:
        self._question, self._answer, self._draw = question, answer, draw
        self._right = next(entry for entry in answer.alternatives if not entry.is_mistake)
        wide = {
            name: np.random.default_rng(0).uniform(low - (high - low), high + (high - low), 64)
            for name, (low, high) in answer.sample.items()
        }
        for name, formula in answer.derived.items():
            wide[name] = evaluate_formula(formula, wide)
        expected = np.broadcast_to(evaluate_formula(self._right.expression, wide), (64,))
        period = float(evaluate_formula(self._right.modulo, {})) if self._right.modulo else None
        made = []
        names = list(question.symbols)
        for mutant, text in edited_formulas(self._right.expression, names):
            try:
                values = np.broadcast_to(evaluate_formula(text, wide), (64,))
            except CourseError:
                continue  # such as an exponent of a whole number that became a comparison
            if not same_values(expected, values.astype(complex), period):
                made.append((mutant, text))
        self.mutants = [mutant for mutant, _ in made]
        self._texts = [text for _, text in made]

    def passes(self, index: int, seed: int) -> bool:
        points = hidden_points(self._answer, self._draw(seed))
        count = len(next(iter(points.values())))
        values = np.broadcast_to(evaluate_formula(self._texts[index], points), (count,))
        mark = mark_expression(self._question, self._answer, points, values.astype(complex))
        # What equals another form of full credit is right because the author says so.
        return mark.credit == 1 and mark.alternative == self._right.name

    def cases(self, seed: int) -> Sequence[str]:
        return ["all points"]
