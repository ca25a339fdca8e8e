"""Codespaces, Binder and GitHub: what their files name is there."""

from __future__ import annotations

import importlib.util
import json
import os
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.version import Version

ROOT = Path(__file__).parents[1]
# What this test run has set, and a user has not.
OURS = {"VIRTUAL_ENV", "AUTOGRADER_LONG", "AUTOGRADER_RESPONSES", "AUTOGRADER_WIDGETS"}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))

specification = importlib.util.spec_from_file_location("as_a_user", ROOT / ".ci/as_a_user.py")
assert specification is not None
assert specification.loader is not None
as_a_user = importlib.util.module_from_spec(specification)
specification.loader.exec_module(as_a_user)


def paths_in(command: str) -> list[str]:
    """The paths of this repository that a command names."""
    words = shlex.split(command.replace("${{", "").replace("}}", ""))
    return [word for word in words if re.match(r"(\.ci|tests|solutions|notebooks)/", word)]


@pytest.mark.parametrize("workflow", WORKFLOWS, ids=lambda path: path.name)
def test_a_workflow_runs_what_is_there(workflow: Path):
    jobs = yaml.safe_load(workflow.read_text(encoding="utf-8"))["jobs"]
    commands = [step["run"] for job in jobs.values() for step in job["steps"] if "run" in step]
    named = [path for command in commands for path in paths_in(command)]
    assert named
    assert [path for path in named if not (ROOT / path).exists()] == []


def test_the_matrix_has_every_python_from_the_oldest_that_is_allowed():
    jobs = yaml.safe_load(WORKFLOWS[-1].read_text(encoding="utf-8"))["jobs"]
    oldest = PROJECT["project"]["requires-python"].removeprefix(">=")
    assert jobs["versions"]["strategy"]["matrix"]["python"] == ["3.11", "3.12", "3.13", "3.14"]
    assert jobs["versions"]["strategy"]["matrix"]["python"][0] == oldest
    assert {"macos-latest", "windows-latest"} == set(
        jobs["systems"]["strategy"]["matrix"]["system"]
    )


# The first version of each library that came with wheels for a newer Python, on Linux, at PyPI.
FIRST_WHEELS = {
    "3.13": {"numpy": "2.1.0"},
    "3.14": {"numpy": "2.3.2", "matplotlib": "3.10.5", "pyyaml": "6.0.3"},
}


@pytest.mark.parametrize("python", FIRST_WHEELS)
def test_the_lowest_allowed_versions_can_be_installed_without_a_compiler(python: str):
    engine = tomllib.loads((ROOT / "autograder/pyproject.toml").read_text(encoding="utf-8"))
    entries = [*PROJECT["project"]["dependencies"], *engine["project"]["dependencies"]]
    lowest: dict[str, Version] = {}
    for requirement in map(Requirement, entries):
        if requirement.marker is None or requirement.marker.evaluate({"python_version": python}):
            for bound in (one for one in requirement.specifier if one.operator == ">="):
                least = lowest.get(requirement.name, Version("0"))
                lowest[requirement.name] = max(least, Version(bound.version))
    for name, first in FIRST_WHEELS[python].items():
        assert lowest[name] >= Version(first), name


def test_the_lowest_versions_are_tried_with_the_oldest_and_the_newest_python():
    matrix = yaml.safe_load(WORKFLOWS[-1].read_text(encoding="utf-8"))["jobs"]["versions"]
    lowest = [
        entry["python"]
        for entry in matrix["strategy"]["matrix"]["include"]
        if entry["resolution"] == "lowest-direct"
    ]
    assert lowest == ["3.11", "3.14"]


def test_the_container_installs_an_extra_that_exists():
    container = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text(encoding="utf-8"))
    command = container["onCreateCommand"]
    [extra] = re.findall(r"--extra (\w+)", command)
    assert extra in PROJECT["project"]["optional-dependencies"]
    assert container["image"].partition("python:")[2] >= "3.11"


def test_binder_installs_the_folder_and_nothing_twice():
    # pip refuses a folder that is asked for twice, once to be edited and once not: the course asks
    # for the engine beside it by itself.
    lines = (ROOT / ".binder/requirements.txt").read_text(encoding="utf-8").splitlines()
    assert lines == ["-e ."]


def test_what_the_readme_installs_asks_for_no_folder_twice():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    commands = [line for line in text.splitlines() if re.search(r'pip install .*-e "?\.', line)]
    assert len(commands) == 3
    assert [line for line in commands if "-e autograder" in line] == []


@pytest.mark.parametrize("after", ["## Try it", "and for students:", "**Plain pip**"])
def test_what_is_tried_in_a_clean_system_is_what_the_readme_says(after: str):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    commands = as_a_user.readme_block(after)
    assert commands
    for command in commands:
        assert command in text
        assert "#" not in command


def test_every_way_that_the_workflow_tries_is_one_of_the_script_s():
    script = (ROOT / ".ci/clean").read_text(encoding="utf-8")
    (known,) = re.findall(r"(?m)^.* checks=\((.*)\)$", script)
    jobs = yaml.safe_load(WORKFLOWS[-1].read_text(encoding="utf-8"))["jobs"]
    assert jobs["clean"]["strategy"]["matrix"]["check"] == known.split()


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """What a user has before the first command: this repository's last commit."""
    folder = tmp_path / "a clone"
    subprocess.run(["git", "clone", "-q", "--no-local", str(ROOT), str(folder)], check=True)
    return folder


@pytest.mark.long
def test_the_newest_pip_finds_what_binder_and_the_readme_ask_for(clone: Path, tmp_path: Path):
    subprocess.run([sys.executable, "-m", "venv", str(tmp_path / "env")], check=True)
    pip = [str(tmp_path / "env/bin/python"), "-m", "pip", "install", "-q"]
    subprocess.run([*pip, "--upgrade", "pip"], check=True)
    for asked in (["-r", ".binder/requirements.txt"], ["--group", "dev", "-e", "."]):
        subprocess.run([*pip, "--dry-run", *asked], cwd=clone, check=True)


@pytest.mark.long
def test_the_readme_s_first_commands_work_in_a_fresh_clone(clone: Path):
    command = [sys.executable, ".ci/as_a_user.py", "readme"]
    told = {
        name: value
        for name, value in os.environ.items()
        if name not in OURS and not name.startswith("PYTEST_")
    }
    done = subprocess.run(command, cwd=clone, env=told, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert len(done.stdout.splitlines()) == 3


def test_the_citation_names_this_version_and_licence():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation["version"] == PROJECT["project"]["version"]
    assert citation["license"] == PROJECT["project"]["license"]


def test_issue_forms_have_fields_with_names():
    for path in (ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml"):
        form = yaml.safe_load(path.read_text(encoding="utf-8"))
        if path.name != "config.yml":
            assert all(
                field["attributes"].get("label") or field["type"] == "markdown"
                for field in form["body"]
            )
            assert form["name"]
            assert form["description"]
