"""Grades one submission inside Gradescope's container, and writes ``results.json``.

``python -m autograder.release.gradescope.run --root /autograder`` reads ``submission/`` and
``submission_metadata.json`` below the root. The course is the one that this package lies in.
"""

from __future__ import annotations

import argparse
import json
import secrets
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path

from autograder.course import load_course
from autograder.gradebook.record import Record
from autograder.grading.graded_submission import Graded
from autograder.grading.threads import Threads
from autograder.grading.whole_class import grade_class
from autograder.intake.submissions import Submission
from autograder.marking.marker import Marker
from autograder.release.gradescope.results import failure, results
from autograder.reports.json_output import most_points
from autograder.reports.whole_files import write_text
from autograder.sandbox.launcher import SandboxError


def main(arguments: Sequence[str] | None = None) -> int:
    """Grade, and write results even if grading fails; returns 0 unless they cannot be written."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", type=Path, default=Path("/autograder"))
    parser.add_argument("--course", type=Path, default=Path(__file__).parents[3])
    parser.add_argument("--explanations", action="store_true")
    parsed = parser.parse_args(arguments)
    try:
        found = _grade(parsed.root, parsed.course, parsed.explanations)
    except Exception as error:
        # For the instructor, who sees standard output; students see one sentence.
        traceback.print_exc(file=sys.stdout)
        found = failure(type(error).__name__, 0.0)
    write_text(parsed.root / "results/results.json", json.dumps(found, indent=1) + "\n")
    return 0


def _grade(root: Path, course_root: Path, explanations: bool) -> dict[str, object]:
    course = load_course(course_root)
    submission = Submission(_student(root), root / "submission")
    marker = Marker(course, secrets.randbits(32), tells=False)
    done: list[Graded] = []
    try:
        with Threads(marker, 1) as spread:
            grade_class([submission], course, spread, done.append)
    except SandboxError as error:
        print(error)
        return failure("student code could not be isolated", most_points(course))
    return results(course, Record(done[0], 0, marker.seed), explanations)


def _student(root: Path) -> str:
    try:
        metadata = json.loads((root / "submission_metadata.json").read_text(encoding="utf-8"))
        return ", ".join(str(user["name"]) for user in metadata["users"]) or "student"
    except (OSError, ValueError, KeyError, TypeError):
        return "student"


if __name__ == "__main__":
    raise SystemExit(main())
