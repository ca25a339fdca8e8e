"""What stands around a question in its chapter: for finding out what was mixed up with what."""

from __future__ import annotations

import ast

from autograder.course import Course
from autograder.course.folders import readable_notebooks, student_notebooks
from autograder.course.questions import Question
from autograder.questions.drawn import Around


def around(course: Course, question: Question) -> Around:
    """The other questions of the same kind in a question's chapter, and the numbers given there."""
    chapter = next((c for c in course.chapters if c.name == question.chapter), None)
    others = [] if chapter is None else [q for q in chapter.questions if q.id != question.id]
    return Around(
        tuple((other, course.key[other.id]) for other in others if other.kind == question.kind),
        {**_numbers(course, question.chapter), **(course.numbers(question.id) or {})},
    )


def _numbers(course: Course, chapter: str) -> dict[str, float]:
    """What a chapter's notebook assigns as a plain number to a name; the first one counts."""
    found: dict[str, float] = {}
    own = [
        path
        for path in student_notebooks(course.root)
        if path.stem == chapter or path.stem.endswith(f"_{chapter}")
    ]
    for notebook in readable_notebooks(own):
        for cell in notebook["cells"]:
            if cell["cell_type"] != "code":
                continue
            try:
                tree = ast.parse(cell["source"])
            except (SyntaxError, ValueError):  # a cell of the notebook's own commands, such as %pip
                continue
            for statement in tree.body:
                match statement:
                    case ast.Assign(
                        targets=[ast.Name(id=name)],
                        value=ast.Constant(value=int() | float() as value),
                    ) if not isinstance(value, bool):
                        found.setdefault(name, value)
    return found
