"""Two courses in one process: each gets its own ``solutions`` and ``data``."""

from __future__ import annotations

from pathlib import Path

from autograder.course.loading import load_object


def course(root: Path, number: int) -> Path:
    for name in ("data", "solutions"):
        (root / name).mkdir(parents=True)
    (root / "data" / "__init__.py").write_text(f"NUMBER = {number}\n")
    (root / "solutions" / "__init__.py").write_text("")
    (root / "solutions" / f"only_{number}.py").write_text(
        "import data\n\n\ndef number():\n    return data.NUMBER\n"
    )
    return root


def test_each_course_loads_its_own_code_and_data(tmp_path: Path):
    one, two = course(tmp_path / "one", 1), course(tmp_path / "two", 2)
    for _ in range(2):
        assert load_object("solutions.only_1:number", one)() == 1
        assert load_object("solutions.only_2:number", two)() == 2


def test_a_function_stays_the_same_while_its_course_does(tmp_path: Path):
    one = course(tmp_path / "one", 1)
    assert load_object("solutions.only_1:number", one) is load_object(
        "solutions.only_1:number", one
    )


def test_a_course_in_the_folder_of_another_has_its_own_code_and_data(tmp_path: Path):
    one = course(tmp_path / "one", 1)
    inner = course(one / "examples" / "two", 2)
    for _ in range(2):
        assert load_object("solutions.only_2:number", inner)() == 2
        assert load_object("solutions.only_1:number", one)() == 1
