"""What people decide: points by hand in place of a mark's, and remarks about students."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping

from autograder.gradebook.gradebook_file import GradebookFile, now_text
from autograder.gradebook.record import Note, Override
from autograder.gradebook.unusable_gradebook import readable_entries


class OverridesAndNotes(GradebookFile):
    """The overrides and the notes in a gradebook; none is ever taken out."""

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
        given = Override(
            student, question, points, reason, now_text(), author, levels or {}, response
        )
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

    def note(self, student: str, text: str, author: str = "") -> None:
        """Add a remark about a student."""
        self.add([], [Note(student, text, now_text(), author)])

    def notes(self) -> list[Note]:
        """Every remark, oldest first."""
        return self._notes()

    def _notes(self, where: str = "", values: tuple[object, ...] = ()) -> list[Note]:
        rows = self._rows(
            f"SELECT student, text, made_at, author FROM note {where} ORDER BY id", values
        )
        return [Note(*row) for row in rows]
