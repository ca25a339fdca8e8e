"""What may have been the machine's doing is graded once more, alone and last."""

from dataclasses import replace
from pathlib import Path

import pytest

from autograder.grading.cluster_messages import pack_result, unpack_result
from autograder.grading.graded_submission import Graded
from autograder.grading.spread import Task
from autograder.grading.whole_class import grade_class
from autograder.intake.find_submissions import find_submissions
from tests.classroom import graded, hand_in, make_course


class Doubtful:
    """A spread whose first results are in doubt."""

    isolation, has_room = "", True

    def __init__(self, times: dict[str, int]) -> None:
        self._times = times
        self._tasks: list[Task] = []
        self.begun: list[list[str]] = []  # what was under way whenever something was begun

    @property
    def under_way(self) -> int:
        return len(self._tasks)

    def __enter__(self) -> "Doubtful":
        return self

    def __exit__(self, *exception: object) -> None: ...

    def begin(self, task: Task, more: int) -> None:
        self._tasks.append(task)
        self.begun.append([entry.submission.student for entry in self._tasks])

    def finished(self, wait: bool) -> list[Graded]:
        tasks, self._tasks = (self._tasks, []) if wait else ([], self._tasks)
        found = []
        for task in tasks:
            student = task.submission.student
            doubtful = self._times.get(student, 0) > 0
            self._times[student] = self._times.get(student, 0) - 1
            entry = graded(student, notes=(f"try {-self._times[student]}",), is_doubtful=doubtful)
            found.append(replace(entry, submission=task.submission))
        return found

    def describe(self) -> str:
        return ""


@pytest.mark.parametrize("times", [1, 5])
def test_a_doubtful_submission_is_tried_once_more_and_then_counts(tmp_path: Path, times: int):
    course = make_course(tmp_path / "course")
    for name in ("ada", "bob", "zoe"):
        hand_in(tmp_path / "work", name)
    spread, done = Doubtful({"ada": times}), []
    grade_class(find_submissions([tmp_path / "work"], course.settings), course, spread, done.append)
    assert [entry.submission.student for entry in done] == ["bob", "zoe", "ada"]
    assert spread.begun[-1] == ["ada"]  # alone
    assert sum(begun[-1] == "ada" for begun in spread.begun) == 2


def test_a_doubt_crosses_from_a_worker():
    entry = graded("ada", is_doubtful=True)
    assert unpack_result(pack_result(entry), entry.submission).is_doubtful
