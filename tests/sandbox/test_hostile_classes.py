"""Whole classes with every kind of attack in them: each costs what it hits, and nothing else."""

import csv
import re
import sys
import zipfile
from pathlib import Path

import pytest
from attacks import tree

from autograder.cli import main
from tests.classroom import RIGHT, START, hand_in, make_course, notebook

PYPROJECT = """
[project]
name = "orchard"
version = "0.1"

[tool.autograder]
notebook_seconds = 20
cell_seconds = 1
question_seconds = 1
memory_mb = 300
"""
LEAK = "leaked-hidden-input"
HANG = "    while True: pass"
# student: (what replaces a right response, points for Q1 to Q4, statuses of the questions lost)
ATTACKS = {
    "loop": ({"Q4": f"def heaviest(w):\n{HANG}"}, (2, 2, 2, 0)),
    "blocked": (
        {"Q4": "import signal\ndef heaviest(w):\n"
         f"    signal.pthread_sigmask(signal.SIG_BLOCK, range(1, 64))\n{HANG}"},
        (2, 2, 2, 0),
    ),
    "endless_cell": ({"Q2": "while True: pass\ntrees = 12"}, (2, 0, 2, 4)),
    "crash": ({"Q4": "import ctypes\ndef heaviest(w):\n    ctypes.string_at(0)"}, (2, 2, 2, 0)),
    "crash_cell": ({"Q2": "import ctypes\nctypes.string_at(0)\ntrees = 12"}, (2, 0, 2, 4)),
    "exit": ({"Q2": "import os\nos._exit(0)\ntrees = 12"}, (2, 0, 2, 4)),
    "memory": ({"Q4": "def heaviest(w):\n    return bytearray(10**10)"}, (2, 2, 2, 0)),
    "forkbomb": ({"Q2": "import os\nwhile True:\n    try: os.fork()\n    except OSError: pass"},
                 (2, 0, 2, 4)),
    "always_equal": (
        {"Q2": "class Liar(int):\n    def __eq__(self, other): return True\n"
         "    __hash__ = int.__hash__\ntrees = Liar(3)",
         "Q4": "class Liar(float):\n    def __eq__(self, other): return True\n"
         "    def __sub__(self, other): return 0.0\n    __rsub__ = __sub__\n"
         "def heaviest(w): return Liar(1)"},
        (2, 0, 2, 0),
    ),
    "patches": (
        {"Q4": "import numpy, math\nnumpy.allclose = numpy.isclose = lambda *a, **k: True\n"
         "math.isclose = lambda *a, **k: True\ndef heaviest(w): return 0.0"},
        (2, 2, 2, 0),
    ),
    "text": ({"Q3": "hedge = \"__import__('os').system('touch /tmp/pwned') or 2*w+2*l\""},
             (2, 2, 0, 4)),
    "not_a_number": ({"Q2": "trees = float('nan')"}, (2, 0, 2, 4)),
    "huge_number": ({"Q2": "trees = 10**400"}, (2, 0, 2, 4)),
    "leaky": (
        {"Q4": f"def heaviest(w):\n    print('{LEAK}', w)\n    raise ValueError('{LEAK}', w)"},
        (2, 2, 2, 0),
    ),
    "leaky_value": ({"Q4": f"def heaviest(w): return ['{LEAK}', *w]"}, (2, 2, 2, 0)),
    # What is public can be learnt by heart, and earns nothing by itself.
    "visible_only": (
        {"Q4": "def heaviest(w):\n    if w == [120.0, 180.0, 150.0]: return 180.0\n    return 0.0"},
        (2, 2, 2, 0),
    ),
    "in_place": ({"Q4": "def heaviest(w):\n    w.sort()\n    return w[-1]"}, (2, 2, 2, 0)),
    "steals": (
        {"Q4": "import os\ndef heaviest(w):\n    import orchard_reference\n"
         "    return orchard_reference.heaviest(w)"},
        (2, 2, 2, 0),
    ),
    "<script>alert(1)<-script>": ({}, (2, 2, 2, 4)),
    "=HYPERLINK(1)": ({}, (2, 2, 2, 4)),
}  # fmt: skip


@pytest.fixture(scope="module")
def graded(tmp_path_factory) -> Path:
    root = tmp_path_factory.mktemp("hostile")
    make_course(root / "course")
    (root / "course/pyproject.toml").write_text(PYPROJECT)
    for name, (responses, _) in ATTACKS.items():
        hand_in(root / "work", name, **responses)
        hand_in(root / "work", f"good after {name.replace('<', '').replace('>', '')}")
    work = root / "work"
    (work / "lovelace.docx").write_bytes(b"PK")
    (work / "empty.zip").write_bytes(b"")
    (work / "list.ipynb").write_text("[]")
    with zipfile.ZipFile(work / "bomb.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("3_orchard.ipynb", b" " * 40_000_000)
    with zipfile.ZipFile(work / "outside.zip", "w") as archive:
        archive.writestr("../../3_orchard.ipynb", notebook([START, *RIGHT.values()]))
    before = tree(root / "course")
    arguments = ["grade", str(work), "--out", str(root / "grades"), "--seed", "3", "--jobs", "2"]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "dont_write_bytecode", True)  # what is new there is an attack's
        assert main(["--course", str(root / "course"), *arguments]) == 0
    assert tree(root / "course") == before
    return root


@pytest.fixture(scope="module")
def rows(graded: Path) -> dict[str, dict[str, str]]:
    with open(graded / "grades/grades.csv", encoding="utf-8", newline="") as file:
        return {row["student"].lstrip("'"): row for row in csv.DictReader(file)}


def points(row: dict[str, str]) -> tuple[float, ...]:
    return tuple(float(row[id]) for id in ("Q1", "Q2", "Q3", "Q4"))


@pytest.mark.parametrize("name", ATTACKS)
def test_an_attack_costs_the_question_that_it_hits(rows, name):
    assert points(rows[name]) == ATTACKS[name][1]


def test_everybody_who_comes_after_gets_full_marks(rows):
    good = {name: points(row) for name, row in rows.items() if name.startswith("good after")}
    assert len(good) == len(ATTACKS)
    assert set(good.values()) == {(2, 2, 2, 4)}


@pytest.mark.parametrize("name", ["lovelace", "empty", "list", "bomb", "outside"])
def test_what_cannot_be_read_is_listed_with_its_reason(rows, name):
    assert points(rows[name]) == (0, 0, 0, 0)
    assert rows[name]["status"] != "graded"


def test_no_hidden_input_gets_to_students(graded):
    for path in (graded / "grades/feedback").rglob("*"):
        if path.is_file():
            # What happened on the public example is told, with its message; the others begin so:
            assert not re.search(r"\b(251\.5|49\.0)\b", path.read_text())


def test_nothing_was_run_as_a_program():
    assert not Path("/tmp/pwned").exists()


def test_the_reports_name_the_isolation(graded):
    assert "seccomp" in (graded / "grades/class.html").read_text()


def test_a_run_without_the_sandbox_says_so_in_its_reports(tmp_path):
    make_course(tmp_path / "course")
    hand_in(tmp_path / "work", "ada")
    out = ["--out", str(tmp_path / "grades"), "--no-sandbox"]
    grade = ["--course", str(tmp_path / "course"), "grade", str(tmp_path / "work"), *out]
    assert main(grade) == 0
    assert "--no-sandbox" in (tmp_path / "grades/class.html").read_text()


def test_without_any_isolation_grading_refuses_and_says_what_to_do(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("autograder.sandbox.tiers.tiers", lambda course: [])
    make_course(tmp_path / "course")
    hand_in(tmp_path / "work", "ada")
    grade = ["grade", str(tmp_path / "work"), "--out", str(tmp_path / "grades")]
    assert main(["--course", str(tmp_path / "course"), *grade]) == 1
    said = capsys.readouterr().err
    assert "cannot be isolated on this machine" in said
    assert "--no-sandbox" in said
