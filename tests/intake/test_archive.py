"""Zips from anybody: bombs, broken ones, names that lead out, links, too many files."""

import random
import stat
import tempfile
import zipfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.intake.notebook_reader import Unreadable
from tests.intake.handed_in import notebook, read, read_zip, zipped

_ARCHIVE = zipped({"3_ransac.ipynb": notebook("a"), "responses/ransac.json": b'{"responses": {}}'})


@pytest.mark.parametrize(
    "name", ["../3_ransac.ipynb", "a/../../3_ransac.ipynb", "..\\3_ransac.ipynb"]
)
def test_a_name_that_leads_out_of_the_zip_is_left_out(tmp_path, name):
    contents = read_zip(tmp_path, {name: notebook("evil"), "2_line_fitting.ipynb": notebook("a")})
    assert list(contents.notebooks) == ["line_fitting"]
    assert "3_ransac.ipynb lies at a path that leads out of the zip" in contents.notes[0]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ada.zip"]
    with pytest.raises(Unreadable, match="leads out of the zip"):
        read_zip(tmp_path, {name: notebook("evil")})


@pytest.mark.parametrize(
    "name", ["/etc/3_ransac.ipynb", "C:\\3_ransac.ipynb", "c:/x/3_ransac.ipynb"]
)
def test_an_absolute_name_in_a_zip_is_read_without_its_beginning(tmp_path, name):
    contents = read_zip(tmp_path, {name: notebook("k = 1")})
    assert contents.notebooks["ransac"].cells == ["k = 1"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ada.zip"]


def test_a_zip_bomb_is_refused_after_little_work(tmp_path):
    with pytest.raises(Unreadable, match="zip bomb"):
        read_zip(tmp_path, {"3_ransac.ipynb": b" " * 30_000_000})


def test_a_zip_that_grows_beyond_the_cap_in_all_is_refused(tmp_path):
    noise = random.Random(1).randbytes(700_000)
    with pytest.raises(Unreadable, match="larger than 1 MB"):
        read_zip(tmp_path, {"1_a.ipynb": noise, "2_b.ipynb": noise}, submission_mb=1)


def test_a_header_that_claims_a_smaller_size_does_not_get_more_through(tmp_path):
    data = bytearray(zipped({"3_ransac.ipynb": b" " * 900_000}))
    real = (900_000).to_bytes(4, "little")
    data = bytearray(bytes(data).replace(real, (100).to_bytes(4, "little")))
    path = tmp_path / "ada.zip"
    path.write_bytes(data)
    with pytest.raises(Unreadable):
        read(path)


def test_too_many_files_are_refused(tmp_path):
    with pytest.raises(Unreadable, match="more than 2000 files"):
        read_zip(tmp_path, {f"{n}.txt": b"" for n in range(2500)})
    folder = tmp_path / "bob"
    folder.mkdir()
    for n in range(30):
        (folder / f"{n}.txt").touch()
    with pytest.raises(Unreadable, match="more than 20 files"):
        read(folder, submission_files=20)


def test_folders_that_are_too_deep_are_not_read(tmp_path):
    deep = "/".join("d" * 1 for _ in range(20))
    contents = read_zip(
        tmp_path, {f"{deep}/3_ransac.ipynb": notebook("a"), "2_line_fitting.ipynb": notebook("b")}
    )
    assert list(contents.notebooks) == ["line_fitting"]
    assert contents.notes == ["Folders more than 8 deep were not read."]


@pytest.mark.parametrize("cut", [0, 10, 200, -5])
def test_a_damaged_zip_is_refused_with_a_sentence(tmp_path, cut):
    path = tmp_path / "ada.zip"
    path.write_bytes(zipped({"3_ransac.ipynb": notebook("a" * 500)})[:cut])
    with pytest.raises(Unreadable, match="zip is damaged"):
        read(path)


def test_an_encrypted_zip_is_refused_with_a_sentence(tmp_path):
    data = bytearray(zipped({"3_ransac.ipynb": notebook("a")}))
    data[data.index(b"PK\x01\x02") + 8] |= 1
    path = tmp_path / "ada.zip"
    path.write_bytes(data)
    with pytest.raises(Unreadable, match="password"):
        read(path)


def test_a_link_in_a_zip_is_not_followed(tmp_path):
    link = zipfile.ZipInfo("3_ransac.ipynb")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    with zipfile.ZipFile(tmp_path / "ada.zip", "w") as archive:
        archive.writestr(link, "/etc/passwd")
        archive.writestr("2_line_fitting.ipynb", notebook("a"))
    contents = read(tmp_path / "ada.zip")
    assert list(contents.notebooks) == ["line_fitting"]
    assert "is a link" in contents.notes[0]


def test_of_a_name_that_is_in_the_zip_twice_the_last_is_taken_as_every_unzip_tool_does(tmp_path):
    path = tmp_path / "ada.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("3_ransac.ipynb", notebook("first"))
        with pytest.warns(UserWarning, match="Duplicate"):
            archive.writestr("3_ransac.ipynb", notebook("second"))
    contents = read(path)
    assert contents.notebooks["ransac"].cells == ["second"]
    assert contents.notes == ["3_ransac.ipynb is in the zip twice; the last was taken."]


def test_entries_of_one_name_are_unpacked_once(tmp_path, monkeypatch):
    """And what is unpacked counts, even if it is then left out."""
    opened = []
    really = zipfile.ZipFile.open

    def open_entry(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, *arguments: str) -> object:
        opened.append(entry.filename)
        return really(archive, entry, *arguments)

    path = tmp_path / "ada.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("3_ransac.ipynb", notebook("first"))
        for _ in range(5):
            with pytest.warns(UserWarning, match="Duplicate"):
                archive.writestr("3_ransac.ipynb", notebook("again"))
    monkeypatch.setattr(zipfile.ZipFile, "open", open_entry)
    assert read(path).notebooks["ransac"].cells == ["again"]
    assert opened == ["3_ransac.ipynb"]


def test_responses_that_are_too_large_count_towards_the_whole(tmp_path):
    noise = random.Random(1).randbytes(2**20 + 1)
    entries = {f"responses/{n}.json": noise for n in range(4)}
    books = {"3_ransac.ipynb": notebook("k = 1")}
    contents = read_zip(tmp_path, {**books, **entries}, submission_mb=6)
    assert contents.notes.count("0.json is too large for saved responses; it was left out.") == 1
    (tmp_path / "folder/responses").mkdir(parents=True)
    for name, data in entries.items():
        (tmp_path / "folder" / name).write_bytes(data)
    (tmp_path / "folder/3_ransac.ipynb").write_bytes(notebook("k = 1"))
    with pytest.raises(Unreadable, match="larger than 2 MB"):
        read(tmp_path / "folder", submission_mb=2)


@settings(max_examples=300, deadline=None)
@given(st.lists(st.tuples(st.integers(0, len(_ARCHIVE) - 1), st.integers(0, 255)), max_size=8))
def test_a_zip_with_any_bytes_changed_is_read_or_refused(changes):
    data = bytearray(_ARCHIVE)
    for position, value in changes:
        data[position] = value
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "ada.zip"
        path.write_bytes(data)
        try:
            read(path)
        except Unreadable as reason:
            assert str(reason).endswith(".")  # noqa: PT017 -- both outcomes are fine
