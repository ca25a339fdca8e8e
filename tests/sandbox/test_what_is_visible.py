"""Which folders of this machine a sandbox is given."""

import sys
from pathlib import Path

from autograder.sandbox import bubblewrap


def test_a_folder_is_given_in_pieces_if_something_in_it_is_to_be_hidden(tmp_path):
    for name in ("lib/site/numpy", "lib/site/solutions/answers", "lib/site/data", "bin"):
        (tmp_path / name).mkdir(parents=True)
    hidden = [tmp_path / "lib/site/solutions"]
    pieces = bubblewrap.leave_out([tmp_path], hidden)
    assert pieces == [tmp_path / "bin", tmp_path / "lib/site/data", tmp_path / "lib/site/numpy"]
    assert bubblewrap.leave_out([tmp_path / "bin"], hidden) == [tmp_path / "bin"]


def test_solutions_that_were_installed_with_the_course_are_covered(tmp_path, monkeypatch):
    (tmp_path / "site/solutions").mkdir(parents=True)
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    monkeypatch.setattr(bubblewrap, "interpreter_folders", lambda: [tmp_path / "site"])
    assert tmp_path / "site/solutions" in bubblewrap.installed_solutions()
    line = bubblewrap.command(
        "bwrap",
        root=tmp_path / "course",
        package=tmp_path / "autograder",
        notebooks=tmp_path / "notebooks",
        fonts=None,
        size_mb=1,
        as_root=False,
    )
    cover = line.index(str(tmp_path / "site/solutions"))
    assert line[cover - 1] == "--tmpfs"
    assert cover > line.index(str(tmp_path / "site"))


def test_a_course_among_the_libraries_is_covered_but_its_own_environment_is_not(tmp_path):
    root = tmp_path / "course"
    environment = root / ".venv"
    environment.mkdir(parents=True)
    line = bubblewrap._hidden(root, [tmp_path, environment])
    assert line[:2] == ["--tmpfs", str(root)]
    assert line[2:5] == ["--ro-bind", str(environment), str(environment)]


def test_the_interpreter_is_visible():
    folders = bubblewrap.interpreter_folders()
    home = Path(sys.base_prefix).resolve()
    assert any(home == folder or folder in home.parents for folder in folders) or str(
        home
    ).startswith("/usr")
