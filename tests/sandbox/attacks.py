"""What the tests of the sandbox share: limits, a good notebook, and helpers."""

from pathlib import Path
from typing import Any

from msgspec.structs import replace

from autograder.course import Settings
from autograder.sandbox.launcher import Sandbox, Session

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


NUMBER = {"inside": "autograder.kinds.number.inside.evaluate"}


GOOD = [
    "import math\nimport numpy as np\nk = math.ceil(math.log(1 - 0.95) / math.log(1 - 0.2**2))",
    "import data\nfrom notebooks import figures\nfigures.draw()",
    "def double(x):\n    return 2 * np.asarray(x)",
]


CASE = {"inside": "autograder.kinds.function.inside.evaluate", "cases": [{"args": [[1.0, 2.0]]}]}


def asked(session: Session, name: str, *arguments: object) -> dict[str, Any]:
    """Evaluate a function for one list of arguments."""
    return session.evaluate(
        name,
        {
            "inside": "autograder.kinds.function.inside.evaluate",
            "cases": [{"args": list(arguments)}],
        },
    )


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


def check_good(sandbox: Sandbox) -> None:
    # Patient, because the machine may be busy with other tests.
    with Session(sandbox._take_host, PATIENT, 1) as session:
        report = session.run(GOOD, ["k"])
        assert report["errors"] == [None] * 3
        assert report["understood"] == {"k": "74"}
        assert session.evaluate("k", NUMBER) == {"state": "given", "value": 74}
        (outcome,) = session.evaluate("double", CASE)["outcomes"]
        assert outcome["value"].tolist() == [2.0, 4.0]


def tree(folder: Path) -> dict[str, str]:
    return {
        str(path): path.read_text(errors="replace")
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
