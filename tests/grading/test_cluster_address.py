"""What `--cluster` takes, and what is said where Dask is not installed."""

import subprocess
import sys

import pytest

from autograder.errors import UsageError
from autograder.grading.dask_address import parse_address
from tests.classroom import hand_in, make_course


@pytest.mark.parametrize("text", ["local:1", "local:12"])
def test_local_names_a_number_of_workers(text):
    assert parse_address(text).local == int(text[6:])


@pytest.mark.parametrize(
    "text", ["tcp://lab-1:8786", "tls://lab-1.uni.example:8786", "10.0.0.1:8786", "[::1]:8786"]
)
def test_anything_else_is_a_scheduler(text):
    assert parse_address(text).local == 0


@pytest.mark.parametrize("text", ["", "local", "local:0", "local:-1", "local:x", "lab-1", "tcp://"])
def test_a_wrong_address_is_wrong_usage(text):
    with pytest.raises(UsageError, match="local:"):
        parse_address(text)


def test_without_dask_everything_else_works_and_cluster_says_how_to_get_it(tmp_path):
    make_course(tmp_path / "course")
    hand_in(tmp_path / "work", "ada")
    program = (
        "import sys\n"
        "for name in ('distributed', 'dask'): sys.modules[name] = None\n"
        "from autograder.cli import main\n"
        "sys.exit(main(['--course', 'course', 'grade', 'work', *sys.argv[1:]]))\n"
    )

    def grade(*more: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-c", program, *more]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)

    missing = grade("--cluster", "local:2")
    assert missing.returncode == 2
    assert "pip install 'course-autograder[cluster]'" in missing.stderr
    assert not (tmp_path / "grades").exists()
    without = grade()
    assert without.returncode == 0, without.stderr
    assert (tmp_path / "grades/grades.csv").exists()
