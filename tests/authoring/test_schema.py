"""The schemas for editors say what the strict reader says."""

from __future__ import annotations

import inspect
import json
import tomllib
from pathlib import Path

import jsonschema
import pytest

from autograder.authoring.schema import answers_schema, questions_schema, schema_files
from autograder.cli import main

ROOT = Path(__file__).parents[2]
ANSWERS = sorted((ROOT / "solutions/answers").glob("*.toml"))
QUESTIONS = sorted((ROOT / "notebooks/questions").glob("*.toml"))


@pytest.fixture(scope="module")
def questions() -> jsonschema.Draft202012Validator:
    jsonschema.Draft202012Validator.check_schema(questions_schema())
    return jsonschema.Draft202012Validator(questions_schema())


@pytest.fixture(scope="module")
def answers() -> jsonschema.Draft202012Validator:
    jsonschema.Draft202012Validator.check_schema(answers_schema())
    return jsonschema.Draft202012Validator(answers_schema())


def test_this_course_fits_its_schemas(questions, answers):
    for path in QUESTIONS:
        questions.validate(tomllib.loads(path.read_text(encoding="utf-8")))
    for path in ANSWERS:
        answers.validate(tomllib.loads(path.read_text(encoding="utf-8")))


@pytest.mark.parametrize("change", [{"pionts": 1}, {"points": -1}, {"hints": []}, {"id": "one"}])
def test_an_editor_underlines_what_the_reader_refuses(questions, change):
    table = tomllib.loads(QUESTIONS[-1].read_text(encoding="utf-8"))
    table["question"] = [entry for entry in table["question"] if entry["kind"] == "number"]
    questions.validate(table)
    table["question"][0].update(change)
    assert not questions.is_valid(table)


def test_no_author_writes_what_the_files_name_says(questions, answers):
    assert not questions.is_valid({"title": "t", "question": [{"id": "Q1", "chapter": "c"}]})
    right = {"alternative": [{"name": "right", "credit": 1, "value": 2}]}
    assert answers.is_valid({"Q1": right})
    assert not answers.is_valid({"Q1": {**right, "id": "Q1"}})


def schema_named(name: str) -> jsonschema.Draft202012Validator:
    schema = json.loads(dict(schema_files())[f".schemas/{name}.json"])
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def test_settings_the_class_and_the_grading_have_schemas_as_well():
    settings = schema_named("settings")
    settings.validate(tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8")))
    assert not settings.is_valid({"tool": {"autograder": {"memory_bm": 300}}})
    assert not settings.is_valid({"tool": {"autograder": {"variants": "students"}}})
    listed = schema_named("class")
    listed.validate({"late": {"due": "2026-11-20T23:59:00"}, "student": [{"name": "Ada", "id": 3}]})
    assert not listed.is_valid({"student": [{"id": 3}]})
    assert not listed.is_valid({"late": {"due": "2026-11-20T23:59:00", "percent_a_day": 120}})
    grading = schema_named("grading")
    grading.validate({"dropped": ["Q1"], "curve": {"add": 2.0}})
    assert not grading.is_valid({"droped": ["Q1"]})


def test_the_files_of_this_course_are_up_to_date():
    for name, text in schema_files():
        assert (ROOT / name).read_text(encoding="utf-8") == text, f"run autograder schema: {name}"


def test_the_command_writes_them_and_says_when_they_are_old(toy, capsys):
    root = str(toy.root)
    assert main(["--course", root, "schema", "--check"]) == 1
    assert "Run autograder schema" in capsys.readouterr().out
    assert main(["--course", root, "schema"]) == 0
    assert main(["--course", root, "schema", "--check"]) == 0


def test_descriptions_are_the_same_on_every_python():
    """Some keep the indentation of docstrings, newer ones remove it."""
    texts = [text for name, text in schema_files() if name.endswith(".json")]
    described = [
        part["description"]
        for text in texts
        for part in json.loads(text)["$defs"].values()
        if "description" in part
    ]
    assert any("\n" in one for one in described)
    assert [one for one in described if one != inspect.cleandoc(one)] == []
