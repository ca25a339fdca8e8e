"""Mutants of an expression question's right formula, marked as a student's would be."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from autograder.errors import CourseError
from autograder.kinds.expression.answer import ExpressionAnswer
from autograder.kinds.expression.equal_values import same_values
from autograder.kinds.expression.marking import hidden_points, mark_expression
from autograder.kinds.expression.question import Expression
from autograder.mutants.formula_edits import edited_formulas
from autograder.mutants.mutant import Trial
from autograder.questions.key_formulas import evaluate_formula


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
        modulo = self._right.modulo
        period = float(evaluate_formula(modulo, {})) if modulo else None
        self._period = period
        self._seeds: dict[int, tuple[dict[str, np.ndarray], np.ndarray]] = {}
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
        points, expected = self._points_of(seed)
        values = np.broadcast_to(evaluate_formula(self._texts[index], points), expected.shape)
        values = values.astype(complex)
        # Marking looks for a known mistake in what is not equal, which takes far longer.
        if not same_values(expected, values, self._period):
            return False
        mark = mark_expression(self._question, self._answer, points, values)
        # What equals another form of full credit is right because the author says so.
        return mark.credit == 1 and mark.alternative == self._right.name

    def _points_of(self, seed: int) -> tuple[dict[str, np.ndarray], np.ndarray]:
        """The hidden points of a seed, and the right values there."""
        if seed not in self._seeds:
            points = hidden_points(self._answer, self._draw(seed))
            count = len(next(iter(points.values())))
            expected = np.broadcast_to(evaluate_formula(self._right.expression, points), (count,))
            self._seeds[seed] = points, expected
        return self._seeds[seed]

    def cases(self, seed: int) -> Sequence[str]:
        return ["all points"]
