"""Which small changes of a module do its tests let live?

    uv run python tests/mutate.py autograder/kinds/number/marking.py tests/kinds/test_number.py

Every mutant that `autograder check` would make of a course's reference is made of each function of
the module, and the tests are run against it, in a fork of a process that has collected them once.
The survivors are printed as diffs, and how many of the mutants were killed.
"""

from __future__ import annotations

import argparse
import ast
import importlib
import os
import resource
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import pytest

from autograder.marking.mutants.edits import edited
from autograder.marking.mutants.mutant import Mutant

ROOT = Path(__file__).parent.parent
_FUTURE = importlib.import_module("__future__").annotations.compiler_flag


def main() -> int:
    """Try the mutants of one module; the status says whether one lives."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("module", type=Path)
    parser.add_argument("tests", nargs="+")
    parser.add_argument("--quiet", action="store_true", help="only the figures")
    parser.add_argument("--only", nargs="+", default=[], help="functions, by name; or all")
    parsed = parser.parse_args()
    os.chdir(ROOT)
    sys.path.insert(0, str(ROOT))
    begin = time.process_time()
    if run(parsed.tests) != 0:
        print("The tests fail as they are; mend them first.")
        return 2
    seconds = time.process_time() - begin
    module = importlib.import_module(".".join(parsed.module.with_suffix("").parts))
    tables = made_of_functions(parsed.module)
    tried = lived = 0
    for function, mutant, code in mutants(parsed.module, module):
        if parsed.only and function.__name__ not in parsed.only:
            continue
        tried += 1
        if lives(function, code, tables, parsed.tests, seconds):
            lived += 1
            if not parsed.quiet:
                print(f"\n{parsed.module}:{mutant.line} {function.__qualname__}: {mutant.operator}")
                print(mutant.diff, flush=True)
    print(f"{parsed.module}: {tried - lived} of {tried} mutants killed")
    return int(lived > 0)


def run(tests: list[str]) -> int:
    """Pytest's status for some tests, with nothing printed."""
    sys.stdout.flush()
    saved, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        return int(pytest.main(["-x", "-q", "-n0", "-p", "no:cacheprovider", *tests]))
    finally:
        sys.stdout.flush()
        os.dup2(saved, 1)


def mutants(path: Path, module: Any) -> Iterator[tuple[FunctionType, Mutant, CodeType]]:
    """Each mutant of a module's functions and methods, with the code that it has."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for owner, node in _functions(tree):
        function = _object(module, owner, node.name)
        if function is None:
            continue
        node.decorator_list = []
        for mutant, changed in edited(node):
            whole = compile(
                ast.Module([changed], []), str(path), "exec", flags=_FUTURE, dont_inherit=True
            )
            code = next(entry for entry in whole.co_consts if isinstance(entry, CodeType))
            if code.co_freevars == function.__code__.co_freevars:
                yield function, mutant, code


def _functions(tree: ast.Module) -> Iterator[tuple[str, ast.FunctionDef]]:
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            yield "", node
        elif isinstance(node, ast.ClassDef):
            yield from ((node.name, n) for n in node.body if isinstance(n, ast.FunctionDef))


def _object(module: Any, owner: str, name: str) -> FunctionType | None:
    holder = getattr(module, owner) if owner else module
    found: Any = vars(holder).get(name)
    found = getattr(found, "fget", None) or getattr(found, "__func__", found)
    found = getattr(found, "__wrapped__", found)
    return found if isinstance(found, FunctionType) else None


def made_of_functions(path: Path) -> CodeType:
    """The module's assignments in which its functions are used, such as a table of them."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    names = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    tree.body = [
        node
        for node in tree.body
        if isinstance(node, ast.Assign | ast.AnnAssign)
        and any(isinstance(inner, ast.Name) and inner.id in names for inner in ast.walk(node))
    ]
    return compile(tree, str(path), "exec", flags=_FUTURE, dont_inherit=True)


def lives(
    function: FunctionType, code: CodeType, tables: CodeType, tests: list[str], seconds: float
) -> bool:
    """Whether the tests pass with another code in a function's place, in a fork.

    What the module had made with the function when it was imported is made again.
    """
    child = os.fork()
    if child == 0:
        limit = int(os.times().user + 5 + 5 * seconds)
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
        try:
            function.__code__ = code
            exec(tables, function.__globals__)
            os._exit(0 if run(tests) == 0 else 1)
        except BaseException:
            os._exit(1)
    return os.waitpid(child, 0)[1] == 0


if __name__ == "__main__":
    sys.exit(main())
