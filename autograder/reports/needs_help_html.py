"""Who needs help, on ``class.html``: by section and name, with chapters, mistakes and reasons."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from autograder.course import Course
from autograder.language import _, n_
from autograder.reports.class_summary import ClassFindings, Section
from autograder.reports.html_page import table
from autograder.reports.markdown import text
from autograder.reports.student_links import Links
from autograder.reports.who_needs_help import Needy

_MOST_MISTAKES = 3  # named beside a student


def needy_html(course: Course, found: ClassFindings, links: Links) -> str:
    """Who needs help, by section and name, with the chapters, the mistakes and the reasons."""
    needy, most = found.needy, found.most
    if not needy:
        sentence = _("Nobody: everyone has at least half of the points, and all work could be run.")
        return f"<p>{sentence}</p>"
    rows = [
        [
            links.to(entry.student),
            text(entry.section or "–"),
            _("{some} of {all}").format(some=f"{entry.total:g}", all=f"{most:g}"),
            text(", ".join(entry.chapters)) or "–",
            _mistakes(entry, links),
            text("; ".join(entry.reasons)),
        ]
        for entry in sorted(needy, key=lambda e: (e.section.casefold(), e.total, e.student))
    ]
    header = [_("student"), _("section"), _("points"), _("below half in"), _("mistakes"), _("why")]
    caption = n_("{count} student", "{count} students", found.needy_count)
    cut = found.needy_count > len(needy)
    if cut:
        caption = _("{count} students, the lowest {some}")
    parts = [table(caption.format(count=found.needy_count, some=len(needy)), header, rows, {2})]
    if cut:
        parts.append(f"<p>{_('All of them are in class_students.csv.')}</p>")
    by_chapter = [
        [text(chapter.title), str(weak.count), links.all(weak.first, count=weak.count)]
        for chapter in course.chapters
        if (weak := found.needy_in.get(chapter.title))
    ]
    if by_chapter:
        columns = [_("chapter"), _("students"), _("who")]
        parts.append(table(_("By chapter"), columns, by_chapter, {1}))
    if len(found.sections) > 1:
        parts.append(_sections(found.sections))
    return "\n".join(parts)


def _mistakes(entry: Needy, links: Links) -> str:
    shown = [
        links.to(entry.student, question, f"{question} {name}")
        for question, name in entry.mistakes[:_MOST_MISTAKES]
    ]
    left = len(entry.mistakes) - len(shown)
    more = n_("{count} more", "{count} more", left).format(count=left)
    return "; ".join([*shown, *([more] if left > 0 else [])]) or "–"


def _sections(sections: Mapping[str, Section]) -> str:
    rows = []
    for name, section in sorted(sections.items()):
        median = f"{np.median(section.totals):.4g}"
        rows.append([text(name or "–"), str(len(section.totals)), median, str(section.needy)])
    header = [_("section"), _("students"), _("median"), _("need help")]
    return table(_("Each section"), header, rows, {1, 2, 3})
