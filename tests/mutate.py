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
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import zip_longest
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any, TextIO

import pytest

from autograder.mutants.code_edits import edited
from autograder.mutants.mutant import Mutant

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
    with os.fdopen(os.dup(1), "w") as shown, open(os.devnull, "wb") as nowhere:
        os.dup2(nowhere.fileno(), 1)  # what pytest and the tests print
        trial = Trial(parsed.module, parsed.only, parsed.quiet, shown)
        options = ["-x", "-q", "-s", "-n0", "-p", "no:cacheprovider"]
        pytest.main([*options, *parsed.tests], plugins=[trial])
        if trial.tried == 0:
            print("The tests fail as they are; mend them first.", file=shown)
            return 2
        killed = trial.tried - trial.lived
        print(f"{parsed.module}: {killed} of {trial.tried} mutants killed", file=shown)
    return int(trial.lived > 0)


class Trial:
    """A plugin for pytest: what it has collected is run against each mutant, in forks."""

    def __init__(self, path: Path, only: Sequence[str], quiet: bool, shown: TextIO) -> None:
        self.path, self.only, self.quiet, self.shown = path, only, quiet, shown
        self.tried = self.lived = 0

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """In place of pytest's own loop over the tests."""
        begin = os.times()
        if session.testsfailed or not passes(session, lambda: None, 600.0):
            return True
        seconds = os.times().children_user - begin.children_user
        module = importlib.import_module(".".join(self.path.with_suffix("").parts))
        tables = made_of_functions(self.path)
        for function, mutant, changed in mutants(self.path, module):
            if self.only and function.__name__ not in self.only:
                continue
            self.tried += 1
            change = partial(exchange, function, changed, tables)
            if passes(session, change, 5 + 5 * seconds):
                self.lived += 1
                if not self.quiet:
                    place = f"{self.path}:{mutant.line} {function.__qualname__}"
                    print(f"\n{place}: {mutant.operator}\n{mutant.diff}", file=self.shown)
            self.shown.flush()
        return True


def exchange(function: FunctionType, changed: FunctionType, tables: CodeType) -> None:
    """Put another in a function's place, and make again what the module made with it."""
    function.__code__ = changed.__code__
    function.__defaults__, function.__kwdefaults__ = changed.__defaults__, changed.__kwdefaults__
    exec(tables, function.__globals__)


def passes(session: pytest.Session, change: Callable[[], None], seconds: float) -> bool:
    """Whether the collected tests pass after a change, in a fork that has some processor time."""
    child = os.fork()
    if child == 0:
        limit = int(os.times().user + 1 + seconds)
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
        try:
            change()
            for item, following in zip_longest(session.items, session.items[1:]):
                item.config.hook.pytest_runtest_protocol(item=item, nextitem=following)
                if session.testsfailed:
                    os._exit(1)
            os._exit(0)
        except BaseException:
            os._exit(1)
    return os.waitpid(child, 0)[1] == 0


def mutants(path: Path, module: Any) -> Iterator[tuple[FunctionType, Mutant, FunctionType]]:
    """Each mutant of a module's functions and methods, beside the function as it is."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for owner, node in _functions(tree):
        function = _object(module, owner, node.name)
        if function is None:
            continue
        node.decorator_list = []
        for mutant, changed in edited(node):
            other = _defined(changed, owner, path, module)
            if other.__code__.co_freevars == function.__code__.co_freevars:
                yield function, mutant, other


def _defined(node: ast.FunctionDef, owner: str, path: Path, module: Any) -> FunctionType:
    """A function as its module would define it; a method in a class, so that it knows `super`."""
    body: list[ast.stmt] = [node]
    if owner:
        body = ast.parse(f"class {owner}: pass").body
        body[0].body = [node]  # type: ignore[attr-defined]
    names = dict(vars(module))
    whole = ast.fix_missing_locations(ast.Module(body, []))
    exec(compile(whole, str(path), "exec", flags=_FUTURE, dont_inherit=True), names)
    found: FunctionType = vars(names[owner])[node.name] if owner else names[node.name]
    return found


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
    """The module's assignments and loops in which its functions are used, such as a table."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    names = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    tree.body = [
        node
        for node in tree.body
        if isinstance(node, ast.Assign | ast.AnnAssign | ast.For)
        and any(isinstance(inner, ast.Name) and inner.id in names for inner in ast.walk(node))
    ]
    return compile(tree, str(path), "exec", flags=_FUTURE, dont_inherit=True)


if __name__ == "__main__":
    sys.exit(main())
