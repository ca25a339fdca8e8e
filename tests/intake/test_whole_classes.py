"""A class of twelve in every layout: everybody found once, the right attempt, the right time."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from datetime import datetime
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.course import Course
from autograder.intake.class_list import read_class_lists
from autograder.intake.find_submissions import take_in
from autograder.intake.handout import handout_of
from autograder.intake.layouts.layout import Context
from autograder.intake.submissions import read_submission
from tests.classroom import make_course
from tests.intake.classes import MAKERS, PACKINGS, PEOPLE, Download

POLICY = "[late]\ndue = 2026-11-20T12:00:00Z\npercent_a_day = 10\n"


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Course:
    return make_course(tmp_path_factory.mktemp("orchard") / "course")


@pytest.mark.parametrize("packed", PACKINGS, ids=lambda packing: packing.__name__)
@pytest.mark.parametrize("layout", MAKERS)
def test_everybody_is_found_once_with_the_right_attempt_and_time(
    course: Course,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    layout: str,
    packed: Callable[[Download], Path],
):
    download = MAKERS[layout](tmp_path)
    path = packed(download)
    policy = tmp_path / "class.toml"
    policy.write_text(POLICY)
    lists = ["--class-list", str(download.class_list), "--class-list", str(policy)]
    arguments = ["intake", str(path), "--json", "--out", str(tmp_path / "grades"), *lists]
    assert main(["--course", str(course.root), *arguments]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["belong_to_nobody"] == 0, told["submissions"]
    assert told["unreadable"] == 0
    assert told["handed_in_nothing"] == []
    found = {}
    for entry in told["submissions"]:
        person = entry["person"]
        address = person["email"] or person["login"]
        # GitHub's roster calls people by a name and an identifier, which is an address here.
        address = address or person["sis_id"]
        assert address not in found
        found[address] = entry["handed_in"] and datetime.fromisoformat(entry["handed_in"])
    assert found == download.times

    listed = read_class_lists([download.class_list, policy])
    assert listed.late is not None
    zone = listed.zone
    context = Context(course.settings, handout_of(course), listed.students, listed.late.due, zone)
    intake = take_in([path], course.settings, context)
    whose = set()
    for submission in intake.submissions:
        contents = read_submission(submission, course.settings, context.handout)
        comment = contents.notebooks["orchard"].cells[1].partition("# ")[2]
        address, _, attempt = comment.partition(" ")
        assert attempt == "last"
        whose.add(address)
    assert whose == {person.email for person in PEOPLE}


@pytest.mark.parametrize(("layout", "format"), [("moodle", "csv"), ("canvas", "canvas")])
def test_the_grade_goes_to_the_right_one_of_two_with_one_name(
    course: Course, tmp_path: Path, layout: str, format: str
):
    from tests.classroom import START, notebook

    download = MAKERS[layout](tmp_path)
    # The first Ada's answer is right, everybody else's is not an answer.
    ada = next(
        path
        for path in sorted(download.path.rglob("*"))
        if path.is_file() and ("871000" in str(path) or "_90000_" in str(path))
    )
    right = notebook([START, "trees = 12"])
    if ada.suffix == ".zip":
        from tests.intake.handed_in import zipped

        ada.write_bytes(zipped({"3_orchard.ipynb": right.encode()}))
    else:
        ada.write_text(right)
    other = next(
        path
        for path in sorted(download.path.rglob("*"))
        if path.is_file()
        and path.stat().st_size > 9
        and ("871001" in str(path) or "_90001_5001" in str(path))
    )
    wrong = notebook([START, "trees = 5"]).encode()
    other.write_bytes(zipped_or_not(other, wrong))
    run = ["--course", str(course.root)]
    out = ["--out", str(tmp_path / "grades"), "--class-list", str(download.class_list)]
    assert (
        main([*run, "grade", str(ada.parent if layout == "canvas" else download.path), *out]) == 0
    )
    assert main([*run, "export", "--format", format, *out]) == 0
    with (tmp_path / "grades" / f"{format}.csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(file))
    adas = [row for row in rows if any("Ada Lovelace" in cell for cell in row)]
    assert len(adas) == 2
    points = {}
    for row in adas:
        key = next(cell for cell in row if cell.endswith("@example.org"))
        points[key] = row[-1] if format == "canvas" else row[rows[0].index("total")]
    assert points == {"user00@example.org": "2", "user01@example.org": "0"}


def zipped_or_not(path: Path, book: bytes) -> bytes:
    from tests.intake.handed_in import zipped

    return zipped({"3_orchard.ipynb": book}) if path.suffix == ".zip" else book
