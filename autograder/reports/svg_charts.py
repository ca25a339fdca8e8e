"""Small charts as SVG text: nothing to load, sharp on paper, with words for who cannot see them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import count

from autograder.language import _
from autograder.reports.color_patterns import fill_of
from autograder.reports.markdown import text

# Okabe and Ito's colours, which colour-blind readers tell apart.
# The page's style gives some of them another value on a dark page.
BLUE, ORANGE, RED, GREEN, PURPLE = "var(--blue)", "#E69F00", "#D55E00", "#009E73", "#CC79A7"
GRAY, DARK, LINE = "var(--grey)", "var(--dark)", "var(--line)"
_ids = count(1)


@dataclass
class Chart:
    """An area of data coordinates inside margins for the labels, in pixels."""

    width: float
    height: float
    x_range: tuple[float, float]
    y_range: tuple[float, float]
    left: float = 48
    right: float = 12
    top: float = 14
    bottom: float = 44

    def __post_init__(self) -> None:
        self._parts: list[str] = []

    def x(self, value: float) -> float:
        """The pixel column of a value."""
        low, high = self.x_range
        inner = self.width - self.left - self.right
        return round(self.left + (value - low) / (high - low) * inner, 2)

    def y(self, value: float) -> float:
        """The pixel row of a value."""
        low, high = self.y_range
        inner = self.height - self.top - self.bottom
        return round(self.height - self.bottom - (value - low) / (high - low) * inner, 2)

    def box(
        self, x0: float, y0: float, x1: float, y1: float, color: str, pattern: str = ""
    ) -> None:
        """A filled rectangle between two corners in data coordinates, with a pattern over it."""
        left, right = sorted((self.x(x0), self.x(x1)))
        top, bottom = sorted((self.y(y0), self.y(y1)))
        for fill in (color, fill_of(pattern)) if pattern else (color,):
            self._parts.append(
                f'<rect x="{left}" y="{top}" width="{max(right - left, 0):.2f}" '
                f'height="{max(bottom - top, 0):.2f}" fill="{fill}" stroke="var(--paper)"/>'
            )

    def line(
        self, points: Iterable[tuple[float, float]], color: str, width: float = 2, dash: str = ""
    ) -> None:
        """A line through points in data coordinates."""
        path = " ".join(f"{self.x(x)},{self.y(y)}" for x, y in points)
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        self._parts.append(
            f'<polyline points="{path}" fill="none" stroke="{color}" '
            f'stroke-width="{width}"{dashed}/>'
        )

    def dot(self, x: float, y: float, color: str, radius: float = 4.5) -> None:
        """A point."""
        self._parts.append(
            f'<circle cx="{self.x(x)}" cy="{self.y(y)}" r="{radius}" fill="{color}" '
            'stroke="var(--paper)"/>'
        )

    def pixel_line(self, x0: float, y0: float, x1: float, y1: float) -> None:
        """A thin line between two pixel positions."""
        self._parts.append(
            f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" stroke="{DARK}"/>'
        )

    def label(
        self, px: float, py: float, said: str, anchor: str = "middle", turned: bool = False
    ) -> None:
        """Text at a pixel position."""
        turn = f' transform="rotate(-90 {px} {py})"' if turned else ""
        self._parts.append(
            f'<text x="{px:.2f}" y="{py:.2f}" text-anchor="{anchor}"{turn}>{text(said)}</text>'
        )

    def axes(self, x_label: str, y_label: str, whole_y: bool = False) -> None:
        """Ticks, faint grid lines and the names of both axes."""
        bottom = self.height - self.bottom
        for value in ticks(*self.x_range):
            self.line([(value, self.y_range[0]), (value, self.y_range[1])], LINE, 1)
            self.label(self.x(value), bottom + 17, f"{value:g}")
        for value in ticks(*self.y_range, whole_y):
            self.line([(self.x_range[0], value), (self.x_range[1], value)], LINE, 1)
            self.label(self.left - 7, self.y(value) + 4, f"{value:g}", "end")
        self.label((self.left + self.width - self.right) / 2, self.height - 6, x_label)
        self.label(13, (self.top + bottom) / 2, y_label, turned=True)

    def svg(self, title: str, description: str) -> str:
        """The finished picture; ``description`` says in words what it shows."""
        number = next(_ids)
        return (
            f'<svg role="img" aria-labelledby="t{number} d{number}" '
            f'viewBox="0 0 {self.width:g} {self.height:g}" width="{self.width:g}" '
            f'height="{self.height:g}"><title id="t{number}">{text(title)}</title>'
            f'<desc id="d{number}">{text(description)}</desc>{"".join(self._parts)}</svg>'
        )


def ticks(low: float, high: float, whole: bool = False, most: int = 6) -> list[float]:
    """Round numbers from ``low`` to ``high``, at most about ``most`` of them."""
    power = 10.0 ** math.floor(math.log10((high - low) / most))
    step = next(power * f for f in (1, 2, 2.5, 5, 10, 20) if (high - low) / (power * f) <= most)
    if whole:
        step = max(1.0, math.ceil(step))
    first = math.ceil(low / step - 1e-9)
    return [round(n * step, 10) for n in range(first, math.floor(high / step + 1e-9) + 1)]


def histogram(
    values: Sequence[float], low: float, high: float, bins: int, x_label: str, title: str
) -> str:
    """How many students fall into each bin."""
    counts = [0] * bins
    for value in values:
        counts[min(bins - 1, max(0, int((value - low) / (high - low) * bins)))] += 1
    chart = Chart(520, 250, (low, high), (0, max(1, *counts) * 1.08))
    chart.axes(x_label, _("students"), whole_y=True)
    width = (high - low) / bins
    said = []
    for index, students in enumerate(counts):
        start = low + index * width
        if students:
            chart.box(start, 0, start + width, students, BLUE)
            between = _("{low} to {high}").format(low=f"{start:.3g}", high=f"{start + width:.3g}")
            said.append(f"{between}: {students}")
    return chart.svg(title, f"{_('Students in each bin.')} {'; '.join(said)}.")


def bar(share: float, title: str, color: str = BLUE) -> str:
    """A bar that is filled to a share of its length."""
    share = min(1.0, max(0.0, share))
    number = next(_ids)
    return (
        f'<svg role="img" aria-labelledby="t{number}" viewBox="0 0 400 12" width="400" height="12">'
        f'<title id="t{number}">{text(title)}</title>'
        f'<rect width="400" height="12" rx="6" fill="{LINE}"/>'
        f'<rect width="{400 * share:.1f}" height="12" rx="6" fill="{color}"/></svg>'
    )


def swatch(color: str, pattern: str = "") -> str:
    """A small square of a colour, with a pattern over it, for a key."""
    over = f'<rect width="12" height="12" rx="2" fill="{fill_of(pattern)}"/>' if pattern else ""
    return (
        '<svg aria-hidden="true" viewBox="0 0 12 12" width="12" height="12">'
        f'<rect width="12" height="12" rx="2" fill="{color}"/>{over}</svg>'
    )
