"""Who may import whom, and what the trusted side must never call."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
OURS = {"autograder", "benchmarks", "data", "notebooks", "solutions", "tests"}


def sources(folder: str) -> list[Path]:
    found = sorted((ROOT / folder).rglob("*.py"))
    assert found, folder
    return [path for path in found if not {"node_modules", "sample_class"} & set(path.parts)]


def imported(path: Path) -> Iterator[str]:
    """The full names of everything a file imports, at any depth, also by `importlib`."""
    package = list(path.relative_to(ROOT).parent.parts)
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        match node:
            case ast.Import(names=names):
                yield from (alias.name for alias in names)
            case ast.ImportFrom(module=module, names=names, level=level):
                base = package[: len(package) - level + 1] if level else []
                yield ".".join([*base, *([module] if module else [])])
            case ast.Call(
                func=ast.Attribute(attr="import_module") | ast.Name(id="__import__"),
                args=[ast.Constant(value=str(name)), *_],
            ):
                yield name


def our_packages(path: Path) -> set[str]:
    return {name.partition(".")[0] for name in imported(path)} & OURS


# Folder by folder: what of ours it may import. The sample class is made from the notebooks' files
# and imports nothing of ours either.
ALLOWED = {"data": {"data"}, "solutions": {"solutions"}, "autograder": {"autograder"}}


@pytest.mark.parametrize("folder", ALLOWED)
def test_a_package_imports_nothing_of_ours_but_itself(folder):
    wrong = {
        str(path.relative_to(ROOT)): our_packages(path) - ALLOWED[folder]
        for path in sources(folder)
        if our_packages(path) - ALLOWED[folder]
    }
    assert wrong == {}


def test_pictures_import_nothing_of_ours_but_data_and_themselves():
    for path in sources("notebooks/figures"):
        assert our_packages(path) <= {"data", "notebooks"}, path


def test_explorers_import_nothing_of_ours_but_the_engine_that_shows_them():
    for path in sources("notebooks/explorers"):
        assert our_packages(path) <= {"autograder", "data", "notebooks"}, path


def test_masters_import_the_autograder_data_and_pictures_only():
    """What a student's notebook imports must be in a student's bundle."""
    for path in sources("notebooks/source"):
        assert our_packages(path) <= {"autograder", "data", "notebooks", "figures"}, path


def test_an_import_would_be_noticed_in_every_form(tmp_path, monkeypatch):
    monkeypatch.setitem(globals(), "ROOT", tmp_path)
    path = tmp_path / "autograder" / "sandbox" / "x.py"
    path.parent.mkdir(parents=True)
    for line in (
        "import solutions",
        "import numpy, solutions.ransac.fast.consensus as r",
        "from solutions import ransac",
        "def f():\n    from solutions.ransac.fast.consensus import ransac_line",
        "import importlib\nimportlib.import_module('solutions.ransac.fast.consensus')",
        "__import__('solutions')",
        "from ...solutions import ransac",
    ):
        path.write_text(line)
        assert our_packages(path) == {"solutions"}, line


# The trusted side: everything but what lives in the student's process or kernel.
TRUSTED = [
    path
    for path in sources("autograder")
    if not {"inside", "student"} & set(path.relative_to(ROOT).parts)
]
# Makes mutants of the course's own functions, from the course's own files; nothing of a student's
# ever reaches it.
COMPILES_THE_COURSE = ROOT / "autograder/mutants/changed_functions.py"
RUNS_TEXT = {"eval", "exec", "compile", "execfile", "sympify", "parse_expr", "run_cell", "S"}
UNPICKLES = {"pickle", "cPickle", "dill", "cloudpickle", "joblib", "shelve", "marshal"}


def called(path: Path) -> Iterator[str]:
    """Names of the functions a file calls: ``eval`` of ``eval(x)``, ``sympify`` of ``sp.sympify``.

    Methods of a compiled pattern and the like are not meant: ``re.compile`` is left out.
    """
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        match node:
            case ast.Call(func=ast.Name(id=name)):
                yield name
            case ast.Call(func=ast.Attribute(value=ast.Name(id="re"))):
                continue
            case ast.Call(func=ast.Attribute(attr=name)):
                yield name


@pytest.mark.parametrize("path", TRUSTED, ids=lambda path: str(path.relative_to(ROOT)))
def test_the_trusted_side_runs_no_text_and_unpickles_nothing(path):
    if path != COMPILES_THE_COURSE:
        assert not set(called(path)) & RUNS_TEXT
    assert not {name.partition(".")[0] for name in imported(path)} & UNPICKLES
    text = path.read_text(encoding="utf-8")
    assert "allow_pickle=True" not in text
    assert "shell=True" not in text


def test_the_trusted_side_does_not_import_sympy():
    """Whose parser executes what it reads; only the student's process needs it."""
    for path in TRUSTED:
        assert "sympy" not in {name.partition(".")[0] for name in imported(path)}, path


KINDS = sorted(path.parent.name for path in (ROOT / "autograder/kinds").glob("*/kind.py"))
ENGINE = [
    path
    for path in sources("autograder")
    if not any(ROOT / "autograder/kinds" / kind in path.parents for kind in KINDS)
]


def test_every_folder_of_kinds_is_a_kind():
    folders = {path.parent.name for path in (ROOT / "autograder/kinds").glob("*/__init__.py")}
    assert folders == set(KINDS)
    assert {"true_false", "order", "number", "expression", "function"} <= set(KINDS)


@pytest.mark.parametrize("path", ENGINE, ids=lambda path: str(path.relative_to(ROOT)))
def test_the_engine_names_no_kind_of_question(path):
    """A new kind is a new folder: nothing outside of `kinds` tells one kind from another."""
    of_a_kind = tuple(f"autograder.kinds.{kind}" for kind in KINDS)
    assert not [name for name in imported(path) if name.startswith(of_a_kind)]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        match node:
            case ast.Compare(left=ast.Attribute(attr="kind"), comparators=[ast.Constant(value=v)]):
                assert v not in KINDS


def test_a_kind_knows_no_other_kind():
    for kind in KINDS:
        for path in sources(f"autograder/kinds/{kind}"):
            others = tuple(f"autograder.kinds.{other}." for other in KINDS if other != kind)
            assert not [name for name in imported(path) if name.startswith(others)], path


def test_few_things_are_typed_as_anything():
    """What cannot be known has a name in `autograder.exchange.messages`; the rest has a type."""
    uses = [
        f"{path}:{node.lineno}"
        for folder in ("autograder", "benchmarks", "notebooks/explorers", "solutions")
        for path in sources(folder)
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Name) and node.id == "Any"
    ]
    assert 0 < len(uses) < 100, uses
