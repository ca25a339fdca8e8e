"""The parts of ``class.html`` about people: who needs help, who handed in nothing, who waits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from urllib.parse import quote

import numpy as np

from autograder.course import Course
from autograder.gradebook.record import Record, names_of
from autograder.gradebook.view import ClassView
from autograder.reports.files import file_name
from autograder.reports.machine import most_for
from autograder.reports.markdown import isolated, text
from autograder.reports.page import table
from autograder.reports.statistics import Needy, section_of, who_needs_help

_MOST_MISTAKES = 3  # named beside a student
_MOST_LISTED = 60


class Links:
    """Students as links to their pages, under the names that tell them apart."""

    def __init__(self, records: Sequence[Record]) -> None:
        self._names: Mapping[str, str] = names_of(records)

    def to(self, student: str, anchor: str = "", said: str = "") -> str:
        """A link to a student's page, or to a question there."""
        address = f"feedback/{quote(file_name(student))}.html"
        place = f"#{quote(anchor.replace('.', '-'))}" if anchor else ""
        shown = text(said) if said else isolated(self._names.get(student, student))
        return f'<a href="{address}{place}">{shown}</a>'

    def all(self, students: Sequence[str], anchor: str = "", most: int = 5) -> str:
        """Several links; those beyond ``most`` are folded away."""
        made = [self.to(student, anchor) for student in students]
        if len(made) <= most:
            return ", ".join(made)
        shown, rest = ", ".join(made[:most]), ", ".join(made[most:])
        return f"{shown}<details><summary>{len(made) - most} more</summary>{rest}</details>"


def needy_html(course: Course, records: Sequence[Record], links: Links) -> str:
    """Who needs help, by section and name, with the chapters, the mistakes and the reasons."""
    needy = who_needs_help(course, records)
    if not needy:
        return "<p>Nobody: everyone has at least half of the points, and all work could be run.</p>"
    most = most_for(course, records[0])
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
    parts = [table(f"{len(needy)} students", header, rows, {2})]
    by_chapter = [
        [text(chapter.title), str(len(weak)), links.all([e.student for e in weak])]
        for chapter in course.chapters
        if (weak := [entry for entry in needy if chapter.title in entry.chapters])
    ]
    if by_chapter:
        parts.append(table("By chapter", ["chapter", "students", "who"], by_chapter, {1}))
    sections = sorted({section_of(record) for record in records})
    if len(sections) > 1:
        parts.append(_sections(sections, records, needy))
    return "\n".join(parts)


def _mistakes(entry: Needy, links: Links) -> str:
    shown = [
        links.to(entry.student, question, f"{question} {name}")
        for question, name in entry.mistakes[:_MOST_MISTAKES]
    ]
    left = len(entry.mistakes) - len(shown)
    return "; ".join(shown) + (f"; {left} more" if left > 0 else "") if shown else "–"


def _sections(sections: Sequence[str], records: Sequence[Record], needy: Sequence[Needy]) -> str:
    rows = []
    for section in sections:
        totals = [record.total for record in records if section_of(record) == section]
        weak = sum(entry.section == section for entry in needy)
        rows.append([text(section or "–"), str(len(totals)), f"{np.median(totals):.4g}", str(weak)])
    header = ["section", "students", "median", "need help"]
    return table("Each section", header, rows, {1, 2, 3})


def to_do_html(view: ClassView, links: Links) -> str:
    """What needs a person: work of nobody, open questions, who handed in nothing, groups."""
    parts = []
    if view.nobodys:
        rows = [
            [
                links.to(record.student),
                text(view.matches[record.student].reason or "it fits nobody"),
                f"<code>{text(view.matches[record.student].line)}</code>",
            ]
            for record in view.nobodys[:_MOST_LISTED]
        ]
        header = ["submission", "why", "the line in students.toml that settles it"]
        parts.append(table(f"{len(rows)} submissions belong to nobody", header, rows, set()))
    if view.open:
        rows = [
            [links.to(record.student), text(", ".join(record.open))]
            for record in view.open[:_MOST_LISTED]
        ]
        caption = f"{len(view.open)} students have questions that wait for a person"
        parts.append(table(caption, ["student", "questions"], rows, set()))
    if view.missing:
        named = [
            f"{person.text()}{f', {person.section}' if person.section else ''}"
            for person in sorted(view.missing, key=lambda p: (p.section, p.name))
        ]
        said = "; ".join(map(isolated, named))
        parts.append(f"<p><strong>{len(named)} handed in nothing:</strong> {said}.</p>")
    groups = [record for record in view.records if len(record.people) > 1]
    if groups:
        said = "; ".join(links.to(record.student) for record in groups)
        parts.append(f"<p><strong>Handed in together:</strong> {said}.</p>")
    return "\n".join(parts)
