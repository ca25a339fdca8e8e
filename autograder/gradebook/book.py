"""Reading and writing the gradebook."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from autograder.gradebook.lookup import find_record
from autograder.gradebook.record import Attempt, Note, Override, Record
from autograder.gradebook.schema import connect, readable_errors
from autograder.grading.graded import Graded
from autograder.intake.origin import Origin, path_from_text, path_to_text
from autograder.intake.submissions import Submission
from autograder.marking import Mark
from autograder.marking.draw import set_number

_WORKS = "works"


@dataclass(frozen=True)
class Run:
    """One run of the grader: the key and the seed that decide the marks."""

    id: int
    course_version: str
    seed: int
    isolation: str = ""
    started_at: str = ""
    seconds: float = 0.0


class Gradebook:
    """Submissions and marks; every write is one transaction, readers may look on meanwhile."""

    def __init__(self, path: Path, create: bool = True) -> None:
        """Open the gradebook, or begin one.

        Raises:
            GradebookError: if the file is damaged, something else or from a newer version, or if it
                is missing and ``create`` is false.
        """
        self.path = path
        self._db = connect(path, create)

    def __enter__(self) -> Gradebook:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the file."""
        self._db.close()

    @contextmanager
    def _transaction(self) -> Iterator[sqlite3.Connection]:
        with readable_errors(self.path):
            self._db.execute("BEGIN IMMEDIATE")
            try:
                yield self._db
            except BaseException:
                self._db.execute("ROLLBACK")
                raise
            self._db.execute("COMMIT")

    def _rows(self, query: str, values: tuple[Any, ...] = ()) -> list[Any]:
        with readable_errors(self.path):
            return self._db.execute(query, values).fetchall()

    # Runs

    def last_run(self) -> Run | None:
        """The latest run, if there was one."""
        rows = self._rows(
            "SELECT id, course_version, seed, isolation, started_at, seconds "
            "FROM run ORDER BY id DESC LIMIT 1"
        )
        return Run(*rows[0]) if rows else None

    def begin_run(self, course_version: str, seed: int, isolation: str = "") -> Run:
        """Note a new run."""
        started = _now()
        with self._transaction() as db:
            cursor = db.execute(
                "INSERT INTO run (course_version, seed, isolation, started_at) VALUES (?, ?, ?, ?)",
                (course_version, seed, isolation, started),
            )
        assert cursor.lastrowid is not None
        return Run(cursor.lastrowid, course_version, seed, isolation, started)

    def finish_run(self, run: Run, seconds: float) -> None:
        """Note that everything of a run was graded; a run that was resumed adds up."""
        with self._transaction() as db:
            db.execute(
                "UPDATE run SET finished_at = ?, seconds = seconds + ? WHERE id = ?",
                (_now(), seconds, run.id),
            )

    def note_isolation(self, run: Run, isolation: str) -> Run:
        """Note what kept student code in, beside what did so in this run before."""
        before = [] if run.isolation.startswith("unknown") else run.isolation.split("; and ")
        if isolation in before:
            return run
        text = "; and ".join([*before, isolation])
        with self._transaction() as db:
            db.execute("UPDATE run SET isolation = ? WHERE id = ?", (text, run.id))
        return replace(run, isolation=text)

    # Submissions and marks

    def store(self, graded: Graded, run: Run, whole: bool = True) -> None:
        """Write one submission and its marks, all or nothing.

        Unless the ``whole`` of it was graded, earlier marks of other questions stay. Overrides stay
        always.
        """
        with self._transaction() as db:
            if whole:
                _keep_attempt(db, graded)
                db.execute("DELETE FROM mark WHERE student = ?", (graded.submission.student,))
            db.execute(
                "INSERT INTO submission "
                "(student, path, fingerprint, status, notes, run, seconds, origin) "
                "VALUES (?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT (student) DO UPDATE "
                "SET path = excluded.path, fingerprint = excluded.fingerprint, "
                "status = excluded.status, notes = excluded.notes, run = excluded.run, "
                "seconds = excluded.seconds, origin = excluded.origin",
                (
                    graded.submission.student,
                    path_to_text(graded.submission.path),
                    graded.fingerprint,
                    graded.status,
                    json.dumps(graded.notes),
                    run.id,
                    graded.seconds,
                    json.dumps(graded.submission.origin.to_dict()),
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
            "SELECT path, status, notes, seconds, origin FROM submission "
            "WHERE student = ? AND fingerprint = ? AND run = ? AND status = 'graded'",
            (student, fingerprint, run.id),
        )
        marked = self._rows(
            "SELECT question FROM mark WHERE student = ? AND run = ?", (student, run.id)
        )
        if not rows or not {question for (question,) in marked} >= set(questions):
            return None
        path, status, notes, seconds, origin = rows[0]
        marks = self._marks("WHERE student = ?", (student,))[student]
        submission = Submission(student, path_from_text(path), origin=_origin(origin))
        return Graded(submission, status, fingerprint, marks, tuple(json.loads(notes)), seconds)

    def works(self) -> dict[str, list[str]]:
        """The fingerprints of what each student handed in until now, in the order it first came."""
        found: dict[str, list[str]] = json.loads(self.setting(_WORKS) or "{}")
        for student, fingerprint in self._rows(
            "SELECT student, fingerprint FROM (SELECT student, fingerprint, 0 AS now, id "
            "FROM attempt UNION ALL SELECT student, fingerprint, 1, 0 FROM submission) "
            "WHERE fingerprint != '' ORDER BY now, id"
        ):
            known = found.setdefault(student, [])
            if fingerprint not in known:
                known.append(fingerprint)
        return found

    def note_works(self) -> dict[str, list[str]]:
        """As `works`; from now on their order stays, whatever comes back."""
        found = self.works()
        self.set(_WORKS, json.dumps(found))
        return found

    def records(self) -> list[Record]:
        """Everything about every student, by name, as of one moment."""
        with readable_errors(self.path):
            self._db.execute("BEGIN")
            try:
                return self._read_records()
            finally:
                self._db.execute("COMMIT")

    def record(self, student: str) -> Record:
        """Everything about one student, by key; upper and lower case do not matter.

        Raises:
            UsageError: if there is no such student; the sentence names those that are near.
        """
        return find_record(self.records(), student)

    def _read_records(self) -> list[Record]:
        marks = self._marks()
        overrides: dict[str, dict[str, Override]] = {}
        disputes: dict[str, dict[str, tuple[Override, ...]]] = {}
        for entry, disputed in self._overrides():
            counting = overrides.setdefault(entry.student, {})
            disputed_ones = disputes.setdefault(entry.student, {})
            before = counting.pop(entry.question, None)
            if disputed:
                others = disputed_ones.get(entry.question) or ((before,) if before else ())
                disputed_ones[entry.question] = (*others, entry)
                continue
            disputed_ones.pop(entry.question, None)
            if entry.points is not None:
                counting[entry.question] = entry
        notes: dict[str, list[Note]] = {}
        for note in self.notes():
            notes.setdefault(note.student, []).append(note)
        attempts: dict[str, list[Attempt]] = {}
        for student, *fields, text in self._rows(
            "SELECT student, handed_in, late_percent, replaced_at, fingerprint, marks "
            "FROM attempt ORDER BY id"
        ):
            past = tuple(Mark.from_dict(mark) for mark in json.loads(text))
            attempts.setdefault(student, []).append(Attempt(past, *fields))
        rows = self._rows(
            "SELECT student, path, fingerprint, status, notes, submission.seconds, origin, run, "
            "seed, handed_in, late_days, late_percent, isolation, course_version "
            "FROM submission JOIN run ON run.id = submission.run ORDER BY student"
        )
        found, works = [], self.works()
        for student, path, fingerprint, status, odd, seconds, origin, run, seed, *rest in rows:
            number = set_number(student, fingerprint, works.get(student, ()))
            handed_in, late_days, late_percent, isolation, version = rest
            submission = Submission(student, path_from_text(path), origin=_origin(origin))
            notes_on_files = tuple(json.loads(odd))
            found.append(
                Record(
                    Graded(
                        *(submission, status, fingerprint, marks.get(student, ())),
                        *(notes_on_files, seconds),
                    ),
                    run,
                    seed,
                    overrides.get(student, {}),
                    tuple(notes.get(student, ())),
                    handed_in,
                    late_days,
                    late_percent,
                    isolation,
                    version,
                    tuple(attempts.get(student, ())),
                    disputes.get(student, {}),
                    set_number=number,
                )
            )
        return found

    def _marks(self, where: str = "", values: tuple[Any, ...] = ()) -> dict[str, tuple[Mark, ...]]:
        marks: dict[str, list[Mark]] = {}
        for student, text in self._rows(
            f"SELECT student, mark FROM mark {where} ORDER BY rowid", values
        ):
            marks.setdefault(student, []).append(Mark.from_dict(json.loads(text)))
        return {student: tuple(found) for student, found in marks.items()}

    # What people decide

    def override(
        self,
        student: str,
        question: str,
        points: float | None,
        reason: str,
        author: str = "",
        levels: Mapping[str, str] | None = None,
        response: str = "",
    ) -> None:
        """Give points in place of a mark's; None withdraws the override."""
        given = Override(student, question, points, reason, _now(), author, levels or {}, response)
        self.add([given], [])

    def add(
        self,
        overrides: Iterable[Override],
        notes: Iterable[Note],
        disputed: Iterable[Override] = (),
    ) -> None:
        """Add what people decided, here or in another gradebook; ``disputed`` counts for nobody."""
        with self._transaction() as db:
            for entries, is_disputed in ((overrides, 0), (disputed, 1)):
                db.executemany(
                    "INSERT INTO override (student, question, points, reason, made_at, author, "
                    "levels, response, disputed) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
                    [
                        (
                            entry.student,
                            entry.question,
                            entry.points,
                            entry.reason,
                            entry.made_at,
                            entry.author,
                            json.dumps(dict(entry.levels)),
                            entry.response,
                            is_disputed,
                        )
                        for entry in entries
                    ],
                )
            db.executemany(
                "INSERT INTO note (student, text, made_at, author) VALUES (?, ?, ?, ?)",
                [(note.student, note.text, note.made_at, note.author) for note in notes],
            )

    def overrides(self, student: str | None = None) -> list[Override]:
        """Every override there ever was, oldest first, of one student or of all."""
        return [
            entry for entry, _ in self._overrides() if student is None or entry.student == student
        ]

    def decisions(self) -> list[tuple[Override, bool]]:
        """Every override there ever was, and whether it is disputed."""
        return list(self._overrides())

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

    def _overrides(self) -> Iterator[tuple[Override, bool]]:
        for row in self._rows(
            "SELECT student, question, points, reason, made_at, author, levels, response, disputed "
            "FROM override ORDER BY id"
        ):
            student, question, points, reason, made_at, author, levels, response, disputed = row
            said = json.loads(levels)
            entry = Override(student, question, points, reason, made_at, author, said, response)
            yield entry, bool(disputed)

    def notes(self) -> list[Note]:
        """Every remark, oldest first."""
        return [
            Note(*row)
            for row in self._rows("SELECT student, text, made_at, author FROM note ORDER BY id")
        ]

    def note(self, student: str, text: str, author: str = "") -> None:
        """Add a remark about a student."""
        self.add([], [Note(student, text, _now(), author)])

    def set_lateness(self, late: Mapping[str, tuple[str | None, int, float]]) -> None:
        """Write for each student when it was handed in, the days late and the percent they cost."""
        with self._transaction() as db:
            db.executemany(
                "UPDATE submission SET handed_in = ?, late_days = ?, late_percent = ? "
                "WHERE student = ?",
                [(*values, student) for student, values in late.items()],
            )

    def setting(self, name: str) -> str | None:
        """What was set under a name, None if nothing was."""
        rows = self._rows("SELECT value FROM setting WHERE name = ?", (name,))
        return rows[0][0] if rows else None

    def set(self, name: str, value: str) -> None:
        """Keep a setting."""
        with self._transaction() as db:
            db.execute("INSERT OR REPLACE INTO setting VALUES (?, ?)", (name, value))


def _keep_attempt(db: sqlite3.Connection, graded: Graded) -> None:
    """Keep the marks of what a student had handed in before, if this is other work."""
    student = graded.submission.student
    before = db.execute(
        "SELECT fingerprint, run, handed_in, late_days, late_percent FROM submission "
        "WHERE student = ? AND status = 'graded' AND fingerprint NOT IN ('', ?)",
        (student, graded.fingerprint),
    ).fetchone()
    if before is None or not graded.fingerprint:
        return
    marks = db.execute(
        "SELECT mark FROM mark WHERE student = ? ORDER BY rowid", (student,)
    ).fetchall()
    fingerprint, run, *late = before
    # Work that comes back after other work is the same attempt as before.
    db.execute(
        "DELETE FROM attempt WHERE student = ? AND fingerprint IN (?, ?)",
        (student, fingerprint, graded.fingerprint),
    )
    db.execute(
        "INSERT INTO attempt (student, fingerprint, run, marks, handed_in, late_days, "
        "late_percent, replaced_at) VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
        (
            student,
            fingerprint,
            run,
            json.dumps([json.loads(mark) for (mark,) in marks]),
            *late,
            _now(),
        ),
    )


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


def _origin(text: str) -> Origin:
    return Origin.from_dict(json.loads(text))
