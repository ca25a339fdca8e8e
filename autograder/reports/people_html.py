"""The parts of ``class.html`` about people: who needs help, who handed in nothing, who waits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from urllib.parse import quote

import numpy as np

from autograder.course import Course
from autograder.gradebook.record import Names
from autograder.gradebook.view import ClassView
from autograder.reports.files import file_name
from autograder.reports.gather import MOST_NAMED, ClassFindings, Section
from autograder.reports.markdown import person as person_html
from autograder.reports.markdown import text
from autograder.reports.page import table
from autograder.reports.statistics import Needy

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
        shown = text(said) if said else person_html(self._names[student])
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
        left = f" and {count - len(made)} others" if count > len(made) else ""
        return f"{shown}<details><summary>{count - most} more</summary>{rest}{left}</details>"


def needy_html(course: Course, found: ClassFindings, links: Links) -> str:
    """Who needs help, by section and name, with the chapters, the mistakes and the reasons."""
    needy, most = found.needy, found.most
    if not needy:
        return "<p>Nobody: everyone has at least half of the points, and all work could be run.</p>"
    rows = [
        [
            links.to(entry.student),
            text(entry.section or "–"),
            f"{entry.total:g} of {most:g}",
            text(", ".join(entry.chapters)) or "–",
            _mistakes(entry, links),
            text("; ".join(entry.reasons)),
        ]
        for entry in sorted(needy, key=lambda e: (e.section.casefold(), e.total, e.student))
    ]
    header = ["student", "section", "points", "below half in", "mistakes", "why"]
    lowest = "" if found.needy_count == len(needy) else f", the lowest {len(needy)}"
    parts = [table(f"{found.needy_count} students{lowest}", header, rows, {2})]
    if lowest:
        parts.append("<p>All of them are in class_students.csv.</p>")
    by_chapter = [
        [text(chapter.title), str(weak.count), links.all(weak.first, count=weak.count)]
        for chapter in course.chapters
        if (weak := found.needy_in.get(chapter.title))
    ]
    if by_chapter:
        parts.append(table("By chapter", ["chapter", "students", "who"], by_chapter, {1}))
    if len(found.sections) > 1:
        parts.append(_sections(found.sections))
    return "\n".join(parts)


def _mistakes(entry: Needy, links: Links) -> str:
    shown = [
        links.to(entry.student, question, f"{question} {name}")
        for question, name in entry.mistakes[:_MOST_MISTAKES]
    ]
    left = len(entry.mistakes) - len(shown)
    return "; ".join(shown) + (f"; {left} more" if left > 0 else "") if shown else "–"


def _sections(sections: Mapping[str, Section]) -> str:
    rows = []
    for name, section in sorted(sections.items()):
        median = f"{np.median(section.totals):.4g}"
        rows.append([text(name or "–"), str(len(section.totals)), median, str(section.needy)])
    header = ["section", "students", "median", "need help"]
    return table("Each section", header, rows, {1, 2, 3})


def to_do_html(view: ClassView, found: ClassFindings, links: Links) -> str:
    """What needs a person: work of nobody, open questions, who handed in nothing, groups."""
    parts = []
    if view.class_list.students and found.nobodys.count:
        rows = [
            [
                links.to(student),
                text(view.matches[student].reason or "it fits nobody"),
                f"<code>{text(view.matches[student].line)}</code>",
            ]
            for student in found.nobodys.first[:_MOST_LISTED]
        ]
        header = ["submission", "why", "the line in students.toml that settles it"]
        caption = f"{found.nobodys.count} submissions belong to nobody"
        parts.append(table(caption, header, rows, set()))
    if found.waiting:
        rows = [
            [links.to(student), text(", ".join(questions))]
            for student, questions in found.waiting[:_MOST_LISTED]
        ]
        caption = f"{found.waiting_count} students have questions that wait for a person"
        parts.append(table(caption, ["student", "questions"], rows, set()))
    if view.missing:
        named = [
            person_html(person.text()) + (f", {text(person.section)}" if person.section else "")
            for person in sorted(view.missing, key=lambda p: (p.section, p.name))
        ]
        said = "; ".join(named)
        parts.append(f"<p><strong>{len(named)} handed in nothing:</strong> {said}.</p>")
    if found.groups.count:
        said = "; ".join(map(links.to, found.groups.first))
        left = found.groups.count - len(found.groups.first)
        said += f"; and {left} others" if left else ""
        parts.append(f"<p><strong>Handed in together:</strong> {said}.</p>")
    return "\n".join(parts)
