"""The command line: ``autograder grade``, ``check``, ``build``."""

from __future__ import annotations

import argparse
import os
import secrets
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from rich.console import Console

from autograder.course import Course, load_course
from autograder.errors import AutograderError, UsageError

DONE, BROKEN, WRONG_USAGE = 0, 1, 2


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return the exit status.

    0: done, whatever the marks; 1: the course or the run is broken; 2: wrong usage.
    """
    parsed = _parser().parse_args(arguments)
    console = Console(stderr=False, highlight=False)
    try:
        return int(parsed.run(parsed, console))
    except UsageError as error:
        print(f"autograder: {error}", file=sys.stderr)
        return WRONG_USAGE
    except AutograderError as error:
        print(f"autograder: {error}", file=sys.stderr)
        return BROKEN
    except KeyboardInterrupt:
        print(
            "autograder: stopped. What was graded is kept; run it again to go on.", file=sys.stderr
        )
        return BROKEN


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="autograder", description="Mark a course, prove it, and write its notebooks."
    )
    parser.add_argument(
        "--course", type=Path, metavar="DIR", help="the course's folder (default: found from here)"
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    grade = commands.add_parser("grade", help="mark submissions")
    grade.add_argument(
        "paths",
        nargs="+",
        type=Path,
        metavar="PATH",
        help="a zip, a notebook, a folder of one student, or a folder of submissions",
    )
    grade.add_argument("--out", type=Path, default=Path("grades"), metavar="DIR")
    grade.add_argument(
        "--jobs", type=_positive, default=os.cpu_count() or 1, metavar="N", help="how many at once"
    )
    grade.add_argument(
        "--question", action="append", metavar="ID", help="mark only this question (repeatable)"
    )
    grade.add_argument("--regrade", action="store_true", help="mark again what was marked before")
    grade.add_argument("--seed", type=int, metavar="N", help="of the hidden inputs")
    grade.set_defaults(run=_grade)

    check = commands.add_parser("check", help="prove the course")
    check.set_defaults(run=_check)

    build = commands.add_parser("build", help="write the notebooks from the masters")
    build.add_argument(
        "--check", action="store_true", help="write nothing; exit 1 if what is committed differs"
    )
    build.set_defaults(run=_build)
    return parser


def _positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("give a number of at least 1")
    return number


def _load(parsed: argparse.Namespace) -> Course:
    return load_course(parsed.course)


def _grade(parsed: argparse.Namespace, console: Console) -> int:
    from autograder.gradebook import Gradebook
    from autograder.grading import Graded, grade_all
    from autograder.marker import Marker
    from autograder.reports.grades_csv import write_grades_csv
    from autograder.reports.terminal import print_table, progress_bar
    from autograder.sandbox.launcher import Sandbox
    from autograder.submissions import find_submissions

    course = _load(parsed)
    assert course.key  # a broken key is said before anything runs
    for path in parsed.paths:
        if not path.exists():
            raise UsageError(f"There is nothing at {path}; name a file or folder that exists.")
    questions = frozenset(course.question(id).id for id in parsed.question or ()) or None
    submissions = find_submissions(parsed.paths, course.settings)
    if not submissions:
        raise UsageError(f"There are no submissions in {', '.join(map(str, parsed.paths))}.")

    book = Gradebook(parsed.out / "gradebook.db")
    run = book.last_run()
    if (
        run is None
        or parsed.regrade
        or run.course_version != course.version
        or parsed.seed not in (None, run.seed)
    ):
        seed = secrets.randbits(32) if parsed.seed is None else parsed.seed
        run = book.begin_run(course.version, seed, Sandbox.isolation)
    marker = Marker(course, run.seed)
    known = partial(book.find, run=run) if questions is None else None

    with progress_bar(console) as progress:
        task = progress.add_task("", total=len(submissions))

        def done(graded: Graded) -> None:
            book.store(graded, run)
            progress.advance(task)

        grade_all(submissions, marker, min(parsed.jobs, len(submissions)), done, questions, known)

    names = {submission.student for submission in submissions}
    everybody = book.all()
    write_grades_csv(parsed.out / "grades.csv", course, everybody)
    print_table(
        console, course, [graded for graded in everybody if graded.submission.student in names]
    )
    console.print(f"{len(submissions)} graded; {parsed.out / 'grades.csv'} is written.")
    book.close()
    return DONE


def _check(parsed: argparse.Namespace, console: Console) -> int:
    from autograder.authoring.proof import prove_course

    course = _load(parsed)
    with console.status("") as status:
        problems = prove_course(course.root, lambda step: status.update(f"proving: {step}"))
    for problem in problems:
        print(problem)
    if problems:
        print(f"{len(problems)} problem{'s' if len(problems) > 1 else ''}.")
        return BROKEN
    print(f"The course is sound: {len(course.questions)} questions prove themselves.")
    return DONE


def _build(parsed: argparse.Namespace, console: Console) -> int:
    from autograder.authoring import build

    course = _load(parsed)
    if parsed.check:
        stale = build.stale_notebooks(course)
        for path in stale:
            print(f"{path.relative_to(course.root)} differs from what the masters give.")
        if stale:
            print("Run `autograder build` and commit what it writes.")
        return BROKEN if stale else DONE
    with console.status("") as status:
        written = build.write(build.build_student_notebooks(course))
        written += build.write(
            build.build_solved_notebooks(course, lambda name: status.update(f"running {name}"))
        )
    for path in written:
        print(f"wrote {path.relative_to(course.root)}")
    if not written:
        print("Every notebook is up to date.")
    return DONE
