"""What needs a person, on ``class.html``: work of nobody, open questions, who handed in nothing."""

from __future__ import annotations

from autograder.gradebook.view import ClassView
from autograder.language import _, n_
from autograder.reports.class_summary import ClassFindings
from autograder.reports.html_page import table
from autograder.reports.markdown import isolated, text
from autograder.reports.student_links import Links

_MOST_LISTED = 60


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
