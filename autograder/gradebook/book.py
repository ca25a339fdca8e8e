"""Reading and writing the gradebook."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from autograder.gradebook.lookup import find_record
from autograder.gradebook.record import Attempt, Note, Override, Record
from autograder.gradebook.schema import connect, readable_entries, readable_errors
from autograder.grading.graded_submission import Graded
from autograder.intake.origin import Origin, path_from_text, path_to_text
from autograder.intake.submissions import Submission
from autograder.marking import Mark
from autograder.marking.draw import set_number

_WORKS = "works of "  # a student


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

    def _rows(self, query: str, values: tuple[object, ...] = ()) -> list[Any]:
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
            submission = Submission(student, path_from_text(path), origin=_origin(origin))
            return Graded(
                *(submission, status, fingerprint, marks, tuple(json.loads(notes)), seconds),
                numbers_of=numbers_of,
                predictions=json.loads(predictions),
                isolation=isolation,
            )

    def works(self, student: str) -> list[str]:
        """The fingerprints of what a student handed in until now, in the order they first came."""
        return self._works_of([student]).get(student, [])

    def note_works(self) -> None:
        """From now on the order of everybody's `works` stays, whatever comes back."""
        for several in _in_turns(self.students()):
            noted = self._noted_works(several)
            found = self._works_of(several)
            with self._transaction() as db:
                db.executemany(
                    "INSERT OR REPLACE INTO setting VALUES (?, ?)",
                    [
                        (_WORKS + student, json.dumps(works))
                        for student, works in found.items()
                        if works != noted.get(student)
                    ],
                )

    def _works_of(self, students: Sequence[str]) -> dict[str, list[str]]:
        found: dict[str, list[str]] = {}
        for several in _in_turns(students):
            found |= self._works_of_several(several)
        return found

    def _works_of_several(self, students: Sequence[str]) -> dict[str, list[str]]:
        found = self._noted_works(students)
        among = f"fingerprint != '' AND student IN ({', '.join('?' * len(students))})"
        for table, order in (("attempt", "id"), ("submission", "student")):
            for student, fingerprint in self._rows(
                f"SELECT student, fingerprint FROM {table} WHERE {among} ORDER BY {order}",
                tuple(students),
            ):
                known = found.setdefault(student, [])
                if fingerprint not in known:
                    known.append(fingerprint)
        return found

    def _noted_works(self, students: Sequence[str]) -> dict[str, list[str]]:
        rows = self._rows(
            f"SELECT name, value FROM setting WHERE name IN ({', '.join('?' * len(students))})",
            tuple(_WORKS + student for student in students),
        )
        with readable_entries(self.path):
            return {name.removeprefix(_WORKS): list(json.loads(value)) for name, value in rows}

    def records(self) -> list[Record]:
        """Everything about every student, by name, as of one moment."""
        with readable_errors(self.path), readable_entries(self.path):
            self._db.execute("BEGIN")
            try:
                return self._read_records()
            finally:
                self._db.execute("COMMIT")

    def students(self) -> list[str]:
        """The keys of all students, in their order."""
        return [row[0] for row in self._rows("SELECT student FROM submission ORDER BY student")]

    def records_of(self, students: Sequence[str]) -> list[Record]:
        """Everything about some hundred students at most, in their order; absent ones are not."""
        with readable_errors(self.path), readable_entries(self.path):
            return self._read_records(students)

    def origins(self) -> Iterator[tuple[str, Path, Origin]]:
        """The key of every student, the path of the work and where it comes from, by name."""
        last = None
        while rows := self._rows(
            "SELECT student, path, origin FROM submission WHERE ?1 IS NULL OR student > ?1 "
            "ORDER BY student LIMIT 500",
            (last,),
        ):
            with readable_entries(self.path):
                found = [(key, path_from_text(path), _origin(text)) for key, path, text in rows]
            yield from found
            last = rows[-1][0]

    def record(self, student: str) -> Record:
        """Everything about one student, by key; upper and lower case do not matter.

        Raises:
            UsageError: if there is no such student; the sentence names those that are near.
        """
        return find_record(self.records(), student)

    def _read_records(self, students: Sequence[str] | None = None) -> list[Record]:
        chosen, names = "", tuple(students or ())
        if students is not None:
            chosen = f"WHERE student IN ({', '.join('?' * len(names))})"
        marks = self._marks(chosen, names)
        overrides: dict[str, dict[str, Override]] = {}
        disputes: dict[str, dict[str, tuple[Override, ...]]] = {}
        for entry, disputed in self._overrides(chosen, names):
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
        for note in self._notes(chosen, names):
            notes.setdefault(note.student, []).append(note)
        attempts: dict[str, list[Attempt]] = {}
        for student, *fields, text in self._rows(
            "SELECT student, handed_in, late_percent, replaced_at, fingerprint, marks "
            f"FROM attempt {chosen} ORDER BY id",
            names,
        ):
            past = tuple(Mark.from_dict(mark) for mark in json.loads(text))
            attempts.setdefault(student, []).append(Attempt(past, *fields))
        rows = self._rows(
            "SELECT student, path, fingerprint, status, notes, submission.seconds, origin, run, "
            "seed, handed_in, late_days, late_percent, run.isolation, course_version, predictions, "
            "numbers_of, submission.isolation FROM submission JOIN run ON run.id = submission.run "
            f"{chosen} ORDER BY student",
            names,
        )
        found, works = [], self._works_of([row[0] for row in rows])
        for student, path, fingerprint, status, odd, seconds, origin, run, seed, *rest in rows:
            number = set_number(student, fingerprint, works.get(student, ()))
            handed_in, late_days, late_percent, of_run, version, predictions, *rest = rest
            numbers_of, isolation = rest
            submission = Submission(student, path_from_text(path), origin=_origin(origin))
            notes_on_files = tuple(json.loads(odd))
            found.append(
                Record(
                    Graded(
                        *(submission, status, fingerprint, marks.get(student, ())),
                        *(notes_on_files, seconds),
                        numbers_of=numbers_of,
                        predictions=json.loads(predictions),
                        isolation=isolation,
                    ),
                    run,
                    seed,
                    overrides.get(student, {}),
                    tuple(notes.get(student, ())),
                    handed_in,
                    late_days,
                    late_percent,
                    isolation or of_run,
                    version,
                    tuple(attempts.get(student, ())),
                    disputes.get(student, {}),
                    set_number=number,
                )
            )
        return found

    def _marks(
        self, where: str = "", values: tuple[object, ...] = ()
    ) -> dict[str, tuple[Mark, ...]]:
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

    def _overrides(
        self, where: str = "", values: tuple[object, ...] = ()
    ) -> Iterator[tuple[Override, bool]]:
        for row in self._rows(
            "SELECT student, question, points, reason, made_at, author, levels, response, disputed "
            f"FROM override {where} ORDER BY id",
            values,
        ):
            student, question, points, reason, made_at, author, levels, response, disputed = row
            with readable_entries(self.path):
                said = dict(json.loads(levels))
            entry = Override(student, question, points, reason, made_at, author, said, response)
            yield entry, bool(disputed)

    def notes(self) -> list[Note]:
        """Every remark, oldest first."""
        return self._notes()

    def _notes(self, where: str = "", values: tuple[object, ...] = ()) -> list[Note]:
        rows = self._rows(
            f"SELECT student, text, made_at, author FROM note {where} ORDER BY id", values
        )
        return [Note(*row) for row in rows]

    def note(self, student: str, text: str, author: str = "") -> None:
        """Add a remark about a student."""
        self.add([], [Note(student, text, _now(), author)])

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


def _in_turns(students: Sequence[str]) -> Iterator[Sequence[str]]:
    """As many at once as SQLite takes in one question."""
    for start in range(0, len(students), 250):
        yield students[start : start + 250]


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


def _origin(text: str) -> Origin:
    return Origin.from_dict(json.loads(text))
