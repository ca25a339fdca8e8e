"""Compiled modules that are of no use, as in an environment that was copied."""

import os
import py_compile
import shutil
import subprocess
import sys
from importlib.util import MAGIC_NUMBER, cache_from_source

import pytest

from autograder.sandbox import compiled_libraries, stale_bytecode


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


@pytest.fixture
def library(tmp_path):
    folder = tmp_path / "library"
    folder.mkdir()
    for name in ("one", "two"):
        (folder / f"{name}.py").write_text(f"name = {name!r}\n")
        py_compile.compile(str(folder / f"{name}.py"))
    return folder


def all_compiled(folder):
    return all(stale_bytecode.is_compiled(source) for source in folder.glob("*.py"))


def test_a_library_that_was_imported_where_it_lies_is_compiled(library):
    assert all_compiled(library)


def test_a_module_that_was_never_compiled_is_noticed(library):
    os.remove(cache_from_source(str(library / "two.py")))
    assert not all_compiled(library)


def test_a_copy_has_new_times_and_is_noticed(library, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(library, copy, copy_function=shutil.copyfile)
    for source in copy.glob("*.py"):
        os.utime(source, (1e9, 1e9))
    assert not all_compiled(copy)
    # What Python itself says: importing from the copy writes its compiled modules anew.
    code = "import sys; sys.path.insert(0, sys.argv[1]); import one, two"
    writing = {name: value for name, value in os.environ.items() if "BYTECODE" not in name}
    subprocess.run([sys.executable, "-c", code, copy], check=True, env=writing)
    assert all_compiled(copy)


def test_times_do_not_matter_where_the_source_s_hash_is_kept(library):
    for source in library.glob("*.py"):
        mode = py_compile.PycInvalidationMode.UNCHECKED_HASH
        py_compile.compile(str(source), invalidation_mode=mode)
        os.utime(source, (1e9, 1e9))
    assert all_compiled(library)


@pytest.mark.parametrize("content", [b"", b"\0" * 16, MAGIC_NUMBER + b"\0" * 11])
def test_a_damaged_compiled_module_is_noticed(library, content):
    with open(cache_from_source(str(library / "one.py")), "wb") as compiled:
        compiled.write(content)
    assert not all_compiled(library)


def test_what_is_stale_is_compiled_once_before_the_first_sandbox(library, monkeypatch):
    started = []
    monkeypatch.setattr(compiled_libraries.subprocess, "run", lambda *a, **k: started.append(a[0]))
    monkeypatch.setattr(compiled_libraries, "font_folder", lambda: library)
    monkeypatch.setattr(compiled_libraries, "stale_modules", lambda: iter([library]))
    monkeypatch.setattr(compiled_libraries, "are_known", lambda: True)
    compiled_libraries.compile_libraries()
    assert "autograder.sandbox.inside.warm_imports" in started[0]
    monkeypatch.setattr(compiled_libraries, "stale_modules", lambda: iter([]))
    compiled_libraries.compile_libraries()
    assert len(started) == 1


def test_a_folder_that_cannot_be_written_is_not_tried_again_and_again(library, monkeypatch):
    monkeypatch.setattr(stale_bytecode, "_LOOKED_AT", {"json": ("decoder.py",)})
    monkeypatch.setattr(stale_bytecode, "is_compiled", lambda source: False)
    assert len(list(stale_bytecode.stale_modules())) == 1
    monkeypatch.setattr(stale_bytecode.os, "access", lambda path, mode: False)
    assert list(stale_bytecode.stale_modules()) == []


def test_compiling_the_libraries_comes_to_its_end(monkeypatch):
    """A failure would be seen nowhere: the next run would only be slow again."""
    ended = []
    run = compiled_libraries.subprocess.run

    def watched(*arguments, **options):
        ended.append(run(*arguments, **options).returncode)

    monkeypatch.setattr(compiled_libraries.subprocess, "run", watched)
    monkeypatch.setattr(compiled_libraries, "stale_modules", lambda: iter(["sympy"]))
    compiled_libraries.compile_libraries()
    assert ended == [0]
    assert stale_bytecode.are_known()
    kept = stale_bytecode._kept().read_text(encoding="utf-8").splitlines()
    assert sum("sympy" in line for line in kept) > 100
    assert any("mpmath" in line for line in kept)


def test_one_stale_module_of_those_that_are_imported_is_noticed_and_no_other(library):
    """As after the upgrade of one library: what stands for the others is compiled."""
    stale_bytecode.keep_imported([library / "one.py"])
    assert list(stale_bytecode.stale_modules()) == []
    os.utime(library / "two.py", (1e9, 1e9))
    assert list(stale_bytecode.stale_modules()) == []
    os.utime(library / "one.py", (1e9, 1e9))
    assert list(stale_bytecode.stale_modules()) == [library / "one.py"]


def test_what_cannot_be_compiled_is_not_tried_at_every_start(library):
    os.remove(cache_from_source(str(library / "two.py")))
    stale_bytecode.keep_imported(library.glob("*.py"))
    assert list(stale_bytecode.stale_modules()) == []


def test_where_nothing_can_be_kept_nothing_is_missed(monkeypatch):
    assert not stale_bytecode.are_known()
    monkeypatch.setattr(stale_bytecode.os, "access", lambda path, mode: False)
    assert stale_bytecode.are_known()


def test_libraries_that_stay_stale_are_known_by_their_folder(monkeypatch):
    assert stale_bytecode.never_renewed() is None
    monkeypatch.setattr(stale_bytecode, "is_compiled", lambda source: "sympy" not in source.parts)
    assert stale_bytecode.never_renewed() is None  # it may be written, and is compiled once
    monkeypatch.setattr(stale_bytecode.os, "access", lambda path, mode: False)
    folder = stale_bytecode.never_renewed()
    assert folder is not None
    assert (folder / "sympy" / "core").is_dir()
