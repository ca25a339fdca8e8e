"""Practice: the key of chosen chapters goes into the bundle, for full feedback at once.

It lies in ``practice/``, a small course of its own with nothing but those chapters, their keys and
the modules that the keys name.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator
from pathlib import Path

from autograder.course import Course
from autograder.course.folders import ANSWERS, QUESTIONS
from autograder.errors import UsageError
from autograder.questions.registry import kind_of

PRACTICE = Path("practice")


def practice_files(course: Course, chapters: Collection[str]) -> Iterator[Path]:
    """The files of the practice course, relative to the root.

    Raises:
        UsageError: if a chapter does not exist, or its key needs a module that answers a chapter
            which is not practised.
    """
    known = [chapter.name for chapter in course.chapters]
    for name in chapters:
        if name not in known:
            raise UsageError(f"There is no chapter {name!r}; this course has {', '.join(known)}.")
        yield QUESTIONS / f"{name}.toml"
        yield ANSWERS / f"{name}.toml"
    modules = needed_modules(course, chapters)
    for id, answer in course.key.items():
        question = course.question(id)
        chapter = question.chapter
        # The right solution of a chapter that is not practised; a mistake tells little.
        for name in kind_of(question).solutions(answer)[:1]:
            module = name.partition(":")[0]
            if chapter not in chapters and module in modules:
                raise UsageError(
                    f"The key to {', '.join(chapters)} needs {module}, which answers {id}; "
                    f"practise {chapter} too (--practice {chapter}), or leave it out."
                )
    for package in course.own_kinds:
        folder = module_file(course, package).parent
        yield from (path.relative_to(course.root) for path in sorted(folder.rglob("*.py")))
        for parent in folder.relative_to(course.root).parents[:-1]:
            if (course.root / parent / "__init__.py").exists():
                yield parent / "__init__.py"
    for module in sorted(modules):
        yield module_file(course, module).relative_to(course.root)


def needed_modules(course: Course, chapters: Collection[str]) -> set[str]:
    """The course's own modules that the keys name, and all that those import."""
    waiting = {
        name.partition(":")[0]
        for id, answer in course.key.items()
        if course.question(id).chapter in chapters
        for name in (
            *kind_of(course.question(id)).code_names(answer),
            kind_of(course.question(id)).picture(answer) or "",  # grading draws it
        )
        if name
    }
    needed: set[str] = set()
    while waiting:
        module = waiting.pop()
        path = module_file(course, module)
        if module in needed or not path.exists():
            continue
        needed.add(module)
        parents = module.split(".")[:-1]
        waiting |= {".".join(parents[:count]) for count in range(1, len(parents) + 1)}
        waiting |= set(_imports(path))
    return needed


def _imports(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def module_file(course: Course, module: str) -> Path:
    """The file of one of the course's own modules, whether or not it exists."""
    base = course.root.joinpath(*module.split("."))
    package = base / "__init__.py"
    return package if package.exists() else base.with_suffix(".py")
