"""``feedback/STUDENT.html``: one file for each student, to be read on a phone and on paper."""

from __future__ import annotations

from dataclasses import dataclass

from autograder.course import Course
from autograder.course.questions import Question
from autograder.gradebook.record import Override, Record
from autograder.kinds.registry import kind_of
from autograder.marking import Mark, Part
from autograder.reports.machine import most_points
from autograder.reports.markdown import inline, markdown, text
from autograder.reports.page import page
from autograder.reports.pictures import Pictures
from autograder.reports.svg import bar

SIGNS = {"right": "✓", "partial": "◐", "wrong": "✗", "not attempted": "○", "recorded": "●"}
WORDS = {
    "right": "Right",
    "partial": "Partly right",
    "wrong": "Not right yet",
    "not attempted": "Not attempted",
    "recorded": "Recorded",
    "error": "Stopped by an exception",
    "timeout": "Took too long",
    "killed": "Ended before it answered",
    "unreadable": "Could not be opened",
}


@dataclass(frozen=True)
class Feedback:
    """What all students' pages of one course share.

    ``explanations`` says whether they may read why the right answer is right.
    """

    course: Course
    pictures: Pictures
    explanations: bool = False


def feedback_html(shared: Feedback, record: Record) -> str:
    """The page of one student."""
    course = shared.course
    most = most_points(course)
    share = record.total / most if most else 0.0
    header = [
        f"<h1>Feedback for {text(record.student)}</h1>",
        f'<p class="total"><strong>{record.total:g}</strong> of {most:g} points</p>',
        bar(share, f"{100 * share:.0f} percent of the points"),
    ]
    if record.late_days:
        days = "1 day" if record.late_days == 1 else f"{record.late_days} days"
        header.append(
            f"<p>Handed in {days} late: {record.late_percent:g} % of the {record.earned:g} points "
            f"earned, that is {record.deduction:g}, are taken off.</p>"
        )
    for note in record.graded.notes:
        header.append(f'<p class="soft">{text(note)}</p>')
    header.append(_index(course, record))
    chapters = [
        f"<section>\n<h2>{text(chapter.title)}</h2>\n"
        + "\n".join(_question(shared, record, question) for question in chapter.questions)
        + "\n</section>"
        for chapter in course.chapters
    ]
    footer = "<p>Questions about a mark? Name its question and say what you meant.</p>"
    if record.isolation.startswith("none"):
        footer += f"<p>Your code was run with this isolation: {text(record.isolation)}.</p>"
    return page(f"Feedback for {record.student}", "\n".join(header), "\n".join(chapters), footer)


def _index(course: Course, record: Record) -> str:
    entries = []
    for question in course.questions.values():
        mark = record.marks.get(question.id)
        status = mark.status if mark else "not attempted"
        points = record.points(question.id) or 0.0
        entries.append(
            f'<li><a class="{_class(status)}" href="#{_anchor(question)}">'
            f'<span aria-hidden="true">{SIGNS.get(status, "!")}</span> {text(question.id)} '
            f'<span class="soft">{points:g}/{question.points:g}</span></a></li>'
        )
    return f'<nav aria-label="Questions"><ul class="index">{"".join(entries)}</ul></nav>'


def _question(shared: Feedback, record: Record, question: Question) -> str:
    mark = record.marks.get(question.id)
    override = record.overrides.get(question.id)
    status = mark.status if mark else "not attempted"
    points = record.points(question.id) or 0.0
    unit = "point" if question.points == 1 else "points"
    lines = [
        f'<article class="{_class(status)}" id="{_anchor(question)}">',
        f'<div class="head"><h3>{text(question.id)} · {inline(question.title)}</h3>'
        f'<span class="points">{points:g} of {question.points:g} {unit}</span></div>',
        f'<p class="verdict"><span aria-hidden="true">{SIGNS.get(status, "!")}</span> '
        f"{WORDS[status]}</p>",
    ]
    if override is not None:
        lines.append(_override(override, mark))
    if mark is None:
        lines.append("<p>This question was not marked.</p>")
    else:
        lines += _understood(question, mark)
        lines.append(_feedback(mark))
        lines += _parts(question, mark)
        lines.append(shared.pictures.html(question.id, mark, record.seed))
        if shared.explanations and mark.full_explanation:
            why = markdown(mark.full_explanation)
            lines.append(f'<div class="explained"><h4>Why</h4>{why}</div>')
    return "\n".join(line for line in [*lines, "</article>"] if line)


def _override(override: Override, mark: Mark | None) -> str:
    grader = f" The grader gave {mark.points:g}." if mark else ""
    return (
        f'<p class="byhand"><strong>Marked by hand: {override.points:g} points.</strong> '
        f"{text(override.reason)}{grader}</p>"
    )


def _understood(question: Question, mark: Mark) -> list[str]:
    if not mark.understood or mark.status == "not attempted":
        return []
    label = '<p class="label">Your response was read as</p>'
    read_as = kind_of(question).read_as(question, mark)
    if read_as is not None:
        return [label, f"<ol>{''.join(f'<li>{inline(line)}</li>' for line in read_as)}</ol>"]
    return [label, f'<p class="said">{text(mark.understood)}</p>']


def _feedback(mark: Mark) -> str:
    if mark.status == "right" and mark.feedback == "Right.":
        return ""  # the verdict says so
    if mark.status in ("right", "partial", "wrong"):
        return markdown(mark.feedback)
    # Reasons can name files, and students name files.
    return f"<p>{text(mark.feedback)}</p>"


def _parts(question: Question, mark: Mark) -> list[str]:
    kind = kind_of(question)
    wrong = [part for part in mark.parts if part.feedback and part.right is not True]
    if kind.parts_stand_alone:
        entries = [
            f"<li>{text(part.label)}: {markdown(part.feedback)[3:-4]}</li>"
            if markdown(part.feedback).count("<p>") == 1
            else f"<li>{text(part.label)}: {markdown(part.feedback)}</li>"
            for part in wrong
        ]
        return [f"<ul>{''.join(entries)}</ul>"] if entries else []
    if all(part.right for part in mark.parts):
        return []
    return [
        f'<p class="label">{text(kind.parts_heading)}</p>',
        f"<ul>{''.join(_part(part) for part in mark.parts)}</ul>",
    ]


def _part(part: Part) -> str:
    sign = (
        '<span aria-hidden="true">✓</span> right:'
        if part.right
        else ('<span aria-hidden="true">✗</span> not yet:')
    )
    return f"<li>{sign} {text(part.label)}{text(part.feedback)}</li>"


def _anchor(question: Question) -> str:
    return text(question.id.replace(".", "-"))


def _class(status: str) -> str:
    return status.replace(" ", "-")
