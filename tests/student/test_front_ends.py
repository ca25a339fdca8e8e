"""What a student hands in from Visual Studio Code, Colab, JupyterLab and nbclient.

The front ends are not here; what they send is. Kernels are real ones, and get the messages of the
front ends' public sources: microsoft/vscode-jupyter, src/kernels/execution/cellExecution.ts (the
address of a cell's document as its id, together with the cell's own metadata), and
googlecolab/colabtools, google/colab/_history.py (``metadata.colab.cell_id``) and _message.py.
"""

from __future__ import annotations

import json
import os
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any, ClassVar

import nbformat
import pytest
from jupyter_client.blocking.client import BlockingKernelClient
from jupyter_client.manager import start_new_kernel
from nbclient import NotebookClient

from autograder import ask, submit
from autograder.student import frontend, unsaved

SETUP = "from autograder import ask, check, submit"
NAME = "3_orchard.ipynb"


def save(folder: Path, *sources: str, ids: bool = True, name: str = NAME) -> None:
    """Save a notebook with these cells, as a front end does when a student saves."""
    cells = [
        {
            "cell_type": "code",
            **({"id": f"cell-{n}"} if ids else {}),
            "metadata": {},
            "execution_count": None,
            "outputs": [],
            "source": source,
        }
        for n, source in enumerate(sources)
    ]
    path = folder / name
    before = path.stat().st_mtime_ns if path.exists() else 0
    notebook = {"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": cells}
    path.write_text(json.dumps(notebook), encoding="utf-8")
    if path.stat().st_mtime_ns == before:  # a file system with coarse times
        os.utime(path, ns=(before + 10**9, before + 10**9))


# What a kernel of Colab finds when it asks for the notebook on the screen.
COLAB_PACKAGE = """
import json, sys
from types import ModuleType

google, colab, message = map(ModuleType, ("google", "google.colab", "google.colab._message"))
google.colab, colab._message = colab, message
message.blocking_request = lambda kind, request="", timeout_sec=5: dict(
    ipynb=json.loads({notebook!r})
)
sys.modules.update({{module.__name__: module for module in (google, colab, message)}})
"""


class FrontEnd:
    """A kernel, and the messages of one front end."""

    def __init__(self, client: BlockingKernelClient, folder: Path) -> None:
        self.client = client
        self.folder = folder

    def metadata(self, n: int) -> dict[str, Any]:
        """What is sent along with the code of cell number ``n``: nothing, as nbclient does."""
        return {}

    def run(self, n: int, code: str) -> str:
        """Run a cell and return what it shows."""
        content = {
            "code": code,
            "silent": False,
            "store_history": True,
            "user_expressions": {},
            "allow_stdin": True,
            "stop_on_error": False,
        }
        message = self.client.session.msg("execute_request", content, metadata=self.metadata(n))
        self.client.shell_channel.send(message)
        shown = []
        while True:
            reply = self.client.get_iopub_msg(timeout=60)
            if reply["parent_header"].get("msg_id") != message["header"]["msg_id"]:
                continue
            content = reply["content"]
            shown.append(content.get("text") or content.get("data", {}).get("text/plain") or "")
            shown.append("\n".join(content.get("traceback", [])))
            if reply["msg_type"] == "status" and content["execution_state"] == "idle":
                return "".join(shown)


class VSCode(FrontEnd):
    """Visual Studio Code: it says which file the notebook is, and its own addresses of cells."""

    def metadata(self, n: int) -> dict[str, Any]:
        address = self.folder.as_posix().replace(" ", "%20")
        return {"cellId": f"vscode-notebook-cell:{address}/{NAME}#W{n}sZmlsZQ%3D%3D", "tags": []}

    def begin(self) -> None:
        self.client.execute_interactive(
            f'__vsc_ipynb_file__ = r"{self.folder / NAME}"', silent=True, store_history=False
        )


class Colab(FrontEnd):
    def metadata(self, n: int) -> dict[str, Any]:
        return {"colab": {"cell_id": f"x7yZ{n}"}}


@pytest.fixture
def kernel(own_orchard: Path) -> Iterator[BlockingKernelClient]:
    yield from kernel_in(own_orchard / "notebooks")


@pytest.fixture
def kernel_above(own_orchard: Path) -> Iterator[BlockingKernelClient]:
    """A kernel in the course's folder, where a notebook of the student's own lies as well.

    Visual Studio Code starts them there with `jupyter.notebookFileRoot = ${workspaceFolder}`.
    """
    save(own_orchard, "x = 1", name="scratch.ipynb")
    yield from kernel_in(own_orchard)


def kernel_in(folder: Path) -> Iterator[BlockingKernelClient]:
    environment = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("AUTOGRADER_", "JPY_"))
    }
    manager, client = start_new_kernel(
        cwd=str(folder), env={**environment, "AUTOGRADER_WIDGETS": "0"}
    )
    yield client
    client.stop_channels()
    manager.shutdown_kernel(now=True)


def test_vscode_is_told_what_is_not_saved(kernel: BlockingKernelClient, own_orchard: Path):
    folder = own_orchard / "notebooks"
    save(folder, SETUP, "trees = ...", "submit()", ids=False)
    editor = VSCode(kernel, folder)
    editor.begin()
    editor.run(0, SETUP)
    editor.run(1, "trees = 12")
    said = editor.run(2, "submit()")
    assert "Not ready to hand in: 3_orchard.ipynb is saved without code that you ran" in said
    assert "`trees = 12`" in said
    assert "Ctrl+S" in said
    assert "Hand in this file" not in said
    save(folder, SETUP, "trees = 12", "submit()", ids=False)
    assert "Hand in this file." in editor.run(2, "submit()")
    # What was run before the last save was saved with it, even where it was changed since.
    save(folder, SETUP, "trees = 4 * 3", "submit()", ids=False)
    assert "Hand in this file." in editor.run(2, "submit()")
    editor.run(1, "trees = 13")
    assert "`trees = 13`" in editor.run(2, "submit()")


def test_vscode_may_start_kernels_in_the_folder_that_is_open(
    kernel_above: BlockingKernelClient, own_orchard: Path
):
    folder = own_orchard / "notebooks"
    save(folder, SETUP, "trees = 12", "submit()", ids=False)
    editor = VSCode(kernel_above, folder)
    editor.begin()
    editor.run(0, SETUP)
    editor.run(1, "trees = 12")
    editor.run(3, 'ask("Q1").respond([True, None])')
    assert "is saved without code that you ran" in editor.run(2, "submit()")
    # What is saved and was changed since it ran is not blamed for ever.
    save(folder, SETUP, "trees = 13", "submit()", ids=False)
    assert "Hand in this file." in editor.run(2, "submit()")
    assert "responses/orchard.json" in zipfile.ZipFile(folder / "submission.zip").namelist()
    assert not (own_orchard / "responses").exists()


def test_a_change_of_the_working_folder_takes_nothing_away(
    kernel: BlockingKernelClient, own_orchard: Path, tmp_path: Path
):
    folder = own_orchard / "notebooks"
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    save(elsewhere, "x = 1", name="scratch.ipynb")
    save(folder, SETUP, "trees = ...", "submit()")
    editor = FrontEnd(kernel, folder)
    editor.run(0, SETUP)
    editor.run(3, f"import os; os.chdir({str(elsewhere)!r})")
    editor.run(4, 'ask("Q1").respond([True, None])')
    editor.run(1, "trees = 12")
    assert "is saved without code that you ran" in editor.run(2, "submit()")
    save(folder, SETUP, "trees = 13", "submit()")
    assert "Hand in this file." in editor.run(2, "submit()")
    assert "responses/orchard.json" in zipfile.ZipFile(folder / "submission.zip").namelist()
    assert [path.name for path in elsewhere.iterdir()] == ["scratch.ipynb"]


def test_nothing_is_claimed_where_the_notebook_is_saved_elsewhere(
    kernel: BlockingKernelClient, own_orchard: Path
):
    """A notebook that was opened from another folder, or is not saved at all."""
    editor = VSCode(kernel, own_orchard / "elsewhere" / "a b")
    editor.run(0, SETUP)
    (own_orchard / "notebooks" / NAME).rename(own_orchard / "notebooks/4_orchard.ipynb")
    said = editor.run(1, "submit()")
    assert "Whether your notebook is saved cannot be seen from here" in said
    assert "Hand in this file" not in said


def test_colab_hands_out_the_notebook_on_the_screen(
    kernel: BlockingKernelClient, own_orchard: Path
):
    folder = own_orchard / "notebooks"
    browser = Colab(kernel, folder)
    work = nbformat.v4.new_notebook(metadata={"colab": {"name": "Copy of 3_orchard.ipynb"}})
    work["cells"] = [
        nbformat.v4.new_code_cell(source)
        for source in (SETUP, 'ask("Q1")', "trees = 12", "submit()")
    ]
    package = COLAB_PACKAGE.format(notebook=json.dumps(work))
    kernel.execute_interactive(package, silent=True, store_history=False)
    browser.run(0, SETUP)
    browser.run(1, "trees = 12")
    said = browser.run(2, "submit()")
    assert "Hand in this file." in said
    assert "Colab forgets its files" in said
    with zipfile.ZipFile(folder / "submission.zip") as archive:
        assert archive.namelist() == [NAME, "submitted.txt"]
        assert "trees = 12" in archive.read(NAME).decode()
    assert "trees" not in (folder / NAME).read_text(encoding="utf-8")


def test_colab_that_does_not_answer_is_no_reason_to_hand_in_a_blank(
    own_orchard: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setitem(sys.modules, "google.colab", ModuleType("google.colab"))
    said = repr(submit())
    assert "Not ready to hand in: Colab did not hand over your notebook" in said
    assert "Download .ipynb" in said


def test_nbclient_sends_no_ids_and_what_it_runs_is_saved(own_orchard: Path):
    folder = own_orchard / "notebooks"
    save(folder, SETUP, "trees = 12", "submit()")
    notebook = nbformat.read(folder / NAME, as_version=4)
    NotebookClient(notebook, resources={"metadata": {"path": str(folder)}}).execute()
    assert "Hand in this file." in notebook.cells[2].outputs[0]["data"]["text/plain"]


# What was run and what is saved, without a kernel


@pytest.fixture
def folder(own_orchard: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(unsaved, "_runs", {})
    monkeypatch.delenv("JPY_SESSION_NAME", raising=False)
    return own_orchard / "notebooks"


def test_a_saved_cell_that_was_changed_and_run_is_noticed(folder: Path):
    save(folder, SETUP, "area = ...")
    unsaved.remember("cell-0", SETUP)
    unsaved.remember("cell-1", "area = 12")
    assert "3_orchard.ipynb differs from what you ran last" in unsaved.unsaved_work(folder)
    assert "Not ready to hand in: 3_orchard.ipynb differs" in repr(submit())
    save(folder, SETUP, "area = 12")
    assert unsaved.unsaved_work(folder) == ""
    assert "Hand in this file." in repr(submit())


def test_a_new_cell_that_was_never_saved_is_noticed(folder: Path):
    save(folder, SETUP)
    unsaved.remember("cell-0", SETUP)
    unsaved.remember("new", "area = 12\narea")
    assert "without code that you ran, such as `area = 12`" in unsaved.unsaved_work(folder)


def test_a_cell_that_jupyterlab_calls_deleted_is_not_missed(
    folder: Path, monkeypatch: pytest.MonkeyPatch
):
    class Shell:
        user_ns: ClassVar[dict[str, Any]] = {}

        def get_parent(self) -> dict[str, Any]:
            return {"metadata": {"deletedCells": ["new"], "cellId": "cell-0"}}

    class Info:
        cell_id = "cell-0"
        raw_cell = SETUP
        store_history = True

    save(folder, SETUP)
    unsaved.remember("new", "area = 12")
    monkeypatch.setattr(frontend, "running_shell", Shell)
    unsaved._remember(Info)
    assert unsaved.unsaved_work(folder) == ""


@pytest.mark.parametrize(
    "cell", ["cell-0", None, "vscode-notebook-cell:/home/x/3_orchard.ipynb#W1"]
)
@pytest.mark.parametrize("how", ["line ends", "line ends of what ran", "blanks", "byte order mark"])
def test_what_an_editor_changes_when_it_saves_is_no_work(folder: Path, cell: str | None, how: str):
    ran, kept = "area = 12\nheight = 3", "area = 12\nheight = 3"
    if how == "line ends":
        kept = kept.replace("\n", "\r\n")
    elif how == "line ends of what ran":
        ran = ran.replace("\n", "\r\n")
    elif how == "blanks":
        ran = ran.replace("\n", "  \n")
    save(folder, kept)
    if how == "byte order mark":
        (folder / NAME).write_bytes(b"\xef\xbb\xbf" + (folder / NAME).read_bytes())
    unsaved.remember(cell, ran)
    assert unsaved.unsaved_work(folder) == ""


def test_an_umlaut_in_two_characters_is_the_same_name(folder: Path):
    save(folder, "area = 12", name="3_Ga\u0308rten.ipynb")
    cell = "vscode-notebook-cell:/home/x/3_G%C3%A4rten.ipynb#W1"
    unsaved.remember(cell, "area = 12")
    assert unsaved.unsaved_work(folder) == ""
    unsaved.remember(cell, "area = 13")
    assert "is saved without code that you ran" in unsaved.unsaved_work(folder)


def test_a_cell_that_only_hands_in_is_no_work():
    assert unsaved.hands_in("from autograder import submit\n\nsubmit()  # done")
    assert unsaved.hands_in("import autograder\nautograder.submit(to='/srv/drop')")
    assert unsaved.hands_in("autograder.submit(\n    to='/srv/drop',\n)")
    assert unsaved.hands_in("%time submit()")
    assert unsaved.hands_in('me("Ada Lovelace")\nprogress()')
    assert not unsaved.hands_in("area = 12; submit()")
    assert not unsaved.hands_in("submit()\narea = 12")


def test_the_running_notebook_is_told_from_its_neighbors_by_its_cells(folder: Path):
    save(folder, SETUP, "area = ...")
    save(folder, SETUP, "height = ...", name="4_orchard.ipynb")
    unsaved.remember(None, SETUP)
    unsaved.remember(None, "height = ...")
    assert unsaved.unsaved_work(folder) == ""
    unsaved.remember(None, "height = 3")
    assert unsaved.unsaved_work(folder).startswith("4_orchard.ipynb is saved without code")


def test_of_notebooks_that_fit_equally_the_servers_name_decides(
    folder: Path, monkeypatch: pytest.MonkeyPatch
):
    save(folder, SETUP)
    save(folder, SETUP, name="4_orchard.ipynb")
    unsaved.remember(None, SETUP)
    unsaved.remember(None, "height = 3")
    monkeypatch.setenv("JPY_SESSION_NAME", "/srv/course/notebooks/4_orchard.ipynb")
    assert unsaved.unsaved_work(folder).startswith("4_orchard.ipynb is saved without code")


# Where no widget is drawn


@pytest.mark.parametrize(
    ("id", "line", "then"),
    [
        ("Q1", 'ask("Q1").respond([None, None])', "[False, True]"),
        ("Q5", 'ask("Q5").respond([1, 2, 3])', "[2, 3, 1]"),
        ("Q2", 'check("Q2", trees)', ""),
    ],
)
def test_the_plain_form_shows_a_line_to_copy_that_works(
    orchard: Path, id: str, line: str, then: str
):
    shown = ask(id)
    assert f"`{line}`" in "\n".join(shown.lines())
    if then:
        eval(line, {"ask": ask})  # as it stands, it changes nothing
        shown.respond(eval(then))
        assert f'ask("{id}").respond({then})' in repr(ask(id))


def test_vscode_gets_the_line_below_the_widget_too(orchard: Path, monkeypatch: pytest.MonkeyPatch):
    class Shell:
        user_ns = (frontend.VSCODE_FILE,)

    monkeypatch.setenv("AUTOGRADER_WIDGETS", "1")
    widget = ask("Q1")._widget()
    assert "in a cell" not in widget.receipt()["text/html"]
    monkeypatch.setattr(frontend, "running_shell", Shell)
    assert 'ask("Q1").respond([None, None])' in widget.receipt()["text/html"]
