"""``autograder new``: a complete course that works at once, to be turned into another one."""

from __future__ import annotations

import json
import os
import re
import shutil
import tempfile
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from string import Template
from urllib.parse import unquote, urlparse

from autograder import __version__
from autograder.authoring.bundle_pyproject import ENGINE
from autograder.authoring.schema import schema_files
from autograder.course import Course
from autograder.course.folders import ANSWERS, MASTERS, QUESTIONS
from autograder.course.settings import changed_limits
from autograder.errors import UsageError
from autograder.exchange.messages import Message

TEMPLATE = Path(__file__).parent / "template"
# Of the template, what belongs to the example chapter and is left out by `--from`.
_EXAMPLE = ("data/swings.csv", "data/__init__.py", "pendulum")


@dataclass(frozen=True)
class Source:
    """Where the engine that runs came from: a folder, a git address, or an index (neither)."""

    folder: Path | None = None
    git: str = ""
    commit: str = ""
    subdirectory: str = ""


def new_course(target: Path, title: str, layout: Course | None = None) -> list[Path]:
    """Write a course to ``target``, whole or not at all; returns its files.

    With ``layout`` it has the chapters, requirements and limits of that course, and no questions.

    Raises:
        UsageError: if the folder holds something.
    """
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise UsageError(f"{target} is not empty; name a new folder.")
    target.parent.mkdir(parents=True, exist_ok=True)
    words = _words(target.resolve(), title)
    with tempfile.TemporaryDirectory(dir=target.parent, prefix=".new-") as temporary:
        folder = Path(temporary) / "course"
        for name, text in _files(words, layout):
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8", newline="\n")
        folder.chmod(0o755)
        if target.exists():
            target.rmdir()
        shutil.move(folder, target)
    return sorted(path.relative_to(target) for path in target.rglob("*") if path.is_file())


def _files(words: dict[str, str], layout: Course | None) -> Iterator[tuple[str, str]]:
    for path in sorted(TEMPLATE.rglob("*.txt")):
        name = path.relative_to(TEMPLATE).as_posix().removesuffix(".txt").replace("dot_", ".")
        if layout is not None and any(part in name for part in _EXAMPLE):
            continue
        text = Template(path.read_text(encoding="utf-8")).substitute(words)
        if layout is not None and name == "pyproject.toml":
            text = _like(layout, text)
        yield name, text
    if layout is not None:
        yield from _empty_chapters(layout)
    yield from schema_files()


def _empty_chapters(layout: Course) -> Iterator[tuple[str, str]]:
    """The chapters of a course: their files and titles, and nothing that is asked."""
    yield "data/__init__.py", '"""The data of the course."""\n'
    for master in sorted((layout.root / MASTERS).glob("*.py")):
        name = master.stem.partition("_")[2]
        chapter = next((entry for entry in layout.chapters if entry.name == name), None)
        title = chapter.title if chapter else name.replace("_", " ").capitalize()
        yield (MASTERS / master.name).as_posix(), f"# %% [markdown]\n# # {title}\n"
        if chapter is not None:
            yield (QUESTIONS / f"{name}.toml").as_posix(), f"title = {json.dumps(title)}\n"
            yield (ANSWERS / f"{name}.toml").as_posix(), f"# The key to {title}.\n"


def _like(layout: Course, text: str) -> str:
    """The pyproject.toml with the requirements and limits of another course."""
    path = layout.root / "pyproject.toml"
    table = tomllib.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    needed = table.get("project", {}).get("dependencies")
    if needed:
        listed = "\n".join(f"    {json.dumps(entry)}," for entry in needed)
        text = re.sub(
            r"(?ms)^dependencies = \[.*?^\]", lambda _: f"dependencies = [\n{listed}\n]", text
        )
    limits = [f"{name} = {value}" for name, value in changed_limits(layout.settings).items()]
    return text.partition("[tool.autograder]\n")[0] + "\n".join(["[tool.autograder]", *limits, ""])


def _words(target: Path, title: str) -> dict[str, str]:
    """What stands for the variables of the template."""
    slug = re.sub(r"[^a-z0-9]+", "-", target.name.casefold()).strip("-") or "course"
    source = engine_source()
    return {
        "name": slug if slug.endswith("course") else f"{slug}-course",
        "title": title,
        "quoted": json.dumps(title, ensure_ascii=False),
        "engine": f"{ENGINE}>={__version__},<{_next(__version__)}",
        "sources": _uv_sources(source, target),
        "pip": _pip_line(source, target),
    }


def _next(version: str) -> str:
    """The first version that may break a course written for this one."""
    major, minor, *_ = (int(part) for part in version.split("."))
    return f"{major + 1}" if major else f"0.{minor + 1}"


def engine_source() -> Source:
    """Where the engine that runs came from, as its installer has noted (PEP 610)."""
    try:
        noted = distribution(ENGINE).read_text("direct_url.json")
    except PackageNotFoundError:
        noted = None
    origin: Message = json.loads(noted) if noted else {}
    if "vcs_info" in origin:
        commit = str(origin["vcs_info"].get("commit_id", ""))
        return Source(None, str(origin["url"]), commit, str(origin.get("subdirectory", "")))
    if "dir_info" in origin:
        return Source(Path(unquote(urlparse(origin["url"]).path)))
    return Source()


def _uv_sources(source: Source, target: Path) -> str:
    if source.folder is not None:
        value = {"path": _way(source.folder, target)}
    elif source.git:
        value = {"git": source.git, "rev": source.commit, "subdirectory": source.subdirectory}
    else:
        return ""
    inside = ", ".join(f"{name} = {json.dumps(text)}" for name, text in value.items() if text)
    editable = ", editable = true" if source.folder else ""
    return (
        "\n# Where the engine was when this course was made; remove it for the one on PyPI.\n"
        f"[tool.uv.sources]\n{ENGINE} = {{ {inside}{editable} }}\n"
    )


def _pip_line(source: Source, target: Path) -> str:
    own = '`pip install -e ".[author,lab]"`'
    if source.folder is not None:
        return f"`pip install -e {_way(source.folder, target)}`, then {own}."
    if source.git:
        where = f"git+{source.git}@{source.commit}"
        where += f"#subdirectory={source.subdirectory}" if source.subdirectory else ""
        return f'`pip install "{ENGINE} @ {where}"`, then {own}.'
    return f"{own}."


def _way(folder: Path, target: Path) -> str:
    """A path within one repository from the course, any other in full."""
    if folder.parent in target.parents:
        return Path(os.path.relpath(folder, target)).as_posix()
    return folder.as_posix()
