"""An author's table with numbers put in for its placeholders.

A placeholder is a formula of the variables in braces, with a format if wanted: ``{w}``,
``{100*w:g} %``, ``{log(1 - p) / log(1 - w**2):.2f}``. Braces that hold anything else, such as those
of a formula in TeX, stay as they are; inside ``$...$`` a placeholder keeps its braces where they
group, as in ``x^{N}`` and ``\\frac{N}{2}``.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Mapping
from functools import partial

from autograder.errors import CourseError
from autograder.questions.key_formulas import CONSTANTS, FUNCTIONS, evaluate_formula
from autograder.questions.printed_number import as_written_down, printed
from autograder.questions.strict_reader import Place
from autograder.questions.toml_lines import Path

# What names things stays the same in every variant; the notebook's code reads variables itself.
KEPT = frozenset({"id", "kind", "name", "variable", "function", "code", "story", "variables"})
_BRACES = re.compile(r"\{([^{}]*)\}")
_MATH = re.compile(r"(\$\$.*?\$\$|\$[^$\n]*\$)", re.DOTALL)


class NotFilled(CourseError):
    """A text or a formula that its numbers do not fit, and the path to it in its table."""

    def __init__(self, error: CourseError, step: str | int) -> None:
        super().__init__(str(error))
        self.path: Path = (step, *error.path) if isinstance(error, NotFilled) else (step,)

    def at(self, place: Place) -> CourseError:
        """The same, with the file and the line."""
        return place.error(str(self).rstrip("."), self.path)


def fill(
    table: Mapping[str, object], numbers: Mapping[str, int | float], formulas: Collection[str] = ()
) -> dict[str, object]:
    """The table with numbers in all texts, and in the fields called ``formulas`` their values.

    Raises:
        NotFilled: if a formula cannot be evaluated.
    """
    filled: dict[str, object] = {}
    for key, value in table.items():
        try:
            if key in formulas and isinstance(value, str):
                filled[key] = as_written_down(value_of(value, numbers))
            else:
                filled[key] = value if key in KEPT else _filled(value, numbers, formulas)
        except CourseError as error:
            raise NotFilled(error, key) from None
    return filled


def _filled(value: object, numbers: Mapping[str, int | float], formulas: Collection[str]) -> object:
    if isinstance(value, str):
        return fill_text(value, numbers)
    if isinstance(value, list):
        entries = []
        for position, entry in enumerate(value):
            try:
                entries.append(_filled(entry, numbers, formulas))
            except CourseError as error:
                raise NotFilled(error, position) from None
        return entries
    if isinstance(value, dict):
        return fill(value, numbers, formulas)
    return value


def fill_text(text: str, numbers: Mapping[str, int | float]) -> str:
    """A text with the values of its placeholders."""
    if "{" not in text:
        return text
    parts = _MATH.split(text)
    return "".join(
        _BRACES.sub(partial(_value, numbers=numbers, in_math=bool(at % 2)), part)
        for at, part in enumerate(parts)
    )


def _value(found: re.Match[str], numbers: Mapping[str, int | float], *, in_math: bool) -> str:
    formula, _, form = found[1].partition(":")
    if not _is_of(formula, numbers):
        return found[0]
    value = value_of(formula, numbers)
    shown = printed(value, form, found[0])
    grouped = in_math and found.string[: found.start()][-1:] not in (
        "",
        " ",
        "$",
        "(",
        ",",
        "=",
        "+",
    )
    return f"{{{shown}}}" if grouped else shown


def _is_of(formula: str, numbers: Mapping[str, int | float]) -> bool:
    """Whether it is a formula of the variables: one at least, and no other name."""
    try:
        tree = ast.parse(formula.strip(), mode="eval")
    except (SyntaxError, ValueError):
        return False
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    return bool(names & numbers.keys()) and names <= {*numbers, *FUNCTIONS, *CONSTANTS}


def value_of(formula: str, numbers: Mapping[str, int | float]) -> int | float:
    """The value of a formula; whole where it is, so that it is printed and compared as such.

    Raises:
        CourseError: if it is not a formula of the variables, or has no finite value.
    """
    value = float(evaluate_formula(formula, {name: float(v) for name, v in numbers.items()}))
    if value != value or value in (float("inf"), float("-inf")):
        told = ", ".join(f"{name} = {number}" for name, number in numbers.items())
        raise CourseError(f"The formula {formula!r} has no finite value with {told}.")
    return int(value) if value.is_integer() and abs(value) < 2**53 else value
