"""What ``autograder show`` prints of one student."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from autograder.course import Course
from autograder.gradebook.record import Override, Record
from autograder.language import _, n_
from autograder.questions.registry import kind_of
from autograder.questions.status import Status
from autograder.reports.json_output import most_for
from autograder.reports.terminal import NARROW, colored_sign, print_line, printable


def print_key(console: Console, course: Course, record: Record) -> None:
    """The numbers of one student's questions, and what is right with them.

    They are those by which the work was marked: of whom it says it is from.
    """
    own = course.for_student(record.graded.numbers_of)
    console.print(f"[bold]{escape(printable(record.name))}[/]", soft_wrap=True)
    whose = record.graded.numbers_of if course.personal else ""
    sentence = (
        _("marked by the numbers of {name}") if whose else _("marked by the numbers of the sheet")
    )
    print_line(console, sentence.format(name=whose))
    for question in own.questions.values():
        numbers = own.numbers(question.id) or {}
        told = ", ".join(f"{name} = {value:g}" for name, value in numbers.items())
        print_line(console, f"{question.id} {question.title}" + (f" ({told})" if told else ""))
        for line in kind_of(question).right_in_words(question, own.key[question.id]):
            print_line(console, f"    {line}")


def print_record(
    console: Console,
    course: Course,
    record: Record,
    overrides: Iterable[Override],
) -> None:
    """Everything about one student, a line a question."""
    console.print(f"[bold]{escape(printable(record.name))}[/]", soft_wrap=True)
    for person in record.people:
        apart = filter(None, (person.login, person.email, person.id, person.section))
        print_line(console, f"{person.name}: {', '.join(apart)}")
    if record.name != record.student:
        print_line(console, _("submission: {name}").format(name=record.student))
    said = _("{some} of {all} points, {status}").format(
        some=f"{record.total:g}",
        all=f"{most_for(course, record):g}",
        status=_("graded") if record.graded.status == "graded" else _("unreadable"),
    )
    if record.open:
        said += ", " + _("{count} not marked yet").format(count=len(record.open))
    print_line(console, said)
    for past in record.past():
        said = _("attempt handed in {time}: {points} points")
        time = past.handed_in or _("before")
        print_line(console, said.format(time=time, points=f"{past.total:g}"))
    if record.late_days:
        said = n_(
            "{count} day late: {percent} % off, that is {points} points",
            "{count} days late: {percent} % off, that is {points} points",
            record.late_days,
        ).format(
            count=record.late_days,
            percent=f"{record.late_percent:g}",
            points=f"{record.deduction:g}",
        )
        print_line(console, said)
    print_line(console, _("handed in: {path}").format(path=record.graded.submission.path))
    for note in record.graded.notes:
        print_line(console, f"! {_(note)}")
    is_narrow = console.width < NARROW
    table = Table(box=None, pad_edge=False)
    table.add_column("")
    table.add_column(_("question"), no_wrap=True)
    table.add_column(_("points"), justify="right", no_wrap=True)
    table.add_column(_("understood as"), overflow="fold", ratio=1)
    table.add_column(_("verdict"), overflow="fold", ratio=2)
    for question in course.questions.values():
        mark = record.marks.get(question.id)
        if mark is None:
            continue
        override = record.overrides.get(question.id)
        said = f"{mark.alternative}: {mark.feedback}" if mark.alternative else mark.feedback
        if mark.alternative and mark.evidence:
            said += " " + _("(evidence: {evidence})").format(evidence=mark.evidence)
        if override is not None:
            levels = "".join(f"{name}: {level}; " for name, level in override.levels.items())
            reason = f"{levels}{override.reason}"
            if mark.status == Status.RECORDED:  # the grader said nothing
                said = _("given by hand ({reason}).").format(reason=reason)
            else:
                by_hand = _("given by hand ({reason}); the grader said {points}.")
                said = by_hand.format(reason=reason, points=f"{mark.points:g}") + f" {said}"
        if reason := record.open_reason(question.id):
            said = _("not marked yet: {reason}.").format(reason=reason) + f" {said}"
        counts = record.scheme.remark(question.id, record) if record.scheme else ""
        points = record.points(question.id)
        shown = f"{'?' if points is None else f'{points:g}'} / {question.points:g}"
        if is_narrow:
            print_line(console, f"{Status(mark.status).sign} {question.id}  {shown}")
            for text in (mark.understood, f"{counts} {said}".strip()):
                print_line(console, f"    {text}")
            continue
        table.add_row(
            colored_sign(mark.status),
            question.id,
            f"{'?' if points is None else f'{points:g}'} / {question.points:g}",
            escape(printable(mark.understood)),
            escape(printable(f"{counts} {said}".strip())),
        )
    if not is_narrow:
        console.print(table)
    for entry in overrides:
        points = entry.points
        given = (
            _("withdrawn") if points is None else _("{count} points").format(count=f"{points:g}")
        )
        said = _("override {when}: {question} {given} ({reason})").format(
            when=_when(entry.made_at, entry.author),
            question=entry.question,
            given=given,
            reason=entry.reason,
        )
        print_line(console, said)
    for remark in record.notes:
        when = _when(remark.made_at, remark.author)
        print_line(console, _("note {when}: {text}").format(when=when, text=remark.text))


def _when(time: str, author: str) -> str:
    return _("{time} by {author}").format(time=time, author=author) if author else time
