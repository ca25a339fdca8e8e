"""The runs of the grader: the key and the seed that decided the marks, and how it isolated."""

from __future__ import annotations

from dataclasses import dataclass, replace

from autograder.gradebook.gradebook_file import GradebookFile, now_text


@dataclass(frozen=True)
class Run:
    """One run of the grader: the key and the seed that decide the marks."""

    id: int
    course_version: str
    seed: int
    isolation: str = ""
    started_at: str = ""
    seconds: float = 0.0


class Runs(GradebookFile):
    """The runs in a gradebook."""

    def last_run(self) -> Run | None:
        """The latest run, if there was one."""
        rows = self._rows(
            "SELECT id, course_version, seed, isolation, started_at, seconds "
            "FROM run ORDER BY id DESC LIMIT 1"
        )
        return Run(*rows[0]) if rows else None

    def begin_run(self, course_version: str, seed: int, isolation: str = "") -> Run:
        """Note a new run."""
        started = now_text()
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
                (now_text(), seconds, run.id),
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
