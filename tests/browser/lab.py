"""A JupyterLab of the test's own, and a page of it to act on as a student would."""

from __future__ import annotations

import json
import os
import secrets
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from playwright.sync_api import Locator, Page, expect

ROOT = Path(__file__).parents[2]
COURSE = ("notebooks", "solutions", "data", "pyproject.toml")
SECONDS = 60.0
SECONDS_TO_RUN = 240.0  # a whole chapter, on a machine that is busy with other tests


class Server:
    """JupyterLab and Notebook 7 on 127.0.0.1, with settings and kernels of their own."""

    def __init__(self, folder: Path) -> None:
        self.course = folder / "course"
        _copy_course(self.course)
        self._folder = folder
        self._token = secrets.token_hex(8)
        self._log = (folder / "server.log").open("wb")
        _write_settings(folder / "settings")
        _write_page_config(folder / "config")
        runtime = folder / "runtime"
        environment = {
            name: value
            for name, value in os.environ.items()
            if not name.startswith(("AUTOGRADER_", "JUPYTER", "JPY_"))
        } | {
            "JUPYTER_CONFIG_DIR": str(folder / "config"),
            "JUPYTER_DATA_DIR": str(folder / "data"),
            "JUPYTER_RUNTIME_DIR": str(runtime),
            "JUPYTERLAB_SETTINGS_DIR": str(folder / "settings"),
            "JUPYTERLAB_WORKSPACES_DIR": str(folder / "workspaces"),
            "IPYTHONDIR": str(folder / "ipython"),
            "OMP_NUM_THREADS": "1",
            "OPENBLAS_NUM_THREADS": "1",
        }
        self._process = subprocess.Popen(
            [
                *(sys.executable, "-m", "jupyterlab"),
                *("--no-browser", "--allow-root", "--ip=127.0.0.1", "--port=0"),
                f"--ServerApp.root_dir={self.course}",
                f"--IdentityProvider.token={self._token}",
                "--ServerApp.terminals_enabled=False",
                "--LabApp.expose_app_in_browser=True",
                "--JupyterNotebookApp.expose_app_in_browser=True",
            ],
            cwd=self.course,
            env=environment,
            stdout=self._log,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        self._url = self._wait_for_url(runtime)

    def url(self, path: str) -> str:
        """The address of ``path``, such as ``lab/tree/notebooks/3_ransac.ipynb``."""
        return f"{self._url}{path}?token={self._token}"

    def stop(self) -> None:
        """End the server and its kernels."""
        self._process.send_signal(signal.SIGTERM)
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()
        self._log.close()

    def _wait_for_url(self, runtime: Path) -> str:
        give_up = time.monotonic() + SECONDS
        while time.monotonic() < give_up:
            for path in runtime.glob("jpserver-*.json"):
                try:
                    return str(json.loads(path.read_text())["url"])
                except (ValueError, KeyError):
                    continue
            if self._process.poll() is not None:
                break
            time.sleep(0.05)
        self.stop()
        raise RuntimeError((self._folder / "server.log").read_text()[-2000:])


class Notebook:
    """A notebook in a page of JupyterLab."""

    def __init__(
        self, page: Page, server: Server, path: str, app: str = "", folder: str = "notebooks"
    ) -> None:
        self.page = page
        self.server = server
        self.path = path
        self.folder = folder
        # A workspace of its own, or JupyterLab would open what was open before.
        self.app = app or f"lab/workspaces/{secrets.token_hex(4)}/tree"

    def open(self) -> Notebook:
        """Open it and wait for its kernel."""
        self.page.goto(self.server.url(f"{self.app}/{self.folder}/{self.path}"))
        self.wait_for_kernel()
        return self

    def wait_for_kernel(self) -> None:
        """Wait until the kernel is connected and idle."""
        self._wait(
            f"panel.context.path === '{self.folder}/{self.path}' && panel.sessionContext.isReady"
            " && kernel.connectionStatus === 'connected' && kernel.status === 'idle'"
        )

    def command(self, name: str) -> None:
        """Run a command of JupyterLab without waiting for what it opens."""
        self.page.evaluate("name => { window.jupyterapp.commands.execute(name) }", name)

    def run_all(self) -> None:
        """Run all cells and wait until they are done."""
        self.wait_for_kernel()
        self.command("notebook:run-all-cells")
        self._wait(
            "cells.every(cell => cell.type !== 'code' || !cell.sharedModel.source.trim()"
            " || cell.executionCount !== null) && kernel.status === 'idle'",
            seconds=SECONDS_TO_RUN,
        )

    def wait_for_widgets(self) -> None:
        """Wait until every widget has heard from the kernel: their controls are off before."""
        expect(self.page.locator(".autograder .ag-controls:disabled")).to_have_count(0)

    def run_cell(self, index: int) -> None:
        """Run one cell and wait until it is done."""
        self.wait_for_kernel()
        self.page.evaluate(
            f"() => {{ const panel = {_CURRENT}; panel.content.activeCellIndex = {index};"
            f" panel.content.model.cells.get({index}).executionCount = null; }}"
        )
        self.command("notebook:run-cell")
        self._wait(f"cells[{index}].executionCount !== null && kernel.status === 'idle'")

    def index_of(self, source: str) -> int:
        """The index of the first code cell whose source contains the text."""
        found = f"cell.type === 'code' && cell.sharedModel.source.includes({json.dumps(source)})"
        return int(self.evaluate(f"cells.findIndex(cell => {found})"))

    def write(self, index: int, source: str) -> None:
        """Replace the source of a cell."""
        self.page.evaluate(
            f"source => {{ const panel = {_CURRENT}; panel.content.model.cells.get({index})"
            ".sharedModel.setSource(source) }",
            source,
        )

    def append(self, source: str) -> int:
        """Add a cell at the end; returns its index."""
        self.page.evaluate(
            f"source => {{ {_CURRENT}.content.model.sharedModel.addCell"
            "({cell_type: 'code', source}) }",
            source,
        )
        return int(self.evaluate("cells.length")) - 1

    def sources(self) -> list[str]:
        """The sources of all cells."""
        return list(self.evaluate("cells.map(cell => cell.sharedModel.source)"))

    def save(self) -> None:
        """Save it and wait until nothing is unsaved."""
        self.command("docmanager:save")
        self.wait_until_saved()

    def wait_until_saved(self) -> None:
        """Wait until nothing is unsaved."""
        self._wait("!panel.context.model.dirty", with_kernel=False)

    def evaluate(self, expression: str) -> Any:
        """The value of JavaScript that may use `panel`, `kernel` and `cells`."""
        return self.page.evaluate(f"() => {{ {_NAMES} return {expression}; }}")

    def _wait(self, condition: str, with_kernel: bool = True, seconds: float = SECONDS) -> None:
        needed = "panel && kernel" if with_kernel else "panel"
        self.page.wait_for_function(
            f"() => {{ {_NAMES} return Boolean({needed} && ({condition})); }}",
            timeout=seconds * 1000,
        )

    def question(self, id: str) -> Locator:
        """The widget of a question."""
        return self.page.locator(f'.autograder[aria-label^="{id} "]').last

    def kept(self) -> dict[str, Any]:
        """What the files of responses hold, by question id."""
        found: dict[str, Any] = {}
        for path in (self.server.course / self.folder / "responses").glob("*.json"):
            if "damaged" not in path.name and path.stem != "practice":
                found |= json.loads(path.read_text())["responses"]
        return found


_CURRENT = "window.jupyterapp?.shell?.currentWidget"
_NAMES = (
    f"const panel = {_CURRENT}; const kernel = panel?.sessionContext?.session?.kernel;"
    " const cells = panel?.content?.model?.cells ? Array.from(panel.content.model.cells) : [];"
)


def _copy_course(target: Path) -> None:
    target.mkdir(parents=True)
    for name in COURSE:
        source = ROOT / name
        if source.is_dir():
            ignore = shutil.ignore_patterns(
                "__pycache__", "responses", "submission.zip", "source", ".*"
            )
            shutil.copytree(source, target / name, ignore=ignore)
        elif source.exists():
            shutil.copy(source, target)


def _write_settings(folder: Path) -> None:
    """No news, no dialogs: what JupyterLab asks a new user about."""
    extension = folder / "@jupyterlab/apputils-extension"
    extension.mkdir(parents=True)
    (extension / "notification.jupyterlab-settings").write_text(
        '{"fetchNews": "false", "checkForUpdates": false}'
    )


def _write_page_config(folder: Path) -> None:
    """No look at whether JupyterLab should be built again, which takes seconds."""
    (folder / "labconfig").mkdir(parents=True)
    (folder / "labconfig/page_config.json").write_text(
        '{"buildAvailable": false, "buildCheck": false}'
    )
