"""One run of the grader, from submissions to reports: what `grade` and `regrade` do."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from pathlib import Path

from rich.console import Console

from autograder.cli.choose_run import choose_run
from autograder.cli.exit_status import BROKEN, DONE
from autograder.cli.required_packages import require_packages
from autograder.cli.run_options import GradingWanted
from autograder.cli.run_tally import Tally
from autograder.cli.shared_arguments import print_json
from autograder.cli.stopped_run import after_interruption, ended_orderly
from autograder.cli.tell_github import tell_github
from autograder.course import Course
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
from autograder.sandbox.stale_bytecode import never_renewed


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
    require_packages(course)
    questions = frozenset(course.question(id).id for id in wanted.questions) or None
    run = choose_run(wanted, course, book)
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
    if folder := never_renewed():
        warn(
            _(
                "The compiled modules in {folder} are missing or older than their sources, and you "
                "may not write there: every start compiles them anew, for some seconds. Whoever "
                "may write there ends that by: {command}"
            ).format(folder=folder, command=f'python -m compileall -q "{folder}"')
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
                with _journal(wanted, book) as journal, ended_orderly():
                    grade_class(
                        submissions, course, spread, done, questions, known, journal, book.works
                    )
            except KeyboardInterrupt:
                interrupted = True
            finally:
                if spread.isolation and not wanted.trial:
                    run = book.note_isolation(run, spread.isolation)
    if interrupted:
        return after_interruption(wanted, console, course, book, summary, tally)
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
        tell_github(console, course, summary, _records(view, tally))
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


def _journal(wanted: GradingWanted, book: Gradebook) -> AbstractContextManager[Journal | None]:
    """What is at work, beside the gradebook; a regrade gives everybody another chance."""
    if wanted.trial:
        return nullcontext()
    return Journal(book.path.with_suffix(".at-work"), forget=wanted.regrade)


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


def _tell_trial(wanted: GradingWanted, console: Console, tally: Tally) -> None:
    changed = tally.changes()
    if wanted.for_machines:
        print_json({"dry_run": True, "changed": [change_fields(change) for change in changed]})
        return
    print_changes(console, tally.earned, changed)
    console.print(_("{count} graded on trial; nothing was written.").format(count=tally.count))
