"""The kitchen with secrets, and sandboxes with limits tight enough for attacks to fail fast."""

from collections.abc import Iterator

import pytest
from attacks import LIMITS, PATIENT, SECRET, Lab, check_good

from autograder.course import Course
from autograder.sandbox.launcher import Sandbox, SandboxError, Session
from autograder.sandbox.tiers import best_tier
from tests.toy import make_toy


@pytest.fixture(scope="session")
def course(tmp_path_factory: pytest.TempPathFactory) -> Course:
    root = make_toy(tmp_path_factory.mktemp("course"), "kitchen").root
    for name, text in {
        "notebooks/__init__.py": "",
        "notebooks/figures.py": "import matplotlib.pyplot as plt\ndef draw():\n    plt.plot([1])\n",
        "notebooks/responses/kitchen.json": SECRET,
        "notebooks/1_kitchen.ipynb": SECRET,
        "data/__init__.py": "numbers = [1, 2, 3]\n",
        "solutions/fast/kitchen.py": f"answer = {SECRET!r}\n",
        "solutions/answers/secret.toml": SECRET,
        "grades/gradebook.db": SECRET,
    }.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    for path in (root, *root.rglob("*")):  # as open as can be: the sandbox must not rely on modes
        path.chmod(0o777)
    return Course(root, (), LIMITS)


@pytest.fixture(scope="session")
def started(course: Course) -> Iterator[dict[str, Sandbox]]:
    """The sandboxes that tests have asked for, by their isolation; none is started twice."""
    sandboxes: dict[str, Sandbox] = {}
    yield sandboxes
    for sandbox in sandboxes.values():
        sandbox.stop()


def start(started: dict[str, Sandbox], course: Course, isolation: str) -> Sandbox:
    if isolation not in started:
        started[isolation] = Sandbox(course, isolation=isolation, seed=1).__enter__()
    return started[isolation]


@pytest.fixture(params=["bubblewrap", "reduced"])
def sandbox(request: pytest.FixtureRequest, course: Course, started: dict[str, Sandbox]) -> Sandbox:
    """Each kind of isolation in turn.

    The fixture itself is of one test, so that pytest has nothing to end between one kind and the
    other: with one for all tests, each file would start both anew.
    """
    try:
        return start(started, course, request.param)
    except SandboxError as error:
        pytest.skip(f"{request.param} does not work on this machine: {error}")


@pytest.fixture(autouse=True)
def _little_grace(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in ("session", "conversation"):
        monkeypatch.setattr(f"autograder.sandbox.{module}.GRACE", 0.4)


@pytest.fixture
def session(sandbox: Sandbox) -> Iterator[Session]:
    with sandbox.session() as session:
        yield session


@pytest.fixture
def patient_session(sandbox: Sandbox) -> Iterator[Session]:
    with Session(sandbox._take_host, PATIENT, 1) as session:
        yield session


@pytest.fixture
def best_sandbox(course: Course, started: dict[str, Sandbox]) -> Sandbox:
    """For what does not depend on the kind of isolation."""
    return start(started, course, best_tier(course).name)


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
