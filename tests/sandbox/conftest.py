"""A small course and its sandboxes, with limits tight enough for attacks to fail fast."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from autograder.course import Course, Settings
from autograder.sandbox.launcher import Sandbox, SandboxError, Session

SECRET = "seventy-four-is-the-answer"
LIMITS = Settings(
    notebook_seconds=8,
    cell_seconds=1,
    question_seconds=1,
    memory_mb=300,
    processes=24,
    files=500,
    files_mb=8,
    output_mb=1,
)
PATIENT = replace(LIMITS, notebook_seconds=60, cell_seconds=30, question_seconds=30)
NUMBER = {"kind": "number"}
GOOD = [
    "import math\nimport numpy as np\nk = math.ceil(math.log(1 - 0.95) / math.log(1 - 0.2**2))",
    "import data\nfrom notebooks import figures\nfigures.draw()",
    "def double(x):\n    return 2 * np.asarray(x)",
]
CASE = {"kind": "function", "cases": [{"args": [[1.0, 2.0]]}]}


@pytest.fixture(scope="session")
def course(tmp_path_factory: pytest.TempPathFactory) -> Course:
    root = tmp_path_factory.mktemp("course")
    for name, text in {
        "notebooks/__init__.py": "",
        "notebooks/figures.py": "import matplotlib.pyplot as plt\ndef draw():\n    plt.plot([1])\n",
        "notebooks/questions/ransac.toml": "",
        "notebooks/responses/ransac.json": SECRET,
        "notebooks/3_ransac.ipynb": SECRET,
        "data/__init__.py": "numbers = [1, 2, 3]\n",
        "solutions/__init__.py": "",
        "solutions/ransac.py": f"answer = {SECRET!r}\n",
        "solutions/answers/ransac.toml": SECRET,
        "grades/gradebook.db": SECRET,
    }.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    for path in (root, *root.rglob("*")):  # as open as can be: the sandbox must not rely on modes
        path.chmod(0o777)
    return Course(root, (), LIMITS)


@pytest.fixture(scope="session", params=["bubblewrap", "reduced"])
def sandbox(request: pytest.FixtureRequest, course: Course) -> Iterator[Sandbox]:
    try:
        started = Sandbox(course, isolation=request.param, seed=1).__enter__()
    except SandboxError as error:
        pytest.skip(f"{request.param} does not work on this machine: {error}")
    yield started
    started.stop()


@pytest.fixture(autouse=True)
def _little_grace(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("autograder.sandbox.session.GRACE", 0.4)


@pytest.fixture
def session(sandbox: Sandbox) -> Iterator[Session]:
    with sandbox.session() as session:
        yield session


@pytest.fixture
def patient_session(sandbox: Sandbox) -> Iterator[Session]:
    with Session(sandbox._take_host, PATIENT, 1) as session:
        yield session


@pytest.fixture(scope="session")
def best_sandbox(course: Course) -> Iterator[Sandbox]:
    """For what does not depend on the kind of isolation."""
    with Sandbox(course, seed=1) as sandbox:
        yield sandbox


def asked(session: Session, name: str, *arguments: object) -> dict[str, Any]:
    """Evaluate a function for one list of arguments."""
    return session.evaluate(name, {"kind": "function", "cases": [{"args": list(arguments)}]})


class Lab:
    """Runs attacks."""

    def __init__(self, sandbox: Sandbox) -> None:
        self.sandbox = sandbox
        self.limits = replace(PATIENT, cell_seconds=5)

    def value(self, code: str, name: str = "found") -> str:
        """What an attack found, as its understood text."""
        return self.report(code, name)["understood"].get(name, "")

    def error(self, code: str) -> str | None:
        """The class of the error in which an attack ended."""
        error: str | None = self.report(code)["errors"][0]
        return error

    def report(self, code: str, *names: str) -> dict[str, Any]:
        with Session(self.sandbox._take_host, self.limits, 1) as session:
            return session.run([code], list(names))


@pytest.fixture
def lab(sandbox: Sandbox) -> Lab:
    return Lab(sandbox)


@pytest.fixture
def after_each_a_good_submission_gets_its_marks(sandbox: Sandbox) -> Iterator[None]:
    yield
    check_good(sandbox)


@pytest.fixture
def best_session(best_sandbox: Sandbox) -> Iterator[Session]:
    with best_sandbox.session() as session:
        yield session


@pytest.fixture
def after_each_a_good_submission_gets_its_marks_here(best_sandbox: Sandbox) -> Iterator[None]:
    yield
    check_good(best_sandbox)


def check_good(sandbox: Sandbox) -> None:
    # Patient, because the machine may be busy with other tests.
    with Session(sandbox._take_host, PATIENT, 1) as session:
        report = session.run(GOOD, ["k"])
        assert report == {"errors": [None] * 3, "responses": {}, "understood": {"k": "74"}}
        assert session.evaluate("k", NUMBER) == {"state": "given", "value": 74}
        (outcome,) = session.evaluate("double", CASE)["outcomes"]
        assert outcome["value"].tolist() == [2.0, 4.0]


def tree(folder: Path) -> dict[str, str]:
    return {
        str(path): path.read_text(errors="replace")
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
