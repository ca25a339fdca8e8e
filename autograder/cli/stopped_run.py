"""A run that is told to stop: it ends in order, and what is done gets its reports."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console

from autograder.cli.exit_status import INTERRUPTED
from autograder.cli.run_options import GradingWanted
from autograder.cli.run_tally import Tally
from autograder.course import Course
from autograder.gradebook import Gradebook
from autograder.intake.summary import Summary
from autograder.language import _
from autograder.reports.terminal import (
    warn,
)
from autograder.reports.write import Options, write_reports


@contextmanager
def ended_orderly() -> Iterator[None]:
    """While grading, being told to end, as by a closed terminal, is like Ctrl-C."""

    def interrupt(number: int, frame: object) -> None:
        raise KeyboardInterrupt

    before = {}
    if threading.current_thread() is threading.main_thread():
        for name in ("SIGTERM", "SIGHUP"):
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) is signal.SIG_DFL:
                before[number] = signal.signal(number, interrupt)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def after_interruption(
    wanted: GradingWanted,
    console: Console,
    course: Course,
    book: Gradebook,
    summary: Summary,
    tally: Tally,
) -> int:
    """Write the reports of what is done, and say how to go on."""
    count = len(summary.rows)
    if tally.count and not wanted.trial:
        students = set(tally.students)
        rows = (row for row in summary.rows if row.submission.student in students)
        book.set_lateness((row.submission.student, row.lateness()) for row in rows)
        options = Options(wanted.out, students, summary.class_list)
        write_reports(course, book, options)
        sentence = _(
            "Stopped: {some} of {all} were graded; their reports are written; run it again to go "
            "on."
        )
    else:
        sentence = _("Stopped: {some} of {all} were graded; nothing was written.")
    warn(sentence.format(some=tally.count, all=count))
    return INTERRUPTED
