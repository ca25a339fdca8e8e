"""What the commands print: progress, tables, differences, one student."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from autograder.course import Course
from autograder.exchange.printable import printable as without_controls
from autograder.gradebook.changes import Change
from autograder.gradebook.record import Override, Record, names_of
from autograder.language import _, n_
from autograder.marking import Mark
from autograder.questions.registry import kind_of
from autograder.questions.status import Status
from autograder.reports.json_output import most_for

NARROW = 60  # columns, below which tables are written as lines


def progress_bar(doing: str = "") -> Progress:
    """A bar with the count and the time that is left; silent when nobody watches.

    It goes to standard error, so that standard output holds results only.
    """
    console = Console(stderr=True, highlight=False)
    return Progress(
        TextColumn(doing or _("grading")),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.description}"),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )


def warn(sentence: str) -> None:
    """Say something on standard error."""
    print(f"autograder: {printable(sentence)}", file=sys.stderr)


def print_table(console: Console, course: Course, records: Sequence[Record]) -> None:
    """A row a student: a sign for each question, grouped by chapter, and the total.

    On a narrow terminal each student has lines instead.
    """
    if console.width < NARROW:
        _print_lines(console, course, records)
        return
    table = Table(box=None, pad_edge=False)
    table.add_column(_("student"), overflow="fold")
    for chapter in course.chapters:
        table.add_column(chapter.title, overflow="fold")
    table.add_column(_("points"), justify="right")
    table.add_column("", overflow="fold")
    names = names_of(records)
    for record in records:
        marks = record.marks
        signs = [
            "".join(
                _sign(marks[question.id].status) if question.id in marks else " "
                for question in chapter.questions
            )
            for chapter in course.chapters
        ]
        table.add_row(
            escape(printable(names[record.student])),
            *signs,
            f"{record.total:g} / {most_for(course, record):g}" + (" +?" if record.open else ""),
            escape(printable(" ".join(map(_, record.graded.notes)))),
        )
    console.print(table)
    console.print(f"[dim]{legend()}[/]")


def _print_lines(console: Console, course: Course, records: Sequence[Record]) -> None:
    names = names_of(records)
    for record in records:
        marks = record.marks
        _line(console, f"{names[record.student]}: {record.total:g} / {most_for(course, record):g}")
        for chapter in course.chapters:
            signs = "".join(
                Status(marks[question.id].status).sign if question.id in marks else " "
                for question in chapter.questions
            )
            _line(console, f"  {signs}  {chapter.title}")
        for note in record.graded.notes:
            _line(console, f"  ! {_(note)}")
    _line(console, legend())


def print_changes(console: Console, earned: Mapping[str, float], changes: Sequence[Change]) -> None:
    """A line a student whose marks changed: the totals, and every mark before and after.

    ``earned`` are the points before; ``changes`` are in the order of students.
    """
    count = 0
    for student, entries in groupby(changes, key=lambda change: change.student):
        count += 1
        of_student = list(entries)
        before = earned[student]
        gained = sum(change.points for change in of_student)
        sentence = _("{student}: {before} → {after} points")
        after = f"{round(before + gained, 2):g}"
        _line(console, sentence.format(student=student, before=f"{before:g}", after=after))
        for change in of_student:
            kept = f"; {_('the override stays')}" if change.overridden else ""
            _line(
                console,
                f"  {change.question}: {_verdict(change.before)} → {_verdict(change.after)}{kept}",
            )
    if not changes:
        _line(console, _("No mark differs."))
        return
    sentence = n_(
        "{marks} marks of {count} student differ.",
        "{marks} marks of {count} students differ.",
        count,
    )
    _line(console, sentence.format(marks=len(changes), count=count))


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
    _line(console, sentence.format(name=whose))
    for question in own.questions.values():
        numbers = own.numbers(question.id) or {}
        told = ", ".join(f"{name} = {value:g}" for name, value in numbers.items())
        _line(console, f"{question.id} {question.title}" + (f" ({told})" if told else ""))
        for line in kind_of(question).right_in_words(question, own.key[question.id]):
            _line(console, f"    {line}")


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
        _line(console, f"{person.name}: {', '.join(apart)}")
    if record.name != record.student:
        _line(console, _("submission: {name}").format(name=record.student))
    said = _("{some} of {all} points, {status}").format(
        some=f"{record.total:g}",
        all=f"{most_for(course, record):g}",
        status=_("graded") if record.graded.status == "graded" else _("unreadable"),
    )
    if record.open:
        said += ", " + _("{count} not marked yet").format(count=len(record.open))
    _line(console, said)
    for past in record.past():
        said = _("attempt handed in {time}: {points} points")
        time = past.handed_in or _("before")
        _line(console, said.format(time=time, points=f"{past.total:g}"))
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
        _line(console, said)
    _line(console, _("handed in: {path}").format(path=record.graded.submission.path))
    for note in record.graded.notes:
        _line(console, f"! {_(note)}")
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
            _line(console, f"{Status(mark.status).sign} {question.id}  {shown}")
            for text in (mark.understood, f"{counts} {said}".strip()):
                _line(console, f"    {text}")
            continue
        table.add_row(
            _sign(mark.status),
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
        _line(console, said)
    for remark in record.notes:
        when = _when(remark.made_at, remark.author)
        _line(console, _("note {when}: {text}").format(when=when, text=remark.text))


def printable(text: str) -> str:
    """Text without control characters, so that no name can write to the terminal."""
    return without_controls(text, "�")


def _line(console: Console, text: str) -> None:
    console.print(printable(text), markup=False, soft_wrap=True)


def legend() -> str:
    """What the signs of a table mean."""
    return "  ".join(f"{status.sign} {_(status)}" for status in Status)


def _when(time: str, author: str) -> str:
    return _("{time} by {author}").format(time=time, author=author) if author else time


def _sign(status: str) -> str:
    return f"[{Status(status).color}]{Status(status).sign}[/]"


def _verdict(mark: Mark) -> str:
    named = mark.alternative if mark.alternative not in (None, mark.status) else ""
    return f"{mark.points:g} ({_(mark.status)}{', ' if named else ''}{named})"
