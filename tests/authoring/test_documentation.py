"""What CONTRIBUTING and docs/authoring.md print works as it is printed."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import msgspec
import pytest

from autograder.course import Settings
from autograder.questions.answer import Alternative, Answer
from autograder.questions.question import PointedQuestion
from autograder.questions.registry import kind_named, kind_names

ROOT = Path(__file__).parents[2]
AUTHORING = (ROOT / "docs/authoring.md").read_text(encoding="utf-8")
ENGINE = (ROOT / "docs/engine.md").read_text(encoding="utf-8")


def blocks(text: str, kind: str) -> list[str]:
    """The code blocks of one kind, without the indentation of a list."""
    found = re.findall(rf"(?ms)^( *)```{kind}\n(.*?)^ *```", text)
    return [re.sub(rf"(?m)^{indent}", "", block) for indent, block in found]


def check(course: Path) -> str:
    clean = {name: value for name, value in os.environ.items() if not name.startswith("AUTOGRADER")}
    done = subprocess.run(
        [sys.executable, "-m", "autograder", "--course", str(course), "check"],
        env=clean,
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout + done.stderr


def write(root: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def test_the_question_of_contributing_passes_as_printed(tmp_path: Path):
    """In a chapter of its own, among all that stands beside this course's notebooks."""
    section = (ROOT / "CONTRIBUTING.md").read_text().partition("## Add a question")[2]
    question, answer = blocks(section, "toml")[:2]
    (place,) = (block for block in blocks(section, "python") if "exercise=" in block)
    write(
        tmp_path,
        {
            "notebooks/questions/ransac.toml": 'title = "RANSAC"\n' + question,
            "solutions/answers/ransac.toml": answer,
            "notebooks/source/3_ransac.py": f"# %%\nimport math\n\n{place}",
        },
    )
    for folder in ("explorers", "figures"):
        shutil.copytree(ROOT / "notebooks" / folder, tmp_path / "notebooks" / folder)
    assert check(tmp_path).endswith("The course is sound: 1 questions prove themselves.\n")


def examples() -> dict[str, str]:
    return {
        "notebooks/source/1_kitchen.py": "\n".join(blocks(AUTHORING, "python master")),
        "notebooks/questions/kitchen.toml": "\n".join(blocks(AUTHORING, "toml questions")),
        "solutions/answers/kitchen.toml": "\n".join(blocks(AUTHORING, "toml answers")),
        "solutions/__init__.py": "",
        "solutions/kitchen.py": "\n".join(blocks(AUTHORING, "python solutions")),
    }


def test_the_examples_of_the_page_for_authors_are_a_course_that_is_sound(tmp_path: Path):
    write(tmp_path, examples())
    assert check(tmp_path).endswith("The course is sound: 6 questions prove themselves.\n")


def keys_of_kinds() -> Iterator[tuple[str, str]]:
    """Every key that an author may write for a kind alone, by the kind's name."""
    for name in kind_names():
        kind = kind_named(name)
        common = {
            field.encode_name
            for base in (PointedQuestion, Answer, Alternative)
            for field in of(base)
        }
        tables = [kind.question_type, kind.answer_type]
        while tables:
            table = tables.pop()
            for field in of(table):
                if field.encode_name not in common:
                    yield name, field.encode_name
                tables += inner_tables(field.type)


def of(table: type) -> tuple[msgspec.structs.FieldInfo, ...]:
    return msgspec.structs.fields(table)


def inner_tables(annotation: object) -> list[type]:
    """The structs of the kinds' own in a type such as ``tuple[Statement, ...]``."""
    if isinstance(annotation, type) and issubclass(annotation, msgspec.Struct):
        return [annotation] if annotation.__module__.count(".") > 2 else []
    return [found for part in get_args(annotation) for found in inner_tables(part)]


@pytest.mark.parametrize(("kind", "key"), sorted(set(keys_of_kinds())))
def test_every_key_of_every_kind_is_explained(kind: str, key: str):
    section = AUTHORING.partition(f"\n## {kind}\n")[2].partition("\n## ")[0]
    assert (
        f"`{key}`" in section
        or f'."{key}"]]`' in section
        or f".{key}]]`" in section
        or (f"`{key} = " in section)
    ), f"say under `## {kind}` what {key} means"


@pytest.mark.parametrize(
    "key", ["id", "kind", "title", "prompt", "points", "hints", "explanation", "code"]
)
def test_every_common_key_is_explained(key: str):
    section = AUTHORING.partition("## What every question has")[2].partition("\n## ")[0]
    assert f"`{key}`" in section


LIMITS = {field.name: field.default for field in msgspec.structs.fields(Settings)}


@pytest.mark.parametrize("name", LIMITS)
def test_every_limit_is_listed(name: str):
    default = LIMITS[name]
    if isinstance(default, int | float):
        row = re.search(rf"(?m)^\| `{name}` \| (\S+)", AUTHORING)
        assert row
        assert float(row[1].replace("_", "")) == default


def test_every_environment_variable_is_described():
    read = set()
    for path in [*(ROOT / "autograder").rglob("*.py"), *(ROOT / "tests").glob("*.py")]:
        read |= set(re.findall(r"[\"']?(AUTOGRADER_[A-Z]+)[\"']", path.read_text()))
    assert read
    assert {name for name in read if f"`{name}`" not in ENGINE} == set()
