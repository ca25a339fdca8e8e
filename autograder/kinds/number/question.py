"""What is asked: a value."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from autograder.questions.author_tables import FieldError, PythonName, check_python_name
from autograder.questions.question import PointedQuestion


class Number(PointedQuestion, frozen=True, kw_only=True, tag="number"):
    """A value: an integer, or a number that may be rounded to ``decimals`` places."""

    kind = "number"
    variable: PythonName
    integer: bool = False
    decimals: Annotated[int, Meta(ge=0, le=15, description="how many are asked for")] | None = None
    unit: str = ""
    unit_of_one: Annotated[str, Meta(description="the unit after 1, if it differs")] = ""
    rounding: Annotated[
        str, Meta(description="said of a value that is not whole: which way to round, and why")
    ] = ""
    between: Annotated[
        tuple[float, float] | None, Meta(description="the least and the largest value there can be")
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        check_python_name("variable", self.variable, "variable")
        if self.integer == (self.decimals is not None):
            raise FieldError("say either integer = true or decimals = N", "decimals")
        if self.rounding and not self.integer:
            raise FieldError("rounding is for integer = true", "rounding")
        if self.between is not None and not self.between[0] < self.between[1]:
            raise FieldError("the first number of between must be below the second", "between")

    @property
    def name(self) -> str | None:
        """The variable that holds the value."""
        return self.variable

    @property
    def tolerance(self) -> float:
        """How far a value may be from a stated one and still be that value."""
        return 1e-9 if self.decimals is None else 0.5 * 10.0**-self.decimals * (1 + 1e-9)

    def in_unit(self, value: int | float) -> str:
        """A value with its unit, as people read it."""
        unit = self.unit_of_one if value == 1 and self.unit_of_one else self.unit
        return f"{value:.10g} {unit}".strip()

    def printed(self, value: float) -> str:
        """A value with as many digits as are asked for."""
        return f"{value:.{self.decimals or 0}f}"
