"""Intake: whatever was handed in is read or refused with one sentence; nothing is written."""

import io
import json
import os
import random
import stat
import tempfile
import time
import zipfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.course import Settings
from autograder.errors import UsageError
from autograder.exchange.responses import RECEIPT
from autograder.intake.find_submissions import find_submissions
from autograder.intake.handout import Handout
from autograder.intake.notebook_reader import Notebook, Unreadable, read_notebook
from autograder.intake.submissions import Contents, Submission, read_submission

LIMITS = Settings()


def notebook(*cells: str, **outputs: object) -> bytes:
    code = [
        {"cell_type": "code", "metadata": {}, "source": cell, "outputs": [], "execution_count": 1}
        for cell in cells
    ]
    return json.dumps({"cells": code, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}).encode()


def zipped(entries: dict[str, bytes]) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in entries.items():
            archive.writestr(name, data)
    return buffer.getvalue()


def read(path: Path, **limits: int) -> Contents:
    return read_submission(Submission("ada", path), Settings(**limits))


def read_zip(folder: Path, entries: dict[str, bytes], **limits: int) -> Contents:
    path = folder / "ada.zip"
    path.write_bytes(zipped(entries))
    return read(path, **limits)


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


# --- what is in a notebook


def test_only_code_cells_are_read_in_their_order(tmp_path):
    cells = [
        {"cell_type": "markdown", "source": "# no"},
        {"cell_type": "code", "source": ["a = 1\n", "b = 2"]},
        {"cell_type": "raw", "source": "no"},
        {"cell_type": "code", "source": "c = 3"},
    ]
    path = tmp_path / "3_ransac.ipynb"
    path.write_text(json.dumps({"cells": cells, "nbformat": 4}))
    assert read(path).notebooks["ransac"].cells == ["a = 1\nb = 2", "c = 3"]


def test_receipts_are_the_only_outputs_that_are_read():
    def shown(data: object) -> dict[str, object]:
        return {"output_type": "display_data", "data": data}

    receipt = {RECEIPT: {"question": "Q1.1", "response": [True, False]}, "text/html": "score: 100"}
    outputs = [shown({"text/plain": "100 points"}), shown(receipt), shown("junk"), 7]
    cell = {"cell_type": "code", "source": 'ask("Q1.1")', "outputs": outputs}
    read = read_notebook(json.dumps({"cells": [cell]}).encode())
    assert read == Notebook(['ask("Q1.1")'], {"Q1.1": [True, False]}, [])


def test_a_receipt_with_broken_text_or_too_much_of_it_is_cleaned_or_dropped():
    def cell(response: str) -> str:
        receipt = f'{{"{RECEIPT}": {{"question": "Q1", "response": {response}}}}}'
        return f'{{"cell_type": "code", "source": "", "outputs": [{{"data": {receipt}}}]}}'

    surrogate = read_notebook(
        f'{{"cells": [{cell(chr(34) + chr(92) + "ud800" + chr(34))}]}}'.encode()
    )
    assert surrogate.receipts == {"Q1": "?"}
    infinite = read_notebook(f'{{"cells": [{cell("[NaN, 1e999]")}]}}'.encode())
    assert infinite.receipts == {"Q1": [None, None]}
    nested = read_notebook(f'{{"cells": [{cell("[" * 50 + "]" * 50)}]}}'.encode())
    assert nested.receipts == {}
    long = read_notebook(f'{{"cells": [{cell(chr(34) + "x" * 30_000 + chr(34))}]}}'.encode())
    assert long.receipts == {}


def test_the_old_format_with_worksheets_is_read_and_noted():
    old = {"nbformat": 3, "worksheets": [{"cells": [{"cell_type": "code", "input": ["x = 1"]}]}]}
    read = read_notebook(json.dumps(old).encode(), "3_ransac.ipynb")
    assert read.cells == ["x = 1"]
    assert read.notes == ["3_ransac.ipynb is in an old notebook format (nbformat 3)."]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-32"])
def test_other_encodings_and_byte_order_marks_are_read(encoding):
    text = json.dumps({"cells": [{"cell_type": "code", "source": "α = 1"}]}, ensure_ascii=False)
    assert read_notebook(text.encode(encoding)).cells == ["α = 1"]


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "is empty"),
        (b" \n", "is empty"),
        (b"\x89PNG\r\n\x1a\n\xff\xfe\x00", "is not text"),
        (b"[1, 2]", "holds a list of JSON"),
        (b"null", "holds nothing of JSON"),
        (b'"text"', "holds a text of JSON"),
        (b"{}", "has no list of cells"),
        (notebook("x = 1")[:-30], "is cut off"),
        (notebook("x = 1")[:40], "is cut off"),
        (b'{"cells": [}', "is damaged|is cut off"),
        (b'{"cells": oops}' + b" " * 50, "is damaged"),
        (b"[" * 100_000, "holds data that does not belong in a notebook"),
        (b'{"cells": [' + b"9" * 10_000 + b"]}", "holds data that does not belong in a notebook"),
        (notebook(*["x"] * 3000), "more than 2000 code cells"),
        (notebook("x" * 3_000_000), "more than 2 million characters"),
        (b'{"cells": [' + b"[" * 5_000_000, "holds data that does not belong in a notebook"),
    ],
    ids=lambda value: str(value)[:30],  # some are too long for the name of a test
)
def test_what_is_no_notebook_is_refused_with_a_sentence(data, reason):
    with pytest.raises(Unreadable, match=reason) as caught:
        read_notebook(data, "3_ransac.ipynb")
    assert str(caught.value).startswith("3_ransac.ipynb ")
    assert str(caught.value).endswith(".")


def test_sixty_megabytes_of_stored_outputs_do_not_hide_the_code(tmp_path):
    output = {"output_type": "stream", "text": "x" * 60_000_000}
    cell = {"cell_type": "code", "source": "k = 74", "outputs": [output]}
    path = tmp_path / "3_ransac.ipynb"
    path.write_text(json.dumps({"cells": [cell]}))
    assert read(path).notebooks["ransac"].cells == ["k = 74"]


def test_a_notebook_made_to_exhaust_memory_is_refused_and_the_grader_stays_small():
    import resource

    bomb = b'{"cells": [' + b"[]," * 20_000_000 + b"[]]}"
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(Unreadable, match="too large to be read"):
        read_notebook(bomb, "3_ransac.ipynb")
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 300_000  # kB


# --- which notebook, which chapter


@pytest.mark.parametrize(
    "name",
    [
        "3_ransac.ipynb",
        "3_ransac (1).ipynb",
        "3_ransac-Copy1.ipynb",
        "3_ransac - Copy.ipynb",
        "3_ransac copy 2.ipynb",
        "Copy of 3_ransac.ipynb",
        "deep/inside/3_ransac.ipynb",
    ],
)
def test_a_copy_belongs_to_its_chapter(tmp_path, name):
    assert list(read_zip(tmp_path, {name: notebook("k = 1")}).notebooks) == ["ransac"]


@pytest.mark.parametrize(
    "suffix",
    ["-copy1" * 40, "-copy1" * 10_000, " (1)" * 10_000, "-copy" * 10_000, "- _" * 10_000,
     "-" * 60_000 + "copy", "(1" * 30_000, "copy " + "1" * 60_000],
    ids=lambda suffix: f"{suffix[:6]} {len(suffix)}",
)  # fmt: skip
def test_a_name_made_to_look_like_a_copy_in_many_ways_is_read_at_once(tmp_path, suffix):
    began = time.process_time()
    books = {"3_ransac.ipynb": notebook("k = 1"), f"3_ransac{suffix}x.ipynb": notebook("k = 2")}
    contents = read_zip(tmp_path, books)
    assert time.process_time() - began < 1  # of this process alone
    assert contents.notebooks["ransac"].cells == ["k = 1"]


def test_a_copy_of_a_copy_belongs_to_its_chapter(tmp_path):
    names = [
        "3_ransac-Copy1 (2).ipynb",
        "3_ransac (1) - Copy (3).ipynb",
        "3_ransac(4)_copy_2.ipynb",
    ]
    for name in names:
        assert list(read_zip(tmp_path, {name: notebook("k = 1")}).notebooks) == ["ransac"]


def test_with_the_chapters_known_a_renamed_notebook_is_found(tmp_path):
    path = tmp_path / "lovelace_4711_3_RANSAC final.ipynb"
    path.write_bytes(notebook("k = 1"))
    found = read_submission(Submission("ada", path), LIMITS, ["line_fitting", "ransac"])
    assert list(found.notebooks) == ["ransac"]


def test_of_two_notebooks_for_one_chapter_the_original_is_marked_and_the_other_named(tmp_path):
    copies = {"3_ransac (1).ipynb": notebook("copy"), "3_ransac.ipynb": notebook("original")}
    contents = read_zip(tmp_path, copies)
    assert contents.notebooks["ransac"].cells == ["original"]
    assert contents.notes == [
        "There are two notebooks for one chapter: 3_ransac.ipynb was marked, "
        "3_ransac (1).ipynb was not."
    ]


def test_a_backup_of_an_earlier_handout_is_not_taken_for_the_work(tmp_path):
    handout = Handout(
        {"ransac": ("Q3.1",)},
        {"ransac": ("k = ...", 'def fit():\n    """New words."""\n    raise NotImplementedError')},
    )
    stub = 'def fit():\n    """Old words."""\n    raise NotImplementedError'
    entries = {
        "backup/3_ransac.ipynb": notebook("k = ...", stub, "old_figure()"),
        "final/3_ransac.ipynb": notebook("k = 74", stub[:-25] + "    return 1", "old_figure()"),
    }
    path = tmp_path / "ada.zip"
    path.write_bytes(zipped(entries))
    contents = read_submission(Submission("ada", path), LIMITS, handout)
    assert contents.notebooks["ransac"].cells[0] == "k = 74"
    assert contents.notes == [
        "There are two notebooks for one chapter: final/3_ransac.ipynb was marked, "
        "backup/3_ransac.ipynb was not (it is as handed out)."
    ]


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


def test_checkpoints_and_resource_forks_are_passed_over(tmp_path):
    names = [".ipynb_checkpoints/3_ransac-checkpoint.ipynb", "__MACOSX/._3_ransac.ipynb"]
    with pytest.raises(Unreadable, match="holds no notebook"):
        read_zip(tmp_path, {name: notebook("a") for name in names})


# --- anything at all

_json = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3)
    | st.dictionaries(
        st.sampled_from(
            ["cells", "cell_type", "code", "source", "input", "outputs", "data", RECEIPT,
             "question", "response", "worksheets", "nbformat", "responses"]
        ),
        inner | st.sampled_from(["code", "Q1.1"]),
        max_size=5,
    ),
    max_leaves=30,
)  # fmt: skip


def _reads_or_refuses(data: bytes) -> None:
    try:
        found = read_notebook(data, "it")
    except Unreadable as reason:
        assert str(reason).endswith(".")  # noqa: PT017 -- both outcomes are fine
    else:
        assert all(isinstance(cell, str) for cell in found.cells)
        json.dumps(found.receipts, allow_nan=False).encode("utf-8")


@settings(max_examples=200, deadline=None)
@given(st.binary(max_size=200))
def test_any_bytes_are_read_as_a_notebook_or_refused(data):
    _reads_or_refuses(data)


@settings(max_examples=300, deadline=None)
@given(_json)
def test_any_json_is_read_as_a_notebook_or_refused(value):
    _reads_or_refuses(json.dumps(value).encode())
    _reads_or_refuses(json.dumps({"cells": [{"cell_type": "code", "outputs": [value]}]}).encode())


_ARCHIVE = zipped({"3_ransac.ipynb": notebook("a"), "responses/ransac.json": b'{"responses": {}}'})


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
