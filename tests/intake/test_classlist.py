"""Who is who, and what lateness costs."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import pytest

from autograder.errors import CourseError
from autograder.intake.class_list import ClassList, read_class_list
from autograder.intake.spreadsheets import decode

TEXT = """
[assignment]
title = "Exercise 3"
canvas_id = 4711

[late]
due = 2026-10-23T23:59:00
zone = "Europe/Zurich"
grace_minutes = 15
percent_a_day = 10
most_percent = 25

[[student]]
name = "Ada Lovelace"
id = "98765"
sis_id = "S-1815"
login = "ada"
email = "ada@example.org"

[[student]]
name = "George Boole"
id = "5"
submission = "gb final"
extension_days = 3
"""


@pytest.fixture
def listed(tmp_path: Path) -> ClassList:
    return read(tmp_path, TEXT)


def read(folder: Path, text: str) -> ClassList:
    (folder / "class.toml").write_text(text, encoding="utf-8")
    return read_class_list(folder / "class.toml")


@pytest.mark.parametrize(
    ("submission", "name"),
    [
        ("ada", "Ada Lovelace"),
        ("ADA@example.org", "Ada Lovelace"),
        ("98765", "Ada Lovelace"),
        ("S-1815", "Ada Lovelace"),
        ("ada lovelace", "Ada Lovelace"),
        ("lovelaceada_98765_123456_submission", "Ada Lovelace"),
        ("lovelaceada_LATE_98765_123456_submission", "Ada Lovelace"),
        ("Ada Lovelace_123_assignsubmission_file", "Ada Lovelace"),
        ("gb final", "George Boole"),
    ],
)
def test_a_submission_is_known_by_any_of_a_students_names(
    listed: ClassList, submission: str, name: str
):
    found = listed.find(submission)
    assert found is not None
    assert found.name == name


@pytest.mark.parametrize("submission", ["", "adam", "boole_98_765", "x_5", "ada (2)"])
def test_other_names_are_nobodys(listed: ClassList, submission: str):
    assert listed.find(submission) is None


@pytest.mark.parametrize(
    ("handed_in", "days", "percent"),
    [
        ("2026-10-23T21:59:00", 0, 0),  # 23:59 in Zurich, where summer time still holds
        ("2026-10-23T22:14:00", 0, 0),  # within the grace
        ("2026-10-23T22:14:01", 1, 10),
        ("2026-10-24T21:59:00", 1, 10),
        ("2026-10-24T21:59:01", 2, 20),
        ("2026-11-30T00:00:00", 38, 25),
    ],
)
def test_every_day_begun_after_the_grace_costs_its_percent(
    listed: ClassList, handed_in: str, days: int, percent: float
):
    found = datetime.fromisoformat(handed_in).replace(tzinfo=UTC)
    assert listed.lateness("ada", found)[1:] == (days, percent)


def test_an_extension_keeps_the_hour_when_summer_time_ends(listed: ClassList):
    # Three days after 23 October, 23:59 summer time, it is 23:59 winter time: 22:59 UTC.
    on_time = datetime(2026, 10, 26, 22, 59, tzinfo=UTC)
    assert listed.lateness("gb final", on_time)[1] == 0
    assert listed.lateness("gb final", on_time.replace(hour=23, minute=20))[1] == 1


def test_a_time_in_the_list_goes_before_the_files(tmp_path: Path):
    text = TEXT + "handed_in = 2026-10-23T12:00:00\n"
    listed = read(tmp_path, text)
    late_file = datetime(2026, 12, 1, tzinfo=UTC)
    assert listed.lateness("gb final", late_file) == ("2026-10-23T10:00:00+00:00", 0, 0)


def test_without_a_policy_nobody_is_late(tmp_path: Path):
    listed = read(tmp_path, '[[student]]\nname = "Ada"\n')
    assert listed.lateness("ada", datetime(2030, 1, 1, tzinfo=UTC))[1:] == (0, 0)
    assert listed.lateness("ada", None) == (None, 0, 0)


MOODLE_TABLES = {
    "German participants": "Vorname;Nachname;ID-Nummer;E-Mail-Adresse;Gruppen",
    "French participants": "Prénom;Nom de famille;Numéro d’identification;Courriel;Groupes",
    "French, short": "Prénom;Nom;Numéro d'identification;Adresse de courriel;Groupes",
    "Spanish participants": "Nombre;Apellido(s);Número de ID;Dirección de correo;Grupos",
    "Spanish, before 4": "Nombre;Apellidos;Número de ID;Dirección Email;Grupos",
}


@pytest.mark.parametrize("header", MOODLE_TABLES.values(), ids=MOODLE_TABLES)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252", "mac-roman", "utf-16"])
def test_moodles_tables_are_read_in_its_languages(tmp_path: Path, header: str, encoding: str):
    text = f"{header}\r\nZoë;Núñez;S-7;zoe@example.org;Di\r\n"
    path = tmp_path / "participants.csv"
    path.write_bytes(text.encode(encoding))
    (person,) = read_class_list(path).students
    found = (person.name, person.sis_id, person.email, person.section)
    assert found == ("Zoë Núñez", "S-7", "zoe@example.org", "Di")


@pytest.mark.parametrize("encoding", ["cp1252", "mac-roman"])
@pytest.mark.parametrize(
    "text",
    ["Müller;Groß", "MÜLLER;GRÖSSE", "Jürgen;Özil", "René;François", "Søren Håkon", "Peña;José"],
)
def test_letters_of_windows_and_of_a_mac_are_told_apart(text: str, encoding: str):
    assert decode(f"name;first\r\n{text}\r\n".encode(encoding)) == f"name;first\r\n{text}\r\n"


@pytest.mark.parametrize("text", ["gut – „so“", "a ‘b’ – c…", "Škoda;Žižek", "5 € für Müller"])
def test_signs_of_windows_are_not_taken_for_letters_of_a_mac(text: str):
    assert decode(text.encode("cp1252")) == text


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[late]\npercent_a_day = 10\n", "line 1: in late, the field 'due' is missing"),
        ("[late]\ndue = 2026-10-23T23:59:00\n", "no time zone"),
        ('[late]\ndue = "friday"\nzone = "UTC"\n', "line 2: due of late is"),
        ('[late]\ndue = 2026-10-23\nzone = "UTC"\n', "line 2: due of late is"),
        ('[late]\ndue = 2026-10-23T23:59:00\nzone = "Mars"\n', "not a known time zone"),
        (
            "[late]\ndue = 2026-10-23T23:59:00Z\npercent_a_day = 120\n",
            "line 3: percent_a_day of late is 120; give a number of at most 100",
        ),
        (
            "[late]\ndue = 2026-10-23T23:59:00Z\npercent_day = 12\n",
            "perhaps 'percent_a_day' is meant",
        ),
        ("[[student]]\nid = 3\n", "line 1: in student 1, the field 'name' is missing"),
        ('[[student]]\nname = "A"\nid = 3\n[[student]]\nname = "B"\nid = 3\n', "share '3'"),
        ('student = "Ada"\n', "must be a list in [...]"),
        ("late = 3\n", "must be a table"),
        ("[class]\n", "unknown field 'class'"),
        ("= broken", "cannot be read"),
    ],
)
def test_what_is_unclear_is_said_in_one_sentence(tmp_path: Path, text: str, said: str):
    with pytest.raises(CourseError) as raised:
        read(tmp_path, text)
    assert said in str(raised.value)


def test_a_list_that_is_not_there_is_said(tmp_path: Path):
    with pytest.raises(CourseError, match="no class list"):
        read_class_list(tmp_path / "class.toml")


@pytest.mark.parametrize(
    ("identifiers", "emails"),
    [
        (["ada@example.org", "boole@example.org"], ["ada@example.org", "boole@example.org"]),
        (["31815", "31864"], ["", ""]),
        (["Ada @ home", "31864"], ["", ""]),
    ],
)
def test_identifiers_of_github_classroom_that_are_addresses_are_those_of_the_students(
    tmp_path: Path, identifiers: list[str], emails: list[str]
):
    rows = [f'"{identifier}","git-{i}","{i}",""' for i, identifier in enumerate(identifiers)]
    header = '"identifier","github_username","github_id","name"'
    path = tmp_path / "classroom_roster.csv"
    path.write_text("\n".join([header, *rows]))
    people = read_class_list(path).students
    assert [person.email for person in people] == emails
    assert [person.sis_id for person in people] == identifiers
