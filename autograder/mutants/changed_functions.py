"""Functions of a course with one of them changed, and none of the course's own modules touched.

A helper that a function finds among its module's names has to be replaced there. So every function
that can be reached is made once more, in copies of the modules' names.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable, Mapping
from pathlib import Path
from types import CodeType, FunctionType

from autograder.exchange.messages import Value


def reachable(function: FunctionType, root: Path) -> list[FunctionType]:
    """The function, and all the functions of the course at ``root`` that it may call."""
    found = [function]
    for current in found:
        # Sorted: every process that tries mutants counts them in the same order.
        for name in sorted(_names(current.__code__)):
            value = current.__globals__.get(name)
            if isinstance(value, FunctionType) and value not in found and is_ours(value, root):
                found.append(value)
    return found


def is_ours(function: FunctionType, root: Path) -> bool:
    """Whether a function is written in the course's own files, outside of its environment."""
    path = Path(function.__code__.co_filename)
    if not path.is_relative_to(root) or function.__closure__:
        return False
    return not {".venv", "site-packages"} & set(path.relative_to(root).parts)


def tree_of(function: FunctionType) -> ast.FunctionDef:
    """The function's definition, its lines numbered as in its file."""
    lines, first = inspect.getsourcelines(function)
    tree = ast.parse(textwrap.dedent("".join(lines))).body[0]
    assert isinstance(tree, ast.FunctionDef)
    ast.increment_lineno(tree, first - 1)
    return tree


def with_changed(
    function: FunctionType,
    reached: list[FunctionType],
    changed: FunctionType,
    tree: ast.FunctionDef,
    more: Mapping[str, object] | None = None,
    codes: Mapping[FunctionType, CodeType] | None = None,
) -> Callable[..., object]:
    """``function`` as it is when ``changed``, one of those it reaches, has another tree.

    ``more`` are names that a tree uses beyond those of its module, and ``codes`` stand for the
    functions' own, the changed one's apart.
    """
    modules = {entry.__module__: {**entry.__globals__, **(more or {})} for entry in reached}
    clones = {
        entry: FunctionType(
            (codes or {}).get(entry, entry.__code__),
            modules[entry.__module__],
            entry.__name__,
            entry.__defaults__,
        )
        for entry in reached
    }
    for entry, clone in clones.items():
        clone.__kwdefaults__ = entry.__kwdefaults__
    names = modules[changed.__module__]
    made: dict[str, Value] = {}
    exec(_compiled(tree, "<mutant>"), names, made)
    clones[changed] = made[changed.__name__]
    for own in modules.values():
        for name, value in own.items():
            if isinstance(value, FunctionType) and value in clones:
                own[name] = clones[value]
    names[changed.__name__] = clones[changed]
    return clones[function]


def codes_of(
    functions: list[FunctionType], prepare: Callable[[ast.FunctionDef], ast.FunctionDef]
) -> dict[FunctionType, CodeType]:
    """What each function runs when its tree was prepared."""
    return {
        function: _code_of(prepare(tree_of(function)), function.__code__.co_filename)
        for function in functions
    }


def _code_of(tree: ast.FunctionDef, filename: str) -> CodeType:
    inner = _compiled(tree, filename).co_consts
    return next(code for code in inner if isinstance(code, CodeType) and code.co_name == tree.name)


def _compiled(tree: ast.FunctionDef, filename: str) -> CodeType:
    module = ast.Module(body=[tree], type_ignores=[])
    code: CodeType = compile(module, filename, "exec", dont_inherit=True, flags=_annotations())
    return code


def course_sources(dotted_names: list[str], root: Path) -> list[Path]:
    """The course's files that the modules of some dotted names import, and these themselves."""
    found: dict[Path, None] = {}
    waiting = [name.partition(":")[0] for name in dotted_names]
    while waiting:
        name = waiting.pop()
        base = root.joinpath(*name.split("."))
        path = next(
            (p for p in (base.with_suffix(".py"), base / "__init__.py") if p.is_file()), None
        )
        if path is None or path in found:
            continue
        found[path] = None
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            match node:
                case ast.Import(names=names):
                    waiting += [alias.name for alias in names]
                case ast.ImportFrom(module=str(module), names=names, level=0):
                    waiting += [module, *(f"{module}.{alias.name}" for alias in names)]
                case ast.ImportFrom(module=within, names=names, level=level) if level:
                    package = name.split(".")
                    package = package[: len(package) - level + (path.name == "__init__.py")]
                    inside = [*package, *([within] if within else [])]
                    waiting += [".".join([*inside, *rest]) for rest in ([], *_each(names))]
    return sorted(found)


def _each(names: list[ast.alias]) -> list[list[str]]:
    return [[alias.name] for alias in names]


def _names(code: CodeType) -> set[str]:
    """The names that code looks up, that of comprehensions and inner functions included."""
    inner = (entry for entry in code.co_consts if isinstance(entry, CodeType))
    return set(code.co_names).union(*(_names(entry) for entry in inner))


def _annotations() -> int:
    import __future__

    return __future__.annotations.compiler_flag  # annotations are not evaluated
