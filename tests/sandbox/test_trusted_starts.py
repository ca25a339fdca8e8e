"""What is started on the trusted side imports nothing from the folder it is started in."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from autograder.sandbox import compiled_libraries, host, zygote_start

MARK = "from pathlib import Path\nPath({!r}).touch()\n"


@pytest.fixture
def trapped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A current folder whose modules leave a mark where they are imported; the mark's path."""
    mark = tmp_path / "imported"
    folder = tmp_path / "handed-in"
    for name in ("autograder", "data", "notebooks", "numpy", "sympy"):
        (folder / name).mkdir(parents=True)
        (folder / name / "__init__.py").write_text(MARK.format(str(mark)))
    for name in ("cv2.py", "json.py", "sitecustomize.py", "socket.py"):
        (folder / name).write_text(MARK.format(str(mark)))
    monkeypatch.chdir(folder)
    return mark


def test_compiling_the_libraries_imports_nothing_from_the_current_folder(
    trapped, tmp_path, monkeypatch
):
    fonts = tmp_path / "fonts"
    monkeypatch.setenv("MPLCONFIGDIR", str(fonts))  # no fonts yet, so that it has work to do
    monkeypatch.setenv("PYTHONPATH", "")
    compiled_libraries.compile_libraries()
    assert list(fonts.glob("fontlist-*.json"))  # it did run
    assert not trapped.exists()


def test_outside_of_the_sandbox_no_module_of_the_course_is_imported(tmp_path):
    mark = tmp_path / "imported"
    for name in ("data", "notebooks"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text(MARK.format(str(mark)))
    package = str(zygote_start._PACKAGE.parent)
    environment = {**os.environ, "PYTHONPATH": f"{tmp_path}{os.pathsep}{package}"}
    subprocess.run(
        [
            *(sys.executable, "-P", "-m", "autograder.sandbox.inside.warm_imports"),
            str(tmp_path / "modules.txt"),
        ],
        env=environment,
        check=True,
    )
    assert not mark.exists()


def test_starting_a_sandbox_imports_nothing_from_the_current_folder(trapped, course, monkeypatch):
    monkeypatch.setattr(host, "compile_libraries_once", lambda: None)
    started = host.Host(course.root, course.settings, with_namespaces=False)
    try:
        started.wait_until_ready()
    finally:
        started.stop()
    assert not trapped.exists()


def test_the_command_imports_nothing_from_the_folder_in_which_it_is_started(tmp_path):
    mark = tmp_path / "imported"
    (tmp_path / "numpy.py").write_text(MARK.format(str(mark)))
    done = subprocess.run(
        [sys.executable, "-m", "autograder", "--help"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "grade" in done.stdout
    assert not mark.exists()
