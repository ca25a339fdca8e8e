"""The workflow that grades a student's repository on push, run without GitHub."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import yaml

from autograder.course import load_course
from autograder.release.bundle import release
from tests.classroom import hand_in, make_course


def test_the_workflow_grades_a_push_by_the_key_for_practice(tmp_path: Path):
    course = load_course(make_course(tmp_path / "course").root)
    bundle = tmp_path / "bundle"
    release(course, bundle, [chapter.name for chapter in course.chapters])
    hand_in(tmp_path / "work", "ada", Q2="trees = 7")
    for notebook in (tmp_path / "work/ada").rglob("*.ipynb"):
        shutil.copy(notebook, bundle / "notebooks")
    assert "responses/\n" not in (bundle / ".gitignore").read_text(encoding="utf-8")

    workflow = yaml.safe_load(
        (bundle / ".github/workflows/practice.yml").read_text(encoding="utf-8")
    )
    [script] = [
        step["run"] for step in workflow["jobs"]["practice"]["steps"] if step.get("name") == "grade"
    ]
    tools = tmp_path / "tools"
    tools.mkdir()
    (tmp_path / "runner").mkdir()
    # `uv run python` here is the Python of the tests, which has all that is needed.
    (tools / "uv").write_text(f'#!/bin/sh\nshift 2\nexec "{sys.executable}" "$@"\n', "utf-8")
    (tools / "uv").chmod(0o755)
    clean = {name: value for name, value in os.environ.items() if not name.startswith("AUTOGRADER")}
    done = subprocess.run(
        ["bash", "-e", "-c", script],
        cwd=bundle,
        env=clean
        | {
            "PATH": f"{tools}{os.pathsep}{os.environ['PATH']}",
            "RUNNER_TEMP": str(tmp_path / "runner"),
            "GITHUB_STEP_SUMMARY": str(tmp_path / "page.md"),
            "PYTHONPATH": str(bundle),
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    [remark] = [line for line in done.stdout.splitlines() if "title=Q2 " in line]
    assert remark.startswith("::warning file=notebooks/3_orchard.ipynb,")
    assert "| Q2 ·" in (tmp_path / "page.md").read_text(encoding="utf-8")
