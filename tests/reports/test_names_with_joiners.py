"""Names are written as people write them, wherever they are shown."""

from pathlib import Path

import pytest

from autograder.cli import main
from tests.classroom import hand_in, make_course

FAMILY, PERSIAN, INDIC = "👨\u200d👩\u200d👧", "می\u200cخواهم", "क्\u200dष"


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("names")
    make_course(root / "course")
    for name in (FAMILY, PERSIAN, INDIC, "gnp\u202eexe"):
        hand_in(root / "work", name)
    grade = ["grade", str(root / "work"), "--out", str(root / "out")]
    assert main(["--course", str(root / "course"), *grade]) == 0
    return root / "out"


@pytest.mark.parametrize("name", [FAMILY, PERSIAN, INDIC])
def test_joiners_stay_in_tables_pages_and_file_names(out, name):
    for report in ("grades.csv", f"feedback/{name}.html"):
        assert name in (out / report).read_text()
    assert name[1] + "�" not in (out / "class.html").read_text()


def test_a_change_of_direction_is_shown_nowhere(out):
    for path in out.rglob("*"):
        assert "\u202e" not in path.name
        if path.suffix in (".csv", ".html"):
            assert "\u202e" not in path.read_text()


def test_the_terminal_shows_joiners(out, capsys):
    arguments = ["--course", str(out.parent / "course"), "show", PERSIAN, "--out", str(out)]
    assert main(arguments) == 0
    assert PERSIAN in capsys.readouterr().out
