"""Right work in other clothes (``solutions/variants``): each of them must earn everything."""

from __future__ import annotations

from msgspec import structs

from autograder.course import Course
from autograder.course.questions import Question
from autograder.course.right_work import right_work_of
from autograder.marking.draw import draw
from autograder.mutants.mutant import OutOfTime
from autograder.mutants.time_limit import time_limit
from autograder.questions.answer import Answer
from autograder.questions.drawn import Drawn
from autograder.questions.registry import kind_of
from autograder.sandbox.inside.evaluate import evaluate

SEEDS = range(1, 26)
_SECONDS = 5.0  # of a processor, for a variant and the hidden inputs of one seed


class RightWork:
    """Tries variants; what is drawn for a question serves all of its variants."""

    def __init__(self, course: Course) -> None:
        self._course = course
        self._drawn: dict[tuple[str, int], Drawn] = {}

    def problem(self, question: Question, name: str) -> str:
        """Why a variant earns less than everything, empty if it does not."""
        kind, answer = kind_of(question), self._answer(question)
        written = right_work_of(self._course, question)[name]
        try:
            response = kind.variant(question, written)
        except Exception as error:  # the course's own code may do anything
            return f"it cannot be made: {type(error).__name__}: {error}"
        for seed in SEEDS:
            drawn = self._draw(question, answer, seed)
            try:
                with time_limit(_SECONDS):
                    found = evaluate(response, drawn.probe)
            except OutOfTime:
                return f"with seed {seed} it takes more than {_SECONDS:g} s"
            mark = kind.mark(question, answer, drawn, found)
            if mark.credit != 1:
                return f"with seed {seed} it gets {mark.credit:g} credit: {mark.feedback}"
        return ""

    def _answer(self, question: Question) -> Answer:
        """The key; without the mistakes that take long and change nothing for what is right."""
        answer = self._course.key[question.id]
        if not kind_of(question).solutions(answer):
            return answer
        right = tuple(entry for entry in answer.alternatives if not entry.is_mistake)
        return structs.replace(answer, alternatives=right)

    def _draw(self, question: Question, answer: Answer, seed: int) -> Drawn:
        if (question.id, seed) not in self._drawn:
            self._drawn[question.id, seed] = draw(question, answer, seed, self._course.root)
        return self._drawn[question.id, seed]
