"""Settings of a course: the defaults, and what is said of a wrong one."""

import pytest

from autograder.course import Settings
from tests.toy import refusal


def test_settings_come_from_pyproject_and_the_rest_from_the_defaults(toy):
    settings = toy.set("memory_mb = 300\nnotebook_seconds = 60").load().settings
    assert (settings.memory_mb, settings.notebook_seconds) == (300, 60)
    assert settings.cell_seconds == Settings().cell_seconds


def test_a_course_without_pyproject_has_the_default_limits(toy):
    (toy.root / "pyproject.toml").unlink()
    assert toy.load().settings == Settings()


@pytest.mark.parametrize(
    "line",
    [
        "memory_gb = 1",
        "memory_mb = 0",
        "memory_mb = -3",
        'memory_mb = "much"',
        "memory_mb = true",
        "memory_mb = nan",
        "memory_mb = inf",
        "processes = 1.5",
        "files = 2.0",
        "memory_mb = 10000000",
        "cell_seconds = nan",
        "cell_seconds = inf",
        "cell_seconds = -inf",
        "cell_seconds = true",
        "cell_seconds = 0.0",
        "cell_seconds = 1e30",
        "cell_seconds = [1]",
        "cell_seconds = 2026-01-01",
    ],
)
def test_a_setting_that_is_unknown_or_no_positive_number_is_said(toy, line):
    toy.append("pyproject.toml", line + "\n")
    sentence = refusal(toy)
    assert line.split()[0] in sentence
    assert "pyproject.toml" in sentence
    assert sentence.endswith(".")


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("memory_bm = 300", "perhaps 'memory_mb' is meant"),
        ("memory_mb = 0", "memory_mb is 0; give a number of at least 1"),
        ('variants = "students"', "write 'sheet' or 'student'"),
        ('packages = ["not a name"]', 'such as packages = ["pandas"]'),
        ("kinds = 3", "kinds is 3, and must be a list in [...]"),
    ],
)
def test_a_wrong_setting_is_said_with_its_line_and_what_to_write(toy, line, words):
    toy.append("pyproject.toml", "\n" + line + "\n")
    text = (toy.root / "pyproject.toml").read_text()
    number = text.splitlines().index(line) + 1
    sentence = refusal(toy)
    assert f"pyproject.toml, line {number}: " in sentence or "packages" in line
    assert words in sentence


def test_seconds_may_be_a_fraction(toy):
    toy.append("pyproject.toml", "cell_seconds = 0.5\n")
    assert toy.load().settings.cell_seconds == 0.5


@pytest.mark.parametrize("text", ["tool = 3\n", "[tool]\nautograder = 3\n"])
def test_settings_that_are_no_table_are_refused_or_nobodys(toy, text):
    (toy.root / "pyproject.toml").write_text(text)
    if text.startswith("tool"):
        assert toy.load().settings == Settings()
    else:
        assert "must be a table" in refusal(toy)
