"""One assignment, from the roster to the feedback that went back, with two assistants."""

from __future__ import annotations

import csv
import io
import re
import shutil
import sys
import zipfile
from email import message_from_bytes
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.course import load_course
from autograder.gradebook import Gradebook, view_class
from autograder.gradebook.by_hand import Item, give, open_items
from autograder.intake.class_list import ClassList, read_class_lists
from tests.classroom import RIGHT, START, notebook
from tests.cli.test_marking_by_hand import with_text
from tests.intake.classes import PEOPLE, Someone, put, worksheet

CLASS = (*PEOPLE[:3], *PEOPLE[8:])
ADA, OTHER_ADA, *_, ABSENT = CLASS
POLICY = '[assignment]\ntitle = "Orchard"\n[late]\ndue = 2026-11-01T20:00:00Z\npercent_a_day = 10\n'


class Office:
    """The course on one desk, with gradebooks in several folders."""

    def __init__(self, root: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self.root, self.capsys = root, capsys
        self.course = with_text(root / "course")
        self.lists = [worksheet(root), put(root / "policy.toml", POLICY.encode())]
        self.work = root / "CS101-Exercise 3-4711"
        for person in CLASS:
            if person is not ABSENT:
                self.hand_in(person)

    def hand_in(self, person: Someone) -> None:
        cells = {**RIGHT, "Q5": f'ask("Q5").respond("{person.email} says: it rests.")'}
        if person.number % 2:  # among them the second of the two who are called Ada Lovelace
            cells["Q2"] = "trees = 3 + 4"
        folder = self.work / f"{person.name}_{person.participant}_assignsubmission_file"
        put(folder / "3_orchard.ipynb", notebook([START, *cells.values()]).encode())

    def run(self, desk: str, command: str, *arguments: str, status: int = 0) -> str:
        """What a command says; ``desk`` is the folder of the gradebook."""
        self.capsys.readouterr()
        out = ["--out", str(self.root / desk)]
        ended = main(["--course", str(self.root / "course"), command, *out, *arguments])
        said = self.capsys.readouterr()
        assert ended == status, said
        return said.out + said.err

    def open(self, desk: str) -> list[Item]:
        with Gradebook(self.root / desk / "gradebook.db") as book:
            return open_items(view_class(load_course(self.course.root), book, self.class_list))

    @property
    def class_list(self) -> ClassList:
        return read_class_lists(self.lists)

    def table(self, desk: str, file: str) -> list[dict[str, str]]:
        with (self.root / desk / file).open(encoding="utf-8-sig", newline="") as stream:
            return list(csv.DictReader(stream))

    def totals(self, desk: str) -> dict[str, str]:
        self.run(desk, "export", "--format", "csv")
        return {row["email"]: row["total"] for row in self.table(desk, "csv.csv") if row["email"]}


def lateness(person: Someone) -> float:
    hours = person.number - 7.5 + 0.001  # handed in at 12:30:05 and as many hours later; due at 20
    return 0.9 if hours > 0 else 1.0


@pytest.fixture
def office(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Office:
    return Office(tmp_path, capsys)


def test_from_the_roster_to_the_feedback_that_went_back(
    office: Office, monkeypatch: pytest.MonkeyPatch
):
    # --- Who handed in what: the sheet has two of one name, one of the list did nothing.
    lists = [said for path in office.lists for said in ("--class-list", str(path))]
    said = office.run("one", "grade", str(office.work), "--seed", "5", *lists)
    assert "6 handed in, 0 unreadable, 0 belong to nobody, 3 late, 6 of the list" in said
    assert set(office.totals("one").values()) == {"not yet", ""}
    shutil.copytree(office.root / "one", office.root / "two")
    assert len(office.open("one")) == 6

    # --- The first assistant marks the first three in the terminal, the second the rest and a few
    # of the same, with another verdict on one of them.
    typed = "".join("1\n1\nwell said\n" for _ in range(3)) + "q\n"
    monkeypatch.setattr(sys, "stdin", io.StringIO(typed))
    said = office.run("one", "mark", "--author", "first")
    assert "3 still wait." in said
    left = {item.record.student for item in office.open("one")}
    with Gradebook(office.root / "two/gradebook.db") as book:
        items = open_items(view_class(load_course(office.course.root), book, office.class_list))
        shared = [item for item in items if item.record.student not in left][:2]
        for item in [i for i in items if i.record.student in left] + shared:
            best = item is not shared[1]
            levels = {c.name: c.levels[0 if best else -1].name for c in item.rubric}
            give(book, item, levels, None, "well said" if best else "", "second")
    disputed = shared[1].record

    # --- Their work is joined in a third place; nobody decides for them.
    said = office.run(
        "joined", "merge", str(office.root / "one"), str(office.root / "two"), status=1
    )
    assert f"{disputed.student} Q5: first gave 3, second gave 0" in said
    assert [item.record.student for item in office.open("joined")] == [disputed.student]
    said = office.run("joined", "export", "--format", "moodle", *lists)
    assert "1 students have questions that wait for a person" in said
    assert len(office.table("joined", "moodle.csv")) == 5
    office.run("joined", "override", disputed.student, "Q5", "1.5", "--reason", "We met.")
    assert office.open("joined") == []

    # --- A spreadsheet goes out and comes back with a correction for one of the two Adas.
    sheet = office.root / "overrides.csv"
    office.run("joined", "override", "--write", str(sheet), "--all")
    rows = list(csv.DictReader(sheet.open(encoding="utf-8-sig", newline="")))
    (row,) = (r for r in rows if r["question"] == "Q2" and "871001" in r["student"])
    row["points"], row["comment"] = "1,5", "Shown in the tutorial."
    with sheet.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0].keys(), delimiter=";")
        writer.writeheader()
        writer.writerows(rows)
    office.run("joined", "override", "--read", str(sheet), "--author", "first")

    def wanted(person: Someone, q3: float = 2.0) -> str:
        text = 1.5 if person.participant == disputed.origin.claims[0].number else 3.0
        q2 = 1.5 if person is OTHER_ADA else 0.5 if person.number % 2 else 2.0
        return f"{round((2 + q2 + q3 + 4 + text) * lateness(person), 2):g}"

    nothing = {person.email: "" for person in PEOPLE}
    there = [person for person in CLASS if person is not ABSENT]
    assert office.totals("joined") == {
        **nothing,
        **{person.email: wanted(person) for person in there},
    }

    # --- Question 3 was not fair: it is dropped, shown first, then accepted; a regrade keeps it.
    (office.root / "joined/grading.toml").write_text('dropped = ["Q3"]\n')
    said = office.run("joined", "adjust")
    assert "6 of 6 students see a difference" in said
    assert office.totals("joined")[ADA.email] == wanted(ADA)
    office.run("joined", "adjust", "--accept", "--author", "first")
    answers = office.course.root / "solutions/answers/orchard.toml"
    answers.write_text(answers.read_text().replace("credit = 0.25", "credit = 0.75", 1))
    office.run("joined", "regrade")
    after = {person.email: wanted(person, q3=0) for person in there}
    for person in there:
        if person.number % 2 and person is not OTHER_ADA:  # 7 now earns 1.5 of 2, as hers by hand
            more = float(after[person.email]) + 1.0 * lateness(person)
            after[person.email] = f"{round(more, 2):g}"
    assert office.totals("joined") == {**nothing, **after}

    # --- Every way back holds everybody's own page.
    pages = {}
    office.run("joined", "feedback", "--for", "moodle")
    with zipfile.ZipFile(office.root / "joined/feedback_for_moodle.zip") as archive:
        for name in archive.namelist():
            (person,) = (p for p in there if p.participant in name)
            pages[person.email] = archive.read(name).decode()
    assert {email: total_on(page) for email, page in pages.items()} == after
    for person in there:
        assert f"{person.email} says" in pages[person.email]
    assert "Shown in the tutorial." in pages[OTHER_ADA.email]
    assert "Shown in the tutorial." not in pages[ADA.email]
    office.run("joined", "feedback", "--for", "email")
    letters = sorted((office.root / "joined/feedback_for_email").glob("*.eml"))
    for path in letters:
        letter = message_from_bytes(path.read_bytes())
        said = letter.get_payload()[0].get_payload(decode=True).decode()  # type: ignore[union-attr,index]
        assert f"has {after[path.stem]} of 11 points" in said
    assert len(letters) == 6
    office.run("joined", "feedback", "--for", "folder")
    assert len(list((office.root / "joined/feedback_for_folder").iterdir())) == 6
    assert "no name that Canvas gave" in office.run(
        "joined", "feedback", "--for", "canvas", status=1
    )
    office.run("joined", "export", "--format", "moodle")
    moodle = {row["Email address"]: row["Orchard"] for row in office.table("joined", "moodle.csv")}
    assert moodle == after
    said = office.run("joined", "show", ABSENT.email, status=2)
    assert "Kim Lee (user11@example.org) is in the class list and handed in nothing" in said


def total_on(page: str) -> str:
    found = re.search(r"<strong>([\d.]+)</strong> of [\d.]+ points", page)
    assert found is not None
    return found[1]
