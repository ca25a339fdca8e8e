"""How one submission is graded: contents, a marker and a sandbox make marks."""

from __future__ import annotations

import time
from collections.abc import Collection
from dataclasses import replace

from autograder.course import Course
from autograder.course.predictions import Guess
from autograder.errors import AutograderError, machine_error
from autograder.exchange.identity import said_to_be
from autograder.grading.chapter import grade_chapter
from autograder.grading.graded_submission import Graded, grader_failed, same_mark_for_all
from autograder.intake.name_in_code import said_in_code
from autograder.intake.submissions import Contents, Submission
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.sandbox.launcher import Sandbox
from autograder.sandbox.machine_to_blame import Doubt


def grade_submission(
    submission: Submission,
    contents: Contents,
    marker: Marker,
    sandbox: Sandbox,
    questions: Collection[str] | None = None,
) -> Graded:
    """Grade one submission; an error of the grader's own costs this submission alone.

    Raises:
        AutograderError: if the course or this machine is broken, not the submission: no mark says
            that there was no memory, no process or no room left here.
    """
    began = time.monotonic()
    sandbox.doubt = Doubt()
    fingerprint, notes = contents.fingerprint, tuple(contents.notes)
    try:
        marks = tuple(grade_contents(contents, marker, sandbox, questions))
        notes = tuple(contents.notes)  # running it may have added some
    except AutograderError:
        raise
    except Exception as error:
        short = machine_error(error)
        if short is not None:
            raise short from None
        # No submission, whatever it did, may keep the others from being graded. Without a
        # fingerprint it is not taken for graded, and the next run tries again.
        said = grader_failed(error)
        marks = same_mark_for_all(marker.course, "killed", said, questions)
        fingerprint, notes = "", (*notes, said)
    seconds = time.monotonic() - began
    doubtful = sandbox.doubt.is_doubtful
    said = _says(contents) if marker.course.personal else ""
    predictions = predictions_of(contents, marker.course)
    return Graded(
        *(submission, "graded", fingerprint, marks, notes, seconds, doubtful, said, predictions),
        isolation=sandbox.isolation,
    )


def predictions_of(contents: Contents, course: Course) -> dict[str, Guess]:
    """What a student predicted: the saved responses are the truth, receipts stand in for them.

    Both are files of a student; what the course does not ask for or does not allow is left out.
    """
    kept: dict[str, object] = {}
    for notebook in contents.notebooks.values():
        kept |= notebook.receipts
    for entries in contents.sidecars.values():
        kept |= {id: entry.get("response") for id, entry in entries.items()}
    return {
        id: value for id, asked in course.predictions.items() if asked.fits(value := kept.get(id))
    }


def grade_contents(
    contents: Contents,
    marker: Marker,
    sandbox: Sandbox,
    questions: Collection[str] | None = None,
) -> list[Mark]:
    """Mark the notebooks of one student, in the order of the course's questions.

    Where students have numbers of their own, these are those of whom the work says it is from.
    """
    contents = _by_chapter(contents, marker.course)
    student = _says(contents)
    marker = marker.for_student(student)
    deadline = time.monotonic() + marker.course.settings.submission_seconds
    return [
        mark
        for chapter in marker.course.chapters
        for mark in grade_chapter(
            chapter,
            [q for q in chapter.questions if questions is None or q.id in questions],
            contents,
            marker,
            sandbox,
            deadline,
            student if marker.course.personal else "",
        )
    ]


def _says(contents: Contents) -> str:
    """Who the work says it is from: its responses, or its notebooks where those are not there."""
    cells = (cell for name in sorted(contents.notebooks) for cell in contents.notebooks[name].cells)
    return said_to_be(contents.sidecars) or said_in_code(cells)


def _by_chapter(contents: Contents, course: Course) -> Contents:
    """The contents with every notebook under a chapter of the course.

    A notebook whose name says nothing (``jacobi.ipynb``) is recognised by the questions it asks.
    """
    known = {chapter.name for chapter in course.chapters}
    notebooks = {name: book for name, book in contents.notebooks.items() if name in known}
    for name, notebook in contents.notebooks.items():
        code = "\n".join(notebook.cells)
        asked = {
            chapter.name: sum(f'"{question.id}"' in code for question in chapter.questions)
            for chapter in course.chapters
            if chapter.name not in notebooks
        }
        likeliest = max(asked, key=lambda chapter: asked[chapter], default=None)
        if name not in known and likeliest is not None and asked[likeliest] > 0:
            notebooks[likeliest] = notebook
    return replace(contents, notebooks=notebooks)
