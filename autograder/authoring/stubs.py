"""What an exercise looks like: the stub for a student, the same cell solved, and the check."""

from __future__ import annotations

import ast
import inspect
import textwrap
from dataclasses import dataclass

from autograder.course import Course
from autograder.course.answers import Answer, FunctionAnswer, OrderAnswer, TrueFalseAnswer
from autograder.course.questions import Expression, Function, Order, Question, TrueFalse
from autograder.errors import CourseError
from autograder.marking.make_probe import load_object


@dataclass(frozen=True)
class Exercise:
    """The cells of one exercise; ``check`` is None where the answer cell marks itself."""

    heading: str
    stub: str
    solved: str
    check: str | None


def exercise_cells(course: Course, question: Question) -> Exercise:
    """The cells that take the place of an exercise's one line in a master."""
    answer = course.key[question.id]
    if isinstance(question, TrueFalse | Order):
        return Exercise(
            heading=_heading(question, with_prompt=False),
            stub=f'ask("{question.id}")',
            solved=f'ask("{question.id}").respond({_choice(answer)})',
            check=None,
        )
    if isinstance(question, Function) and isinstance(answer, FunctionAnswer):
        source = reference_source(course, answer)
        stub, solved = function_stub(source, question), source
    else:
        if not answer.code:
            raise CourseError(f"The answer to {question.id} has no code for the solved notebook.")
        stub, solved = f"{question.name} = ...", f"{question.name} = {answer.code}"
    return Exercise(
        heading=_heading(question, with_prompt=True),
        stub=stub,
        solved=solved,
        check=f'check("{question.id}", {question.name})',
    )


def reference_source(course: Course, answer: FunctionAnswer) -> str:
    """The source of the reference function, as it stands in the solutions."""
    function = load_object(answer.reference, course.root)
    return textwrap.dedent(inspect.getsource(function)).strip()


def function_stub(source: str, question: Function) -> str:
    """The signature and docstring of a function, and a body that says it is not written.

    Raises:
        CourseError: if the reference is no plain function of the question's name.
    """
    definition = ast.parse(source).body[0]
    if not isinstance(definition, ast.FunctionDef) or definition.name != question.function:
        raise CourseError(
            f"The reference of {question.id} must be a function called {question.function}."
        )
    if ast.get_docstring(definition) is None:
        raise CourseError(
            f"The reference of {question.id} has no docstring to tell a student what to write."
        )
    docstring = definition.body[0]
    kept = source.splitlines()[: docstring.end_lineno]
    return "\n".join([*kept, "    raise NotImplementedError"])


def _choice(answer: Answer) -> str:
    if isinstance(answer, TrueFalseAnswer):
        return repr([statement.truth for statement in answer.statements])
    assert isinstance(answer, OrderAnswer)
    rows = textwrap.wrap(", ".join(f'"{card}"' for card in answer.order), 92)
    return "\n".join(["[", *(f"    {row}" for row in rows), "]"])


def _heading(question: Question, with_prompt: bool) -> str:
    points = f"{question.points:g} point" + ("" if question.points == 1 else "s")
    lines = [f"### {question.id} · {question.title}", "", f"*{points}*"]
    if with_prompt:
        lines += ["", question.prompt]
    if isinstance(question, Expression):
        lines += ["", "| symbol | meaning |", "|:--|:--|"]
        lines += [f"| `{name}` | {meaning} |" for name, meaning in question.symbols]
    # The widget of any other question gives its hints one at a time.
    hints = question.hints if isinstance(question, Function) else ()
    for count, hint in enumerate(hints, 1):
        lines += ["", f"<details><summary>Hint {count}</summary>", "", hint, "", "</details>"]
    return "\n".join(lines)
