"""Does in a fresh clone what a user of Codespaces, Binder or the README does, and times each step.

``python .ci/as_a_user.py codespaces`` (or ``binder``, ``readme``, ``pip``) in the clone's folder.
The commands are read from where the user has them: the container's file, Binder's, the README.
``.ci/clean`` calls this in a Debian that holds nothing else. Only the standard library is used,
since nothing else is there at the start.
"""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
STARTS_WITHIN = 60  # seconds, for JupyterLab
CHAPTERS = ("notebooks/0_start_here.ipynb", "notebooks/1_place_recognition.ipynb")


def codespaces() -> None:
    """Make the container's environment, grade, open a kernel as VS Code does, and JupyterLab."""
    container = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text(encoding="utf-8"))
    sh(container["onCreateCommand"])
    settings = container["customizations"]["vscode"]["settings"]
    path = settings["python.defaultInterpreterPath"]
    python = path.replace("${containerWorkspaceFolder}", str(ROOT))
    sh("uv run autograder grade solutions/sample_class")
    run_notebooks(python)
    sh("uv run autograder doctor")
    start_lab("uv run jupyter lab")


def binder() -> None:
    """Install as repo2docker does, in the environment whose Python runs this; open JupyterLab."""
    folder = Path(sys.executable).parent
    asked = (ROOT / ".binder/runtime.txt").read_text(encoding="utf-8").strip()
    here = f"python-{sys.version_info.major}.{sys.version_info.minor}"
    if asked != here:
        raise SystemExit(f".binder/runtime.txt asks for {asked}, and this is {here}")
    sh(f"{folder}/pip install --no-cache-dir -r .binder/requirements.txt")
    run_notebooks(sys.executable)
    start_lab(f"{folder}/jupyter lab")


def readme() -> None:
    """The README's first commands, with uv on the path; of the tests the quick ones."""
    grade, test = readme_block("## Try it")
    (lab,) = readme_block("and for students:")
    sh(grade.removeprefix("pip install uv && "))
    sh(test + " -m quick")
    start_lab(lab)


def pip() -> None:
    """The README's commands without uv, in two shells; of the tests the quick ones."""
    lines = readme_block("**Plain pip**")
    before = lines.index("jupyter lab notebooks/0_start_here.ipynb")
    sh("\n".join(["set -e", *lines[:before]]))
    run_notebooks(".venv/bin/python")
    activate = next(line for line in lines if "activate" in line)
    start_lab(f"{activate}\n{lines[before]}")
    sh("\n".join(["set -e", activate, *lines[before + 1 :]]) + " -m quick")


def readme_block(after: str) -> list[str]:
    """The commands of the first shell block after some words of the README."""
    text = (ROOT / "README.md").read_text(encoding="utf-8").split(after, 1)[1]
    (block,) = re.findall(r"(?ms)^ *```sh\n(.*?)^ *```", text)[:1]
    return [line.partition("  #")[0].strip() for line in block.splitlines()]


def run_notebooks(python: str) -> None:
    """Run chapters in a kernel of the interpreter at this path, whatever kernels are installed."""
    with tempfile.TemporaryDirectory() as folder:
        spec = Path(folder, "kernels/chosen/kernel.json")
        spec.parent.mkdir(parents=True)
        command = [str(Path(python).absolute()), "-m", "ipykernel_launcher", "-f"]
        spec.write_text(
            json.dumps({"argv": [*command, "{connection_file}"], "display_name": "chosen"}),
            encoding="utf-8",
        )
        execute = Path(python).absolute().with_name("jupyter-execute")
        for chapter in CHAPTERS:
            sh(f"JUPYTER_PATH={folder} {execute} --kernel_name=chosen {chapter}")


def start_lab(command: str) -> None:
    """Start JupyterLab, open its page, and look whether it brings what draws widgets."""
    with tempfile.TemporaryDirectory() as runtime:
        started = time.monotonic()
        as_root = " --allow-root" if os.geteuid() == 0 else ""
        process = subprocess.Popen(
            ["/bin/sh", "-c", f"{command} --no-browser --ip=127.0.0.1{as_root}"],
            cwd=ROOT,
            env=os.environ | {"JUPYTER_RUNTIME_DIR": runtime},
            start_new_session=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        try:
            page = read_page(Path(runtime), process, started + STARTS_WITHIN)
        finally:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        told(time.monotonic() - started, command)
    brought = {entry["name"] for entry in page["federated_extensions"]}
    if "anywidget" not in brought:
        raise SystemExit(f"JupyterLab runs, but cannot draw the course's widgets: {brought}")


def read_page(runtime: Path, process: subprocess.Popen[bytes], until: float) -> dict[str, Any]:
    """The configuration in JupyterLab's page, as soon as a server has said where it is."""
    while time.monotonic() < until and process.poll() is None:
        for path in runtime.glob("jpserver-*.json"):
            try:
                server = json.loads(path.read_text(encoding="utf-8"))
                url = f"{server['url']}lab?token={server['token']}"
                with urllib.request.urlopen(url, timeout=10) as answer:
                    html = answer.read().decode()
            except (OSError, ValueError):  # half written, or not listening yet
                continue
            (found,) = re.findall(r'(?s)<script id="jupyter-config-data"[^>]*>(.*?)</script>', html)
            page: dict[str, Any] = json.loads(found)
            return page
        time.sleep(0.2)
    os.killpg(process.pid, signal.SIGKILL)
    raise SystemExit(f"JupyterLab has not started:\n{process.communicate()[0].decode()[-3000:]}")


def sh(command: str) -> None:
    """Run a command as a terminal does, in the clone's folder; if it fails, stop with its words."""
    started = time.monotonic()
    done = subprocess.run(
        ["/bin/sh", "-c", command],
        cwd=ROOT,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        check=False,
    )
    told(time.monotonic() - started, command)
    if done.returncode != 0:
        said = done.stdout.decode(errors="replace")[-5000:]
        raise SystemExit(f"exit status {done.returncode}:\n{said}")


def told(seconds: float, command: str) -> None:
    """One line, and the commands below it where there are several."""
    print(f"{seconds:7.1f} s  " + command.replace("\n", "\n           "), flush=True)


if __name__ == "__main__":
    ways = {"codespaces": codespaces, "binder": binder, "readme": readme, "pip": pip}
    way = ways.get(sys.argv[1]) if len(sys.argv) == 2 else None
    if way is None:
        raise SystemExit(f"usage: {sys.argv[0]} {'|'.join(ways)}")
    way()
