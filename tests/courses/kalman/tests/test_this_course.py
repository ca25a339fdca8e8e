"""The course proves itself, and its notebooks are those of the masters."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize("command", [["check"], ["build", "--check"]], ids=" ".join)
def test_the_course_is_sound(command):
    done = subprocess.run(
        [sys.executable, "-m", "autograder", "--course", str(ROOT), *command],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
