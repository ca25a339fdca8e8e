"""``feedback/STUDENT.html``: one file for each student, to be read on a phone and on paper."""

from __future__ import annotations

from dataclasses import dataclass, replace

from autograder.course import Course
from autograder.course.questions import Question
from autograder.gradebook.record import Override, Record
from autograder.language import _, chosen, n_
from autograder.marking import Mark, Part
from autograder.questions.mark import status_for
from autograder.questions.registry import kind_of
from autograder.questions.status import Status
from autograder.reports.html_page import page
from autograder.reports.json_output import most_for
from autograder.reports.markdown import inline, isolated, markdown, text
from autograder.reports.pictures import Pictures
from autograder.reports.svg_charts import bar


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
    most = most_for(course, record)
    share = record.total / most if most else 0.0
    header = [
        f"<h1>{_('Feedback for {name}').format(name=isolated(record.name))}</h1>",
        f'<p class="total">{_total(record, most)}</p>',
        bar(share, _("{percent} percent of the points").format(percent=f"{100 * share:.0f}")),
    ]
    if record.open:
        waiting = ", ".join(map(text, record.open))
        sentence = _("Not marked yet, a person will do it: {questions}.").format(questions=waiting)
        header.append(f"<p>{sentence}</p>")
    header += _after_the_exam(course, record)
    if record.late_days:
        sentence = n_(
            "Handed in {count} day late: {percent} % of the {points} points earned, that is "
            "{deduction}, are taken off.",
            "Handed in {count} days late: {percent} % of the {points} points earned, that is "
            "{deduction}, are taken off.",
            record.late_days,
        ).format(
            count=record.late_days,
            percent=f"{record.late_percent:g}",
            points=f"{record.earned:g}",
            deduction=f"{record.deduction:g}",
        )
        header.append(f"<p>{sentence}</p>")
    for note in record.graded.notes:
        header.append(f'<p class="soft">{text(_(note))}</p>')
    header.append(_index(course, record))
    chapters = [
        f"<section>\n<h2>{text(chapter.title)}</h2>\n"
        + "\n".join(_question(shared, record, question) for question in chapter.questions)
        + "\n</section>"
        for chapter in course.chapters
    ]
    asked = _("Questions about a mark? Name its question and say what you meant.")
    footer = f"<p>{asked}</p>"
    if record.isolation.startswith("none"):
        sentence = _("Your code was run with this isolation: {isolation}.")
        footer += f"<p>{sentence.format(isolation=text(record.isolation))}</p>"
    title = _("Feedback for {name}").format(name=record.name)
    return page(title, "\n".join(header), "\n".join(chapters), footer, language=chosen())


def _total(record: Record, most: float) -> str:
    sentence = (
        _("{earned} of {most} points so far") if record.open else _("{earned} of {most} points")
    )
    return sentence.format(earned=f"<strong>{record.total:g}</strong>", most=f"{most:g}")


def _after_the_exam(course: Course, record: Record) -> list[str]:
    """What a scheme makes of the points, where they are more than their sum."""
    scheme, lines = record.scheme, []
    if scheme is None:
        return []
    if scheme.weights:
        weights = ", ".join(
            f"{text(chapter.title)} {scheme.weights.get(chapter.name, 0):g}"
            for chapter in course.chapters
        )
        sentence = _("The chapters count for so many points: {weights}.").format(weights=weights)
        lines.append(f"<p>{sentence}</p>")
    if scheme.curve is not None:
        raw = replace(record, scheme=replace(scheme, curve=None)).earned
        sentence = _("The points were adjusted for everybody: {before} became {after}.")
        lines.append(f"<p>{sentence.format(before=f'{raw:g}', after=f'{record.earned:g}')}</p>")
    if record.attempts and scheme.resubmission != "newest":
        past = ", ".join(f"{attempt.total:g}" for attempt in record.past())
        sentence = (
            _("The best of your attempts counts; earlier ones: {points} points.")
            if scheme.resubmission == "best"
            else _("The mean of your attempts counts; earlier ones: {points} points.")
        )
        lines.append(f"<p>{sentence.format(points=past)}</p>")
    return lines


def _index(course: Course, record: Record) -> str:
    entries = []
    for question in course.questions.values():
        mark = record.marks.get(question.id)
        status = mark.status if mark else "not attempted"
        status = _verdict(record, question, status)
        points = _points(record, question)
        entries.append(
            f'<li><a class="{_class(status)}" href="#{_anchor(question)}">'
            f'<span aria-hidden="true">{Status(status).sign}</span> {text(question.id)} '
            f'<span class="soft">{points}/{question.points:g}</span></a></li>'
        )
    return f'<nav aria-label="{_("Questions")}"><ul class="index">{"".join(entries)}</ul></nav>'


def _question(shared: Feedback, record: Record, question: Question) -> str:
    mark = record.marks.get(question.id)
    override = record.overrides.get(question.id)
    status = _verdict(record, question, mark.status if mark else "not attempted")
    points = _points(record, question)
    of = n_("{earned} of {most} point", "{earned} of {most} points", question.points)
    earned = of.format(earned=points, most=f"{question.points:g}")
    lines = [
        f'<article class="{_class(status)}" id="{_anchor(question)}">',
        f'<div class="head"><h3>{text(question.id)} · {inline(question.title)}</h3>'
        f'<span class="points">{earned}</span></div>',
        f'<p class="verdict"><span aria-hidden="true">{Status(status).sign}</span> '
        f"{Status(status).words}</p>",
    ]
    if record.scheme is not None and (counts := record.scheme.remark(question.id, record)):
        lines.append(f'<p class="byhand">{text(counts)}</p>')
    if record.open_reason(question.id):
        lines.append(f"<p>{_('A person will mark this.')}</p>")
    elif override is not None:
        lines.append(_override(override, mark))
    if mark is None:
        lines.append(f"<p>{_('This question was not marked.')}</p>")
    else:
        lines += _understood(question, mark)
        if mark.status != "recorded":
            lines.append(_feedback(mark))
        if mark.told:
            label = _("It raised")
            lines.append(f'<p class="label">{label}</p><p class="said">{text(mark.told)}</p>')
        lines += _parts(question, mark)
        if mark.code:
            lines.append(_code(mark.code))
        whose = record.graded.numbers_of
        lines.append(shared.pictures.html(question.id, mark, record.inputs_seed, whose))
        if shared.explanations and mark.full_explanation:
            why = markdown(mark.full_explanation)
            lines.append(f'<div class="explained"><h4>{_("Why")}</h4>{why}</div>')
    return "\n".join(line for line in [*lines, "</article>"] if line)


def _code(code: str) -> str:
    """The cell that holds the response, folded, with the lines' numbers that exceptions name."""
    rows = "".join(f"<li>{text(line) or ' '}</li>" for line in code.splitlines())
    label = _("Your code")
    return f'<details><summary>{label}</summary><ol class="code">{rows}</ol></details>'


def _override(override: Override, mark: Mark | None) -> str:
    grader = ""
    if mark and mark.status != "recorded":
        grader = " " + _("The grader gave {points}.").format(points=f"{mark.points:g}")
    given = _("Marked by hand: {points} points.").format(points=f"{override.points or 0:g}")
    levels = "".join(
        f"<li>{text(criterion)}: {text(level)}</li>" for criterion, level in override.levels.items()
    )
    return (
        f'<div class="byhand"><p><strong>{given}</strong> '
        f"{text(override.reason)}{grader}</p>{f'<ul>{levels}</ul>' if levels else ''}</div>"
    )


def _points(record: Record, question: Question) -> str:
    points = record.points(question.id)
    return "?" if record.open_reason(question.id) else f"{points or 0.0:g}"


def _verdict(record: Record, question: Question, status: str) -> str:
    """The status; what only a person can mark is as right as the points are."""
    override = record.overrides.get(question.id)
    if status != "recorded" or override is None or record.open_reason(question.id):
        return status
    credit = (override.points or 0.0) / question.points if question.points else 1.0
    return status_for(min(1.0, credit))


def _understood(question: Question, mark: Mark) -> list[str]:
    if not mark.understood or mark.status == "not attempted":
        return []
    label = f'<p class="label">{_("Your response was read as")}</p>'
    read_as = kind_of(question).read_as(question, mark)
    if read_as is not None:
        return [label, f"<ol>{''.join(f'<li>{inline(line)}</li>' for line in read_as)}</ol>"]
    if kind_of(question).by_hand:
        said = f'<div class="said prose">{markdown(mark.understood)}</div>'
        return [f'<p class="label">{_("Your answer")}</p>', said]
    return [label, f'<p class="said">{text(mark.understood)}</p>']


def _feedback(mark: Mark) -> str:
    if mark.status == "right" and mark.feedback in ("Right.", _("Right.")):
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
        f'<p class="label">{text(_(kind.parts_heading))}</p>',
        f"<ul>{''.join(_part(part) for part in mark.parts)}</ul>",
    ]


def _part(part: Part) -> str:
    sign = (
        f'<span aria-hidden="true">✓</span> {_("right:")}'
        if part.right
        else f'<span aria-hidden="true">✗</span> {_("not yet:")}'
    )
    return f"<li>{sign} {text(part.label)}{text(part.feedback)}</li>"


def _anchor(question: Question) -> str:
    return text(question.id.replace(".", "-"))


def _class(status: str) -> str:
    return status.replace(" ", "-")
