"""Function, as the engine sees it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from autograder.course.loading import load_object, place_of
from autograder.exchange.messages import Value
from autograder.kinds.function import snapshot as examples
from autograder.kinds.function.answer import FunctionAnswer
from autograder.kinds.function.expected import draw
from autograder.kinds.function.functions_to_read import draw_reading
from autograder.kinds.function.marking import mark_function
from autograder.kinds.function.question import Function
from autograder.kinds.function.raises_promises import promises
from autograder.kinds.function.reference_failures import (
    other_counts,
    problem_of_the_generator,
    reference_failures,
    returns_nothing,
)
from autograder.kinds.function.stub import function_stub, reference_source
from autograder.kinds.function.take_snapshot import take_snapshot
from autograder.kinds.function.trial import FunctionTrial
from autograder.language import N_
from autograder.mutants.mutant import Trial
from autograder.questions.answer import Alternative
from autograder.questions.code_kinds import CodeKind
from autograder.questions.drawn import Drawn
from autograder.questions.functions_to_read import Reading
from autograder.questions.mark import Mark

if TYPE_CHECKING:
    from autograder.kinds.function.widget import FunctionWidget
    from autograder.student.desk import Desk


class FunctionKind(CodeKind[Function, FunctionAnswer]):
    """A function to write; what is ``expected`` is what is `Expected` of it."""

    name = "function"
    parts_heading = N_("Kinds of input")
    fewest_variants = 4
    can_be_read = True
    hints_in_heading = True
    varies_in_words = True
    question_type = Function
    answer_type = FunctionAnswer

    def draw(
        self, question: Function, answer: FunctionAnswer, rng: np.random.Generator, root: Path
    ) -> Drawn:
        return draw(question, answer, rng, root, self.base_probe())

    def mark_given(
        self,
        question: Function,
        answer: FunctionAnswer,
        drawn: Drawn,
        response: dict[str, object],
        understood: str,
    ) -> Mark | None:
        outcomes = response.get("outcomes")
        return mark_function(question, answer, drawn.expected, outcomes, drawn.tells)

    def example(self, drawn: Drawn) -> tuple[dict[str, Value], Value] | None:
        case, outcome = drawn.expected.cases[0], drawn.expected.outcomes[0]
        return (case, outcome["value"]) if case.get("public") and "value" in outcome else None

    def reading(
        self,
        question: Function,
        answer: FunctionAnswer,
        drawn: Drawn,
        rng: np.random.Generator,
        root: Path,
        names: Sequence[str],
    ) -> Reading | None:
        return draw_reading(question, answer, drawn, rng, root, names)

    def public_cases(self, drawn: Drawn) -> list[int]:
        # An exception that the case asks for is not worth telling.
        return [
            place
            for place, (case, right) in enumerate(
                zip(drawn.expected.cases, drawn.expected.outcomes, strict=True)
            )
            if case.get("public") and "value" in right
        ]

    def picture(self, answer: FunctionAnswer) -> str | None:
        return answer.picture

    def right_in_words(self, question: Function, answer: FunctionAnswer) -> list[str]:
        return [answer.reference]

    def widget(
        self, desk: Desk, question: Function, value: object = ..., mark: Mark | None = None
    ) -> FunctionWidget:
        from autograder.kinds.function.widget import FunctionWidget

        return FunctionWidget(desk, question, value, mark)

    def cells(self, question: Function, answer: FunctionAnswer, root: Path) -> tuple[str, str]:
        source = reference_source(answer, root)
        where = place_of(load_object(answer.reference, root), root)
        return function_stub(source, question, where), source

    def more_heading(self, question: Function) -> list[str]:
        # The widget of any other kind gives its hints one at a time.
        lines: list[str] = []
        for count, hint in enumerate(question.hints, 1):
            lines += ["", f"<details><summary>Hint {count}</summary>", "", hint, "", "</details>"]
        return lines

    def problems(self, question: Function, answer: FunctionAnswer) -> Iterator[str]:
        yield from self.too_few_mistakes(answer)
        for entry in answer.alternatives:
            if not entry.is_mistake:
                yield f"the mistake {entry.name!r} gets full credit; lower it."

    def unsound(
        self, question: Function, answer: FunctionAnswer, drawn: Drawn, root: Path
    ) -> Iterator[str]:
        yield from reference_failures(load_object(answer.reference, root), drawn.expected)
        if returns_nothing(drawn.expected):
            yield (
                "the reference returns None in every case, so that an empty function earns "
                "everything; does it lack a return?"
            )
        make_cases = load_object(answer.cases, root)
        place = place_of(make_cases, root)
        arguments = any(case["args"] or case.get("kwargs") for case in drawn.expected.cases)
        if problem := problem_of_the_generator(make_cases, not arguments):
            yield f"the cases of '{answer.cases}'{place} {problem}."
        for problem in other_counts(drawn.expected):
            yield f"{problem} (the cases are '{answer.cases}'{place})."
        if not any(case.get("public") for case in drawn.expected.cases):
            yield (
                f"no case of '{answer.cases}'{place} is "
                "public, so students see no example of their own before they hand in; write "
                '"public": True into one.'
            )

    def response_like(self, question: Function, alternative: Alternative, drawn: Drawn) -> object:
        outcomes = {entry.name: found for entry, found in drawn.expected.mistakes}
        return {"state": "given", "outcomes": list(outcomes[alternative.name])}

    def secrets(self, question: Function, answer: FunctionAnswer) -> Iterator[str]:
        yield from super().secrets(question, answer)
        yield from self.solutions(answer)

    def code_names(self, answer: FunctionAnswer) -> tuple[str, ...]:
        others = [answer.cases, *([answer.compare] if answer.compare else [])]
        return (*self.solutions(answer), *others)

    def solutions(self, answer: FunctionAnswer) -> tuple[str, ...]:
        return (answer.reference, *(entry.function for entry in answer.alternatives))

    def trial(
        self,
        question: Function,
        answer: FunctionAnswer,
        proven: Sequence[str],
        root: Path,
        draw: Callable[[int], np.random.Generator],
    ) -> Trial:
        return FunctionTrial(answer, proven, root, draw)

    def promises(
        self, answer: FunctionAnswer, root: Path, drawn: Drawn
    ) -> list[tuple[str, list[str]]]:
        return promises(load_object(answer.reference, root), drawn.expected)

    def take_snapshot(
        self, question: Function, answer: FunctionAnswer, drawn: Drawn, again: Drawn
    ) -> tuple[dict[str, Value], list[str]]:
        return take_snapshot(answer, drawn.expected, again.expected)

    def snapshot_probe(
        self, question: Function, snapshot: dict[str, Value] | None
    ) -> dict[str, object]:
        cases = snapshot["cases"] if snapshot else []
        sent = [{"args": case["args"], "kwargs": case.get("kwargs", {})} for case in cases]
        return {**super().snapshot_probe(question, snapshot), "cases": sent}

    def mark_snapshot(
        self, question: Function, snapshot: dict[str, Value], response: dict[str, Value]
    ) -> Mark:
        return examples.mark_snapshot(question, snapshot, response.get("outcomes", []))


KIND = FunctionKind()
