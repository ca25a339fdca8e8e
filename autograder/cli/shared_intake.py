"""What `grade`, `regrade` and `intake` share: submissions with their people and times."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from autograder.cli.run_options import IntakeWanted
from autograder.course import Course
from autograder.errors import UsageError
from autograder.gradebook import Gradebook
from autograder.intake.class_list import ClassList
from autograder.intake.find_submissions import take_in
from autograder.intake.handout import handout_of
from autograder.intake.layouts.layout import Context
from autograder.intake.submissions import Submission, Unreadable, read_submission
from autograder.intake.summary import Summary
from autograder.intake.times_csv import read_times
from autograder.intake.whose_and_when import summarise

_TRUST = "trust_times"


def take_in_paths(
    wanted: IntakeWanted, course: Course, class_list: ClassList, book: Gradebook | None
) -> Summary:
    """What is at the paths, whose it is and when it was handed in.

    Raises:
        UsageError: if there is nothing, or if it is not clear what it is.
    """
    for path in wanted.paths:
        if not path.exists():
            raise UsageError(f"There is nothing at {path}; name a file or folder that exists.")
    late = class_list.late
    context = Context(
        course.settings,
        handout_of(course),
        class_list.students,
        late.due + late.grace if late else None,
        class_list.zone,
    )
    known = _known_keys(book) if book is not None else {}
    intake = take_in(wanted.paths, course.settings, context, wanted.layout, known)
    if not intake.submissions:
        why = (
            f": {intake.passed_over[0].place} was passed over, it is {intake.passed_over[0].reason}"
        )
        raise UsageError(
            f"There are no submissions in {', '.join(map(str, wanted.paths))}"
            f"{why if intake.passed_over else ''}."
        )
    summary = settle(wanted, class_list, intake.submissions, book)
    summary.passed_over = intake.passed_over
    summary.rules = intake.rules
    summary.warnings = [*intake.warnings, *summary.warnings]
    return summary


def settle(
    wanted: IntakeWanted,
    class_list: ClassList,
    submissions: Sequence[Submission],
    book: Gradebook | None,
) -> Summary:
    """Whose submissions are and when they were handed in."""
    times = _times(wanted, class_list)
    return summarise(submissions, class_list, times, _trusted(wanted, book))


def unreadable_students(course: Course, summary: Summary) -> frozenset[str]:
    """Those whose submission cannot be read at all; each is opened for this."""
    handout = handout_of(course)
    found = set()
    for row in summary.rows:
        try:
            read_submission(row.submission, course.settings, handout)
        except Unreadable:
            found.add(row.submission.student)
    return frozenset(found)


def _known_keys(book: Gradebook) -> dict[tuple[str, str], str]:
    return {
        (origin.layout, origin.prefix or path.name): student
        for student, path, origin in book.origins()
    }


def _times(wanted: IntakeWanted, class_list: ClassList) -> dict[str, datetime]:
    """The table that is given, or `times.csv` beside the submissions or the gradebook."""
    if wanted.times is not None:
        return read_times(wanted.times, class_list.zone)
    folders: list[Path] = [path for path in wanted.paths if path.is_dir()]
    for folder in (*folders, wanted.out):
        if (folder / "times.csv").is_file():
            return read_times(folder / "times.csv", class_list.zone)
    return {}


def _trusted(wanted: IntakeWanted, book: Gradebook | None) -> bool:
    if wanted.trust_times is None:
        return book is not None and book.setting(_TRUST) == "yes"
    if book is not None and not wanted.trial:
        book.set(_TRUST, "yes" if wanted.trust_times else "no")
    return bool(wanted.trust_times)
