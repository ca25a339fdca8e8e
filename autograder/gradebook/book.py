"""The gradebook: submissions and their marks are written here, all the rest beside it."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Mapping

from autograder.gradebook.handed_in_before import keep_attempt
from autograder.gradebook.read_records import Records, origin_from_text
from autograder.gradebook.record import Record
from autograder.gradebook.runs import Run, Runs
from autograder.gradebook.unusable_gradebook import readable_entries
from autograder.grading.graded_submission import Graded
from autograder.intake.origin import path_from_text, path_to_text
from autograder.intake.submissions import Submission


class Gradebook(Runs, Records):
    """Submissions and marks, runs, and what people decided."""

    def store(self, graded: Graded, run: Run, whole: bool = True) -> None:
        """Write one submission and its marks, all or nothing.

        Unless the ``whole`` of it was graded, earlier marks of other questions stay. Overrides stay
        always.
        """
        with self._transaction() as db:
            if whole:
                keep_attempt(db, graded)
                db.execute("DELETE FROM mark WHERE student = ?", (graded.submission.student,))
            db.execute(
                "INSERT INTO submission "
                "(student, path, fingerprint, status, notes, run, seconds, origin, predictions, "
                "numbers_of, isolation) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?) "
                "ON CONFLICT (student) DO UPDATE "
                "SET path = excluded.path, fingerprint = excluded.fingerprint, "
                "status = excluded.status, notes = excluded.notes, run = excluded.run, "
                "seconds = excluded.seconds, origin = excluded.origin, "
                "predictions = excluded.predictions, numbers_of = excluded.numbers_of, "
                "isolation = excluded.isolation",
                (
                    graded.submission.student,
                    path_to_text(graded.submission.path),
                    graded.fingerprint,
                    graded.status,
                    json.dumps(graded.notes),
                    run.id,
                    graded.seconds,
                    json.dumps(graded.submission.origin.to_dict()),
                    json.dumps(dict(graded.predictions)),
                    graded.numbers_of,
                    graded.isolation,
                ),
            )
            db.executemany(
                "INSERT OR REPLACE INTO mark VALUES (?, ?, ?, ?)",
                [
                    (graded.submission.student, m.question, run.id, json.dumps(m.to_dict()))
                    for m in graded.marks
                ],
            )

    def find(
        self, student: str, fingerprint: str, run: Run, questions: Collection[str] = ()
    ) -> Graded | None:
        """What was graded before: the same work, in the same run, with a mark for each question."""
        rows = self._rows(
            "SELECT path, status, notes, seconds, origin, predictions, numbers_of, isolation "
            "FROM submission WHERE student = ? AND fingerprint = ? AND run = ? "
            "AND status = 'graded'",
            (student, fingerprint, run.id),
        )
        marked = self._rows(
            "SELECT question FROM mark WHERE student = ? AND run = ?", (student, run.id)
        )
        if not rows or not {question for (question,) in marked} >= set(questions):
            return None
        path, status, notes, seconds, origin, predictions, numbers_of, isolation = rows[0]
        with readable_entries(self.path):
            marks = self._marks("WHERE student = ?", (student,))[student]
            submission = Submission(student, path_from_text(path), origin=origin_from_text(origin))
            return Graded(
                *(submission, status, fingerprint, marks, tuple(json.loads(notes)), seconds),
                numbers_of=numbers_of,
                predictions=json.loads(predictions),
                isolation=isolation,
            )

    def adopt(self, record: Record) -> None:
        """Take over the submission and the marks of a student from another gradebook."""
        run = self.last_run()
        same = run is not None and (run.course_version, run.seed) == (
            record.course_version,
            record.seed,
        )
        if run is None or not same:
            run = self.begin_run(record.course_version, record.seed, record.isolation)
        self.store(record.graded, run)
        late = (record.handed_in, record.late_days, record.late_percent)
        self.set_lateness({record.student: late})
        with self._transaction() as db:
            db.executemany(
                "INSERT INTO attempt (student, fingerprint, run, marks, handed_in, late_days, "
                "late_percent, replaced_at) VALUES (?, ?, ?, ?, ?, 0, ?, ?)",
                [
                    (
                        record.student,
                        attempt.fingerprint,
                        run.id,
                        json.dumps([mark.to_dict() for mark in attempt.marks]),
                        attempt.handed_in,
                        attempt.late_percent,
                        attempt.replaced_at,
                    )
                    for attempt in record.attempts
                ],
            )

    def set_lateness(
        self,
        late: Mapping[str, tuple[str | None, int, float]]
        | Iterable[tuple[str, tuple[str | None, int, float]]],
    ) -> None:
        """Write for each student when it was handed in, the days late and the percent they cost."""
        entries = late.items() if isinstance(late, Mapping) else late
        with self._transaction() as db:
            db.executemany(
                "UPDATE submission SET handed_in = ?, late_days = ?, late_percent = ? "
                "WHERE student = ?",
                ((*values, student) for student, values in entries),
            )
