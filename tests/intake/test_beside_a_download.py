"""What lies beside a class's work makes neither the class one student nor a folder a student."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from autograder.course import Course
from autograder.errors import UsageError
from autograder.intake.class_list import ClassList
from autograder.intake.find_submissions import Intake, take_in
from autograder.intake.handout import handout_of
from autograder.intake.layouts.layout import Context
from autograder.intake.origin import Claim, Origin
from autograder.intake.person import Person
from autograder.intake.roster_exports import read_people
from tests.classroom import START, notebook
from tests.intake.classes import put
from tests.intake.handed_in import zipped

BOOK = notebook([START, "trees = 12"]).encode()
LOGINS = ("ada", "boole", "curie", "dirac")
PEOPLE = tuple(Person(login.title(), login=login) for login in LOGINS)


def moodle(folder: Path) -> None:
    for number, login in enumerate(LOGINS):
        put(folder / f"{login.title()}_{number}_assignsubmission_file/3_orchard.ipynb", BOOK)


def canvas(folder: Path) -> None:
    for number, login in enumerate(LOGINS):
        put(folder / f"{login}_{number}_47{number}_work.zip", zipped({"3_orchard.ipynb": BOOK}))


def gradescope(folder: Path) -> None:
    who = [f"{n}:\n  :submitters:\n  - :name: {login}\n" for n, login in enumerate(LOGINS)]
    put(folder / "submission_metadata.yml", "".join(who).encode())
    for number in range(len(LOGINS)):
        put(folder / f"{number}/3_orchard.ipynb", BOOK)


def plain(folder: Path) -> None:
    for login in LOGINS:
        put(folder / f"{login}.zip", zipped({"3_orchard.ipynb": BOOK}))


BESIDE: dict[str, Callable[[Path], object]] = {
    "the zip it came in": lambda top: (
        shutil.make_archive(str(top.parent / "made"), "zip", top / "submissions")
        and shutil.move(top.parent / "made.zip", top / "submissions.zip")
    ),
    "somebody's folder": lambda top: put(top / "old/try.ipynb", BOOK),
    "a zip": lambda top: put(top / "handout.zip", zipped({"3_orchard.ipynb": BOOK})),
    "a notebook": lambda top: put(top / "3_orchard.ipynb", BOOK),
}


def read(
    course: Course, paths: list[Path], people: tuple[Person, ...] = (), layout: str | None = None
) -> Intake:
    context = Context(course.settings, handout_of(course), people)
    return take_in(paths, course.settings, context, layout)


@pytest.mark.parametrize("people", [(), PEOPLE], ids=["no list", "a list"])
@pytest.mark.parametrize("beside", BESIDE.values(), ids=BESIDE)
@pytest.mark.parametrize("make", [moodle, canvas, gradescope, plain])
def test_something_beside_the_folder_of_a_class_stops_and_asks(
    course: Course,
    tmp_path: Path,
    make: Callable[[Path], None],
    beside: Callable[[Path], object],
    people: tuple[Person, ...],
):
    top = tmp_path / "work"
    make(top / "submissions")
    assert len(read(course, [top], people).submissions) == 4
    beside(top)
    with pytest.raises(UsageError, match="looks like a download of a whole class"):
        read(course, [top], people)
    assert len(read(course, [top / "submissions"], people).submissions) == 4
    assert len(read(course, [top], people, "one").submissions) == 1


def test_a_students_drafts_beside_the_work_are_still_one_student(course: Course, tmp_path: Path):
    for name in ("3_orchard.ipynb", "old/3_orchard.ipynb", "drafts/try.ipynb"):
        put(tmp_path / "ada" / name, BOOK)
    put(tmp_path / "ada/backup.zip", zipped({"3_orchard.ipynb": BOOK}))
    assert [entry.student for entry in read(course, [tmp_path / "ada"]).submissions] == ["ada"]


def test_downloads_of_several_sections_are_read_together_zipped_or_not(
    course: Course, tmp_path: Path
):
    for section in "AB":
        for number, login in enumerate(LOGINS[:2] if section == "A" else LOGINS[2:]):
            name = f"{login.title()}_{number}_assignsubmission_file"
            put(tmp_path / "work" / section / name / "3_orchard.ipynb", BOOK)
        zips = tmp_path / "zips"
        shutil.make_archive(str(zips / section), "zip", tmp_path / "work" / section)
    for paths in ([tmp_path / "work"], [zips], sorted(zips.iterdir())):
        found = read(course, paths).submissions
        assert sorted(entry.student for entry in found) == ["Ada", "Boole", "Curie", "Dirac"]


def test_the_whole_folder_of_an_nbgrader_course_is_read_by_what_was_submitted(
    course: Course, tmp_path: Path
):
    top = tmp_path / "course"
    for login in LOGINS:
        for stage in ("submitted", "autograded", "feedback"):
            put(top / stage / login / "ps1/3_orchard.ipynb", BOOK)
        put(top / "submitted" / login / "ps1/timestamp.txt", b"2026-11-01 12:30:05.0 UTC")
    put(top / "source/ps1/3_orchard.ipynb", BOOK)
    put(top / "release/ps1/3_orchard.ipynb", BOOK)
    put(top / "nbgrader_config.py", b"c = get_config()")
    put(top / "gradebook.db", b"SQLite format 3")
    put(top / "notes.txt", b"ask Ada")
    for path in (top, tmp_path):
        found = read(course, [path])
        assert [entry.student for entry in found.submissions] == list(LOGINS)
        assert all(entry.origin.handed_in for entry in found.submissions)
        named = {entry.place.rpartition("/")[2]: entry.needs_person for entry in found.passed_over}
        assert named.pop("notes.txt") is True
        assert named == dict.fromkeys(
            ("source", "release", "autograded", "feedback", "nbgrader_config.py", "gradebook.db"),
            False,
        )


def test_the_side_file_of_an_export_is_listed(course: Course, tmp_path: Path):
    gradescope(tmp_path / "export")
    (side,) = read(course, [tmp_path / "export"]).passed_over
    assert side.place.endswith("submission_metadata.yml")
    assert not side.needs_person


# Moodle's clean_filename leaves out these, with nothing in their place: & < > " ` | ' : \ /
@pytest.mark.parametrize(
    ("name", "in_moodle"),
    [
        ("Seán O'Brien", "Seán OBrien"),
        ("Jeanne d'Arc", "Jeanne dArc"),
        ('William "Bill" Gosset', "William Bill Gosset"),
        ("Ana Costa/Silva", "Ana CostaSilva"),
        ("Ng`ugi wa Thiong'o", "Ngugi wa Thiongo"),
    ],
)
@pytest.mark.parametrize("number", ["", "871104"], ids=["participants", "worksheet"])
def test_a_name_that_moodle_cleaned_is_its_persons(name: str, in_moodle: str, number: str):
    people = (Person(name, email="x@example.org", number=number), Person("Ada Lovelace"))
    for written in (in_moodle, f"Group A-{in_moodle}") if number else (in_moodle,):
        origin = Origin("moodle", claims=(Claim(name=written, number="871104"),))
        found = ClassList(people).match_all({"key": origin})["key"]
        assert [person.name for person in found.people] == [name]


def test_two_people_with_the_same_letters_are_not_guessed_from_a_cleaned_name():
    people = (Person("Sean O'Brien", email="1@x.org"), Person("Seano Brien", email="2@x.org"))
    origins = {"key": Origin("moodle", claims=(Claim(name="Se Anobrien", number="7"),))}
    found = ClassList(people).match_all(origins)["key"]
    assert found.people == ()
    assert set(found.candidates) == set(people)


@pytest.mark.parametrize(
    "name", ["boole (1).ipynb", "boole (2).ipynb.txt", "boole (1).zip", "boole (1)"]
)
def test_a_number_from_a_browser_does_not_hide_whose_a_file_is(
    course: Course, tmp_path: Path, name: str
):
    top = tmp_path / "work"
    data = zipped({"3_orchard.ipynb": BOOK}) if name.endswith("zip") else BOOK
    put(top / name / "3_orchard.ipynb" if name == "boole (1)" else top / name, data)
    put(top / "ada.ipynb", BOOK)

    def owners() -> list[tuple[str, list[str]]]:
        found = read(course, [top], PEOPLE).submissions
        matches = ClassList(PEOPLE).match_all({entry.student: entry.origin for entry in found})
        return [(key, [person.login for person in match.people]) for key, match in matches.items()]

    assert [people for _, people in owners()] == [["ada"], ["boole"]]
    put(top / "boole.ipynb", BOOK)
    assert [people for _, people in owners() if people] == [["ada"], ["boole"]]
    assert ("boole", ["boole"]) in owners()


@pytest.mark.parametrize(
    ("written", "called"),
    [
        ("Lovelace, Ada", "Ada Lovelace"),
        ("John Smith, Jr.", "John Smith, Jr."),
        ("Smith, Jr., John", "John Smith, Jr."),
        ("Gates, III, William", "William Gates, III"),
        ("van Dyk, Anna, Maria", "Anna, Maria van Dyk"),
    ],
)
def test_a_comma_in_a_name_turns_it_round_only_where_it_is_sorted(written: str, called: str):
    (person,) = read_people(f'Name,Login\n"{written}",x\n', Path("list.csv"), None)
    assert person.name == called


def test_the_work_of_a_team_is_everybodys_whom_the_list_has_in_its_group():
    people = (
        Person("Ada Lovelace", email="ada@x.org", number="55", section="Group A; Tuesday"),
        Person("George Boole", email="boole@x.org", number="7", section="Tuesday, Group A"),
        Person("Marie Curie", email="curie@x.org", section="Group B"),
        Person("Kim Lee", email="kim@x.org", section="Tuesday"),
    )

    def of(*names: str, number: str = "7") -> list[list[str]]:
        origins = {
            name: Origin("moodle", claims=(Claim(name=name, number=number),)) for name in names
        }
        found = ClassList(people).match_all(origins)
        return [[person.name for person in found[name].people] for name in names]

    # 7 is the number of the group, whoever has it as a participant.
    assert of("Group A", "Group B") == [["Ada Lovelace", "George Boole"], ["Marie Curie"]]
    assert of("Default group") == [[]]
    assert of("Kim Lee", number="9") == [["Kim Lee"]]
    # Whoever handed in twice is listed, and nobody gets a grade by chance.
    assert of("Group A", "Tuesday") == [[], []]
    # Only Moodle's downloads name a group, and always with a number.
    assert of("Group A", number="") == [[]]
