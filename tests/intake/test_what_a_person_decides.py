"""What no rule may decide: whose work it is, whether times can be believed, what a folder is."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest

from autograder.cli import grading_run, main
from autograder.course import Course
from tests.classroom import START, notebook
from tests.intake.classes import commit, git, put
from tests.intake.conftest import Reader
from tests.intake.handed_in import zipped

pytestmark = pytest.mark.usefixtures("nothing_runs")

PEOPLE = """Name,Login,Email
Ada Lovelace,ada,ada@example.org
Ada Lovelace,ada2,lovelace@example.org
George Boole,boole,boole@example.org
Marie Curie,curie,curie@example.org
"""
LATE = "[late]\ndue = 2026-11-20T12:00:00Z\npercent_a_day = 10\n"
BOOK = notebook([START, "trees = 12"]).encode()
Told = dict[str, Any]


class Class:
    """A folder of work with a class list; `intake` and `grade` return the status and the JSON."""

    def __init__(self, course: Course, root: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self.course, self.root, self.capsys = course, root, capsys
        self.work, self.out = root / "work", root / "grades"
        self.lists = [put(root / "people.csv", PEOPLE.encode())]
        self.lists.append(put(root / "policy.toml", LATE.encode()))

    def hand_in(self, *names: str, data: bytes = BOOK) -> None:
        for name in names:
            put(self.work / name, zipped({"3_orchard.ipynb": data}))

    def run(self, command: str, *arguments: str, path: Path | None = None) -> tuple[int, Told]:
        lists = [said for list in self.lists for said in ("--class-list", str(list))]
        where = [str(path or self.work), "--out", str(self.out), "--json", *lists]
        status = main(["--course", str(self.course.root), command, *where, *arguments])
        self.err = ""
        told = self.capsys.readouterr()
        self.err = told.err
        found = json.loads(told.out) if told.out else {}
        return status, found.get("intake", found)

    def intake(self, *arguments: str, path: Path | None = None) -> Told:
        status, told = self.run("intake", *arguments, path=path)
        assert status == 0, self.err
        return told

    def of(self, told: Told, student: str) -> Told:
        (entry,) = (entry for entry in told["submissions"] if entry["student"] == student)
        found: Told = entry
        return found


@pytest.fixture
def school(course: Course, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(course, tmp_path, capsys)


# --- whose it is


def test_the_line_that_is_printed_for_a_doubtful_name_settles_it(school: Class):
    school.hand_in("Ada Lovelace.zip", "boole.zip")
    told = school.intake()
    entry = school.of(told, "Ada Lovelace")
    assert entry["person"] is None
    assert {person["login"] for person in entry["candidates"]} == {"ada", "ada2"}
    assert told["belong_to_nobody"] == 1
    put(school.out / "students.toml", entry["settle"].encode())
    entry = school.of(school.intake(), "Ada Lovelace")
    assert entry["person"]["login"] == "ada"


@pytest.mark.parametrize(
    ("file", "listed"),
    [("Joerg Mueller", "Jörg Müller"), ("Lukasz Wojcik", "Łukasz Wójcik"), ("Soren A", "Søren A")],
)
def test_a_name_typed_on_another_keyboard_is_suggested_and_never_taken(
    school: Class, file: str, listed: str
):
    people = f"Name,Login\n{listed},theirs\nMarie Curie,curie\n"
    school.lists = [put(school.root / "people.csv", people.encode())]
    school.hand_in(f"{file}.zip")
    entry = school.of(school.intake(), file)
    assert entry["person"] is None
    assert f"it may be {listed} (theirs)" in entry["reason"]
    assert entry["settle"] == f'"{file}.zip" = "theirs"'


@pytest.mark.parametrize(
    ("said", "logins"),
    [
        ("curie", ["curie"]),
        ("CURIE@example.org", ["curie"]),
        ("Marie Curie", ["curie"]),
        ("curie, boole", ["curie", "boole"]),
        ("nobody", []),
        ("Ada Lovelace", []),
        ("curei", []),
    ],
)
def test_students_toml_takes_whatever_names_one_person(school: Class, said: str, logins: list[str]):
    school.hand_in("group seven.zip")
    text = f'\ufeff"group seven.zip" = "{said}"\r\n'
    put(school.root / "students.toml", text.encode())  # beside the class list
    told = school.intake()
    (entry,) = told["submissions"]
    assert [person["login"] for person in entry["people"]] == logins
    assert told["belong_to_nobody"] == (not logins)
    assert bool(entry["reason"]) == (not logins)


def test_a_settled_person_is_not_found_a_second_time_by_name(school: Class):
    school.hand_in("final.zip", "Marie Curie.zip")
    put(school.out / "students.toml", b'"final.zip" = "curie"')
    told = school.intake()
    assert school.of(told, "final")["person"]["login"] == "curie"
    entry = school.of(told, "Marie Curie")
    assert entry["person"] is None
    assert "so does 'final'" in entry["reason"]


@pytest.mark.parametrize("text", ['["Ada"]\nx = 1', "x = ", 'x = ["ada"]'])
def test_students_toml_that_says_something_else_is_named(school: Class, text: str):
    school.hand_in("x.zip")
    put(school.out / "students.toml", text.encode())
    status, _ = school.run("intake")
    assert status == 1
    assert "students.toml" in school.err
    assert school.err.count("\n") == 1


# --- when it was handed in


def test_the_sources_of_a_time_go_before_each_other_in_their_order(school: Class):
    """The class list, the layout, times.csv, the submission itself, and only when told the file."""
    start = "Exercise_{login}_attempt_2026-11-01-12-00-00"
    for login in ("ada", "boole"):
        put(school.work / f"{start.format(login=login)}_x.zip", zipped({"3_orchard.ipynb": BOOK}))
    listed = '[[student]]\nname = "Ada Lovelace"\nlogin = "ada"\nhanded_in = 2026-11-03T00:00:00Z\n'
    school.lists = [put(school.root / "class.toml", (LATE + listed).encode())]
    school.lists.append(put(school.root / "people.csv", PEOPLE.encode()))
    times = put(
        school.root / "when.csv", b"login,time\nada,2026-11-02T00:00Z\nboole,2026-11-02T00:00Z"
    )
    told = school.intake("--times", str(times))
    assert school.of(told, "ada")["handed_in"] == "2026-11-03T00:00:00+00:00"
    assert school.of(told, "ada")["time_from"] == "class list"
    assert school.of(told, "boole")["handed_in"] == "2026-11-01T12:00:00+00:00"
    assert school.of(told, "boole")["time_from"] == "layout"

    shutil.rmtree(school.work)
    packed = {"3_orchard.ipynb": BOOK, "submitted.txt": b"2026-11-04T00:00:00+00:00"}
    put(school.work / "boole.zip", zipped(packed))
    put(school.work / "curie.zip", zipped(packed))
    put(school.work / "ada2.zip", zipped({"3_orchard.ipynb": BOOK}))
    os.utime(school.work / "ada2.zip", (1793620800, 1793620800))  # 2026-11-02, 12:00 UTC
    told = school.intake("--times", str(times))
    assert school.of(told, "boole")["time_from"] == "times.csv"
    assert school.of(told, "curie")["time_from"] == "submit()"
    assert school.of(told, "ada2")["handed_in"] is None
    assert any("Nothing says when ada2" in warning for warning in told["warnings"])
    told = school.intake("--times", str(times), "--trust-times")
    assert school.of(told, "ada2")["time_from"] == "file"
    assert school.of(told, "ada2")["handed_in"] == "2026-11-02T12:00:00+00:00"


def test_a_line_of_the_times_that_fits_nobody_is_said(school: Class):
    put(school.work / "ada.zip", zipped({"3_orchard.ipynb": BOOK}))
    school.lists = [put(school.root / "people.csv", PEOPLE.encode())]
    lines = b"login,time\nada,2026-11-02T00:00Z\nboole,2026-11-02T00:00Z\nadda,2026-11-02T00:00Z"
    told = school.intake("--times", str(put(school.root / "when.csv", lines)))
    (said,) = [warning for warning in told["warnings"] if "table of times" in warning]
    assert "names adda, from whom nothing was handed in" in said  # boole is in the list


def times_of(school: Class, *when: str) -> None:
    school.hand_in("ada.zip", "boole.zip", "curie.zip")
    rows = [f"{login};{time}" for login, time in zip(("ada", "boole", "curie"), when, strict=True)]
    put(school.work / "times.csv", "\r\n".join(["Login;Submitted at", *rows]).encode("utf-16"))


@pytest.mark.parametrize(
    ("when", "said"),
    [
        (("2026-11-21T10:00Z", "2026-11-21T10:03Z", "2026-11-21T10:05Z"), "within 5 minutes"),
        (("2026-11-21T10:00Z", "2026-11-22T10:00Z", "2026-11-23T10:00Z"), "are late"),
    ],
)
def test_doubtful_times_cost_nobody_anything_until_they_are_trusted(
    school: Class, when: tuple[str, ...], said: str
):
    times_of(school, *when)
    _, told = school.run("grade")
    assert any(said in warning for warning in told["warnings"])
    assert [entry["percent_off"] for entry in told["submissions"]] == [0, 0, 0]
    assert told["late"] == 3
    _, told = school.run("grade", "--trust-times")
    assert not told["warnings"]
    assert all(entry["percent_off"] >= 10 for entry in told["submissions"])
    _, told = school.run("grade")  # what was said once is remembered
    assert all(entry["percent_off"] >= 10 for entry in told["submissions"])
    _, told = school.run("grade", "--no-trust-times")
    assert [entry["percent_off"] for entry in told["submissions"]] == [0, 0, 0]


def test_one_late_among_others_is_late_and_nothing_is_doubted(school: Class):
    times_of(school, "2026-11-19T10:00Z", "2026-11-21T13:00Z", "2026-11-18T10:00Z")
    told = school.intake()
    assert [entry["days_late"] for entry in told["submissions"]] == [0, 2, 0]
    assert [entry["percent_off"] for entry in told["submissions"]] == [0, 20, 0]
    assert not told["warnings"]
    assert not told["needs_person"]


def test_what_only_the_submission_says_is_a_hint_and_costs_nothing(school: Class):
    packed = {"3_orchard.ipynb": BOOK, "submitted.txt": b"2026-11-24T00:00:00+00:00"}
    put(school.work / "ada.zip", zipped(packed))
    school.hand_in("boole.zip")
    entry = school.of(school.intake(), "ada")
    assert (entry["days_late"], entry["percent_off"]) == (4, 0)
    entry = school.of(school.intake("--trust-times"), "ada")
    assert entry["percent_off"] == 40


@pytest.mark.parametrize(
    "packed", [b"2026-11-19T10:00:00+00:00", b"2026-11-24T00:00:00+00:00", b""]
)
def test_canvas_word_that_it_is_late_holds_beside_the_time_in_the_zip(school: Class, packed: bytes):
    """A student can pack in time and upload late, and can write any time into the zip."""
    data = zipped({"3_orchard.ipynb": BOOK, **({"submitted.txt": packed} if packed else {})})
    put(school.work / "booleGeorge_LATE_7_100_submission.zip", data)
    put(school.work / "curiemarie_8_101_submission.zip", data)
    told = school.intake()
    assert told["late"] == (2 if b"-24T" in packed else 1)
    entry = school.of(told, "booleGeorge")
    assert entry["called_late"]
    assert entry["percent_off"] == 0
    (said,) = [warning for warning in told["warnings"] if "booleGeorge" in warning]
    assert "late" in said
    assert "--times FILE" in said


def test_the_table_shows_canvas_word_that_it_is_late_at_the_time_in_the_zip(
    school: Class, capsys: pytest.CaptureFixture[str]
):
    packed = {"3_orchard.ipynb": BOOK, "submitted.txt": b"2026-11-19T10:00:00+00:00"}
    put(school.work / "booleGeorge_LATE_7_100_submission.zip", zipped(packed))
    assert main(["--course", str(school.course.root), "intake", str(school.work)]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "called late" in told
    assert "1 handed in, 0 unreadable, 1 late" in told


def test_a_time_that_cannot_be_read_is_named(school: Class):
    times_of(school, "2026-11-19T10:00Z", "3/4/2026 10:00", "2026-11-18T10:00Z")
    status, _ = school.run("intake")
    assert status == 1
    assert "'3/4/2026 10:00' is not a time" in school.err


# --- what needs a person


def nothing_else(school: Class) -> None:
    """Everything is clear."""


def nobodys(school: Class) -> None:
    school.hand_in("stranger.zip")


def broken(school: Class) -> None:
    put(school.work / "curie.zip", b"PK\3\4 broken")


def hidden(school: Class) -> None:
    school.hand_in(".curie.zip")


def another_kind(school: Class) -> None:
    put(school.work / "curie.rar", b"Rar!")


def a_side_file(school: Class) -> None:
    put(school.work / ".DS_Store", b"")


@pytest.mark.parametrize(
    ("change", "needed"),
    [
        (nothing_else, 0),
        (a_side_file, 0),
        (nobodys, 1),
        (broken, 1),
        (hidden, 1),
        (another_kind, 1),
    ],
)
def test_strict_ends_with_1_exactly_when_something_needs_a_person(
    school: Class, change: Callable[[Class], None], needed: int
):
    school.hand_in("ada.zip", "boole.zip")
    put(
        school.work / "times.csv",
        b"login,time\nada,2026-11-02T00:00Z\nboole,2026-11-03T00:00Z\ncurie,2026-11-03T00:00Z",
    )
    change(school)
    for command in ("intake", "grade"):
        status, told = school.run(command, "--strict")
        assert status == needed, told
        assert told["needs_person"] == bool(needed)
        assert school.run(command)[0] == 0


def test_files_that_change_while_they_are_graded_are_named(
    school: Class, monkeypatch: pytest.MonkeyPatch
):
    school.hand_in("ada.zip", "boole.zip")
    put(school.work / "times.csv", b"login,time\nada,2026-11-02T00:00Z\nboole,2026-11-03T00:00Z")

    class Meddler(Reader):
        def describe(self) -> str:
            put(school.work / "boole.zip", b"other")
            return ""

    monkeypatch.setattr(grading_run, "Threads", Meddler)
    status, told = school.run("grade", "--strict")
    assert status == 1
    (warning,) = told["warnings"]
    assert warning.startswith("1 file changed while it was graded")
    assert "boole.zip" in warning


# --- hostile repositories


def repository(folder: Path) -> None:
    put(folder / "3_orchard.ipynb", BOOK)
    git(folder, "init", "-q")
    commit(folder, datetime(2026, 11, 1, 12, tzinfo=UTC))


def borrows(folder: Path, marker: Path) -> None:
    other = folder.parent / "exercise-3-boole/.git/objects"
    put(folder / ".git/objects/info/alternates", os.fsencode(other))


def leads_elsewhere(folder: Path, marker: Path) -> None:
    shutil.rmtree(folder / ".git")
    put(folder / ".git", b"gitdir: ../exercise-3-boole/.git\n")


def is_a_link(folder: Path, marker: Path) -> None:
    shutil.rmtree(folder / ".git/objects")
    (folder / ".git/objects").symlink_to(folder.parent / "exercise-3-boole/.git/objects")


def is_empty(folder: Path, marker: Path) -> None:
    shutil.rmtree(folder / ".git")
    (folder / ".git").mkdir()


def is_a_worktree(folder: Path, marker: Path) -> None:
    put(folder / ".git/commondir", b"../../exercise-3-boole/.git\n")


@pytest.mark.parametrize("hostile", [borrows, leads_elsewhere, is_a_link, is_empty, is_a_worktree])
def test_a_repository_that_leads_out_of_itself_gives_no_time_and_still_its_files(
    school: Class, hostile: Callable[[Path, Path], None]
):
    for login in ("ada", "boole", "curie"):
        repository(school.work / f"exercise-3-{login}")
    hostile(school.work / "exercise-3-ada", school.root / "marker")
    told = school.intake()
    entry = school.of(told, "ada")
    assert (entry["handed_in"], entry["unreadable"]) == (None, False)
    assert entry["notes"]
    assert school.of(told, "boole")["handed_in"] == "2026-11-01T12:00:00+00:00"


def test_nothing_that_a_repository_configures_is_run(school: Class):
    marker = school.root / "marker"
    for login in ("ada", "boole", "curie"):
        repository(school.work / f"exercise-3-{login}")
    ada = school.work / "exercise-3-ada"
    order = f"touch {marker}"
    config = f'[core]\n\tfsmonitor = "{order}"\n\tpager = "{order}"\n\thooksPath = .git/hooks\n'
    config += f'\tsshCommand = "{order}"\n[filter "x"]\n\tsmudge = "{order}"\n\tclean = "{order}"\n'
    config += f'[diff]\n\texternal = "{order}"\n[include]\n\tpath = /etc/passwd\n'
    with (ada / ".git/config").open("a") as file:
        file.write(config)
    put(ada / ".gitattributes", b"*.ipynb filter=x\n")
    for hook in ("post-checkout", "pre-commit", "post-index-change", "reference-transaction"):
        put(ada / ".git/hooks" / hook, f"#!/bin/sh\n{order}\n".encode()).chmod(0o755)
    os.mkfifo(ada / "endless")
    with (ada / ".git/config").open("a") as file:  # reading it would wait for ever
        file.write(f"[include]\n\tpath = {ada / 'endless'}\n[core]\n\tworktree = /\n")
    told = school.intake()
    assert school.of(told, "ada")["handed_in"] == "2026-11-01T12:00:00+00:00"
    assert not marker.exists()


def test_a_commit_in_the_future_or_before_time_began_is_no_crash(school: Class):
    for login in ("ada", "boole", "curie"):
        repository(school.work / f"exercise-3-{login}")
    ada = school.work / "exercise-3-ada"
    git(ada, "commit", "--allow-empty", "-qm", "x", GIT_COMMITTER_DATE="@9999999999 +0000")
    told = school.intake()
    # After the due time: what was there before counts.
    assert school.of(told, "ada")["handed_in"] == "2026-11-01T12:00:00+00:00"


# --- what a folder is


def test_a_folder_that_may_be_one_or_a_class_stops_and_asks(school: Class):
    put(school.work / "3_orchard.ipynb", BOOK)
    school.hand_in("someone.zip")
    status, _ = school.run("grade")
    assert status == 2
    assert "--layout one or --layout class" in school.err
    assert school.err.count("\n") == 1
    assert not (school.out / "grades.csv").exists()
    assert school.intake("--layout", "one")["handed_in"] == 1
    assert school.intake("--layout", "class")["handed_in"] == 2


def test_a_person_of_the_list_beside_the_courses_notebooks_makes_it_a_class(school: Class):
    put(school.work / "3_orchard.ipynb", BOOK)
    school.hand_in("boole.zip")
    told = school.intake()
    assert told["handed_in"] == 2
    assert "a class" in told["read_as"][0]


def test_a_layout_that_is_given_goes_before_the_marks(school: Class):
    folder = school.work / "Ada Lovelace_1_assignsubmission_file"
    put(folder / "3_orchard.ipynb", BOOK)
    put(school.work / "George Boole_2_assignsubmission_file/3_orchard.ipynb", BOOK)
    assert school.intake()["submissions"][0]["layout"] == "moodle"
    told = school.intake("--layout", "class")
    assert [entry["layout"] for entry in told["submissions"]] == ["plain", "plain"]
    assert school.intake("--layout", "one")["handed_in"] == 1
    status, _ = school.run("intake", "--layout", "canvas")
    assert status == 2
    assert "canvas" in school.err


def test_one_that_fits_a_given_layout_is_enough_and_the_rest_is_named(school: Class):
    school.hand_in("boole.zip", "curie.zip")
    put(school.work / "Ada Lovelace_1_assignsubmission_file/3_orchard.ipynb", BOOK)
    assert school.intake()["handed_in"] == 3
    told = school.intake("--layout", "moodle")
    assert told["handed_in"] == 1
    named = [entry["path"].rpartition("/")[2] for entry in told["passed_over"]]
    assert named == ["boole.zip", "curie.zip"]
    assert told["needs_person"]
