"""The site has every page in its lists, every command, and no answer."""

from __future__ import annotations

import importlib.util
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import nbformat
import pytest

from autograder.cli import parser
from autograder.course import load_course
from autograder.kinds.number.answer import NumberAnswer

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"


@pytest.fixture(scope="module")
def pages() -> ModuleType:
    spec = importlib.util.spec_from_file_location("site_pages", DOCS / "pages.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def listed() -> list[str]:
    """What the lists of the first page name."""
    index = (DOCS / "index.md").read_text(encoding="utf-8")
    lists = re.findall(r"(?ms)^```\{toctree\}\n(.*?)^```", index)
    lines = [line for text in lists for line in text.splitlines()]
    return [line.split("<")[-1].rstrip(">") for line in lines if line and line[0] != ":"]


def test_every_page_is_in_a_list_and_every_listed_page_is_there(pages: ModuleType):
    written = {
        path.relative_to(DOCS).with_suffix("").as_posix()
        for path in DOCS.rglob("*.md")
        if path != DOCS / "index.md"
    }
    made = {
        "commands",
        *(f"chapters/{master.stem}" for master in pages.chapters(load_course(ROOT))),
    }
    assert sorted(listed()) == sorted(written | made)


def test_the_page_of_commands_shows_the_help_of_each(pages: ModuleType):
    page = pages.commands_page(parser())
    helped = subprocess.run(
        [sys.executable, "-m", "autograder", "--help"], capture_output=True, text=True, check=True
    ).stdout
    named = re.findall(r"(?m)^    ([a-z]+)(?: |$)", helped)
    assert len(named) > 20
    for name in named:
        assert f"\n## {name}\n" in page
        assert f"usage: autograder {name} " in page


def test_no_answer_stands_in_a_chapter(pages: ModuleType):
    course = load_course(ROOT)
    answers = 0
    for master in pages.chapters(course):
        page = {cell.id: cell.source for cell in pages.unrun(course, master).cells}
        solved = nbformat.read(ROOT / f"solutions/notebooks/{master.stem}.ipynb", as_version=4)
        for cell in solved.cells:
            if cell.id.endswith("-response") and not cell.source.startswith("ask("):
                answers += 1
                assert not any(cell.source in shown for shown in page.values()), cell.id
    assert answers > 20


def test_no_number_of_the_key_stands_on_a_page():
    text = ""
    for path in DOCS.rglob("*.md"):
        page = path.read_text(encoding="utf-8")
        for name, options in re.findall(r"(?ms)^```\{include\} (\S+)\n(.*?)^```", page):
            included = (path.parent / name).read_text(encoding="utf-8")
            begin = re.search(r':start-after: "(.*)"', options)
            end = re.search(r':end-before: "(.*)"', options)
            included = included.partition(begin[1])[2] if begin else included
            text += included.partition(end[1])[0] if end else included
        text += page
    key = load_course(ROOT).key.values()
    right = {
        f"{alternative.value:.10g}"
        for answer in key
        if isinstance(answer, NumberAnswer)
        for alternative in answer.alternatives
        if alternative.credit == 1
    }
    assert len(right) > 3
    assert {
        number for number in right if re.search(rf"(?<![\d.]){re.escape(number)}(?!\d)", text)
    } == set()


@pytest.mark.long
def test_the_site_is_built_without_a_warning(tmp_path: Path):
    """Among others, each formula of the course is one that the site can set."""
    command = "uv run --isolated --group docs sphinx-build -q -W docs"
    done = subprocess.run(
        [*command.split(), str(tmp_path)], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "chapters/2_line_fitting.html").read_text(encoding="utf-8")
    assert re.search(r"<mn>44</mn>\s*<mo>∘</mo>", page)
