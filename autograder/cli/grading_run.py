"""One run of the grader, from submissions to reports: what `grade` and `regrade` do."""

from __future__ import annotations

import argparse
import secrets
import time
from functools import partial
from importlib.util import find_spec

from rich.console import Console

from autograder.cli.common import find_class_list, print_json
from autograder.cli.status import DONE
from autograder.course import Course
from autograder.errors import CourseError
from autograder.gradebook import Gradebook, Record, Run, view_class
from autograder.grading.changes import Change, changes
from autograder.grading.dask_address import parse_address
from autograder.grading.graded import Graded
from autograder.grading.spread import Spread
from autograder.grading.threads import Threads
from autograder.grading.whole_class import grade_class
from autograder.intake.class_list import handed_in_at
from autograder.intake.submissions import Submission
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
    submissions: list[Submission],
    regrade: bool,
) -> int:
    """Grade, show what changed, and (unless it is a dry run) keep it and write the reports."""
    # What is broken is said before anything runs.
    find_class_list(parsed, book)
    Pictures(course)
    _require_packages(course)
    address = None if parsed.cluster is None else parse_address(parsed.cluster)
    questions = frozenset(course.question(id).id for id in parsed.question or ()) or None
    # The times count as they were before any student code ran.
    handed_in = {submission.student: handed_in_at(submission.path) for submission in submissions}
    before = {record.student: record for record in book.records()}
    isolation: Isolation = "none" if parsed.no_sandbox else "auto"
    run = _choose_run(parsed, course, book, regrade, isolation)
    marker = Marker(course, run.seed)
    known = None
    if questions is None and not parsed.dry_run:
        known = partial(book.find, run=run, questions=course.questions.keys())
    graded: list[Graded] = []
    if parsed.no_sandbox:
        warn("Student code runs with your own rights (--no-sandbox); every report says so.")
    began = time.monotonic()
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
        if address is None:
            jobs = min(parsed.jobs, len(submissions))
            spread = Threads(marker, jobs, questions, isolation)
        else:
            from autograder.grading.dask_cluster import DaskCluster

            spread = DaskCluster(marker, address, questions, isolation, warn)
        with spread:
            try:
                grade_class(submissions, course, spread, done, questions, known)
            finally:
                if spread.isolation and not parsed.dry_run:
                    run = book.note_isolation(run, spread.isolation)
    changed = changes(before, graded)
    if parsed.dry_run:
        _tell_dry_run(parsed, console, before, changed, len(graded))
        return DONE
    book.finish_run(run, time.monotonic() - began)
    if parsed.explanations is not None:
        book.set("explanations", "yes" if parsed.explanations else "no")
    students = {submission.student for submission in submissions}
    class_list = find_class_list(parsed, book)
    book.set_lateness(
        {student: class_list.lateness(student, found) for student, found in handed_in.items()}
    )
    touched = [s.student for s in submissions if handed_in_at(s.path) != handed_in[s.student]]
    if touched:
        warn(
            f"While this ran, the files of {', '.join(touched)} were changed; what was graded, and "
            "whether it was late, is as it was at the start. Look who changed them, then regrade."
        )
    options = Options(parsed.out, students, class_list)
    written = write_reports(course, book, options, console)
    records = [
        record
        for record in view_class(course, book, class_list).records
        if record.student in students
    ]
    if parsed.json:
        print_json(
            {
                "gradebook": str(book.path),
                "run": {"id": run.id, "seed": run.seed, "isolation": run.isolation},
                "students": [record_fields(course, record) for record in records],
                "changed": [change_fields(change) for change in changed],
            }
        )
        return DONE
    if console.is_terminal:
        print_table(console, course, records)
    if changed and console.is_terminal:
        print_changes(console, before, changed)
    elif changed:
        students = {change.student for change in changed}
        console.print(f"{len(changed)} marks of {len(students)} students are others than before.")
    console.print(f"{len(submissions)} graded; {written}.", soft_wrap=True, markup=False)
    return DONE


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
