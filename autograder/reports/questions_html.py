"""Of ``class.html``: every question with its verdicts, its difficulty and its discrimination."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.language import N_, _
from autograder.reports.broken_questions import STOPPED
from autograder.reports.color_patterns import definitions
from autograder.reports.correlations import FEWEST
from autograder.reports.html_page import table
from autograder.reports.markdown import inline, text
from autograder.reports.question_statistics import QuestionStatistics
from autograder.reports.svg_charts import (
    BLUE,
    DARK,
    GRAY,
    ORANGE,
    PURPLE,
    RED,
    Chart,
    swatch,
)

_BANDS = (
    (("right",), N_("right"), BLUE, ""),
    (("partial",), N_("partly right"), ORANGE, "stripes"),
    (("wrong",), N_("wrong"), RED, "crosses"),
    (STOPPED, N_("exception, limit or unreadable"), PURPLE, "dots"),
    (("not attempted",), N_("not attempted"), GRAY, "lines"),
)
_WAITING = (("recorded",), N_("not marked yet"), GRAY, "columns")  # only where something waits


def broken_html(statistics: Sequence[QuestionStatistics], count: int) -> str:
    """A list of the questions that look broken, with why."""
    entries = [
        f"<li><strong>{text(entry.question.id)}</strong> {inline(entry.question.title)}: "
        f"{text(' '.join(entry.troubles))}</li>"
        for entry in statistics
        if entry.troubles
    ]
    if entries:
        return f"<ul>{''.join(entries)}</ul>"
    if count < FEWEST:
        sentence = _("With fewer than {count} submissions that would be guesswork.")
        return f"<p>{sentence.format(count=FEWEST)}</p>"
    return f"<p>{_('None.')}</p>"


def questions_html(statistics: Sequence[QuestionStatistics]) -> str:
    """The verdicts as bars, difficulty against discrimination, and the table of both."""
    bands = _bands_of(statistics)
    key = "".join(
        f"<li>{swatch(color, pattern)}{_(name)}</li>" for _which, name, color, pattern in bands
    )
    rows = []
    for entry in statistics:
        counts = [sum(entry.statuses[s] for s in band) for band, *_look in _BANDS]
        counts[-1] += entry.statuses["recorded"]
        rows.append(
            [
                f"{text(entry.question.id)} {inline(entry.question.title)}",
                f"{entry.question.points:g}",
                *(str(count) for count in counts),
                "–" if entry.difficulty is None else f"{100 * entry.difficulty:.0f} %",
                "–" if entry.discrimination is None else f"{entry.discrimination:.2f}",
                str(entry.unnamed),
            ]
        )
    header = [_("question"), _("points"), _("right"), _("partly"), _("wrong"), _("stopped")]
    header += [_("open"), _("earned"), _("discrimination"), _("unnamed")]
    explained = _(
        "Earned: mean share of the points among those who tried. Discrimination: correlation of a "
        "student’s points here with the points for all other questions; near or below 0 is suspect."
    )
    words = _(
        "Stopped: exception, time limit, crash or unreadable. Open: not attempted, or not marked "
        "yet. Unnamed: wrong or partly right, and like no mistake in the key."
    )
    return (
        f'{definitions()}<div class="pair"><figure>{_bands(statistics)}<figcaption>'
        f'<ul class="key">{key}</ul>'
        f"</figcaption></figure><figure>{_scatter(statistics)}<figcaption>{explained}"
        "</figcaption></figure></div>"
        + table(_("Every question"), header, rows, set(range(1, len(header))), roomy=True)
        + f'<p class="small soft">{words}</p>'
    )


def _bands_of(
    statistics: Sequence[QuestionStatistics],
) -> Sequence[tuple[tuple[str, ...], str, str, str]]:
    """The verdicts that a bar is made of, each with its name and look."""
    waits = any(entry.statuses["recorded"] for entry in statistics)
    return (*_BANDS, _WAITING) if waits else _BANDS


def _bands(statistics: Sequence[QuestionStatistics]) -> str:
    row = 22
    height = 14 + row * len(statistics) + 44
    chart = Chart(520, height, (0, 100), (len(statistics), 0), left=64)
    said = []
    for value in (0, 25, 50, 75, 100):
        chart.label(chart.x(value), height - 27, f"{value}")
    chart.label(chart.x(50), height - 6, _("percent of the class"))
    for index, entry in enumerate(statistics):
        count = max(1, sum(entry.statuses.values()))
        start = 0.0
        for band, _name, color, pattern in _bands_of(statistics):
            share = 100 * sum(entry.statuses[status] for status in band) / count
            if share:
                chart.box(start, index + 0.12, start + share, index + 0.88, color, pattern)
            start += share
        chart.label(58, chart.y(index + 0.5) + 4, entry.question.id, "end")
        right = f"{100 * entry.statuses['right'] / count:.0f}"
        said.append(
            _("{question} {percent} % right").format(question=entry.question.id, percent=right)
        )
    return chart.svg(_("Verdicts for each question"), "; ".join(said) + ".")


def _scatter(statistics: Sequence[QuestionStatistics]) -> str:
    placed = [
        (100 * entry.difficulty, entry.discrimination, entry)
        for entry in statistics
        if entry.difficulty is not None and entry.discrimination is not None
    ]
    if not placed:
        said = _("Too few submissions to say how well a question tells students apart.")
        return f"<p>{said}</p>"
    low = min(0.0, *(y for _x, y, _entry in placed)) - 0.08
    left = max(0.0, min(x for x, _y, _entry in placed) - 5)
    right = 100 + 0.14 * (100 - left)  # room for the labels
    chart = Chart(520, 420, (left - 1, right), (low, 1.04))
    chart.axes(_("percent of the points earned"), _("discrimination"))
    chart.line([(left - 1, 0), (right, 0)], DARK, 1.5)
    taken: list[tuple[float, float]] = []
    dots = [(chart.x(x), chart.y(y)) for x, y, _ in placed]
    spoken_of = _extremes(placed)
    for x, y, entry in sorted(placed, key=lambda place: (-place[1], place[0])):
        if entry not in spoken_of:
            chart.dot(x, y, RED if entry.troubles else BLUE)
            continue
        px, py = chart.x(x), chart.y(y)
        label = _free_place(px + 8, py + 4, taken, dots)
        if abs(label[1] - py - 4) > 6:
            chart.pixel_line(px, py, label[0] - 2, label[1] - 4)
        chart.dot(x, y, RED if entry.troubles else BLUE)
        taken.append(label)
        chart.label(*label, entry.question.id, "start")
    said = "; ".join(
        _("{question} {percent} % and {value}").format(
            question=e.question.id, percent=f"{x:.0f}", value=f"{y:.2f}"
        )
        for x, y, e in placed
    )
    return chart.svg(_("Difficulty and discrimination of each question"), said + ".")


def _extremes(
    placed: Sequence[tuple[float, float, QuestionStatistics]],
) -> list[QuestionStatistics]:
    """The questions to name in the picture: the troubled ones, and those at its edges."""
    by_discrimination = sorted(placed, key=lambda place: place[1])
    by_difficulty = sorted(placed, key=lambda place: place[0])
    edges = [*by_discrimination[:4], *by_discrimination[-2:], *by_difficulty[:3]]
    edges += by_difficulty[-2:] + [place for place in placed if place[2].troubles]
    return [entry for _x, _y, entry in edges]


def _free_place(
    x: float,
    y: float,
    labels: Sequence[tuple[float, float]],
    dots: Sequence[tuple[float, float]],
) -> tuple[float, float]:
    """The nearest place for a label, above or below, that covers no other label and no dot."""
    for shift in (0, *(sign * step for step in range(4, 400, 4) for sign in (1, -1))):
        beside = any(abs(x - lx) < 48 and abs(y + shift - ly) < 13 for lx, ly in labels)
        covers = any(-2 < dx - x < 46 and abs(y + shift - 4 - dy) < 10 for dx, dy in dots)
        if not beside and not covers:
            return x, y + shift
    return x, y
