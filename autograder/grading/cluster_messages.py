"""What crosses between the coordinator and a worker: contents out, marks back, as JSON in bytes.

Nothing here is pickled. Of a submission only what was read and checked crosses: no file, no path.
"""

from __future__ import annotations

import json
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from autograder.grading.graded_submission import Graded
from autograder.grading.spread import Task
from autograder.intake.submissions import Contents, Notebook, Submission
from autograder.marking import Mark


@dataclass(frozen=True)
class Broken:
    """The machine, or the course on it, failed; ``reason`` is a sentence."""

    reason: str


@dataclass(frozen=True)
class Order:
    """One submission as a worker sees it; ``questions`` are those to mark (None: all)."""

    student: str
    contents: Contents
    seed: int
    set_number: int
    questions: frozenset[str] | None

    def submission(self) -> Submission:
        """The submission without its path, which means nothing on another machine."""
        return Submission(self.student, Path())


def pack_order(task: Task, seed: int, questions: Collection[str] | None) -> bytes:
    """What a worker needs to grade a task."""
    contents = task.contents
    return _pack(
        {
            "student": task.submission.student,
            "notebooks": {
                name: [book.cells, book.receipts, list(book.notes)]
                for name, book in contents.notebooks.items()
            },
            "sidecars": contents.sidecars,
            "unreadable": contents.unreadable,
            "notes": contents.notes,
            "fingerprint": contents.fingerprint,
            "seed": seed,
            "set": task.set_number,
            "questions": None if questions is None else sorted(questions),
        }
    )


def unpack_order(data: bytes) -> Order:
    """The order that `pack_order` wrote."""
    fields = json.loads(data)
    contents = Contents(
        {name: Notebook(*book) for name, book in fields["notebooks"].items()},
        fields["sidecars"],
        fields["unreadable"],
        fields["notes"],
        fields["fingerprint"],
    )
    questions = fields["questions"]
    return Order(
        fields["student"],
        contents,
        fields["seed"],
        fields["set"],
        None if questions is None else frozenset(questions),
    )


def pack_result(result: Graded | Broken) -> bytes:
    """What the coordinator is told: the marks as the gradebook stores them, or what is broken."""
    if isinstance(result, Broken):
        return _pack({"broken": result.reason})
    return _pack(
        {
            "fingerprint": result.fingerprint,
            "marks": [mark.to_dict() for mark in result.marks],
            "notes": result.notes,
            "seconds": result.seconds,
            "doubtful": result.is_doubtful,
            "numbers_of": result.numbers_of,
            "predictions": dict(result.predictions),
            "isolation": result.isolation,
        }
    )


def unpack_result(data: bytes, submission: Submission) -> Graded | Broken:
    """The result that `pack_result` wrote, for the submission that it is about."""
    fields = json.loads(data)
    if "broken" in fields:
        return Broken(str(fields["broken"]))
    return Graded(
        submission,
        "graded",
        fields["fingerprint"],
        tuple(Mark.from_dict(mark) for mark in fields["marks"]),
        tuple(fields["notes"]),
        fields["seconds"],
        fields["doubtful"],
        fields["numbers_of"],
        fields["predictions"],
        fields["isolation"],
    )


def _pack(fields: dict[str, object]) -> bytes:
    return json.dumps(fields).encode()
