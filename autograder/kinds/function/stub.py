"""The cells of a function question: the reference, and what of it a student is given."""

from __future__ import annotations

import ast
import inspect
import textwrap
from pathlib import Path

from autograder.course.loading import load_object
from autograder.errors import CourseError
from autograder.kinds.function.answer import FunctionAnswer
from autograder.kinds.function.question import Function


def reference_source(answer: FunctionAnswer, root: Path) -> str:
    """The source of the reference function, as it stands in the solutions."""
    function = load_object(answer.reference, root)
    return textwrap.dedent(inspect.getsource(function)).strip()


def function_stub(source: str, question: Function, where: str = "") -> str:
    """The signature and docstring of a function, and a body that says it is not written.

    ``where`` says in which file and line the function is, for the errors.

    Raises:
        CourseError: if the reference is no plain function of the question's name.
    """
    definition = ast.parse(source).body[0]
    if not isinstance(definition, ast.FunctionDef) or definition.name != question.function:
        raise CourseError(
            f"The reference of {question.id} must be a function called {question.function}{where}."
        )
    if ast.get_docstring(definition) is None:
        raise CourseError(
            f"The reference of {question.id} has no docstring to tell a student what to "
            f"write{where}."
        )
    docstring = definition.body[0]
    kept = source.splitlines()[: docstring.end_lineno]
    return "\n".join([*kept, "    raise NotImplementedError"])
