"""The cell for Colab in a bundle's README does what it says, as far as one sees without it."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from autograder.course import load_course
from autograder.release.bundle import release
from tests.classroom import make_course

# Stands in for Colab: its package, which only mounts, and a kernel that has run for a while.
HOSTED = """
import sys, types
colab = types.ModuleType("google.colab")
colab.drive = types.SimpleNamespace(mount=lambda folder: print("mounted", folder))
sys.modules["google"], sys.modules["google.colab"] = types.ModuleType("google"), colab
from IPython.core.interactiveshell import InteractiveShell
shell = InteractiveShell.instance()
cell = open(sys.argv[1], encoding="utf-8").read()
if sys.argv[2] == "without pip":
    shell.register_magic_function(lambda line: print("pip", line), "line", "pip")
assert shell.run_cell(cell).success
assert shell.run_cell("import os, autograder; from autograder import ask, submit").success
assert shell.run_cell("print('engine', autograder.__file__); print('in', os.getcwd())").success
"""


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small course, handed out."""
    folder = tmp_path_factory.mktemp("drive")
    release(make_course(folder / "orchard"), folder / "course")
    return folder / "course"


def run_cell(python: str | Path, bundle: Path, pip: str, folder: Path) -> str:
    """What the README's cell prints, with the bundle in the place of the Drive."""
    readme = (bundle / "README.md").read_text(encoding="utf-8")
    (cell,) = re.findall(r"(?ms)^```python\n(from google.colab.*?)^```", readme)
    assert "/content/drive/MyDrive/course" in cell
    path = folder / "cell.py"
    path.write_text(cell.replace("/content/drive/MyDrive/course", bundle.as_posix()), "utf-8")
    done = subprocess.run(
        [str(python), "-c", HOSTED, str(path), pip],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_after_the_cell_a_running_kernel_has_the_bundle(bundle: Path, tmp_path: Path):
    printed = run_cell(sys.executable, bundle, "without pip", tmp_path)
    assert "mounted /content/drive" in printed
    assert f"pip install -q -e {bundle}" in printed
    assert f"engine {bundle / 'autograder'}" in printed
    assert f"in {bundle / 'notebooks'}" in printed


@pytest.mark.long
def test_the_cell_replaces_nothing_of_colab_s_kernel(tmp_path: Path):
    """With the versions that Colab brings, and pip as it is."""
    theirs = {
        "ipykernel": "6.17.1",
        "ipython": "7.34.0",
        "ipywidgets": "7.7.1",
        "numpy": "2.0.2",
        "traitlets": "5.7.1",
    }
    release(load_course(Path(__file__).parents[2]), tmp_path / "course")
    subprocess.run([sys.executable, "-m", "venv", str(tmp_path / "colab")], check=True)
    python = tmp_path / "colab/bin/python"
    pip = [str(python), "-m", "pip"]
    wanted = [f"{name}=={version}" for name, version in theirs.items()]
    subprocess.run([*pip, "install", "-q", "setuptools<81", *wanted], check=True)
    assert f"engine {tmp_path / 'course'}" in run_cell(python, tmp_path / "course", "pip", tmp_path)
    frozen = subprocess.run([*pip, "freeze"], capture_output=True, text=True, check=True).stdout
    assert set(wanted) <= set(frozen.splitlines())
