"""Two students on a real JupyterHub, on loopback: homes apart, widgets at work, a drop folder.

`.ci/hub FOLDER` makes the hub's environment, which needs the network and a minute;
``AUTOGRADER_HUB=FOLDER AUTOGRADER_LONG=1 pytest tests/browser/test_hub.py`` runs this. The students
are accounts that the test makes and removes.
"""

from __future__ import annotations

import csv
import json
import os
import shutil
import socket
import subprocess
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from autograder.cli import main
from tests.browser.lab import Notebook

HUB = os.environ.get("AUTOGRADER_HUB")
STUDENTS = ("reach-ada", "reach-bob")
pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(
        HUB is None or not hasattr(os, "geteuid") or os.geteuid() != 0,
        reason="needs root, and in AUTOGRADER_HUB the folder that .ci/hub makes",
    ),
]
CONFIG = """
c.JupyterHub.bind_url = "http://127.0.0.1:{port}"
c.JupyterHub.hub_bind_url = "http://127.0.0.1:{hub}"
c.JupyterHub.authenticator_class = "dummy"
c.Authenticator.allow_all = True
c.ConfigurableHTTPProxy.command = ["{proxy}"]
c.ConfigurableHTTPProxy.api_url = "http://127.0.0.1:{api}"
c.Spawner.cmd = ["{env}/bin/jupyterhub-singleuser"]
c.Spawner.args = ["--LabApp.expose_app_in_browser=True"]
c.Spawner.default_url = "/lab"
c.Spawner.start_timeout = 120
"""


class Student:
    """What a notebook needs of its server: addresses, and where the course is."""

    def __init__(self, hub: str, name: str) -> None:
        self.hub = hub
        self.name = name
        self.course = Path("~" + name).expanduser() / "course"

    def url(self, path: str) -> str:
        return f"{self.hub}/user/{self.name}/{path}"


def free_port() -> int:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return int(found.getsockname()[1])


@pytest.fixture
def accounts() -> Iterator[None]:
    """Two users with the course in their homes, copied from a folder that they cannot change."""
    for name in STUDENTS:
        subprocess.run(["useradd", "--create-home", "--shell", "/bin/sh", name], check=True)
    try:
        for name in STUDENTS:
            home = Path("~" + name).expanduser()
            home.chmod(0o700)
            subprocess.run(
                ["setpriv", f"--reuid={name}", f"--regid={name}", "--clear-groups",
                 "cp", "-r", f"{HUB}/course", str(home)],
                check=True,
            )  # fmt: skip
        yield
    finally:
        for name in STUDENTS:
            subprocess.run(["userdel", "--force", "--remove", name], check=False)


@pytest.fixture
def hub(accounts: None, tmp_path: Path) -> Iterator[str]:
    port = free_port()
    (tmp_path / "config.py").write_text(
        CONFIG.format(
            port=port,
            hub=free_port(),
            api=free_port(),
            env=f"{HUB}/env",
            proxy=f"{HUB}/npm/node_modules/.bin/configurable-http-proxy",
        ),
        encoding="utf-8",
    )
    log = (tmp_path / "hub.log").open("wb")
    process = subprocess.Popen(
        [f"{HUB}/env/bin/jupyterhub", "-f", "config.py"],
        cwd=tmp_path,
        stdout=log,
        stderr=subprocess.STDOUT,
    )
    address = f"http://127.0.0.1:{port}"
    try:
        for _ in range(600):
            try:
                urllib.request.urlopen(f"{address}/hub/login").close()
                break
            except OSError:
                assert process.poll() is None, (tmp_path / "hub.log").read_text("utf-8")[-3000:]
                time.sleep(0.1)
        yield address
    finally:
        process.terminate()
        process.wait(30)
        log.close()


def test_two_students_work_and_hand_in_side_by_side(browser: Browser, hub: str, tmp_path: Path):
    drop = Path(f"{HUB}/drop")
    shutil.rmtree(drop, ignore_errors=True)
    drop.mkdir()
    os.chown(drop, 0, 64200)
    drop.chmod(0o3773)
    for name, says in zip(STUDENTS, (True, False), strict=True):
        student = Student(hub, name)
        page = browser.new_context().new_page()
        page.goto(f"{hub}/hub/login?next=%2Fhub%2Fspawn")
        page.locator("#username_input").fill(name)
        page.locator("#password_input").fill("any")
        page.locator("#login_submit").click()
        page.wait_for_url(f"**/user/{name}/lab**", timeout=120_000)
        chapter = Notebook(page, student, "3_ransac.ipynb", folder="course/notebooks").open()
        chapter.run_cell(chapter.index_of("from autograder"))
        chapter.run_cell(chapter.index_of('ask("Q3.1")'))
        chapter.wait_for_widgets()
        chapter.question("Q3.1").get_by_role("radio").nth(0 if says else 1).click()
        expect(chapter.question("Q3.1").locator(".ag-status")).to_have_text("Kept.")
        chapter.save()
        chapter.run_cell(chapter.append(f'from autograder import submit\nsubmit(to="{drop}")'))
        expect(page.get_by_role("group", name="Submission")).to_contain_text("Handed in")
        page.context.close()

    for name, says in zip(STUDENTS, (True, False), strict=True):
        [kept] = Path("~" + name).expanduser().rglob("responses/ransac.json")
        responses = json.loads(kept.read_text(encoding="utf-8"))["responses"]
        assert responses["Q3.1"]["response"][0] is says
    other = next(drop.glob(f"{STUDENTS[0]}_*.zip"))
    tried = subprocess.run(
        ["setpriv", f"--reuid={STUDENTS[1]}", f"--regid={STUDENTS[1]}", "--clear-groups",
         "cat", str(other)],
        capture_output=True,
        check=False,
    )  # fmt: skip
    assert tried.returncode != 0
    assert main(["collect", str(drop), "--out", str(tmp_path / "class")]) == 0
    rows = list(csv.reader((tmp_path / "class/times.csv").open(encoding="utf-8")))
    assert [row[0] for row in rows[1:]] == [f"{name}.zip" for name in STUDENTS]
