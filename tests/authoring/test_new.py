"""`autograder new` writes a course that works at once, and a second course came of it."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from autograder.authoring import new_course
from autograder.authoring.new_course import Source
from autograder.cli import main
from autograder.cli.missing_extras import missing_extra
from autograder.course import load_course
from autograder.errors import UsageError
from autograder.questions.registry import kind_names

ROOT = Path(__file__).parents[2]
KALMAN = ROOT / "tests/courses/kalman"


def run(*arguments: str | Path, folder: Path = ROOT) -> subprocess.CompletedProcess[str]:
    """The command in a process of its own: each course has a package `solutions`."""
    clean = {name: value for name, value in os.environ.items() if not name.startswith("AUTOGRADER")}
    return subprocess.run(
        [sys.executable, "-m", "autograder", *map(str, arguments)],
        cwd=folder,
        env=clean,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("new") / "my course"
    done = run("new", folder, "--title", 'The "simple" pendulum')
    assert done.returncode == 0, done.stderr
    return folder


def test_a_new_course_asks_a_question_of_each_kind_with_two_mistakes(made: Path):
    course = load_course(made)
    kinds = [question.kind for question in course.questions.values()]
    assert sorted(kinds) == sorted(kind_names())
    for id, answer in course.key.items():
        mistakes = [entry for entry in answer.alternatives if entry.is_mistake]
        told = getattr(answer, "statements", mistakes)
        assert len(told) == 2 or course.question(id).kind == "text", id


def test_a_new_course_proves_itself_and_is_built(made: Path):
    done = run("check", folder=made)
    assert (done.returncode, done.stdout.splitlines(keepends=True)[-1]) == (
        0,
        "The course is sound: 6 questions prove themselves.\n",
    ), done.stdout + done.stderr
    assert run("build", "--check", folder=made).returncode == 0


def test_a_new_course_passes_its_own_tests_with_nbval(made: Path):
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "notebooks", "solutions"],
        cwd=made,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout
    assert "passed" in done.stdout


def test_where_matplotlib_is_not_installed_the_course_is_there_and_the_next_step_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """As in an environment with nothing but the engine."""
    (tmp_path / "poor").mkdir()
    (tmp_path / "poor/matplotlib.py").write_text(
        "raise ModuleNotFoundError(\"No module named 'matplotlib'\", name='matplotlib')\n"
    )
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "poor"))
    done = run("new", "my course", folder=tmp_path)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    assert "1_pendulum.py, line 9 raises ModuleNotFoundError: No module named" in done.stdout
    assert "the course needs it" in done.stdout
    assert "cd 'my course' && pip install -e \".[author,lab]\" && autograder build" in done.stdout
    assert (tmp_path / "my course/notebooks/1_pendulum.ipynb").is_file()


def test_a_module_of_an_extra_is_told_in_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
):
    monkeypatch.setitem(sys.modules, "nbformat", None)
    monkeypatch.delitem(sys.modules, "autograder.authoring.build", raising=False)
    assert main(["new", str(tmp_path / "mine")]) == 1
    said = capsys.readouterr().err
    assert said.startswith("autograder: nbformat is not installed, which writing a course needs")
    assert not (tmp_path / "mine").exists()


def test_a_new_course_is_complete(made: Path):
    for name in (
        *("pyproject.toml", "README.md", ".gitignore", ".github/workflows/tests.yml"),
        *("data/swings.csv", "conftest.py", "solutions/pendulum.py", "tests/test_this_course.py"),
        *("notebooks/1_pendulum.ipynb", "solutions/notebooks/1_pendulum.ipynb"),
    ):
        assert (made / name).is_file(), name
    project = tomllib.loads((made / "pyproject.toml").read_text())["project"]
    assert project["name"] == "my-course"
    assert project["description"] == 'The "simple" pendulum'
    assert any(entry.startswith("course-autograder>=") for entry in project["dependencies"])
    assert "--nbval" in (made / "pyproject.toml").read_text()
    assert "$" not in (made / "README.md").read_text()


def test_only_the_layout_of_another_course_is_taken_over(tmp_path: Path):
    done = run("new", tmp_path / "mine", "--from", KALMAN)
    assert done.returncode == 0, done.stderr
    course = load_course(tmp_path / "mine")
    assert [(chapter.name, chapter.title) for chapter in course.chapters] == [
        ("kalman", "The Kalman filter")
    ]
    assert course.questions == {}
    theirs = tomllib.loads((KALMAN / "pyproject.toml").read_text())
    mine = tomllib.loads((tmp_path / "mine/pyproject.toml").read_text())
    assert mine["project"]["dependencies"] == theirs["project"]["dependencies"]
    assert mine["tool"]["autograder"] == theirs["tool"]["autograder"]
    for path in (tmp_path / "mine").rglob("*"):
        if path.is_file():
            assert "innovation" not in path.read_text().casefold(), path
    assert run("check", folder=tmp_path / "mine").returncode == 0


def test_nothing_is_written_over(tmp_path: Path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine/notes").write_text("mine")
    with pytest.raises(UsageError, match="is not empty"):
        new_course.new_course(tmp_path / "mine", "X")
    assert [path.name for path in tmp_path.rglob("*")] == ["mine", "notes"]


SOURCES = {
    "an index": (Source(), None),
    "a folder": (Source(Path("/opt/it/engine")), {"path": "/opt/it/engine", "editable": True}),
    "git": (
        Source(None, "https://example.org/x.git", "abc", "autograder"),
        {"git": "https://example.org/x.git", "rev": "abc", "subdirectory": "autograder"},
    ),
}


WANTED = {
    "an index": 'pip install "course-autograder[author,lab]"',
    "a folder": 'pip install "/opt/it/engine[author,lab]"',
    "git": '"course-autograder[author,lab] @ git+https://example.org/x.git@abc#subdirectory=aut',
}


@pytest.mark.parametrize("name", SOURCES)
def test_the_engine_is_taken_from_where_it_came(name: str, tmp_path: Path, monkeypatch):
    source, expected = SOURCES[name]
    monkeypatch.setattr(new_course, "engine_source", lambda: source)
    new_course.new_course(tmp_path / "mine", "X")
    table = tomllib.loads((tmp_path / "mine/pyproject.toml").read_text())
    assert table["tool"].get("uv", {}).get("sources", {}).get("course-autograder") == expected


@pytest.mark.parametrize("name", SOURCES)
def test_an_extra_is_taken_from_where_the_engine_came(name: str, monkeypatch):
    monkeypatch.setattr(new_course, "engine_source", lambda: SOURCES[name][0])
    assert WANTED[name] in str(missing_extra(ModuleNotFoundError(name="jupytext")))
    assert missing_extra(ModuleNotFoundError(name="cheese")) is None


# The second course


def test_the_second_course_is_sound_and_its_notebooks_are_those_of_its_masters():
    for command in (["check"], ["build", "--check"]):
        done = run("--course", KALMAN, *command)
        assert done.returncode == 0, done.stdout + done.stderr


def test_the_second_course_s_solved_notebooks_earn_everything(tmp_path: Path):
    solved = KALMAN / "solutions/notebooks/1_kalman.ipynb"
    untouched = KALMAN / "notebooks/1_kalman.ipynb"
    for name, path in (("ada", solved), ("untouched", untouched)):
        (tmp_path / "class" / name).mkdir(parents=True)
        (tmp_path / "class" / name / path.name).write_bytes(path.read_bytes())
    done = run("--course", KALMAN, "grade", tmp_path / "class", "--out", tmp_path / "grades")
    assert done.returncode == 0, done.stderr
    with (tmp_path / "grades/grades.csv").open(encoding="utf-8-sig") as file:
        totals = {row["student"]: float(row["total"]) for row in csv.DictReader(file)}
    assert totals == {"ada": 13, "untouched": 0}


def test_the_second_course_s_bundle_holds_no_word_of_this_one(tmp_path: Path):
    assert run("--course", KALMAN, "release", tmp_path / "bundle").returncode == 0
    readme = (tmp_path / "bundle/README.md").read_text()
    assert 'check("Q1.5", correct)' in readme
    assert "fit_line" not in readme
    assert (tmp_path / "bundle/data/weighings.csv").is_file()
    for folder in ("data", "notebooks"):
        for path in (tmp_path / "bundle" / folder).rglob("*"):
            if path.is_file():
                assert "ransac" not in path.read_text().casefold(), path


def test_a_watch_builds_and_checks_what_was_saved(tmp_path: Path):
    done = run("new", tmp_path / "mine")
    assert done.returncode == 0, done.stderr
    master = tmp_path / "mine/notebooks/source/1_pendulum.py"
    master.write_text(master.read_text().replace("How long does", "For how long does"))
    done = run("watch", "--once", folder=tmp_path / "mine")
    assert "wrote notebooks/1_pendulum.ipynb" in done.stdout
    assert "The course is sound" in done.stdout
    answers = tmp_path / "mine/solutions/answers/pendulum.toml"
    answers.write_text(answers.read_text().replace("value = 1.0030333404", "value = 2.0060666807"))
    done = run("watch", "--once", folder=tmp_path / "mine")
    assert "Q1.3: the alternative 'half a period' is taken for 'right'" in done.stdout
