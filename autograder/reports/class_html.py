"""``class.html``: how the class did, which questions look broken, who needs help."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from autograder.course import Course
from autograder.gradebook import ClassView, Record, Run
from autograder.language import _, chosen, n_
from autograder.reports.class_summary import ClassFindings, gather
from autograder.reports.failures_html import time_and_failures_html
from autograder.reports.html_page import page, table
from autograder.reports.markdown import text
from autograder.reports.mistakes_html import mistakes_html
from autograder.reports.needs_help_html import needy_html
from autograder.reports.predictions import predictions_html
from autograder.reports.questions_html import broken_html, questions_html
from autograder.reports.student_links import Links
from autograder.reports.svg_charts import (
    histogram,
)
from autograder.reports.waits_for_a_person_html import to_do_html


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
        _section(_("Questions that look broken"), broken_html(statistics, found.count)),
        _section(_("Questions"), questions_html(statistics)),
        _section(_("The most common mistakes"), mistakes_html(found.mistakes, links)),
        *([_section(_("Numbers that vary"), _variants(found))] if found.difficulties else []),
        *([_section(_("What was predicted"), predictions)] if predictions else []),
        _section(_("Time and failures"), time_and_failures_html(found, run, links)),
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
