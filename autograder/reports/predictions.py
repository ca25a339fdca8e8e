"""What a class predicted, counted and drawn."""

from __future__ import annotations

import math
from array import array
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from autograder.course.predictions import Prediction
from autograder.gradebook.record import Record
from autograder.language import _
from autograder.reports.html_page import table
from autograder.reports.markdown import inline, text
from autograder.reports.svg_charts import bar

_BINS = 8
_WIDE = 30  # a largest number so many times the smallest is drawn by its magnitude
_MAGNITUDES = (1, 2, 5)


@dataclass
class Predicted:
    """Everybody's prediction of one thing."""

    asked: Prediction
    choices: Counter[str] = field(default_factory=Counter)
    numbers: array[float] = field(default_factory=lambda: array("d"))

    @property
    def count(self) -> int:
        """How many predicted it."""
        return self.choices.total() + len(self.numbers)

    def add(self, record: Record) -> None:
        """What one student predicted, if anything; a gradebook that was edited may hold more."""
        value = record.graded.predictions.get(self.asked.id)
        if not self.asked.fits(value):
            return
        if isinstance(value, str):
            self.choices[value] += 1
        elif value is not None:
            self.numbers.append(float(value))

    def rows(self) -> list[tuple[str, int]]:
        """Each choice, or range of numbers, and how many predicted it."""
        if self.asked.choices:
            return [(choice, self.choices[choice]) for choice in self.asked.choices]
        edges = _edges(self.numbers) if self.numbers else []
        counts = [0] * (len(edges) - 1)
        for number in self.numbers:
            place = next(n for n, edge in enumerate(edges[1:], 1) if number < edge)
            counts[place - 1] += 1
        unit = f" {self.asked.unit}" if self.asked.unit else ""
        return [
            (self._range(low, high) + unit, count)
            for low, high, count in zip(edges, edges[1:], counts, strict=False)
        ]

    def _range(self, low: float, high: float) -> str:
        if not self.asked.integer:
            sentence = _("{low} to below {high}")
            return sentence.format(low=f"{low:g}", high=f"{high:g}")
        first, last = math.ceil(low), math.ceil(high) - 1
        if first == last:
            return f"{first:,}"
        return _("{low} to {high}").format(low=f"{first:,}", high=f"{last:,}")


def predictions_html(found: Sequence[Predicted], students: int) -> str:
    """A table with bars for each thing that anybody predicted; empty if nobody did."""
    counted = [_counted(entry, students) for entry in found if entry.count]
    return f'<div class="predictions">{"".join(counted)}</div>' if counted else ""


def _counted(entry: Predicted, students: int) -> str:
    rows = entry.rows()
    sentence = _("{some} of {all}")
    made = [
        [
            inline(name),
            str(count),
            bar(count / entry.count, sentence.format(some=count, all=entry.count)),
        ]
        for name, count in rows
    ]
    caption = _("{some} of {all} predicted.").format(some=entry.count, all=students)
    header = [_("prediction"), _("students"), _("share")]
    return (
        f'<div class="predicted"><h3>{text(entry.asked.id)}</h3>\n'
        f"<p>{inline(entry.asked.prompt)}</p>\n{table(caption, header, made, {1})}</div>"
    )


def _edges(numbers: Sequence[float]) -> list[float]:
    """Round numbers around all of these, not many: every number lies below the last."""
    low, high = min(numbers), max(numbers)
    least = min((number for number in numbers if number > 0), default=high)
    if low >= 0 and high >= _WIDE * least > 0:
        powers = range(math.floor(math.log10(least)), math.floor(math.log10(high)) + 2)
        made = [float(f"{first}e{power}") for power in powers for first in _MAGNITUDES]
        first = max(n for n, edge in enumerate(made) if edge <= least)
        last = next(n for n, edge in enumerate(made) if edge > high)
        return [*[0.0] * (low == 0), *made[first : last + 1]]
    step = _round_step((high - low) / _BINS) if high > low else 1.0
    start = math.floor(low / step)
    return [round((start + n) * step, 12) for n in range(math.floor(high / step) - start + 2)]


def _round_step(least: float) -> float:
    power = 10.0 ** math.floor(math.log10(least))
    return next(power * first for first in (1, 2, 5, 10) if power * first >= least)
