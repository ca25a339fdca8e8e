"""The progress bar and the table that ``autograder grade`` prints."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from autograder.course import Course
from autograder.grading import Graded

_LETTERS = {
    "right": "[green]✓[/]",
    "partial": "[yellow]◐[/]",
    "wrong": "[red]✗[/]",
    "not attempted": "[dim]·[/]",
    "recorded": "●",
    "error": "[red]E[/]",
    "timeout": "[red]T[/]",
    "killed": "[red]K[/]",
    "unreadable": "[red]?[/]",
}
LEGEND = "✓ right  ◐ partial  ✗ wrong  · not attempted  E error  T timeout  K killed  ? unreadable"


def progress_bar(console: Console) -> Progress:
    """A bar with the count and the time that is left; silent when nobody watches."""
    return Progress(
        TextColumn("grading"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.description}"),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )


def print_table(console: Console, course: Course, graded: Sequence[Graded]) -> None:
    """A row a student: a sign for each question, grouped by chapter, and the total."""
    most = sum(question.points for question in course.questions.values())
    table = Table(box=None, pad_edge=False)
    table.add_column("student", overflow="fold")
    for chapter in course.chapters:
        table.add_column(chapter.title, overflow="fold")
    table.add_column("points", justify="right")
    table.add_column("", overflow="fold")
    for entry in graded:
        statuses = {mark.question: mark.status for mark in entry.marks}
        signs = [
            "".join(
                _LETTERS.get(statuses.get(question.id, ""), " ") for question in chapter.questions
            )
            for chapter in course.chapters
        ]
        notes = " ".join(entry.notes)
        table.add_row(
            escape(printable(entry.submission.student)),
            *signs,
            f"{entry.total:g} / {most:g}",
            escape(printable(notes)),
        )
    console.print(table)
    console.print(f"[dim]{LEGEND}[/]")


def printable(text: str) -> str:
    """Text without control characters, so that no name can write to the terminal."""
    return "".join(character if character.isprintable() else "�" for character in text)
