"""What is asked: a formula in declared symbols."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from autograder.questions.author_tables import FieldError, PythonName, check_python_name
from autograder.questions.question import PointedQuestion

MOST_ROOTS = 8  # results of which each is compared, as those of `sympy.solve`


class Expression(PointedQuestion, frozen=True, kw_only=True, tag="expression"):
    """A sympy expression in the declared symbols (name -> meaning)."""

    kind = "expression"
    variable: PythonName
    symbols: Annotated[
        dict[str, str], Meta(min_length=1, description="each symbol, and in words what it means")
    ]

    def __post_init__(self) -> None:
        super().__post_init__()
        check_python_name("variable", self.variable, "variable")
        for name, meaning in self.symbols.items():
            check_python_name("a symbol", name, "symbols", name)
            if not meaning.strip():
                raise FieldError(f"say in words what the symbol {name!r} means", "symbols", name)

    @property
    def name(self) -> str | None:
        """The variable that holds the expression."""
        return self.variable
