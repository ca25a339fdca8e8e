"""One run of the grader, from submissions to reports: what `grade` and `regrade` do."""

from __future__ import annotations

import argparse
import secrets
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

from rich.console import Console

from autograder.cli.common import print_json
from autograder.cli.status import BROKEN, DONE, INTERRUPTED
from autograder.course import Course
from autograder.errors import CourseError
from autograder.gradebook import Gradebook, Record, Run, view_class
from autograder.gradebook.changes import Change, changes
from autograder.grading.graded import Graded
from autograder.grading.journal import STOPPED_THE_GRADER, Journal
from autograder.grading.spread import Spread
from autograder.grading.threads import Threads
from autograder.grading.whole_class import grade_class
from autograder.intake.submissions import Submission
from autograder.intake.summary import Summary
from autograder.intake.times import changed_since, snapshot
from autograder.marking.marker import Marker
from autograder.reports.machine import change_fields, record_fields
from autograder.reports.pictures import Pictures
from autograder.reports.terminal import print_changes, print_table, progress_bar, warn
from autograder.reports.write import Options, write_reports
from autograder.sandbox.launcher import NO_SANDBOX, Isolation, isolation_text

ON_A_CLUSTER = "unknown, on a cluster that has not answered yet"


def grade_and_report(
    parsed: argparse.Namespace,
    console: Console,
    course: Course,
    book: Gradebook,
    summary: Summary,
    regrade: bool,
) -> int:
    """Grade, show what changed, and (unless it is a dry run) keep it and write the reports."""
    # What is broken is said before anything runs.
    class_list = summary.class_list
    submissions = [row.submission for row in summary.rows]
    Pictures(course)
    _require_packages(course)
    questions = frozenset(course.question(id).id for id in parsed.question or ()) or None
    # The times count as they were before any student code ran.
    lateness = {row.submission.student: row.lateness() for row in summary.rows}
    before = {record.student: record for record in book.records()}
    isolation: Isolation = "none" if parsed.no_sandbox else "auto"
    run = _choose_run(parsed, course, book, regrade, isolation)
    marker = Marker(course, run.seed, tells=False)
    known = None
    if questions is None and not parsed.dry_run:
        known = _known(book, run, course, submissions)
    graded: list[Graded] = []
    if parsed.no_sandbox:
        warn("Student code runs with your own rights (--no-sandbox); every report says so.")
    works = book.works() if parsed.dry_run else book.note_works()
    handed_in = snapshot([piece.path for entry in submissions for piece in entry.pieces])
    began = time.monotonic()
    interrupted = False
    with progress_bar() as progress:
        task = progress.add_task("", total=len(submissions))

        def done(entry: Graded) -> None:
            graded.append(entry)
            if not parsed.dry_run:
                book.store(entry, run, whole=questions is None)
            rate = len(graded) / (time.monotonic() - began)
            said = ", ".join(filter(None, [spread.describe(), f"{rate:.1f} a second"]))
            progress.update(task, advance=1, description=said)

        spread: Spread
        if parsed.cluster is None:
            jobs = min(parsed.jobs, len(submissions))
            spread = Threads(marker, jobs, questions, isolation)
        else:
            from autograder.grading.dask_cluster import DaskCluster

            spread = DaskCluster(marker, parsed.cluster, questions, isolation, warn)
        with spread:
            try:
                with _journal(parsed, book, regrade) as journal, _ended_orderly():
                    grade_class(submissions, course, spread, done, questions, known, journal, works)
            except KeyboardInterrupt:
                interrupted = True
            finally:
                if spread.isolation and not parsed.dry_run:
                    run = book.note_isolation(run, spread.isolation)
    if interrupted:
        return _after_interruption(parsed, console, course, book, summary, graded)
    _look_again(summary, graded, handed_in)
    changed = changes(before, graded)
    if parsed.dry_run:
        _tell_dry_run(parsed, console, before, changed, len(graded))
        return DONE
    book.finish_run(run, time.monotonic() - began)
    if parsed.explanations is not None:
        book.set("explanations", "yes" if parsed.explanations else "no")
    students = {submission.student for submission in submissions}
    book.set_lateness(lateness)
    view = view_class(course, book, class_list)
    summary.missing = tuple(view.missing)
    book.set("intake", summary.sentence())
    options = Options(parsed.out, students, class_list)
    written = write_reports(course, book, options, console)
    ended = BROKEN if parsed.strict and summary.needs_person else DONE
    records = [record for record in view.records if record.student in students]
    if parsed.json:
        print_json(
            {
                "gradebook": str(book.path),
                "run": {"id": run.id, "seed": run.seed, "isolation": run.isolation},
                "students": [record_fields(course, record) for record in records],
                "changed": [change_fields(change) for change in changed],
                "intake": summary.to_dict(),
            }
        )
        return ended
    for remark in summary.remarks():
        warn(remark)
    if console.is_terminal:
        print_table(console, course, records)
    if changed and console.is_terminal:
        print_changes(console, before, changed)
    elif changed:
        students = {change.student for change in changed}
        console.print(f"{len(changed)} marks of {len(students)} students changed.")
    said = f" (read as {'; '.join(summary.rules)})" if summary.rules else ""
    console.print(f"{summary.sentence()}{said}; {written}.", soft_wrap=True, markup=False)
    return ended


def _journal(
    parsed: argparse.Namespace, book: Gradebook, regrade: bool
) -> AbstractContextManager[Journal | None]:
    """What is at work, beside the gradebook; a regrade gives everybody another chance."""
    if parsed.dry_run:
        return nullcontext()
    return Journal(book.path.with_suffix(".at-work"), forget=regrade)


@contextmanager
def _ended_orderly() -> Iterator[None]:
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


def _known(
    book: Gradebook, run: Run, course: Course, submissions: list[Submission]
) -> Callable[[str, str], Graded | None]:
    """What was graded before, with where it comes from now."""
    by_student = {submission.student: submission for submission in submissions}

    def known(student: str, fingerprint: str) -> Graded | None:
        found = book.find(student, fingerprint, run, course.questions.keys())
        return None if found is None else replace(found, submission=by_student[student])

    return known


def _look_again(
    summary: Summary, graded: list[Graded], handed_in: dict[Path, tuple[int, int]]
) -> None:
    """After the run: what could not be read, and which files are no longer as they were."""
    summary.unreadable = frozenset(
        entry.submission.student for entry in graded if entry.status == "unreadable"
    )
    stopped = [entry.submission.student for entry in graded if STOPPED_THE_GRADER in entry.notes]
    if stopped:
        summary.warnings.append(
            f"The work of {', '.join(stopped)} stopped the grader twice and was passed by; mark it "
            "by hand. After a change of the autograder, `autograder regrade` tries it again."
        )
    altered = changed_since(handed_in)
    if altered:
        named = ", ".join(str(path) for path in altered[:5])
        summary.warnings.append(
            f"{len(altered)} files changed while they were graded ({named}); what was handed in "
            "was read before or after that. Look at them, and grade again."
        )


def _after_interruption(
    parsed: argparse.Namespace,
    console: Console,
    course: Course,
    book: Gradebook,
    summary: Summary,
    graded: list[Graded],
) -> int:
    """Write the reports of what is done, and say how to go on."""
    count = len(summary.rows)
    if graded and not parsed.dry_run:
        students = {entry.submission.student for entry in graded}
        rows = [row for row in summary.rows if row.submission.student in students]
        book.set_lateness({row.submission.student: row.lateness() for row in rows})
        options = Options(parsed.out, students, summary.class_list)
        write_reports(course, book, options, console)
        kept = "their reports are written; run it again to go on"
    else:
        kept = "nothing was written"
    warn(f"Stopped: {len(graded)} of {count} were graded; {kept}.")
    return INTERRUPTED


def _require_packages(course: Course) -> None:
    """Refuse to mark where what the course allows is not there: nobody's import may fail for it."""
    missing = [name for name in course.settings.packages if not find_spec(name.partition(".")[0])]
    if missing:
        raise CourseError(
            f"The course allows {', '.join(missing)} (packages in [tool.autograder]), and this "
            f"Python has no such module; install what provides it, then grade."
        )


def _choose_run(
    parsed: argparse.Namespace,
    course: Course,
    book: Gradebook,
    regrade: bool,
    isolation: Isolation,
) -> Run:
    """The last run goes on, unless the key, the seed or the wish to regrade asks for a new one.

    So does grading with the sandbox after a run without it, and the other way round.

    A new run draws the same hidden inputs as the last: what changes is then the key's doing.
    """
    last = book.last_run()
    seed = last.seed if last else secrets.randbits(32)
    if parsed.seed is not None:
        seed = parsed.seed
    if parsed.dry_run:
        return Run(0, course.version, seed)
    same_key = last is not None and (last.course_version, last.seed) == (course.version, seed)
    if last and same_key and not regrade and (last.isolation == NO_SANDBOX) == parsed.no_sandbox:
        return last
    # What holds on the workers of a cluster is not known before they are there.
    text = NO_SANDBOX if isolation == "none" else ON_A_CLUSTER
    if parsed.cluster is None:
        text = isolation_text(course, isolation)
    return book.begin_run(course.version, seed, text)


def _tell_dry_run(
    parsed: argparse.Namespace,
    console: Console,
    before: dict[str, Record],
    changed: list[Change],
    count: int,
) -> None:
    if parsed.json:
        print_json({"dry_run": True, "changed": [change_fields(change) for change in changed]})
        return
    print_changes(console, before, changed)
    console.print(f"{count} graded on trial; nothing was written.")
