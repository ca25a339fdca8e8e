"""The rooms of the engine: who may import whom, and where the wall to student code stands.

The order of the rooms is written down in CONTRIBUTING, and nowhere else.
"""

import ast
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
ENGINE = ROOT / "autograder"


def written_order() -> list[str]:
    """The rooms from the lowest up, as CONTRIBUTING lists them."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    table = text.partition("## Rooms")[2].partition("\n## ")[0]
    return re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE)


def room_of(module: str) -> str | None:
    """The room of a dotted name: a folder of the engine, or a single module at its root."""
    parts = module.split(".")
    if parts[0] != "autograder" or len(parts) == 1:
        return None
    return parts[1]


def imported(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: write the import out"
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def modules() -> dict[str, Path]:
    return {
        ".".join(path.relative_to(ROOT).with_suffix("").parts): path
        for path in sorted(ENGINE.rglob("*.py"))
        if "template" not in path.parts  # what `autograder new` copies is another course's
    }


def is_inside(path: Path) -> bool:
    """Whether a file runs beside the student: it lies in a folder ``inside``."""
    return "inside" in path.relative_to(ENGINE).parts


def test_every_folder_is_a_room_with_a_place_in_the_order():
    folders = {path.parent.name for path in ENGINE.glob("*/__init__.py")}
    assert {*folders, "errors"} == set(written_order())


def test_few_modules_lie_at_the_root():
    assert len(list(ENGINE.glob("*.py"))) <= 5


def test_every_import_between_rooms_runs_down():
    """Then there is no circle either."""
    height = {room: position for position, room in enumerate(written_order())}
    up = [
        f"{module} imports {name}"
        for module, path in modules().items()
        for name in imported(path)
        if (here := room_of(module)) in height
        and (there := room_of(name)) in height
        and here != there
        and height[there] > height[here]
    ]
    assert up == []


def test_an_arrow_that_runs_up_would_be_noticed(tmp_path):
    path = tmp_path / "x.py"
    path.write_text("def f():\n    from autograder.cli.grade import run\n")
    assert [room_of(name) for name in imported(path)] == ["cli"]
    assert room_of("autograder.kinds.number.marking") == "kinds"
    assert room_of("autograder.questions.mark") == "questions"


@pytest.mark.parametrize("room", ["exchange"])
def test_what_crosses_knows_no_policy(room):
    for path in (ENGINE / room).glob("*.py"):
        ours = {name for name in imported(path) if name.startswith("autograder.")}
        assert {room_of(name) for name in ours} <= {room, "errors", "language"}, path


def test_what_runs_beside_the_student_imports_nothing_that_knows_the_key():
    """Only what crosses, what isolates, the questions, and itself."""
    allowed = {"errors", "exchange", "language", "sandbox"}
    for module, path in modules().items():
        if not is_inside(path):
            continue
        for name in imported(path):
            if not name.startswith("autograder."):
                continue
            itself = ".inside" in name or name == "autograder.questions.typed_text"
            asked = ".question." in name or name == "autograder.course.load_course"
            parser = name.startswith("autograder.questions.typed_text.")
            assert room_of(name) in allowed or itself or asked or parser, (module, name)


def test_the_sandbox_isolates_and_does_nothing_else():
    """It knows neither questions nor marks; that is for those who use it."""
    for path in (ENGINE / "sandbox").glob("*.py"):
        rooms = {room_of(name) for name in imported(path)} - {None}
        assert rooms <= {"sandbox", "exchange", "course", "errors", "language"}, path


def test_the_wheel_has_every_room():
    """It names them one by one, and a room that it lacks is missed only where it is installed."""
    project = tomllib.loads((ENGINE / "pyproject.toml").read_text(encoding="utf-8"))
    wheel = project["tool"]["hatch"]["build"]["targets"]["wheel"]
    rooms = sorted(path.parent.name for path in ENGINE.glob("*/__init__.py"))
    assert sorted(wheel["only-include"]) == rooms
    assert wheel["sources"] == {room: f"autograder/{room}" for room in rooms}
