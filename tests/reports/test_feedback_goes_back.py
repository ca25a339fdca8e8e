"""Feedback as learning systems take it back; each rule is held against the importer's own source.

The importers are written again here, from their sources, as short as their rules:
mod/assign/feedback/file/importziplib.php of moodle/moodle and
app/models/abstract_assignment.rb of instructure/canvas-lms.
"""

from __future__ import annotations

import email
import email.policy
import io
import json
import re
import socket
import threading
import zipfile
from pathlib import Path
from typing import NamedTuple

import pytest

from autograder.course import Course
from autograder.gradebook import Record
from autograder.grading.graded_submission import Graded
from autograder.intake.origin import Claim, Origin, Piece
from autograder.intake.person import Person
from autograder.intake.submissions import Submission
from autograder.reports.html_page import page
from autograder.reports.returning import Page, canvas_files, messages, moodle_files, plain_files
from autograder.reports.returning.mail import MailError, as_parcel, send
from tests.classroom import all_marks


def feedback(key: str, origin: Origin, *people: Person) -> Page:
    submission = Submission(key, Path(f"/class/{key}"), origin=origin)
    record = Record(Graded(submission, "graded", "f", all_marks()), 1, 1, people=people)
    return Page(record, page(f"Feedback for {key}", "<h1>Hello</h1>", "<p>Well done.</p>", ""))


class Imported(NamedTuple):
    participant: int
    plugin: tuple[str, str]
    filename: str


def moodle_import(path: str) -> Imported | None:
    """``is_valid_filename_for_import``, for the plugins that every Moodle has."""
    if path.rpartition("/")[2].startswith((".", "~")):
        return None
    parts = path.split("/")
    while parts:
        info = parts.pop(0).split("_", 4)
        if len(info) < 4 or not info[1].isdigit():
            continue
        if (info[2], info[3]) not in {("assignsubmission", "file"), ("assignfeedback", "file")}:
            continue
        rest = info[4] if len(info) == 5 else ""
        return Imported(int(info[1]), (info[2], info[3]), "/".join([rest, *parts]))
    return None


class CanvasFile(NamedTuple):
    user: str
    attachment: str


def canvas_import(path: str) -> CanvasFile | None:
    """``infer_comment_context_from_filename``: whose comment it is, and for which file."""
    filename = path.rpartition("/")[2]
    split = [part for part in filename.split("_") if part != "LATE"]
    if re.match("^link", split[-1]) or filename.startswith("._"):
        return None
    if split[0] == "anon":
        return CanvasFile(split[1], split[2])
    numbers = [part for part in split if re.fullmatch(r"\d+", part)][:2]
    return CanvasFile(*numbers) if len(numbers) == 2 else None


def moodle(name: str, number: str) -> Origin:
    return Origin("moodle", f"{name}_{number}", (Claim(name=name, number=number),))


@pytest.mark.parametrize(
    "name", ["Ada Lovelace", "Ada_B Lovelace", ".Ada", "~Ada", "Ada / Lovelace", "Ädá Łø", "7_8"]
)
def test_moodle_gives_each_page_to_its_participant(name: str):
    parcel = moodle_files([feedback("ada", moodle(name, "871030"))])
    (path,) = parcel.files
    assert moodle_import(path) == Imported(871030, ("assignsubmission", "file"), "feedback.html")


def test_two_people_of_one_name_get_their_own_page_in_moodle():
    pages = [feedback(f"ada{n}", moodle("Ada Lovelace", n)) for n in ("11", "12")]
    found = [moodle_import(path) for path in moodle_files(pages).files]
    assert [entry.participant for entry in found if entry] == [11, 12]


def test_a_participant_number_of_the_worksheet_serves_where_the_download_has_none():
    ada = Person("Ada Lovelace", number="77")
    (path,) = moodle_files([feedback("ada", Origin(), ada)]).files
    found = moodle_import(path)
    assert found is not None
    assert found.participant == 77


def test_without_a_participant_number_nothing_goes_to_moodle_and_the_reason_is_said():
    parcel = moodle_files([feedback("ada", Origin())])
    assert not parcel.files
    assert "offline grading worksheet" in parcel.left[0].reason


def test_moodle_s_zip_opens_and_holds_the_pages(tmp_path: Path):
    moodle_files([feedback("ada", moodle("Ada Lovelace", "5"))]).write_zip(tmp_path / "x/m.zip")
    with zipfile.ZipFile(tmp_path / "x/m.zip") as archive:
        (name,) = archive.namelist()
        assert b"Well done." in archive.read(name)


def canvas(name: str) -> Origin:
    return Origin("canvas", "x", pieces=(Piece(Path(f"/download/{name}")),))


@pytest.mark.parametrize(
    ("handed_in", "owner"),
    [
        ("lovelaceada_98765_4711_submission.zip", CanvasFile("98765", "4711")),
        ("lovelaceada_LATE_98765_4711_submission-2.zip", CanvasFile("98765", "4711")),
        ("anon_x7Yz3_4711_submission.zip", CanvasFile("x7Yz3", "4711")),
        ("lovelaceada_98765_4711_3_ransac.ipynb", CanvasFile("98765", "4711")),
        ("lovelaceada_98765_4711_12_34.zip", CanvasFile("98765", "4711")),
    ],
)
def test_canvas_finds_the_student_and_the_file_that_the_comment_is_for(handed_in, owner):
    (path,) = canvas_files([feedback("ada", canvas(handed_in))]).files
    assert canvas_import(path) == owner


def test_feedback_for_canvas_opens_under_the_name_of_the_file_that_was_handed_in():
    # The comment's attachment is called as the file that was handed in (``display_name``).
    pages = [
        feedback("ada", canvas("lovelaceada_98765_4711_submission.zip")),
        feedback("boole", canvas("boolegeorge_98766_4712_3_ransac.ipynb")),
    ]
    packed, notebook = canvas_files(pages).files.values()
    with zipfile.ZipFile(io.BytesIO(packed)) as archive:
        assert b"Well done." in archive.read("feedback.html")
    (cell,) = json.loads(notebook)["cells"]
    assert "Well done." in cell["source"]
    assert "<style" not in cell["source"]


def test_of_several_files_in_canvas_the_newest_gets_the_comment():
    names = ("lovelaceada_9_100_1_a.ipynb", "lovelaceada_9_103_3_c.ipynb")
    origin = Origin("canvas", pieces=tuple(Piece(Path(name)) for name in names))
    (path,) = canvas_files([feedback("ada", origin)]).files
    assert canvas_import(path) == CanvasFile("9", "103")


@pytest.mark.parametrize("name", ["ada.zip", "lovelaceada_98765_text.html", "a_12_b.zip"])
def test_what_canvas_could_not_place_is_left_out_and_named(name: str):
    parcel = canvas_files([feedback("ada", canvas(name))])
    assert not parcel.files
    assert "Canvas" in parcel.left[0].reason


def test_folders_are_called_by_name_and_two_of_one_name_get_two():
    adas = [Person("Ada Lovelace", login="ada1"), Person("Ada Lovelace", login="ada2")]
    pages = [feedback(f"s{n}", Origin(), ada) for n, ada in enumerate(adas)]
    pages.append(feedback("nobody.zip", Origin()))
    assert set(plain_files(pages).files) == {
        "Ada Lovelace (ada1)/feedback.html",
        "Ada Lovelace (ada2)/feedback.html",
        "nobody.zip/feedback.html",
    }


def test_a_name_leads_out_of_no_folder():
    evil = Person("../../etc/passwd", login="../x")
    (path,) = plain_files([feedback("s", Origin(), evil)]).files
    assert ".." not in Path(path).parts
    assert len(Path(path).parts) == 2


ADA = Person("Ada Lovelace, Countess", email="ada@example.org", login="ada")


def test_a_message_reads_back_with_its_address_points_and_page(course: Course):
    pages = [feedback("ada", Origin(), ADA)]
    letters, left = messages(course, pages, "Übung 3", "Course <course@example.org>")
    parcel = as_parcel(letters, left)
    (name,) = parcel.files
    assert name == "ada@example.org.eml"
    read = email.message_from_bytes(parcel.files[name], policy=email.policy.default)
    (address,) = read["To"].addresses
    assert (address.display_name, address.addr_spec) == (ADA.name, "ada@example.org")
    assert "Übung 3" in read["Subject"]
    body = read.get_body()
    assert body is not None
    assert "10 of 10 points." in body.get_content()
    (attached,) = read.iter_attachments()
    assert "Well done." in attached.get_content()


def test_names_add_no_header_to_a_message(course: Course):
    eve = Person("Eve\r\nBcc: all@example.org", email="eve@example.org")
    letters, _ = messages(course, [feedback("eve", Origin(), eve)], "A\nBcc: b@c", "x@y.org")
    raw = as_parcel(letters, []).files["eve@example.org.eml"]
    assert email.message_from_bytes(raw)["Bcc"] is None


@pytest.mark.parametrize("address", ["", "no address", "a@b@c", "<>"])
def test_without_an_address_nothing_is_sent_and_the_name_is_told(course: Course, address: str):
    pages = [feedback("ada", Origin(), Person("Ada", email=address))]
    letters, left = messages(course, pages, "x", "")
    assert not letters
    assert left[0].record.student == "ada"
    assert left[0].reason == "there is no e-mail address in the class list"


def test_a_member_of_a_group_without_an_address_is_named(course: Course):
    boole = Person("George Boole")
    letters, left = messages(course, [feedback("g", Origin(), ADA, boole)], "x", "")
    assert len(letters) == 1
    assert left[0].reason == "George Boole has no e-mail address in the class list"


def test_a_group_gets_a_message_each(course: Course):
    boole = Person("George Boole", email="boole@example.org")
    letters, _ = messages(course, [feedback("g", Origin(), ADA, boole)], "x", "")
    assert [letter.person for letter in letters] == [ADA, boole]


def test_mail_is_spoken_as_a_server_hears_it(course: Course):
    letters, _ = messages(course, [feedback("ada", Origin(), ADA)], "x", "course@example.org")
    with socket.create_server(("127.0.0.1", 0)) as listener:
        heard: list[str] = []
        server = threading.Thread(target=_smtp_server, args=(listener, heard), daemon=True)
        server.start()
        port = listener.getsockname()[1]
        assert list(send(letters, "127.0.0.1", port, "", "", "none")) == letters
        server.join(20)
    commands = [line.casefold() for line in heard]
    assert commands[1].startswith("mail from:<course@example.org>")
    assert commands[2] == "rcpt to:<ada@example.org>"


def test_a_server_that_refuses_is_told_in_one_sentence(course: Course):
    letters, _ = messages(course, [feedback("ada", Origin(), ADA)], "x", "course@example.org")
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
    with pytest.raises(MailError, match="refused"):
        list(send(letters, "127.0.0.1", port, "", "", "none"))


def _smtp_server(listener: socket.socket, heard: list[str]) -> None:
    connection, _ = listener.accept()
    with connection, connection.makefile("rwb") as stream:

        def say(text: str) -> None:
            stream.write(text.encode() + b"\r\n")
            stream.flush()

        say("220 here")
        in_data = False
        for raw in stream:
            line = raw.decode("utf-8", "replace").rstrip("\r\n")
            if in_data:
                if line == ".":
                    in_data = False
                    say("250 taken")
                continue
            heard.append(line)
            in_data = line.upper() == "DATA"
            say("354 go on" if in_data else "221 bye" if line.lower() == "quit" else "250 well")
            if line.lower() == "quit":
                return


def test_moodle_never_takes_the_number_of_a_team_for_a_participants():
    # Group 55 handed in; participant 55 is somebody who has nothing to do with it.
    team = Origin("moodle", "Group A_55", (Claim(name="Group A", number="55"),))
    ada = Person("Ada Lovelace", number="871", section="Tuesday, Group A")
    boole = Person("George Boole", number="872", section="Group A")
    unknown = Person("Marie Curie", section="Group A")
    for people, numbers, left in (
        ((ada, boole), {871, 872}, 0),
        ((ada,), {871}, 0),
        ((ada, unknown), {871}, 1),
        ((unknown,), set(), 1),
        ((unknown, Person("Kim Lee")), set(), 1),
    ):
        parcel = moodle_files([feedback("Group A", team, *people)])
        read = [moodle_import(file) for file in parcel.files]
        assert {entry.participant for entry in read if entry is not None} == numbers
        assert len(parcel.left) == left
    alone = Origin("moodle", "Ada Lovelace_871", (Claim(name="Ada Lovelace", number="871"),))
    without_worksheet = Person("Ada Lovelace", email="ada@x.org", section="Group A")
    (file,) = moodle_files([feedback("Ada Lovelace", alone, without_worksheet)]).files
    read_alone = moodle_import(file)
    assert read_alone is not None
    assert read_alone.participant == 871
