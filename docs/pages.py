"""The pages of the site that are made: the chapters with their pictures, and the commands.

The chapters are run as students get them, with nothing filled in. What is not in a student's
notebook can therefore not be on the page, neither as text nor in a picture.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import subprocess
import tempfile
from functools import partial
from pathlib import Path

import nbformat
from nbclient import NotebookClient

from autograder.authoring.assemble_notebook import START_ID
from autograder.authoring.executed_notebooks import surroundings
from autograder.authoring.master import Master
from autograder.authoring.masters import read_masters
from autograder.cli import parser
from autograder.course import Course, load_course
from autograder.course.folders import NOTEBOOKS

ROOT = Path(__file__).parents[1]
MADE_FROM = "made_from"


def write(folder: Path) -> None:
    """Write ``commands.md`` and ``chapters/*.ipynb`` into a folder."""
    _write(folder / "commands.md", commands_page(parser()))
    course = load_course(ROOT)
    for master in chapters(course):
        _write_chapter(folder / "chapters" / f"{master.stem}.ipynb", course, master)


def chapters(course: Course) -> list[Master]:
    """The masters that become pages: those with questions, in order."""
    return [master for master in read_masters(course) if master.chapter is not None]


def unrun(course: Course, master: Master) -> nbformat.NotebookNode:
    """A chapter before it runs: what students get."""
    return nbformat.read(course.root / NOTEBOOKS / f"{master.stem}.ipynb", as_version=4)


def commands_page(whole: argparse.ArgumentParser) -> str:
    """Markdown that describes every command as its ``--help`` does."""
    (commands,) = (
        action for action in whole._actions if isinstance(action, argparse._SubParsersAction)
    )
    short = {action.dest: action.help for action in commands._choices_actions}
    lines = ["# Commands", "", str(whole.description), "", "| command | does |", "|---|---|"]
    lines += [f"| [`{name}`](#{name}) | {short.get(name, '')} |" for name in commands.choices]
    lines += ["", *_help(whole)]
    for name, command in commands.choices.items():
        lines += ["", f"## {name}", "", *_help(command)]
    return "\n".join(lines) + "\n"


def _help(command: argparse.ArgumentParser) -> list[str]:
    """What ``--help`` prints where 90 characters fit into a line, whatever this terminal is."""
    command.formatter_class = partial(argparse.HelpFormatter, width=90)
    return ["```text", command.format_help().strip(), "```"]


def _write_chapter(path: Path, course: Course, master: Master) -> None:
    """Run a student's notebook into a page, unless it was run and nothing has changed since."""
    notebook = unrun(course, master)
    code = hashlib.sha256(nbformat.writes(notebook).encode())
    made_from = surroundings(course, master.chapter) + code.hexdigest()
    if path.exists():
        before = nbformat.read(path, as_version=4)
        if before.metadata.get(MADE_FROM) == made_from:
            return
    with tempfile.TemporaryDirectory() as responses:
        # Responses of the author's own must not be seen on the page.
        environment = {
            **os.environ,
            "AUTOGRADER_RESPONSES": responses,
            "AUTOGRADER_WIDGETS": "0",
        }
        client = NotebookClient(
            notebook,
            timeout=600,
            kernel_name="python3",
            resources={"metadata": {"path": str(course.root / NOTEBOOKS)}},
        )
        client.execute(env=environment, stderr=subprocess.DEVNULL)
    for cell in notebook.cells:
        if cell.id.endswith("-check") or cell.source.strip() == "progress()":
            cell.outputs = []  # "not attempted", of each question
        if cell.id == START_ID:  # it says how to install the course
            cell.metadata.tags = ["remove-cell"]
    notebook.metadata[MADE_FROM] = made_from
    _write(path, nbformat.writes(notebook) + "\n")


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(exist_ok=True)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8", newline="\n")
