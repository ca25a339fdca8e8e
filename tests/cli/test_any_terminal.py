"""Windows' redirects, ASCII, a narrow terminal, none at all: no traceback, the same content."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

from autograder.course import Course
from autograder.gradebook import Record
from autograder.reports.terminal import print_table
from autograder.reports.terminal_student import print_record
from tests.classroom import all_marks, graded, hand_in, make_course, mark

NAME = "Łukasz Müller"


@pytest.fixture(scope="module")
def classroom(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("any")
    make_course(root / "course")
    hand_in(root / "work", NAME, Q2="trees = 7")
    return root


def run(root: Path, *arguments: str, **environment: str) -> subprocess.CompletedProcess[bytes]:
    command = [sys.executable, "-m", "autograder", "--course", str(root / "course"), *arguments]
    variables = {k: v for k, v in os.environ.items() if k not in ("PYTHONUTF8", "COLUMNS")}
    return subprocess.run(
        command, capture_output=True, env={**variables, **environment}, timeout=300
    )


@pytest.mark.parametrize("encoding", ["utf-8", "cp1252", "ascii", "latin-1"])
def test_every_encoding_shows_the_same_words(classroom: Path, encoding: str):
    out = ["--out", str(classroom / encoding)]
    setting = {"PYTHONIOENCODING": encoding}
    assert run(classroom, "grade", str(classroom / "work"), *out, **setting).returncode == 0
    shown = run(classroom, "show", NAME, *out, **setting)
    assert b"Traceback" not in shown.stderr
    assert shown.returncode == 0
    words = " ".join(shown.stdout.decode(encoding).split())
    assert "rows and trees added" in words
    assert "8.5 of 10 points" in words
    assert NAME.encode(encoding, "backslashreplace").decode(encoding) in words
    sign = "✓" if encoding == "utf-8" else "+"
    assert f"{sign} Q1" in words


OLD_LOCALE = {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}


@pytest.mark.skipif(os.name != "posix", reason="Windows keeps names in Unicode")
@pytest.mark.parametrize("encoding", ["", "ascii", "cp437", "utf-8"])
def test_names_are_whole_in_an_old_locale(classroom: Path, encoding: str, tmp_path: Path):
    """Python takes arguments and names of files for ASCII there, with half letters in them."""
    out = ["--out", str(tmp_path / "Noten für 李")]
    setting = {**OLD_LOCALE, **({"PYTHONIOENCODING": encoding} if encoding else {})}
    assert run(classroom, "grade", str(classroom / "work"), *out, **setting).returncode == 0
    noted = run(classroom, "note", NAME, "größer – 😀", *out, **setting)
    assert noted.returncode == 0, noted.stderr
    shown = run(classroom, "show", NAME, *out, **setting)
    assert shown.returncode == 0
    wanted = NAME.encode(encoding or "ascii", "backslashreplace")
    assert wanted in shown.stdout
    read = run(classroom, "show", NAME, *out, PYTHONIOENCODING="utf-8").stdout.decode("utf-8")
    assert NAME in read
    assert "größer – 😀" in read


@pytest.mark.skipif(os.name != "posix", reason="Windows keeps names in Unicode")
def test_a_gradebook_in_a_folder_whose_name_is_no_text_is_refused(classroom: Path, tmp_path: Path):
    out = os.fsdecode(os.fsencode(tmp_path) + b"/Noten_\xe4")
    done = run(classroom, "grade", str(classroom / "work"), "--out", out, LC_ALL="C.UTF-8")
    assert done.returncode == 2
    assert b"is not UTF-8" in done.stderr
    assert b"Traceback" not in done.stderr


@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&- <&-"])
def test_without_any_output_the_work_is_done_all_the_same(classroom: Path, closed: str, tmp_path):
    command = f'"{sys.executable}" -m autograder --course "{classroom / "course"}" grade '
    command += f'"{classroom / "work"}" --out "{tmp_path / "grades"}" {closed}'
    assert subprocess.run(["sh", "-c", command], timeout=300).returncode == 0
    assert "8.5" in (tmp_path / "grades/grades.csv").read_text()


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Course:
    return make_course(tmp_path_factory.mktemp("orchard") / "course")


@pytest.mark.parametrize("width", [8, 20, 40, 59, 60, 200])
def test_a_terminal_of_any_width_shows_all_of_it(course: Course, width: int):
    long = "The first apple is missing from your search, so look again from the start."
    marks = (*all_marks()[:3], mark("Q4", 0.5, 4, feedback=long, understood="x" * 70))
    record = Record(graded("ada", *marks, notes=("A notebook was found twice.",)), 1, 1)
    file = StringIO()
    console = Console(file=file, width=width)
    print_table(console, course, [record])
    print_record(console, course, record, [])
    shown = re.sub(r"\s", "", file.getvalue())
    for said in (long, "A notebook was found twice.", "Q4"):
        if width >= 60 and said == long:
            continue  # folded beside another column: its words are there, in pieces
        assert re.sub(r"\s", "", said) in shown
    assert file.getvalue().count("x") >= 70
    assert "…" not in shown
