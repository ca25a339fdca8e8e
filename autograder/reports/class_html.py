"""``class.html``: how the class did, which questions look broken, who needs help."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from autograder.course import Course
from autograder.gradebook import ClassView, Record, Run
from autograder.reports.gather import ClassFindings, gather
from autograder.reports.markdown import inline, text
from autograder.reports.page import page, table
from autograder.reports.patterns import definitions
from autograder.reports.people_html import Links, needy_html, to_do_html
from autograder.reports.predictions import predictions_html
from autograder.reports.statistics import (
    FEWEST,
    STOPPED,
    Mistake,
    QuestionStatistics,
)
from autograder.reports.svg import (
    BLUE,
    DARK,
    GRAY,
    ORANGE,
    PURPLE,
    RED,
    Chart,
    histogram,
    swatch,
)

_BANDS = (
    (("right",), "right", BLUE, ""),
    (("partial",), "partly right", ORANGE, "stripes"),
    (("wrong",), "wrong", RED, "crosses"),
    (STOPPED, "exception, limit or unreadable", PURPLE, "dots"),
    (("not attempted", "recorded"), "not attempted", GRAY, "lines"),
)
_MOST_MISTAKES = 20


def class_html(
    course: Course,
    records: Sequence[Record],
    run: Run | None,
    view: ClassView | None = None,
    intake: str = "",
    found: ClassFindings | None = None,
) -> str:
    """The page; everything on it is also in the CSV files beside it.

    ``intake`` is what the last run said of what was handed in; ``found`` is what was gathered from
    the records, if that was done before.
    """
    header = ["<h1>The class</h1>"]
    if not len(records):
        return page("The class", header[0], "<p>Nothing was graded yet.</p>", "")
    found = found or gather(course, records)
    most, statistics = found.most, found.questions
    links = Links(found.names)
    totals = np.array(found.totals)
    header.append(
        f'<p class="total"><strong>{found.count}</strong> submissions, median '
        f"<strong>{np.median(totals):.4g}</strong> of {most:g} points</p>"
        f'<p class="soft">Mean {totals.mean():.3g}, standard deviation {totals.std():.3g}, '
        f"from {totals.min():g} to {totals.max():g}.</p>"
    )
    if intake:
        header.append(f'<p class="soft">{text(intake)}.</p>')
    if run is not None and run.isolation:
        header.append(f'<p class="soft">Student code was isolated with {text(run.isolation)}.</p>')
    to_do = to_do_html(view, found, links) if view is not None else ""
    predictions = predictions_html(found.predicted, found.count)
    sections = [
        *([_section("What needs a person", to_do)] if to_do else []),
        _section("Who needs help", needy_html(course, found, links)),
        _section("Points", _points(course, found, totals)),
        _section("Questions that look broken", _broken(statistics, found.count)),
        _section("Questions", _questions(statistics)),
        _section("The most common mistakes", _mistakes(found.mistakes, links)),
        *([_section("Numbers that vary", _variants(found))] if found.difficulties else []),
        *([_section("What was predicted", predictions)] if predictions else []),
        _section("Time and failures", _time_and_failures(found, run, links)),
    ]
    predicted = "class_predictions.csv, " if course.predictions else ""
    footer = (
        "<p>The same as tables: class_questions.csv, class_mistakes.csv, class_students.csv, "
        f"{predicted}and grades.csv with every mark. This page names students; "
        "keep it among instructors.</p>"
    )
    return page("The class", "\n".join(header), "\n".join(sections), footer, wide=True)


def _section(title: str, body: str) -> str:
    return f"<section>\n<h2>{title}</h2>\n{body}\n</section>"


def _points(course: Course, found: ClassFindings, totals: np.ndarray) -> str:
    bins = 10 if len(totals) < 60 else 20
    rows = []
    for chapter in course.chapters:
        possible = sum(question.points for question in chapter.questions)
        mean = found.chapters[chapter.title] / found.count
        share = 100 * mean / possible if possible else 0.0
        rows.append([text(chapter.title), f"{mean:.1f}", f"{possible:g}", f"{share:.0f} %"])
    chapters = table("Each chapter", ["chapter", "mean", "of", "share"], rows, {1, 2, 3})
    chart = histogram(totals.tolist(), 0, found.most, bins, "points", "Points")
    return f'<div class="pair"><figure>{chart}</figure><div>{chapters}</div></div>'


def _broken(statistics: Sequence[QuestionStatistics], count: int) -> str:
    entries = [
        f"<li><strong>{text(entry.question.id)}</strong> {inline(entry.question.title)}: "
        f"{text(' '.join(entry.troubles))}</li>"
        for entry in statistics
        if entry.troubles
    ]
    if entries:
        return f"<ul>{''.join(entries)}</ul>"
    if count < FEWEST:
        return f"<p>With fewer than {FEWEST} submissions that would be guesswork.</p>"
    return "<p>None.</p>"


def _questions(statistics: Sequence[QuestionStatistics]) -> str:
    key = "".join(f"<li>{swatch(color, pattern)}{name}</li>" for _, name, color, pattern in _BANDS)
    rows = []
    for entry in statistics:
        counts = [sum(entry.statuses[s] for s in band) for band, _, _, _ in _BANDS]
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
    header = ["question", "points", "right", "partly", "wrong", "stopped", "open"]
    header += ["earned", "discrimination", "unnamed"]
    return (
        f'{definitions()}<div class="pair"><figure>{_bands(statistics)}<figcaption>'
        f'<ul class="key">{key}</ul>'
        f"</figcaption></figure><figure>{_scatter(statistics)}<figcaption>Earned: mean share of "
        "the points among those who tried. Discrimination: correlation of a student’s points here "
        "with the points for all other questions; near or below 0 is suspect."
        "</figcaption></figure></div>"
        + table("Every question", header, rows, set(range(1, len(header))), roomy=True)
        + '<p class="small soft">Stopped: exception, time limit, crash or unreadable. Open: not '
        "attempted. Unnamed: wrong or partly right, and like no mistake in the key.</p>"
    )


def _bands(statistics: Sequence[QuestionStatistics]) -> str:
    row = 22
    height = 14 + row * len(statistics) + 44
    chart = Chart(520, height, (0, 100), (len(statistics), 0), left=64)
    said = []
    for value in (0, 25, 50, 75, 100):
        chart.label(chart.x(value), height - 27, f"{value}")
    chart.label(chart.x(50), height - 6, "percent of the class")
    for index, entry in enumerate(statistics):
        count = max(1, sum(entry.statuses.values()))
        start = 0.0
        for band, _, color, pattern in _BANDS:
            share = 100 * sum(entry.statuses[status] for status in band) / count
            if share:
                chart.box(start, index + 0.12, start + share, index + 0.88, color, pattern)
            start += share
        chart.label(58, chart.y(index + 0.5) + 4, entry.question.id, "end")
        said.append(f"{entry.question.id} {100 * entry.statuses['right'] / count:.0f} % right")
    return chart.svg("Verdicts for each question", "; ".join(said) + ".")


def _scatter(statistics: Sequence[QuestionStatistics]) -> str:
    placed = [
        (100 * entry.difficulty, entry.discrimination, entry)
        for entry in statistics
        if entry.difficulty is not None and entry.discrimination is not None
    ]
    if not placed:
        return "<p>Too few submissions to say how well a question tells students apart.</p>"
    low = min(0.0, *(y for _, y, _ in placed)) - 0.08
    left = max(0.0, min(x for x, _, _ in placed) - 5)
    right = 100 + 0.14 * (100 - left)  # room for the labels
    chart = Chart(520, 420, (left - 1, right), (low, 1.04))
    chart.axes("percent of the points earned", "discrimination")
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
    said = "; ".join(f"{e.question.id} {x:.0f} % and {y:.2f}" for x, y, e in placed)
    return chart.svg("Difficulty and discrimination of each question", said + ".")


def _extremes(
    placed: Sequence[tuple[float, float, QuestionStatistics]],
) -> list[QuestionStatistics]:
    """The questions to name in the picture: the troubled ones, and those at its edges."""
    by_discrimination = sorted(placed, key=lambda place: place[1])
    by_difficulty = sorted(placed, key=lambda place: place[0])
    chosen = [*by_discrimination[:4], *by_discrimination[-2:], *by_difficulty[:3]]
    chosen += by_difficulty[-2:] + [place for place in placed if place[2].troubles]
    return [entry for _, _, entry in chosen]


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


def _variants(found: ClassFindings) -> str:
    """Whether some students had harder numbers than others."""
    rows = []
    for entry in found.difficulties:
        less = f"{100 * entry.less:.0f} ({100 * entry.low:.0f} to {100 * entry.high:.0f})"
        hardest = [text(entry.hardest), less] if entry.hardest else ["–", "–"]
        chance = f"{entry.chance:.3f} ± {entry.error:.3f}"
        rows.append(
            [text(entry.question), f"{entry.students}", f"{entry.variants}", chance, *hardest]
        )
    header = [
        "question",
        "students",
        "variants",
        "chance",
        "hardest",
        "earned less, % of the points",
    ]
    return (
        table("Were all variants equally hard?", header, rows, {1, 2, 3, 5}, roomy=True)
        + '<p class="small soft">Chance: how often variants that are equally hard differ as '
        "much as these, or more (the students of the variants were shuffled, 2000 times). Of "
        "twenty questions, one has less than 0.05 by chance. Hardest: the variant with the lowest "
        "mean among those that three students or more have, and how much less its students earned "
        "than all others, with the range that holds the truth in 95 of 100 cases.</p>"
    )


def _mistakes(mistakes: Sequence[Mistake], links: Links) -> str:
    named = [mistake for mistake in mistakes if mistake.named]
    others = [mistake for mistake in mistakes if not mistake.named]
    if not mistakes:
        return "<p>Nobody made a mistake that has a name.</p>"
    body = ""
    if named:
        body += _mistake_table("Known mistakes, by how many students made them", named, links)
    if others:
        body += _mistake_table("Where responses fail that match no known mistake", others, links)
    return body


def _mistake_table(caption: str, mistakes: Sequence[Mistake], links: Links) -> str:
    rows = [
        [text(m.question), text(m.name), str(len(m.students)), links.all(m.students, m.question)]
        for m in mistakes[:_MOST_MISTAKES]
    ]
    left = len(mistakes) - _MOST_MISTAKES
    more = f"<p>{left} more are in class_mistakes.csv.</p>" if left > 0 else ""
    return table(caption, ["question", "mistake", "students", "who"], rows, {2}) + more


def _time_and_failures(found: ClassFindings, run: Run | None, links: Links) -> str:
    seconds = np.array(found.seconds)
    spent = f"{seconds.sum():.0f} s of running and marking"
    if run is not None and run.seconds:
        spent += f", the last run took {run.seconds:.0f} s by the clock"
    named = ", ".join(f"{links.to(student)} ({s:.1f} s)" for s, student in found.slowest)
    lines = [
        f"<p>{spent}. Median {np.median(seconds):.2g} s a submission; slowest: {named}.</p>",
    ]
    high = max(1.0, float(seconds.max()) * 1.02)
    lines.append(
        f"<figure>{histogram(seconds.tolist(), 0, high, 20, 'seconds', 'Time for each submission')}"
        "</figure>"
    )
    rows = [
        [
            *(text(question), status, text(said), str(students.count)),
            links.all(students.first, count=students.count),
        ]
        for (question, status, said), students in sorted(
            found.failures.items(), key=lambda item: (-item[1].count, item[0])
        )
    ]
    if rows:
        header = ["question", "status", "reason", "students", "who"]
        lines.append(table(f"{found.failure_count} failures", header, rows, {3}))
        listed = sum(students.count for students in found.failures.values())
        if listed < found.failure_count:
            lines.append(f"<p>{found.failure_count - listed} more have other reasons.</p>")
    else:
        lines.append("<p>No response failed to run.</p>")
    return "\n".join(lines)
