"""Intake: whatever was handed in is read or refused with one sentence; nothing is written."""

import json
import os

import pytest

from autograder.course import Settings
from autograder.errors import UsageError
from autograder.intake.find_submissions import find_submissions
from autograder.intake.notebook_reader import Unreadable
from autograder.intake.submissions import read_submission
from tests.intake.handed_in import notebook, read, read_zip, zipped

LIMITS = Settings()


# --- who handed in what


def test_each_entry_of_a_class_folder_is_a_submission(tmp_path):
    (tmp_path / "ada.zip").write_bytes(zipped({"3_ransac.ipynb": notebook("a")}))
    (tmp_path / "bob").mkdir()
    (tmp_path / "bob/3_ransac.ipynb").write_bytes(notebook("b"))
    (tmp_path / "eve.ipynb").write_bytes(notebook("e"))
    (tmp_path / "grace.docx").write_bytes(b"PK no notebook")
    (tmp_path / ".DS_Store").write_bytes(b"")
    (tmp_path / "_notes.txt").write_bytes(b"")
    found = find_submissions([tmp_path], LIMITS)
    assert [submission.student for submission in found] == ["ada", "bob", "eve", "grace"]
    with pytest.raises(Unreadable, match=r"grace\.docx is neither a zip nor a notebook"):
        read_submission(found[3], LIMITS)


def test_a_folder_with_numbered_notebooks_is_one_submission(tmp_path):
    for name in ("2_line_fitting.ipynb", "3_ransac.ipynb"):
        (tmp_path / name).write_bytes(notebook(name))
    (submission,) = find_submissions([tmp_path], LIMITS)
    assert submission.student == tmp_path.name
    assert sorted(read_submission(submission, LIMITS).notebooks) == ["line_fitting", "ransac"]


def test_a_folder_with_a_folder_notebooks_is_one_submission(tmp_path):
    (tmp_path / "ada/notebooks").mkdir(parents=True)
    (tmp_path / "ada/notebooks/3_ransac.ipynb").write_bytes(notebook("k = 1"))
    (submission,) = find_submissions([tmp_path / "ada"], LIMITS)
    assert submission.student == "ada"
    assert read_submission(submission, LIMITS).notebooks["ransac"].cells == ["k = 1"]


def test_a_path_that_does_not_exist_is_a_wrong_usage(tmp_path):
    with pytest.raises(UsageError, match="does not exist"):
        find_submissions([tmp_path / "nobody"], LIMITS)


def test_two_entries_with_one_name_are_told_apart_and_both_say_so(tmp_path):
    (tmp_path / "ada.zip").write_bytes(b"")
    (tmp_path / "ada").mkdir()
    (tmp_path / "Ada.ipynb").write_bytes(b"")
    found = find_submissions([tmp_path], LIMITS)
    names = [submission.student for submission in found]
    assert len({name.casefold() for name in names}) == 3
    assert all("each is marked by itself" in submission.notes[0] for submission in found)


def test_control_characters_do_not_get_into_a_name(tmp_path):
    evil = tmp_path / "ada\x1b[31m\n\u202e.zip"
    evil.write_bytes(b"")
    (submission,) = find_submissions([tmp_path], LIMITS)
    assert submission.student == "ada [31m"
    assert submission.student.isprintable()


def test_a_name_that_is_not_valid_text_can_be_printed(tmp_path):
    with open(os.fsencode(tmp_path) + b"/ad\xe9.zip", "wb"):
        pass
    (submission,) = find_submissions([tmp_path], LIMITS)
    assert submission.student.encode("utf-8")


def test_one_broken_notebook_leaves_the_others_readable(tmp_path):
    contents = read_zip(
        tmp_path, {"2_line_fitting.ipynb": b"[1]", "3_ransac.ipynb": notebook("k = 1")}
    )
    assert list(contents.notebooks) == ["ransac"]
    assert "holds a list" in contents.unreadable["line_fitting"]


def test_saved_responses_are_read_from_their_folder_only(tmp_path):
    saved = {"chapter": "ransac", "responses": {"Q3.1": {"response": [True]}, "Q3.2": 5}}
    entries = {
        "notebooks/3_ransac.ipynb": notebook("k = 1"),
        "notebooks/responses/ransac.json": json.dumps(saved).encode(),
        "notebooks/responses/line_fitting.json": b"not json",
        "ransac.json": json.dumps({"responses": {"Q9": {"response": 1}}}).encode(),
    }
    contents = read_zip(tmp_path, entries)
    assert contents.sidecars == {"ransac": {"Q3.1": {"response": [True]}}}
    assert any("line_fitting.json" in note for note in contents.notes)


def test_the_fingerprint_follows_the_code_and_not_the_outputs_or_the_packing(tmp_path):
    def fingerprint(name: str, data: bytes) -> str:
        path = tmp_path / name / "3_ransac.ipynb"
        path.parent.mkdir()
        path.write_bytes(data)
        return read(path).fingerprint

    plain = fingerprint("plain", notebook("k = 1"))
    loud = json.loads(notebook("k = 1"))
    loud["cells"][0]["outputs"] = [{"output_type": "stream", "text": "hello"}]
    assert fingerprint("loud", json.dumps(loud, indent=4).encode()) == plain
    assert read_zip(tmp_path, {"in/3_ransac.ipynb": notebook("k = 1")}).fingerprint == plain
    assert fingerprint("other", notebook("k = 2")) != plain


# --- archives and folders made to do harm


def test_links_and_pipes_in_a_folder_are_not_opened(tmp_path):
    secret = tmp_path / "solved.ipynb"
    secret.write_bytes(notebook("the answer"))
    folder = tmp_path / "ada"
    folder.mkdir()
    (folder / "3_ransac.ipynb").symlink_to(secret)
    (folder / "elsewhere").symlink_to(tmp_path)
    (folder / "2_line_fitting.ipynb").write_bytes(notebook("a"))
    contents = read(folder)
    assert list(contents.notebooks) == ["line_fitting"]
    os.mkfifo(folder / "1_place_recognition.ipynb")
    with pytest.raises(Unreadable, match="not an ordinary file"):
        read(folder)


def test_an_entry_of_the_class_folder_that_is_a_link_is_refused(tmp_path):
    (tmp_path / "class").mkdir()
    (tmp_path / "solved").mkdir()
    (tmp_path / "solved/3_ransac.ipynb").write_bytes(notebook("the answer"))
    (tmp_path / "class/ada").symlink_to(tmp_path / "solved")
    (submission,) = find_submissions([tmp_path / "class"], LIMITS)
    with pytest.raises(Unreadable, match="is a link"):
        read_submission(submission, LIMITS)


def test_checkpoints_and_resource_forks_are_passed_over(tmp_path):
    names = [".ipynb_checkpoints/3_ransac-checkpoint.ipynb", "__MACOSX/._3_ransac.ipynb"]
    with pytest.raises(Unreadable, match="holds no notebook"):
        read_zip(tmp_path, {name: notebook("a") for name in names})
