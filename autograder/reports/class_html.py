"""``class.html``: how the class did, which questions look broken, who needs help."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from autograder.course import Course
from autograder.gradebook import ClassView, Record, Run
from autograder.language import N_, _, chosen, n_
from autograder.reports.class_summary import ClassFindings, gather
from autograder.reports.color_patterns import definitions
from autograder.reports.html_page import page, table
from autograder.reports.markdown import inline, text
from autograder.reports.people_html import Links, needy_html, to_do_html
from autograder.reports.predictions import predictions_html
from autograder.reports.statistics import (
    FEWEST,
    STOPPED,
    Mistake,
    QuestionStatistics,
)
from autograder.reports.svg_charts import (
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
    (("right",), N_("right"), BLUE, ""),
    (("partial",), N_("partly right"), ORANGE, "stripes"),
    (("wrong",), N_("wrong"), RED, "crosses"),
    (STOPPED, N_("exception, limit or unreadable"), PURPLE, "dots"),
    (("not attempted",), N_("not attempted"), GRAY, "lines"),
)
_WAITING = (("recorded",), N_("not marked yet"), GRAY, "columns")  # only where something waits
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
    title = _("The class")
    header = [f"<h1>{title}</h1>"]
    if not len(records):
        nothing = f"<p>{_('Nothing was graded yet.')}</p>"
        return page(title, header[0], nothing, "", language=chosen())
    found = found or gather(course, records)
    most, statistics = found.most, found.questions
    links = Links(found.names)
    totals = np.array(found.totals)
    total = n_(
        "{count} submission, median {median} of {most} points",
        "{count} submissions, median {median} of {most} points",
        found.count,
    ).format(
        count=f"<strong>{found.count}</strong>",
        median=f"<strong>{np.median(totals):.4g}</strong>",
        most=f"{most:g}",
    )
    spread = _("Mean {mean}, standard deviation {deviation}, from {low} to {high}.").format(
        mean=f"{totals.mean():.3g}",
        deviation=f"{totals.std():.3g}",
        low=f"{totals.min():g}",
        high=f"{totals.max():g}",
    )
    header.append(f'<p class="total">{total}</p><p class="soft">{spread}</p>')
    if intake:
        header.append(f'<p class="soft">{text(intake)}.</p>')
    if run is not None and run.isolation:
        sentence = _("Student code was isolated with {isolation}.")
        header.append(f'<p class="soft">{sentence.format(isolation=text(run.isolation))}</p>')
    to_do = to_do_html(view, found, links) if view is not None else ""
    predictions = predictions_html(found.predicted, found.count)
    sections = [
        *([_section(_("What needs a person"), to_do)] if to_do else []),
        _section(_("Who needs help"), needy_html(course, found, links)),
        _section(_("Points"), _points(course, found, totals)),
        _section(_("Questions that look broken"), _broken(statistics, found.count)),
        _section(_("Questions"), _questions(statistics)),
        _section(_("The most common mistakes"), _mistakes(found.mistakes, links)),
        *([_section(_("Numbers that vary"), _variants(found))] if found.difficulties else []),
        *([_section(_("What was predicted"), predictions)] if predictions else []),
        _section(_("Time and failures"), _time_and_failures(found, run, links)),
    ]
    files = ["class_questions.csv", "class_mistakes.csv", "class_students.csv"]
    files += ["class_predictions.csv"] if course.predictions else []
    same = _(
        "The same as tables: {files}, and grades.csv with every mark. This page names students; "
        "keep it among instructors."
    ).format(files=", ".join(files))
    return page(
        title,
        "\n".join(header),
        "\n".join(sections),
        f"<p>{same}</p>",
        wide=True,
        language=chosen(),
    )


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
    chapters = table(
        _("Each chapter"), [_("chapter"), _("mean"), _("of"), _("share")], rows, {1, 2, 3}
    )
    chart = histogram(totals.tolist(), 0, found.most, bins, _("points"), _("Points"))
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
        sentence = _("With fewer than {count} submissions that would be guesswork.")
        return f"<p>{sentence.format(count=FEWEST)}</p>"
    return f"<p>{_('None.')}</p>"


def _questions(statistics: Sequence[QuestionStatistics]) -> str:
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


def _variants(found: ClassFindings) -> str:
    """Whether some students had harder numbers than others."""
    rows = []
    for entry in found.difficulties:
        less = _("{value} ({low} to {high})").format(
            value=f"{100 * entry.less:.0f}",
            low=f"{100 * entry.low:.0f}",
            high=f"{100 * entry.high:.0f}",
        )
        hardest = [text(entry.hardest), less] if entry.hardest else ["–", "–"]
        chance = f"{entry.chance:.3f} ± {entry.error:.3f}"
        rows.append(
            [text(entry.question), f"{entry.students}", f"{entry.variants}", chance, *hardest]
        )
    header = [
        _("question"),
        _("students"),
        _("variants"),
        _("chance"),
        _("hardest"),
        _("earned less, % of the points"),
    ]
    words = _(
        "Chance: how often variants that are equally hard differ as much as these, or more (the "
        "students of the variants were shuffled, 2000 times). Of twenty questions, one has less "
        "than 0.05 by chance. Hardest: the variant with the lowest mean among those that three "
        "students or more have, and how much less its students earned than all others, with the "
        "range that holds the truth in 95 of 100 cases."
    )
    caption = _("Were all variants equally hard?")
    return (
        table(caption, header, rows, {1, 2, 3, 5}, roomy=True)
        + f'<p class="small soft">{words}</p>'
    )


def _mistakes(mistakes: Sequence[Mistake], links: Links) -> str:
    named = [mistake for mistake in mistakes if mistake.named]
    others = [mistake for mistake in mistakes if not mistake.named]
    if not mistakes:
        return f"<p>{_('Nobody made a mistake that has a name.')}</p>"
    body = ""
    if named:
        known = _("Known mistakes, by how many students made them")
        body += _mistake_table(known, named, links)
    if others:
        unknown = _("Where responses fail that match no known mistake")
        body += _mistake_table(unknown, others, links)
    return body


def _mistake_table(caption: str, mistakes: Sequence[Mistake], links: Links) -> str:
    rows = [
        [text(m.question), text(m.name), str(len(m.students)), links.all(m.students, m.question)]
        for m in mistakes[:_MOST_MISTAKES]
    ]
    left = len(mistakes) - _MOST_MISTAKES
    more = n_(
        "{count} more is in class_mistakes.csv.", "{count} more are in class_mistakes.csv.", left
    ).format(count=left)
    header = [_("question"), _("mistake"), _("students"), _("who")]
    return table(caption, header, rows, {2}) + (f"<p>{more}</p>" if left > 0 else "")


def _time_and_failures(found: ClassFindings, run: Run | None, links: Links) -> str:
    seconds = np.array(found.seconds)
    spent = _("{seconds} s of running and marking.").format(seconds=f"{seconds.sum():.0f}")
    if run is not None and run.seconds:
        spent = _(
            "{seconds} s of running and marking, the last run took {clock} s by the clock."
        ).format(seconds=f"{seconds.sum():.0f}", clock=f"{run.seconds:.0f}")
    named = ", ".join(f"{links.to(student)} ({s:.1f} s)" for s, student in found.slowest)
    usual = _("Median {seconds} s a submission; slowest: {students}.").format(
        seconds=f"{np.median(seconds):.2g}", students=named
    )
    lines = [f"<p>{spent} {usual}</p>"]
    high = max(1.0, float(seconds.max()) * 1.02)
    title = _("Time for each submission")
    chart = histogram(seconds.tolist(), 0, high, 20, _("seconds"), title)
    lines.append(f"<figure>{chart}</figure>")
    rows = [
        [
            *(text(_(question)), _(status), text(sentence), str(students.count)),
            links.all(students.first, count=students.count),
        ]
        for (question, status, sentence), students in sorted(
            found.failures.items(), key=lambda item: (-item[1].count, item[0])
        )
    ]
    if rows:
        header = [_("question"), _("status"), _("reason"), _("students"), _("who")]
        caption = n_("{count} failure", "{count} failures", found.failure_count)
        lines.append(table(caption.format(count=found.failure_count), header, rows, {3}))
        listed = sum(students.count for students in found.failures.values())
        if listed < found.failure_count:
            left = found.failure_count - listed
            sentence = n_(
                "{count} more has another reason.", "{count} more have other reasons.", left
            )
            lines.append(f"<p>{sentence.format(count=left)}</p>")
    else:
        lines.append(f"<p>{_('No response failed to run.')}</p>")
    return "\n".join(lines)
