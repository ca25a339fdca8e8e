"""Two distributions from one repository: the engine without a course, a course without modules."""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
import venv
import zipfile
from email.parser import Parser
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def build_wheel(folder: Path, target: Path, **environment: str) -> zipfile.ZipFile:
    """Build the wheel of a folder without looking anything up."""
    return zipfile.ZipFile(build("wheel", folder, target, **environment))


def build(kind: str, folder: Path, target: Path, **environment: str) -> Path:
    clean = {name: value for name, value in os.environ.items() if not name.startswith("PIP_")}
    subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "-t", kind, "-d", str(target)],
        cwd=folder,
        env=clean | environment,
        check=True,
        capture_output=True,
    )
    (built,) = target.iterdir()
    return built


def requirements(wheel: zipfile.ZipFile) -> list[str]:
    (name,) = (name for name in wheel.namelist() if name.endswith("/METADATA"))
    return Parser().parsestr(wheel.read(name).decode()).get_all("Requires-Dist") or []


@pytest.fixture(scope="module")
def engine(tmp_path_factory: pytest.TempPathFactory) -> zipfile.ZipFile:
    return build_wheel(ROOT / "autograder", tmp_path_factory.mktemp("engine"))


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> zipfile.ZipFile:
    return build_wheel(ROOT, tmp_path_factory.mktemp("course"))


def test_the_engine_s_wheel_holds_the_package_and_no_course(engine: zipfile.ZipFile):
    """Its rooms are named one by one: a new one must not be forgotten."""
    tops = {name.partition("/")[0] for name in engine.namelist()}
    assert {top for top in tops if not top.startswith("course_autograder-")} == {"autograder"}
    modules = {name for name in engine.namelist() if name.endswith(".py")}
    assert modules == {
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "autograder").rglob("*.py")
        if "__pycache__" not in path.parts and path.name != "hatch_build.py"
    }
    assert not any(name.endswith(".toml") for name in engine.namelist())
    # JupyterLab finds its settings where the environment keeps them.
    assert any(name.endswith("overrides.d/autograder.json") for name in engine.namelist())


def test_the_course_s_wheel_holds_no_module_no_data_and_no_key(course: zipfile.ZipFile):
    assert all(".dist-info/" in name for name in course.namelist()), course.namelist()


def test_the_course_needs_the_engine_by_its_name_alone(course: zipfile.ZipFile):
    (needed,) = (entry for entry in requirements(course) if entry.startswith("course-autograder<"))
    assert "@" not in needed


def test_pip_is_told_that_the_engine_lies_beside(tmp_path: Path):
    wheel = build_wheel(ROOT, tmp_path, PIP_BUILD_TRACKER="on")
    assert f"course-autograder @ {(ROOT / 'autograder').as_uri()}" in requirements(wheel)


def test_a_lab_is_an_extra_of_both(engine: zipfile.ZipFile, course: zipfile.ZipFile):
    for wheel in (engine, course):
        base = [entry for entry in requirements(wheel) if "extra ==" not in entry]
        assert not any(entry.startswith(("jupyterlab", "ipykernel", "nbval")) for entry in base)
    assert any(
        entry.startswith("jupyterlab") and "extra == 'lab'" in entry
        for entry in requirements(engine)
    )


def test_the_engine_runs_from_its_wheel_without_a_checkout(engine: zipfile.ZipFile, tmp_path: Path):
    """In an environment that borrows the libraries of this one, but not the checkout."""
    venv.create(tmp_path / "env", with_pip=False)
    (site,) = (tmp_path / "env").glob("lib/python*/site-packages")
    engine.extractall(site)
    (ours,) = {Path(entry) for entry in sys.path if entry.endswith("site-packages")}
    python = tmp_path / "env/bin/python"
    environment = {**os.environ, "PYTHONPATH": str(ours), "PYTHONSAFEPATH": "1"}
    code = (
        "import autograder, importlib.util as u;"
        "print(autograder.__file__, u.find_spec('data'), u.find_spec('solutions'))"
    )
    done = subprocess.run(
        [python, "-c", code], env=environment, cwd=tmp_path, capture_output=True, text=True
    )
    assert done.stdout.split() == [str(site / "autograder/__init__.py"), "None", "None"]
    done = subprocess.run(
        [python, "-m", "autograder", "--version"],
        env=environment,
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.stdout.startswith("autograder 0."), done.stderr


def test_the_engine_s_source_distribution_gives_the_same_wheel(
    engine: zipfile.ZipFile, tmp_path: Path
):
    source = build("sdist", ROOT / "autograder", tmp_path / "source")
    with tarfile.open(source) as archive:
        archive.extractall(tmp_path, filter="data")
    again = build_wheel(tmp_path / source.name.removesuffix(".tar.gz"), tmp_path / "wheel")
    assert {i.filename: i.CRC for i in again.infolist()} == {
        i.filename: i.CRC for i in engine.infolist()
    }


def test_the_engine_brings_the_setting_that_keeps_widgets(engine: zipfile.ZipFile):
    """Where JupyterLab looks for it, below the environment's folder."""
    end = ".data/data/share/jupyter/lab/settings/overrides.d/autograder.json"
    assert [name for name in engine.namelist() if name.endswith(end)]
