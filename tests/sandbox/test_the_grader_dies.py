"""Whatever one submission does to the grader itself, the run goes on at the next start."""

import json
import os
import signal
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest

from autograder.grading.journal import Journal
from autograder.intake.submissions import Submission
from tests.classroom import hand_in, make_course

pytestmark = pytest.mark.long

# The grader as it is, but for one thing: it dies as soon as it marks mallory's work.
DIES = """
import os, signal, sys
from autograder.grading import threads
real = threads.grade_submission
def grade(submission, *others):
    with open({log!r}, "a") as file:
        file.write(submission.student + "\\n")
    if submission.student in {killers!r}:
        os.kill(os.getpid(), signal.{signal})
    return real(submission, *others)
threads.grade_submission = grade
from autograder.cli import main
sys.exit(main(sys.argv[1:]))
"""
NAMES = ("ada", "bob", "mallory", "zoe")


@pytest.fixture
def school(tmp_path: Path) -> Path:
    make_course(tmp_path / "course")
    for name in NAMES:
        hand_in(tmp_path / "work", name)
    return tmp_path


def grade(
    school: Path, *options: str, killers: tuple[str, ...] = ("mallory",), by: str = "SIGKILL"
) -> subprocess.CompletedProcess[str]:
    program = DIES.format(log=str(school / "log"), killers=killers, signal=by)
    arguments = ["--course", str(school / "course"), "grade", str(school / "work")]
    arguments += ["--out", str(school / "out"), "--jobs", "1", *options]
    return subprocess.run(
        [sys.executable, "-c", program, *arguments], capture_output=True, text=True, check=False
    )


def begun(school: Path) -> list[str]:
    """Who was graded since this was asked last, in order."""
    lines = (school / "log").read_text().split()
    (school / "log").unlink()
    return lines


def statuses(school: Path) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    with closing(sqlite3.connect(school / "out/gradebook.db")) as db:
        for student, mark in db.execute("SELECT student, mark FROM mark"):
            found.setdefault(student, set()).add(json.loads(mark)["status"])
    return found


def test_what_the_grader_dies_of_is_passed_by_and_everybody_else_is_graded(school):
    for _ in range(2):
        assert grade(school).returncode == -signal.SIGKILL
        assert begun(school)[-1] == "mallory"
    done = grade(school, "--json")
    assert done.returncode == 0, done.stderr
    assert statuses(school) == {name: {"right"} for name in NAMES if name != "mallory"} | {
        "mallory": {"killed"}
    }
    said = json.loads(done.stdout)["intake"]
    assert said["needs_person"]
    assert "mallory" in " ".join(said["warnings"])
    # A later run passes it by as well; other work of the same student is tried.
    hand_in(school / "work", "mallory", Q2="trees = 7")
    assert grade(school, "--strict", killers=()).returncode == 0
    assert "killed" not in statuses(school)["mallory"]


def test_work_that_is_blameless_after_all_is_graded_alone_at_the_end(school):
    assert grade(school, killers=("bob",)).returncode == -signal.SIGKILL
    begun(school)
    hand_in(school / "work", "new")
    assert grade(school, killers=()).returncode == 0
    assert begun(school)[0] == "new"  # what nobody suspects comes first
    assert set(statuses(school)) == {*NAMES, "new"}
    assert set().union(*statuses(school).values()) == {"right"}
    assert not (school / "out/gradebook.at-work").exists()


def test_a_regrade_tries_it_again(tmp_path):
    mallory = Submission("mallory", tmp_path / "mallory")
    for _ in range(2):
        journal = Journal(tmp_path / "gradebook.at-work")
        journal.begin(mallory)
        os.close(journal._file)  # as if it had died
    with Journal(tmp_path / "gradebook.at-work") as journal:
        assert journal.deaths(mallory) == 2
    with Journal(tmp_path / "gradebook.at-work", forget=True) as journal:
        assert journal.deaths(mallory) == 0


def test_a_grader_that_was_told_to_end_suspects_nobody(school):
    stopped = grade(school, by="SIGTERM")
    assert stopped.returncode == 130, stopped.stderr
    assert "run it again" in stopped.stderr
    assert not (school / "out/gradebook.at-work").exists()
    begun(school)
    assert grade(school, killers=()).returncode == 0
    assert set(statuses(school)) == set(NAMES)


def test_a_journal_that_breaks_off_in_the_midst_of_a_line_is_read_as_far_as_it_goes(tmp_path):
    ada, bob = (Submission(name, tmp_path / name) for name in ("ada", "bob"))
    journal = Journal(tmp_path / "out/gradebook.at-work")
    journal.begin(ada)
    journal.begin(bob)
    journal.end(ada)
    os.close(journal._file)  # as if it had died
    with (tmp_path / "out/gradebook.at-work").open("ab") as file:
        file.write(b'["begun", "half')
    with Journal(tmp_path / "out/gradebook.at-work") as after:
        assert [after.deaths(ada), after.deaths(bob)] == [0, 1]


def test_a_grader_that_is_still_at_work_is_not_taken_for_dead(tmp_path):
    ada = Submission("ada", tmp_path / "ada")
    with Journal(tmp_path / "gradebook.at-work") as first:
        first.begin(ada)
        second = subprocess.run(
            [
                sys.executable,
                "-c",
                "import sys; from pathlib import Path\n"
                "from autograder.grading.journal import Journal\n"
                "from autograder.intake.submissions import Submission\n"
                "with Journal(Path(sys.argv[1])) as journal:\n"
                "    print(journal.deaths(Submission('ada', Path(sys.argv[2]))))",
                str(tmp_path / "gradebook.at-work"),
                str(tmp_path / "ada"),
            ],
            capture_output=True,
            text=True,
            check=True,
        )
        assert second.stdout.strip() == "0"
