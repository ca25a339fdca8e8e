"""Codespaces, Binder and GitHub: what their files name is there."""

from __future__ import annotations

import json
import re
import shlex
import tomllib
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))


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


def test_the_container_installs_an_extra_that_exists():
    container = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text(encoding="utf-8"))
    command = container["onCreateCommand"]
    [extra] = re.findall(r"--extra (\w+)", command)
    assert extra in PROJECT["project"]["optional-dependencies"]
    assert container["image"].partition("python:")[2] >= "3.11"


def test_binder_installs_folders_that_are_distributions():
    lines = (ROOT / ".binder/requirements.txt").read_text(encoding="utf-8").splitlines()
    for line in lines:
        folder = ROOT / line.removeprefix("-e ")
        assert (folder / "pyproject.toml").is_file(), line
    # The engine first: the course requires it, and it is on no index.
    assert lines[0] == "-e ./autograder"


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
