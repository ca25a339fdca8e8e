"""The parts of ``class.html`` about people: who needs help, who handed in nothing, who waits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from urllib.parse import quote

import numpy as np

from autograder.course import Course
from autograder.gradebook.student_names import Names
from autograder.gradebook.view import ClassView
from autograder.language import _, n_
from autograder.reports.class_summary import MOST_NAMED, ClassFindings, Section
from autograder.reports.html_page import table
from autograder.reports.markdown import isolated, text
from autograder.reports.who_needs_help import Needy
from autograder.reports.whole_files import file_name

_MOST_MISTAKES = 3  # named beside a student
_MOST_LISTED = 60


class Links:
    """Students as links to their pages, under the names that tell them apart."""

    def __init__(self, names: Names) -> None:
        self._names = names

    def to(self, student: str, anchor: str = "", said: str = "") -> str:
        """A link to a student's page, or to a question there."""
        address = f"feedback/{quote(file_name(student))}.html"
        place = f"#{quote(anchor.replace('.', '-'))}" if anchor else ""
        shown = text(said) if said else isolated(self._names[student])
        return f'<a href="{address}{place}">{shown}</a>'

    def all(
        self, students: Sequence[str], anchor: str = "", most: int = 5, count: int | None = None
    ) -> str:
        """Several links; those beyond ``most`` are folded away.

        ``count`` says how many there are if not all are given; of many the last are left out.
        """
        count = len(students) if count is None else count
        made = [self.to(student, anchor) for student in students[:MOST_NAMED]]
        if count <= most:
            return ", ".join(made)
        shown, rest = ", ".join(made[:most]), ", ".join(made[most:])
        left = count - len(made)
        if left:
            others = n_("and {count} other", "and {count} others", left)
            rest += f" {others.format(count=left)}"
        more = n_("{count} more", "{count} more", count - most).format(count=count - most)
        return f"{shown}<details><summary>{more}</summary>{rest}</details>"


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


def to_do_html(view: ClassView, found: ClassFindings, links: Links) -> str:
    """What needs a person: work of nobody, open questions, who handed in nothing, groups."""
    parts = []
    if view.class_list.students and found.nobodys.count:
        rows = [
            [
                links.to(student),
                text(view.matches[student].reason or _("it fits nobody")),
                f"<code>{text(view.matches[student].line)}</code>",
            ]
            for student in found.nobodys.first[:_MOST_LISTED]
        ]
        header = [_("submission"), _("why"), _("the line in students.toml that settles it")]
        count = found.nobodys.count
        caption = n_(
            "{count} submission belongs to nobody", "{count} submissions belong to nobody", count
        )
        parts.append(table(caption.format(count=count), header, rows, set()))
    if found.waiting:
        rows = [
            [links.to(student), text(", ".join(questions))]
            for student, questions in found.waiting[:_MOST_LISTED]
        ]
        count = found.waiting_count
        caption = n_(
            "{count} student has questions that wait for a person",
            "{count} students have questions that wait for a person",
            count,
        )
        parts.append(
            table(caption.format(count=count), [_("student"), _("questions")], rows, set())
        )
    if view.missing:
        named = [
            f"{person.text()}{f', {person.section}' if person.section else ''}"
            for person in sorted(view.missing, key=lambda p: (p.section, p.name))
        ]
        said = "; ".join(map(isolated, named))
        nothing = n_("{count} handed in nothing:", "{count} handed in nothing:", len(named))
        parts.append(f"<p><strong>{nothing.format(count=len(named))}</strong> {said}.</p>")
    if found.groups.count:
        said = "; ".join(map(links.to, found.groups.first))
        left = found.groups.count - len(found.groups.first)
        if left:
            said += f"; {n_('and {count} other', 'and {count} others', left).format(count=left)}"
        parts.append(f"<p><strong>{_('Handed in together:')}</strong> {said}.</p>")
    return "\n".join(parts)
