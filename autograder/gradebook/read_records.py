"""Reading everything about students out of the gradebook."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path

from autograder.gradebook.find_student import find_record
from autograder.gradebook.handed_in_before import HandedInBefore
from autograder.gradebook.overrides_and_notes import OverridesAndNotes
from autograder.gradebook.record import Attempt, Note, Override, Record
from autograder.gradebook.unusable_gradebook import readable_entries, readable_errors
from autograder.grading.graded_submission import Graded
from autograder.intake.origin import Origin, path_from_text
from autograder.intake.submissions import Submission
from autograder.marking import Mark
from autograder.marking.draw import set_number


class Records(HandedInBefore, OverridesAndNotes):
    """Everything about every student, as of one moment."""

    def records(self) -> list[Record]:
        """Everything about every student, by name, as of one moment."""
        with readable_errors(self.path), readable_entries(self.path):
            self._db.execute("BEGIN")
            try:
                return self._read_records()
            finally:
                self._db.execute("COMMIT")

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
                found = [
                    (key, path_from_text(path), origin_from_text(text)) for key, path, text in rows
                ]
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
            submission = Submission(student, path_from_text(path), origin=origin_from_text(origin))
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


def origin_from_text(text: str) -> Origin:
    """Where a submission comes from, as the gradebook keeps it."""
    return Origin.from_dict(json.loads(text))
