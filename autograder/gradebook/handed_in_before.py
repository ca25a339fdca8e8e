"""What students had handed in before the submission of now: its fingerprints and its marks."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator, Sequence

from autograder.gradebook.gradebook_file import GradebookFile, now_text
from autograder.gradebook.unusable_gradebook import readable_entries
from autograder.grading.graded_submission import Graded

_WORKS = "works of "  # a student


class HandedInBefore(GradebookFile):
    """The order in which each student's works first came."""

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


def keep_attempt(db: sqlite3.Connection, graded: Graded) -> None:
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
            now_text(),
        ),
    )


def _in_turns(students: Sequence[str]) -> Iterator[Sequence[str]]:
    """As many at once as SQLite takes in one question."""
    for start in range(0, len(students), 250):
        yield students[start : start + 250]
