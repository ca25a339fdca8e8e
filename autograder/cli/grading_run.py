"""One run of the grader, from submissions to reports: what `grade` and `regrade` do."""

from __future__ import annotations

import os
import secrets
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

from rich.console import Console

from autograder.cli.exit_status import BROKEN, DONE, INTERRUPTED
from autograder.cli.run_options import GradingWanted
from autograder.cli.run_tally import Tally
from autograder.cli.shared_arguments import print_json
from autograder.course import Course
from autograder.errors import CourseError
from autograder.gradebook import ClassView, Gradebook, Record, Run, view_class
from autograder.grading.graded_submission import Graded
from autograder.grading.journal import Journal
from autograder.grading.numbers_of_others import compare_numbers
from autograder.grading.spread import Spread
from autograder.grading.threads import Threads
from autograder.grading.whole_class import grade_class
from autograder.intake.changed_files import changed_since, snapshot_class
from autograder.intake.long_list import LongList
from autograder.intake.submissions import Submission
from autograder.intake.summary import Summary
from autograder.language import _, n_
from autograder.marking.marker import Marker
from autograder.reports.json_output import change_fields, record_fields
from autograder.reports.pictures import Pictures
from autograder.reports.terminal import (
    MOST_IN_A_TABLE,
    print_changes,
    print_table,
    progress_bar,
    warn,
)
from autograder.reports.write import Options, write_reports
from autograder.sandbox.launcher import NO_SANDBOX, isolation_text

ON_A_CLUSTER = "unknown, on a cluster that has not answered yet"


def grade_and_report(
    wanted: GradingWanted,
    console: Console,
    course: Course,
    book: Gradebook,
    summary: Summary,
) -> int:
    """Grade, show what changed, and (unless it is a dry run) keep it and write the reports."""
    # What is broken is said before anything runs.
    class_list = summary.class_list
    submissions = LongList(Submission, (row.submission for row in summary.rows))
    Pictures(course)
    _require_packages(course)
    questions = frozenset(course.question(id).id for id in wanted.questions) or None
    run = _choose_run(wanted, course, book)
    marker = Marker(course, run.seed, tells=False)
    known = None
    if questions is None and not wanted.trial:
        known = _known(book, run, course)
    tally = Tally(book)
    if wanted.isolation == "none":
        warn(
            _(
                "--no-sandbox: nothing holds student code back. It can read and change your files, "
                "and use your network, as you can. Every report says so."
            )
        )
    people = {row.submission.student: row.match.people for row in summary.rows if row.match.people}
    if not wanted.trial:
        book.note_works()
    # As it was before any student code ran; so are the times in the summary.
    handed_in = snapshot_class(piece.path for entry in submissions for piece in entry.pieces)
    began = time.monotonic()
    interrupted = False
    with progress_bar() as progress:
        task = progress.add_task("", total=len(submissions))

        def done(entry: Graded) -> None:
            entry = compare_numbers(entry, course, people.get(entry.submission.student, ()))
            tally.add(entry)
            if not wanted.trial:
                book.store(entry, run, whole=questions is None)
            rate = tally.count / (time.monotonic() - began)
            said = ", ".join(filter(None, [spread.describe(), f"{rate:.1f} a second"]))
            progress.update(task, advance=1, description=said)

        spread: Spread
        if wanted.cluster is None:
            jobs = min(wanted.jobs, len(submissions))
            spread = Threads(marker, jobs, questions, wanted.isolation)
        else:
            from autograder.grading.dask_cluster import DaskCluster

            spread = DaskCluster(marker, wanted.cluster, questions, wanted.isolation, warn)
        progress.update(task, description=spread.describe())
        with spread:
            try:
                with _journal(wanted, book) as journal, _ended_orderly():
                    grade_class(
                        submissions, course, spread, done, questions, known, journal, book.works
                    )
            except KeyboardInterrupt:
                interrupted = True
            finally:
                if spread.isolation and not wanted.trial:
                    run = book.note_isolation(run, spread.isolation)
    if interrupted:
        return _after_interruption(wanted, console, course, book, summary, tally)
    _look_again(summary, tally, handed_in)
    if wanted.trial:
        _tell_trial(wanted, console, tally)
        return DONE
    book.finish_run(run, time.monotonic() - began)
    if wanted.explanations is not None:
        book.set("explanations", "yes" if wanted.explanations else "no")
    book.set_lateness((row.submission.student, row.lateness()) for row in summary.rows)
    view = view_class(course, book, class_list, streamed=True)
    summary.missing = tuple(view.missing)
    book.set("intake", summary.sentence())
    written = write_reports(course, book, Options(wanted.out, None, class_list))
    ended = BROKEN if wanted.strict and summary.needs_person else DONE
    if wanted.for_github:
        _tell_github(console, course, summary, _records(view, tally))
    if wanted.for_machines:
        records = _records(view, tally)
        print_json(
            {
                "gradebook": str(book.path),
                "run": {"id": run.id, "seed": run.seed, "isolation": run.isolation},
                "students": [record_fields(course, record) for record in records],
                "changed": [change_fields(change) for change in tally.changes()],
                "intake": summary.to_dict(),
            }
        )
        return ended
    for remark in summary.remarks():
        warn(remark)
    if console.is_terminal and tally.count <= MOST_IN_A_TABLE:
        print_table(console, course, _records(view, tally))
    if tally.changed and console.is_terminal:
        print_changes(console, tally.earned, tally.changes())
    elif tally.changed:
        changed = _("{marks} marks of {students} students changed.")
        console.print(changed.format(marks=len(tally.changed), students=len(tally.earned)))
    said = f" {_('(read as {rules})').format(rules='; '.join(summary.rules))}"
    said = said if summary.rules else ""
    console.print(f"{summary.sentence()}{said}; {written}.", soft_wrap=True, markup=False)
    return ended


def _tell_github(
    console: Console, course: Course, summary: Summary, records: Sequence[Record]
) -> None:
    """Add to the job's summary, and print the remarks that GitHub shows at the files."""
    from autograder.reports import github_summary

    pieces = {row.submission.student: row.submission.pieces for row in summary.rows}
    page = os.environ.get("GITHUB_STEP_SUMMARY")
    for record in records:
        paths = [piece.path for piece in pieces.get(record.student, ())]
        notebooks = [
            found
            for path in paths
            for found in (sorted(path.rglob("*.ipynb")) if path.is_dir() else [path])
        ]
        files = {
            chapter.name: os.path.relpath(path)
            for chapter in course.chapters
            for path in notebooks
            if chapter.name in path.stem
        }
        text = github_summary.summary(course, record)
        if page:
            with open(page, "a", encoding="utf-8", newline="\n") as file:
                file.write(text)
        for line in github_summary.remarks(course, record, files):
            console.out(line, highlight=False)


def _journal(wanted: GradingWanted, book: Gradebook) -> AbstractContextManager[Journal | None]:
    """What is at work, beside the gradebook; a regrade gives everybody another chance."""
    if wanted.trial:
        return nullcontext()
    return Journal(book.path.with_suffix(".at-work"), forget=wanted.regrade)


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


def _records(view: ClassView, tally: Tally) -> list[Record]:
    """Those whose work was graded in this run."""
    students = set(tally.students)
    return [record for record in view.records if record.student in students]


def _known(book: Gradebook, run: Run, course: Course) -> Callable[[Submission, str], Graded | None]:
    """What was graded before, with where it comes from now."""

    def known(submission: Submission, fingerprint: str) -> Graded | None:
        found = book.find(submission.student, fingerprint, run, course.questions.keys())
        return None if found is None else replace(found, submission=submission)

    return known


def _look_again(
    summary: Summary, tally: Tally, handed_in: Sequence[tuple[Path, tuple[int, int]]]
) -> None:
    """After the run: what could not be read, and which files are no longer as they were."""
    summary.unreadable = frozenset(tally.unreadable)
    if tally.passed_by:
        summary.warnings.append(
            _(
                "The work of {students} stopped the grader twice and was passed by; mark it by "
                "hand. After a change of the autograder, `autograder regrade` tries it again."
            ).format(students=", ".join(tally.passed_by))
        )
    altered = changed_since(handed_in)
    if altered:
        named = ", ".join(str(path) for path in altered[:5])
        summary.warnings.append(
            n_(
                "{count} file changed while it was graded ({files}); what was handed in was read "
                "before or after that. Look at it, and grade again.",
                "{count} files changed while they were graded ({files}); what was handed in was "
                "read before or after that. Look at them, and grade again.",
                len(altered),
            ).format(count=len(altered), files=named)
        )


def _after_interruption(
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


def _require_packages(course: Course) -> None:
    """Refuse to mark where what the course allows is not there: nobody's import may fail for it."""
    missing = [name for name in course.settings.packages if not find_spec(name.partition(".")[0])]
    if missing:
        raise CourseError(
            f"The course allows {', '.join(missing)} (packages in [tool.autograder]), and this "
            f"Python has no such module; install what provides it, then grade."
        )


def _choose_run(
    wanted: GradingWanted,
    course: Course,
    book: Gradebook,
) -> Run:
    """The last run goes on, unless the key, the seed or the wish to regrade asks for a new one.

    So does grading with the sandbox after a run without it, and the other way round.

    A new run draws the same hidden inputs as the last: what changes is then the key's doing.
    """
    last = book.last_run()
    seed = last.seed if last else secrets.randbits(32)
    if wanted.seed is not None:
        seed = wanted.seed
    if wanted.trial:
        return Run(0, course.version, seed)
    same_key = last is not None and (last.course_version, last.seed) == (course.version, seed)
    bare = wanted.isolation == "none"
    if last and same_key and not wanted.regrade and (last.isolation == NO_SANDBOX) == bare:
        return last
    # What holds on the workers of a cluster is not known before they are there.
    text = NO_SANDBOX if bare else ON_A_CLUSTER
    if wanted.cluster is None:
        text = isolation_text(course, wanted.isolation)
    return book.begin_run(course.version, seed, text)


def _tell_trial(wanted: GradingWanted, console: Console, tally: Tally) -> None:
    changed = tally.changes()
    if wanted.for_machines:
        print_json({"dry_run": True, "changed": [change_fields(change) for change in changed]})
        return
    print_changes(console, tally.earned, changed)
    console.print(_("{count} graded on trial; nothing was written.").format(count=tally.count))
