"""What is loaded once, before any notebook runs."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

KALMAN = Path(__file__).parents[1] / "courses" / "kalman"
LOADED = """
import sys
from autograder.sandbox.inside.warm_imports import warm
warm(with_course=True)
print(sorted(name for name in sys.modules if name == "autograder.student.api"))
"""


@pytest.mark.parametrize("built", [True, False], ids=["built from masters", "written by hand"])
def test_what_each_notebook_of_a_built_course_imports_first_is_loaded_once_for_all(built, tmp_path):
    course = tmp_path / "course"
    shutil.copytree(KALMAN, course)
    if not built:
        shutil.rmtree(course / "notebooks" / "source")
    environment = {
        **os.environ,
        "AUTOGRADER_COURSE": str(course),
        "AUTOGRADER_RESPONSES": str(tmp_path),
    }
    done = subprocess.run(
        [sys.executable, "-P", "-c", LOADED],
        env=environment,
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.splitlines()[-1] == str(["autograder.student.api"] if built else [])
