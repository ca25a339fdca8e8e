"""Classes that no two seeds make alike, through intake, grade, export and feedback.

Student code is not run: what is graded is whose work it says it is. So the way of each submission
from the download to the person's row is tried for hundreds of classes in little time.
"""

from __future__ import annotations

import contextlib
import csv
import io
import json
import re
import zipfile
from collections.abc import Sequence
from datetime import datetime
from email import message_from_bytes
from pathlib import Path
from typing import Any

import pytest

from autograder.cli import main
from autograder.course import Course
from tests.intake.varied import DUE, LAYOUTS, MadeClass, Student, make_class

pytestmark = pytest.mark.usefixtures("nothing_runs")


def points(made: MadeClass, person: Student) -> float:
    """What the person must get: their number, less 10 % a day where the time is known."""
    number = next((n for n, mates in numbers(made) if person in mates), person.number)
    earned = 2 * (number + 1) / 100
    time = made.times.get(person.email)
    days = 0
    if time is not None and time > DUE:
        days = (time - DUE).days + 1
    return round(earned * (1 - 0.1 * days), 2)


def numbers(made: MadeClass) -> list[tuple[int, list[Student]]]:
    """Whose number somebody's work bears who handed in with another."""
    return [(p.number, made.partners[p.email]) for p in made.people if p.email in made.partners]


def check_class(course: Course, root: Path, layout: str, seed: int) -> None:
    made = make_class(root, layout, seed)
    out = root / "grades"
    lists = [said for path in made.lists for said in ("--class-list", str(path))]
    common = ["--out", str(out), *lists]
    paths = [str(path) for path in made.paths]
    told_in = root / "told.json"
    run = ["--course", str(course.root)]
    story = f"{layout} {seed}: {made.story}"

    told = told_by(told_in, [*run, "intake", *paths, "--json", *common, *made.options])
    check_intake(made, told, story)
    told = told_by(told_in, [*run, "grade", *paths, "--json", *common, *made.options])
    check_intake(made, told["intake"], story)

    certain = [p for p in made.people if p.email in made.times and p.email not in made.untold]
    expected = {p.email: points(made, p) for p in certain}
    assert exported(run, out, "csv", made.people) == expected, story
    if layout not in ("moodle", "github"):  # whose lists hold nothing that Canvas knows
        assert exported(run, out, "canvas", made.people) == expected, story
    assert exported(run, out, "moodle", made.people) == expected, story
    check_feedback(run, out, made, certain, story)


def told_by(path: Path, arguments: list[str]) -> dict[str, Any]:
    """What a command prints as JSON."""
    with path.open("w", encoding="utf-8") as file, contextlib.redirect_stdout(file):
        assert main(arguments) == 0, arguments
    told: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return told


def check_intake(made: MadeClass, told: dict[str, Any], story: str) -> None:
    story = f"{story}\n{json.dumps(told, indent=1, ensure_ascii=False)[:6000]}"
    found: dict[str, datetime | None] = {}
    for entry in told["submissions"]:
        for person in entry["people"]:
            (address,) = [p.email for p in made.people if is_same(p, person)]
            assert address not in found, story
            found[address] = entry["handed_in"] and datetime.fromisoformat(entry["handed_in"])
    certain = {email: time for email, time in made.times.items() if email not in made.untold}
    unlike = {
        e: (found.get(e, "not found"), certain.get(e, "not there")) for e in found.keys() | certain
    }
    unlike = {email: pair for email, pair in unlike.items() if pair[0] != pair[1]}
    assert not unlike, f"{unlike}\n{story}"
    assert told["belong_to_nobody"] == made.strangers + len(made.untold), story
    together = sum(map(len, made.partners.values()))
    assert told["handed_in"] == len(made.times) + made.strangers - together, story
    assert told["unreadable"] == 0, story
    # Of two with one name who cannot be told apart nobody is known to have handed in.
    nothing = [p for p in made.people if p.email not in certain]
    assert len(told["handed_in_nothing"]) == len(nothing), story
    passed = [entry for entry in told["passed_over"] if entry["needs_person"]]
    passed = [entry for entry in passed if "onlinetext" not in entry["path"]]
    assert not passed, f"{passed}\n{story}"


def is_same(person: Student, told: dict[str, str]) -> bool:
    if told["email"]:
        return told["email"] == person.email
    if told["login"]:
        return told["login"] in (person.login, person.email)
    return told["github"] == person.github or told["sis_id"] == person.sis


def exported(run: list[str], out: Path, format: str, people: Sequence[Student]) -> dict[str, float]:
    """The points by address in an export, of those who have any."""
    assert main([*run, "export", "--format", format, "--out", str(out)]) == 0
    text = (out / f"{format}.csv").read_text(encoding="utf-8-sig")
    found = {}
    with_totals = {"csv": "total", "canvas": -1, "moodle": -2}[format]
    rows = list(csv.reader(text.splitlines()))
    index = rows[0].index(with_totals) if isinstance(with_totals, str) else with_totals
    whose = {
        called: person.email
        for person in people
        for called in (person.email, person.login, person.id, person.sis, person.github)
    }
    for row in rows[1:]:
        said = {whose[cell] for cell in row if cell in whose}
        if row[index] and said:
            (address,) = said
            found[address] = float(row[index])
    return found


def check_feedback(
    run: list[str], out: Path, made: MadeClass, certain: list[Student], story: str
) -> None:
    """Each person's page has their points, and nobody else's."""
    wanted = {p.email: f"{points(made, p):g}" for p in certain}
    lost = 1 if made.strangers or made.untold else 0
    status = main([*run, "feedback", "--for", "folder", "--out", str(out)])
    assert status == lost, story
    pages = sorted((out / "feedback_for_folder").rglob("feedback.html"))
    together = {p.email for mates in made.partners.values() for p in mates}
    seen = sorted(total_on(page.read_text(encoding="utf-8")) for page in pages)
    assert seen == sorted(total for email, total in wanted.items() if email not in together), story
    main([*run, "feedback", "--for", "email", "--out", str(out)])
    for path in (out / "feedback_for_email").glob("*.eml"):
        letter = message_from_bytes(path.read_bytes())
        page = letter.get_payload()[1].get_payload(decode=True).decode()  # type: ignore[index,union-attr]
        assert total_on(page) == wanted[path.name.removesuffix(".eml")], story
    if made.layout == "moodle":
        assert main([*run, "feedback", "--for", "moodle", "--out", str(out)]) == lost, story
        with zipfile.ZipFile(out / "feedback_for_moodle.zip") as archive:
            numbers = {p.participant: wanted[p.email] for p in certain}
            got = {
                name.split("_")[1]: total_on(archive.read(name).decode())
                for name in archive.namelist()
            }
        assert got == numbers, story
    if made.layout == "canvas":
        assert main([*run, "feedback", "--for", "canvas", "--out", str(out)]) == lost, story
        with zipfile.ZipFile(out / "feedback_for_canvas.zip") as archive:
            names = archive.namelist()
            assert len(names) == len(certain), story
            for name in names:
                (person,) = (p for p in certain if any(m in name for m in canvas_marks(p)))
                assert total_of_file(archive, name) == wanted[person.email], story


def canvas_marks(person: Student) -> tuple[str, str]:
    return f"_{person.id}_", f"anon_x{person.number:02d}Yz_"


def total_of_file(archive: zipfile.ZipFile, name: str) -> str:
    """The points in a page as Canvas takes it: in a zip, in a notebook or as it is."""
    data = archive.read(name)
    if name.lower().endswith(".zip"):
        with zipfile.ZipFile(io.BytesIO(data)) as inside:
            data = inside.read("feedback.html")
    return total_on(data.decode())


def total_on(page: str) -> str:
    found = re.search(r"<strong>([\d.]+)</strong> of [\d.]+ points", page)
    assert found is not None
    return found[1]


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_point_gets_to_the_right_person(
    course: Course, tmp_path: Path, layout: str, seed: int
):
    check_class(course, tmp_path, layout, seed)


@pytest.mark.long
@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_point_gets_to_the_right_person_in_hundreds_of_classes(
    course: Course, tmp_path: Path, layout: str
):
    for seed in range(100, 160):
        check_class(course, tmp_path / str(seed), layout, seed)
