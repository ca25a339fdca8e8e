"""The version of a course is another one when a mark could be, and only then."""

import json
import shutil

import pytest

from autograder.course import load_course


@pytest.mark.parametrize(
    ("file", "changes"),
    [
        ("notebooks/questions/kitchen.toml", True),
        ("solutions/answers/cellar.toml", True),
        ("solutions/kitchen.py", True),
        ("notebooks/source/1_kitchen.py", False),
        ("notebooks/figures/plots.py", True),
        ("data/scan.csv", True),
        ("data/deep/inside.bin", True),
        ("data/__pycache__/inside.pyc", False),
        ("notebooks/responses/kitchen.json", False),
        ("README.md", False),
    ],
)
def test_the_version_changes_with_everything_that_can_change_a_mark(toy, file, changes):
    (toy.root / file).parent.mkdir(parents=True, exist_ok=True)
    toy.append(file, "\n# a file\n")
    before = toy.load().version
    assert toy.load().version == before
    toy.append(file, "\n# a remark\n")
    assert (toy.load().version != before) == changes


def test_the_version_changes_with_the_settings_and_the_demo_cells(toy):
    toy.write_notebooks()
    before = toy.load().version
    toy.set("question_seconds = 21")
    slower = toy.load().version
    assert slower != before
    toy.append("pyproject.toml", "\n[tool.other]\nname = 1\n")
    assert toy.load().version == slower
    book = toy.root / "notebooks/1_kitchen.ipynb"
    document = json.loads(book.read_text())
    document["cells"][1]["metadata"]["tags"] = ["demo"]
    book.write_text(json.dumps(document))
    assert toy.load().version != slower


def test_the_version_changes_with_the_autograder_that_marks_and_not_with_its_reports(
    toy, tmp_path, monkeypatch
):
    from autograder.course import course_version

    package = tmp_path / "autograder"
    for folder in ("marking", "reports"):
        (package / folder).mkdir(parents=True)
        (package / folder / "it.py").write_text("one = 1")
    monkeypatch.setattr(course_version, "_PACKAGE", package)
    before = toy.load().version
    (package / "reports/it.py").write_text("two = 2")
    assert toy.load().version == before
    (package / "marking/it.py").write_text("two = 2")
    assert toy.load().version != before


def test_the_version_is_that_of_another_checkout(toy, tmp_path):
    (toy.root / "data").mkdir()
    (toy.root / "data/scan.csv").write_text("1, 2")
    copy = tmp_path / "elsewhere"
    shutil.copytree(toy.root, copy, copy_function=shutil.copyfile)
    assert load_course(copy).version == toy.load().version
