"""What is asked: a value."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from autograder.kinds.question import PointedQuestion
from autograder.kinds.written import PythonName, check_python_name


class Number(PointedQuestion, frozen=True, kw_only=True, tag="number"):
    """A value: an integer, or a number that may be rounded to ``decimals`` places."""

    kind = "number"
    variable: PythonName
    integer: bool = False
    decimals: Annotated[int, Meta(ge=0, le=15, description="how many are asked for")] | None = None
    unit: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_python_name("variable", self.variable)
        if self.integer == (self.decimals is not None):
            raise ValueError("say either integer = true or decimals = N")

    @property
    def name(self) -> str | None:
        """The variable that holds the value."""
        return self.variable

    @property
    def tolerance(self) -> float:
        """How far a value may be from a stated one and still be that value."""
        return 1e-9 if self.decimals is None else 0.5 * 10.0**-self.decimals * (1 + 1e-9)

    def printed(self, value: float) -> str:
        """A value with as many digits as are asked for."""
        return f"{value:.{self.decimals or 0}f}"
