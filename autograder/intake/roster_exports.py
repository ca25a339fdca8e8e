"""The people of a class, from the lists that learning systems export.

Canvas: the gradebook's CSV (header, rows of ``Points Possible``, a ``Student, Test``). Moodle: the
participants' table or the offline grading worksheet (``Identifier`` holds ``Participant 871030``,
``Last modified (submission)`` the time). Gradescope: the roster (``First Name``, ``Last Name``,
``SID``, ``Email``, ``Role``). GitHub Classroom: ``identifier``, ``github_username``. Anything else
with a column that is recognised by its name. English, German, French and Spanish headers.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import tzinfo
from pathlib import Path

from autograder.errors import CourseError
from autograder.intake.name_spellings import is_anonymous, plain_name
from autograder.intake.person import Person
from autograder.intake.spreadsheets import column, read_rows
from autograder.intake.time_spellings import read_time

_FIRST = ("first name", "firstname", "given name", "first", "vorname", "prénom", "nombre")
_LAST = ("last name", "lastname", "surname", "family name", "last", "nachname", "nom", "apellidos",
         "apellido(s)", "nom de famille", "familienname", "apellido")  # fmt: skip
_NAME = ("student", "full name", "name", "student name", "first name and last name",
         "first name / surname", "vollständiger name", "nom complet", "nombre completo",
         "first name / last name", "display name", "users")  # fmt: skip
_LOGIN = ("sis login id", "login", "username", "user name", "login id", "anmeldename", "user",
          "nutzername", "benutzername", "nom d'utilisateur", "nom d’utilisateur",
          "nombre de usuario",
          "netid", "uni-id", "student login")  # fmt: skip
_EMAIL = ("email", "email address", "e-mail", "e-mail address", "mail", "e-mail-adresse", "emails",
          "adresse de courriel", "courriel", "adresse e-mail", "adresse électronique",
          "dirección de correo", "dirección email", "dirección de email", "correo electrónico",
          "correo")  # fmt: skip
_SIS = ("sis user id", "sid", "student id", "id number", "sis id", "matriculation number",
        "matrikelnummer", "matrikel-nr.", "id-nummer", "numéro d'identification",
        "numéro d’identification", "número de id", "número de identificación",
        "student number", "identifier number")  # fmt: skip
_ID = ("id", "user id", "userid", "canvas id")
_SECTION = ("section", "sections", "section name", "group", "groups", "gruppe", "gruppen", "groupe",
            "groupes", "grupo", "grupos", "sektion", "sektionen", "sección")  # fmt: skip
_GITHUB = ("github username", "github", "github login")
_NUMBER = ("identifier", "participant", "id", "teilnehmer/in", "identifikator", "identifiant",
           "identificador")  # fmt: skip
_TIME = ("last modified (submission)", "zuletzt geändert (abgabe)", "zuletzt geändert (lösung)",
         "dernière modification (travail remis)", "última modificación (entrega)")  # fmt: skip
_ROLE = ("role", "roles", "rolle", "rôle")
_STAFF = (
    "teacher",
    "instructor",
    "ta",
    "professor",
    "assistant",
    "non-editing teacher",
    "observer",
)
_SUFFIXES = ("jr", "sr", "ii", "iii", "iv", "phd", "ph d", "md", "m d", "esq")
_PARTICIPANT = re.compile(r"\D*?(\d+)\s*\Z")


def read_people(text: str, path: Path, zone: tzinfo | None) -> tuple[Person, ...]:
    """The people in the text of a table.

    Raises:
        CourseError: if no column says who anybody is.
    """
    rows = read_rows(text)
    if not rows:
        raise CourseError(f"{path} is empty; export the class list again.")
    header, *others = rows
    is_worksheet = column(header, *_TIME) is not None or any(
        _is_participant(row[0]) for row in others[:3]
    )
    columns = {
        "first": column(header, *_FIRST),
        "last": column(header, *_LAST),
        "name": column(header, *_NAME),
        "login": column(header, *_LOGIN),
        "email": column(header, *_EMAIL),
        "sis_id": column(header, *_SIS),
        "id": None if is_worksheet else column(header, *_ID),
        "section": column(header, *_SECTION),
        "github": column(header, *_GITHUB),
        "number": column(header, *_NUMBER) if is_worksheet else None,
        "time": column(header, *_TIME),
        "role": column(header, *_ROLE),
    }
    if columns["github"] is not None and columns["email"] is None:
        columns["email"] = _column_of_addresses(column(header, "identifier"), others)
    if columns["github"] is not None and columns["name"] is None:
        columns["name"] = column(header, "identifier")
    elif columns["github"] is not None and columns["sis_id"] is None:
        columns["sis_id"] = column(header, "identifier")
    known = [columns[key] for key in ("first", "last", "name", "login", "email")]
    if all(index is None for index in known):
        named = ", ".join(header[:6])
        raise CourseError(
            f"{path} has no column for names, logins or e-mail addresses (it has {named}); name "
            "one Name, Login or Email."
        )
    people = []
    for row in others:
        person = _person({key: _cell(row, index) for key, index in columns.items()}, zone)
        if person is not None:
            people.append(person)
    return tuple(people)


def _column_of_addresses(index: int | None, rows: Sequence[Sequence[str]]) -> int | None:
    """GitHub Classroom's identifiers, where the instructor chose the students' e-mail addresses."""
    identifiers = [cell for row in rows if (cell := _cell(row, index))]
    return index if identifiers and all("@" in cell for cell in identifiers) else None


def _person(cells: dict[str, str], zone: tzinfo | None) -> Person | None:
    name = cells["name"] or f"{cells['first']} {cells['last']}".strip()
    if cells["last"] and cells["first"]:
        name = f"{cells['first']} {cells['last']}"
    if plain_name(name) in ("points possible", "student test", "test student"):
        return None
    if cells["role"] and plain_name(cells["role"]) in _STAFF:
        return None
    found = _PARTICIPANT.fullmatch(cells["number"])
    number = found[1] if found else ""
    name = name or cells["login"] or cells["email"] or cells["github"]
    if is_anonymous(name) or not name:
        name = f"Participant {number}" if number else ""
    if not name:
        return None
    return Person(
        _as_called(name),
        id=cells["id"],
        sis_id=cells["sis_id"],
        login=cells["login"],
        email=cells["email"],
        section=cells["section"],
        github=cells["github"],
        number=number,
        noted_time=read_time(cells["time"], zone),
    )


def _as_called(name: str) -> str:
    """Ada Lovelace for the sortable ``Lovelace, Ada`` that Canvas repeats.

    In ``John Smith, Jr.`` and ``Smith, Jr., John`` a comma belongs to the family name.
    """
    parts = [part.strip() for part in name.split(",")]
    while len(parts) > 1 and plain_name(parts[1]) in _SUFFIXES:
        parts[:2] = [f"{parts[0]}, {parts[1]}"]
    last, first = parts[0], ", ".join(parts[1:])
    return f"{first} {last}" if first and last else name


def _is_participant(cell: str) -> bool:
    word, _, number = cell.rpartition(" ")
    return number.isdigit() and is_anonymous(word)


def _cell(row: Sequence[str], index: int | None) -> str:
    return row[index].strip() if index is not None and index < len(row) else ""
