"""Two assistants mark texts by hand, from the terminal and on a page, and join their work."""

from __future__ import annotations

import csv
import http.client
import io
import json
import re
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlencode, urlsplit

import pytest

from autograder.cli import main
from autograder.cli.mark_page import make_server
from autograder.course import Course, load_course
from autograder.errors import CourseError
from autograder.gradebook import Gradebook, view_class
from autograder.gradebook.by_hand import open_items
from autograder.intake.class_list import ClassList
from tests.classroom import hand_in, make_course
from tests.toy import Toy, make_toy

QUESTION = """
[[question]]
id = "Q5"
kind = "text"
title = "Why prune"
points = 3
prompt = "Why is a tree pruned in winter?"
hints = ["What does it not carry then?"]
"""
ANSWER = """
["Q5"]
model = "It carries no leaves then, and the wounds close in spring."
explanation = "Sap rests in winter."
[["Q5".criterion]]
name = "names the rest"
levels = [
    {name = "with the reason", points = 2},
    {name = "without a reason", points = 1, feedback = "Why does it rest?"},
    {name = "missing", points = 0, feedback = "What happens to the sap?"},
]
[["Q5".criterion]]
name = "speaks of wounds"
levels = [{name = "yes", points = 1}, {name = "no", points = 0}]
"""


def with_text(root: Path) -> Course:
    make_course(root)
    return Toy(root).add("orchard", QUESTION, ANSWER).load()


@pytest.fixture(scope="module")
def graded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("orchard")
    with_text(root / "course")
    for student in ("ada", "boole", "curie"):
        said = f"Because **{student}** says so: no leaves, $x^2$, <b>x</b>."
        hand_in(root / "work", student, Q5=f'ask("Q5").respond({said!r})')
    hand_in(root / "work", "dumb", Q5='ask("Q5").respond("  ")')
    assert run(root, root / "grades", "grade", str(root / "work"), "--seed", "5") == 0
    return root


def run(root: Path, grades: Path, command: str, *arguments: str) -> int:
    course = ["--course", str(root / "course")]
    return main([*course, command, "--out", str(grades), *arguments])


@pytest.fixture
def grades(graded: Path, tmp_path: Path) -> Path:
    shutil.copytree(graded / "grades", tmp_path / "grades")
    return tmp_path / "grades"


def rows(path: Path) -> dict[str, dict[str, str]]:
    with path.open(encoding="utf-8") as file:
        return {row["student"]: row for row in csv.DictReader(file)}


def typed(monkeypatch: pytest.MonkeyPatch, *lines: str) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO("".join(f"{line}\n" for line in lines)))


def test_no_machine_marks_a_text_and_what_is_open_is_shown_everywhere(graded, grades, capsys):
    found = rows(grades / "grades.csv")
    assert found["ada"]["Q5"] == found["ada"]["total"] == "not yet"
    assert found["dumb"]["Q5"] == "0"
    assert found["dumb"]["total"] == "10"
    assert "A person will mark this" in (grades / "feedback/ada.html").read_text()
    assert "<strong>ada</strong>" in (grades / "feedback/ada.html").read_text()
    assert "<b>x</b>" not in (grades / "feedback/ada.html").read_text()
    assert run(graded, grades, "show", "ada") == 0
    assert "1 not marked yet" in capsys.readouterr().out
    assert run(graded, grades, "mark", "--list", "--json") == 0
    waiting = json.loads(capsys.readouterr().out)
    assert sorted(item["student"] for item in waiting) == ["ada", "boole", "curie"]


def test_an_open_grade_is_exported_as_not_yet_and_nobody_gets_a_part_of_it(graded, grades, capsys):
    (grades / "class.toml").write_text(
        "".join(f'[[student]]\nname = "{n.title()}"\nlogin = "{n}"\n' for n in ("ada", "dumb"))
    )
    for system in ("canvas", "moodle", "csv"):
        assert run(graded, grades, "export", "--format", system) == 0
    assert "wait for a person" in capsys.readouterr().err
    assert "Ada" not in (grades / "moodle.csv").read_text()
    canvas = (grades / "canvas.csv").read_text().splitlines()
    assert next(line for line in canvas if line.startswith("Ada")).endswith(",")
    assert "not yet" in (grades / "csv.csv").read_text()


def test_a_rubric_is_gone_through_in_the_terminal(graded, grades, monkeypatch, capsys):
    # A wrong level is asked again; the second is left for later, the third stops.
    typed(monkeypatch, "9", "1", "2", "well said", "", "q")
    assert run(graded, grades, "mark", "--author", "tutor one") == 0
    out = capsys.readouterr().out
    assert "'9' is none of them" in out
    assert "2 of 3 points." in out
    assert "2 still wait." in out
    found = rows(grades / "grades.csv")
    (student,) = [name for name, row in found.items() if row["Q5"] == "2"]
    html = (grades / f"feedback/{student}.html").read_text()
    assert "names the rest: with the reason" in html
    assert "well said" in html
    assert "Partly right" in html


def test_anonymous_marking_shows_no_name(graded, grades, monkeypatch, capsys):
    capsys.readouterr()
    typed(monkeypatch, "q")
    assert run(graded, grades, "mark", "--anonymous") == 0
    assert "1 of 3  (" in capsys.readouterr().out


def test_a_mark_by_hand_survives_regrading_but_not_another_text(graded, grades, tmp_path, capsys):
    with Gradebook(grades / "gradebook.db") as book:
        course = load_course(graded / "course")
        mark_all(book, course, "tutor", best=True)
    assert run(graded, grades, "regrade") == 0
    assert rows(grades / "grades.csv")["ada"]["Q5"] == "3"
    shutil.copytree(graded / "work", tmp_path / "work")
    hand_in(tmp_path / "work", "ada", Q5='ask("Q5").respond("Something else.")')
    assert run(graded, grades, "grade", str(tmp_path / "work")) == 0
    assert rows(grades / "grades.csv")["ada"]["Q5"] == "not yet"
    capsys.readouterr()
    assert run(graded, grades, "mark", "--list") == 0
    assert "the response has changed since" in capsys.readouterr().out


def mark_all(book: Gradebook, course: Course, author: str, best: bool, only: str = "") -> None:
    from autograder.gradebook.by_hand import give

    for item in open_items(view_class(course, book, ClassList())):
        if only in ("", item.record.student):
            levels = {c.name: c.levels[0 if best else -1].name for c in item.rubric}
            give(book, item, levels, None, "", author)


def test_two_assistants_join_their_work_and_contradictions_are_shown(graded, grades, capsys):
    course = load_course(graded / "course")
    one, two = grades.parent / "one", grades.parent / "two"
    for folder, author, best in ((one, "tutor one", True), (two, "tutor two", False)):
        shutil.copytree(grades, folder)
        with Gradebook(folder / "gradebook.db") as book:
            mark_all(book, course, author, best, "ada")
            mark_all(book, course, author, True, "boole" if best else "curie")
            book.note("ada", f"seen by {author}", author)
    joined = grades.parent / "joined"
    assert run(graded, joined, "merge", str(one), str(two)) == 1
    captured = capsys.readouterr()
    assert "ada Q5: tutor one gave 3, tutor two gave 0" in captured.err
    found = rows(joined / "grades.csv")
    assert (found["boole"]["Q5"], found["curie"]["Q5"]) == ("3", "3")
    assert found["ada"]["Q5"] == "not yet"
    assert run(graded, joined, "merge", str(one), str(two)) == 1  # nothing is doubled or decided
    assert "0 marks and overrides, 0 notes" in capsys.readouterr().out
    with Gradebook(joined / "gradebook.db") as book:
        assert [note.author for note in book.record("ada").notes] == ["tutor one", "tutor two"]
    # The first assistant takes the joined book over: still nobody has decided.
    assert run(graded, one, "merge", str(joined)) == 1
    assert rows(one / "grades.csv")["ada"]["Q5"] == "not yet"
    assert run(graded, joined, "override", "ada", "Q5", "2", "--reason", "we talked") == 0
    assert rows(joined / "grades.csv")["ada"]["Q5"] == "2"
    assert run(graded, joined, "merge", str(one), str(two)) == 0
    assert rows(joined / "grades.csv")["ada"]["Q5"] == "2"


def test_the_same_verdict_of_two_is_no_contradiction(graded, grades, capsys):
    course = load_course(graded / "course")
    one, two = grades.parent / "one", grades.parent / "two"
    for folder in (one, two):
        shutil.copytree(grades, folder)
        with Gradebook(folder / "gradebook.db") as book:
            mark_all(book, course, folder.name, True)
    assert run(graded, one, "merge", str(two)) == 0
    assert rows(one / "grades.csv")["ada"]["Q5"] == "3"


def test_students_of_one_book_alone_come_with_their_marks(graded, grades, tmp_path, capsys):
    hand_in(tmp_path / "late", "euler")
    other = tmp_path / "other"
    assert run(graded, other, "grade", str(tmp_path / "late"), "--seed", "5") == 0
    assert run(graded, grades, "merge", str(other)) == 0
    assert rows(grades / "grades.csv")["euler"]["total"] == "10"


def test_a_spreadsheet_marks_texts_too(graded, grades, capsys):
    sheet = grades / "overrides.csv"
    assert run(graded, grades, "override", "--write", str(sheet)) == 0
    lines = sheet.read_text().splitlines()
    assert len(lines) == 4
    filled = [line.replace(",,3,", ",2.5,3,") for line in lines[1:]]
    sheet.write_text("\n".join([lines[0], *filled]))
    assert run(graded, grades, "override", "--read", str(sheet)) == 0
    assert rows(grades / "grades.csv")["curie"]["Q5"] == "2.5"
    assert run(graded, grades, "mark") == 0


@pytest.fixture
def served(graded: Path, grades: Path) -> Iterator[tuple[str, Gradebook, set[str]]]:
    course, marked = load_course(graded / "course"), set[str]()
    ready, addresses = threading.Event(), list[Any]()

    def work() -> None:  # a connection to the gradebook belongs to one thread
        with Gradebook(grades / "gradebook.db") as book:

            def look() -> list[Any]:
                return open_items(view_class(course, book, ClassList()))

            server = make_server(0, True, "tutor", book, look, marked)
            addresses.append(server)
            ready.set()
            server.serve_forever()
            server.server_close()

    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    assert ready.wait(30)
    with Gradebook(grades / "gradebook.db") as book:
        yield addresses[0].address, book, marked
    addresses[0].shutdown()
    thread.join(30)


def ask(
    address: str, method: str = "GET", form: dict[str, str] | None = None, **headers: str
) -> tuple[int, str]:
    where = urlsplit(address)
    connection = http.client.HTTPConnection("127.0.0.1", where.port or 0, timeout=60)
    body = urlencode(form or {}) if method == "POST" else None
    connection.request(method, where.path, body, headers)
    reply = connection.getresponse()
    return reply.status, reply.read().decode()


def test_a_page_marks_without_names_and_only_with_its_token(served):
    address, book, marked = served
    status, html = ask(address)
    assert status == 200
    assert "1 of 3 that wait" in html
    assert "· ada" not in html.casefold()
    item = re.search(r'name="item" value="(\w+)"', html)
    assert item is not None
    form = {"item": item[1], "c0": "1", "comment": "good"}
    status, html = ask(address, "POST", form)
    assert status == 200  # a criterion is missing: it is asked again, nothing is kept
    assert "Choose a level" in html
    assert "checked" in html
    assert ask(address, "POST", {**form, "c1": "0"})[0] == 303
    (student,) = marked
    override = book.record(student).overrides["Q5"]
    assert (override.points, override.author) == (2, "tutor")
    assert override.reason == "Why does it rest? good"
    assert ask(address, "POST", {**form, "c1": "1"})[0] == 303  # marked meanwhile: not again
    assert book.record(student).overrides["Q5"] == override


@pytest.mark.parametrize(
    ("path", "headers"),
    [
        ("/", {}),
        ("/wrong/", {}),
        ("", {"Host": "evil.example.org"}),
        ("", {"Origin": "http://evil.example.org"}),
    ],
)
def test_who_lacks_the_token_or_comes_from_elsewhere_is_refused(served, path, headers):
    address = served[0]
    where = urlsplit(address)
    target = f"{where.scheme}://{where.netloc}{path or where.path}"
    assert ask(target, "GET", None, **headers)[0] == 404
    assert ask(target, "POST", {"item": "x"}, **headers)[0] == 404


def text_course(root: Path) -> Toy:
    course = make_toy(root)
    course.add("kitchen", QUESTION, ANSWER)
    course.append("notebooks/source/1_kitchen.py", '\n# %% exercise="Q5"\n')
    return course


def test_a_course_with_a_text_proves_itself(tmp_path: Path):
    course = text_course(tmp_path / "course")
    course.write_notebooks()
    # In a process of its own: another course's `solutions` may have been imported in this one.
    command = [sys.executable, "-m", "autograder", "--course", str(course.root), "check"]
    done = subprocess.run([*command, "--without-mutants"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('reason", points = 2}', 'reason", points = 3}', "add up to 4"),
        ('name = "missing"', 'name = "without a reason"', "two levels"),
        ('{name = "yes", points = 1}, {name = "no", points = 0}', "", "two levels"),
        ('"no", points = 0', '"no", points = 2', "from the most points"),
        ('model = "It', 'modle = "It', "model"),
    ],
)
def test_a_rubric_that_does_not_add_up_is_refused(tmp_path: Path, old: str, new: str, said: str):
    course = text_course(tmp_path / "course")
    course.replace("solutions/answers/kitchen.toml", old, new)
    with pytest.raises(CourseError, match=said):
        assert course.load().key
