"""What is asked: a function to write."""

from __future__ import annotations

from autograder.questions.author_tables import PythonName, check_python_name
from autograder.questions.question import PointedQuestion


class Function(PointedQuestion, frozen=True, kw_only=True, tag="function"):
    """A function to write."""

    kind = "function"
    function: PythonName

    def __post_init__(self) -> None:
        super().__post_init__()
        check_python_name("function", self.function, "function")

    @property
    def name(self) -> str | None:
        """The function's name."""
        return self.function
