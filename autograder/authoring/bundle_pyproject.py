"""The pyproject.toml of a bundle that carries the engine itself, for students or for Gradescope.

What the engine needs stands among the course's own requirements, and its settings come along.
"""

from __future__ import annotations

import ast
import json
import re
import tomllib
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, packages_distributions, requires
from pathlib import Path

from autograder.course import Course
from autograder.course.settings import setting_lines
from autograder.questions.strict_reader import Table

ENGINE = "course-autograder"
LAB = "lab"
_PACKAGE = Path(__file__).parents[1]
_EXTRA = re.compile(r"""\s*;?\s*(?:and\s+)?extra\s*==\s*['"]([\w-]+)['"]\s*$""")


def bundle_pyproject(course: Course, suffix: str) -> str:
    """The text of the file; the suffix tells the bundle's name from the course's."""
    path = course.root / "pyproject.toml"
    table = tomllib.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    project = table.get("project", {})
    engine = engine_requirements()
    own = [
        requirement
        for requirement in project.get("dependencies", _imported(course))
        if distribution(requirement) != ENGINE
    ]
    named = {distribution(requirement) for requirement in own}
    needed = [*own, *(entry for entry in engine[""] if distribution(entry) not in named)]
    lines = [
        "[project]",
        f"name = {json.dumps(str(project.get('name', 'course')) + suffix)}",
        f"version = {json.dumps(str(project.get('version', '0')))}",
        f"description = {json.dumps(str(project.get('description', '')))}",
        f"requires-python = {json.dumps(str(project.get('requires-python', '>=3.11')))}",
        *_list("dependencies", needed),
        "",
        "# To open the notebooks on a machine of your own; a hosted server has its own JupyterLab.",
        "[project.optional-dependencies]",
        *_list(LAB, engine[LAB]),
        "",
        "[build-system]",
        'requires = ["hatchling>=1.26,<2"]',
        'build-backend = "hatchling.build"',
        "",
        "[tool.hatch.build]",
        'dev-mode-dirs = ["."]',
        "",
        "[tool.hatch.build.targets.wheel]",
        'packages = ["autograder"]',
        "",
        "[tool.hatch.build.targets.wheel.shared-data]",
        "# So that a reopened notebook shows the widgets as they were.",
        '"autograder/student/jupyterlab_settings.json" = '
        '"share/jupyter/lab/settings/overrides.d/autograder.json"',
    ]
    newest = table.get("tool", {}).get("uv", {}).get("exclude-newer")
    if newest:
        lines += ["", "[tool.uv]", f"exclude-newer = {json.dumps(str(newest))}"]
    settings = setting_lines(course.root)
    if settings:
        lines += ["", *settings]
    return "\n".join(lines) + "\n"


def engine_requirements() -> dict[str, list[str]]:
    """What the engine needs, by extra; that of no extra stands under an empty name.

    It is asked of the installed distribution, or read beside the package where that runs from a
    checkout without being installed.
    """
    source = _PACKAGE / "pyproject.toml"
    found: dict[str, list[str]] = {"": [], LAB: []}
    if source.is_file():
        project: Table = tomllib.loads(source.read_text(encoding="utf-8"))["project"]
        return found | {"": project["dependencies"], **project.get("optional-dependencies", {})}
    try:
        declared = requires(ENGINE) or []
    except PackageNotFoundError:
        return found
    for requirement in declared:
        extra = _EXTRA.search(requirement)
        name = extra[1] if extra else ""
        found.setdefault(name, []).append(_EXTRA.sub("", requirement))
    return found


def _imported(course: Course) -> list[str]:
    """What a course that declares nothing needs: the distributions that its notebooks import."""
    modules = set()
    for folder in ("notebooks", "data"):
        for path in (course.root / folder).rglob("*.py"):
            modules |= set(_imports(path))
    installed = packages_distributions()  # reads the metadata of everything that is installed
    found = {name for module in modules for name in installed.get(module, ())}
    return sorted(name for name in found if distribution(name) != ENGINE)


def _imports(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            yield node.module.partition(".")[0]


def distribution(requirement: str) -> str:
    """The name in a requirement, written one way: that of ``A_b.c[x]>=1`` is ``a-b-c``."""
    name = re.split(r"[^\w.-]", requirement.strip(), maxsplit=1)[0]
    return re.sub(r"[-_.]+", "-", name).casefold()


def _list(name: str, entries: list[str]) -> list[str]:
    return [f"{name} = [", *(f"    {json.dumps(entry)}," for entry in entries), "]"]
