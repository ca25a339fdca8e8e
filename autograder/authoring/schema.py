"""JSON schemas of what authors write, so that an editor completes it and underlines mistakes.

They follow from the same types as the strict reader, so they never say anything else. Even Better
TOML (VS Code) and other editors built on taplo find them by the file ``.taplo.toml``.
"""

from __future__ import annotations

import inspect
import json
from collections.abc import Iterator

import msgspec

from autograder.course.folders import ANSWERS, QUESTIONS
from autograder.course.predictions import Prediction
from autograder.course.settings import WrittenSettings
from autograder.gradebook.read_grading_toml import WrittenScheme
from autograder.intake.class_list_tables import WrittenClass
from autograder.questions.author_tables import Written
from autograder.questions.registry import kind_named, kind_names

FOLDER = ".schemas"

_TAPLO = """# Editors built on taplo (Even Better TOML in VS Code) complete and check these files.
[[rule]]
include = ["{questions}/*.toml"]
[rule.schema]
path = "{folder}/questions.json"

[[rule]]
include = ["{answers}/*.toml"]
[rule.schema]
path = "{folder}/answers.json"

[[rule]]
include = ["**/class.toml"]
[rule.schema]
path = "{folder}/class.json"

[[rule]]
include = ["**/grading.toml"]
[rule.schema]
path = "{folder}/grading.json"

[[rule]]
include = ["pyproject.toml"]
[rule.schema]
path = "{folder}/settings.json"
"""


def schema_files() -> Iterator[tuple[str, str]]:
    """Each file's path within the course, and its text, for the kinds that are known by now."""
    yield f"{FOLDER}/questions.json", _text(questions_schema())
    yield f"{FOLDER}/answers.json", _text(answers_schema())
    yield f"{FOLDER}/class.json", _text(_schema_of(WrittenClass, "The class and the late policy"))
    yield f"{FOLDER}/grading.json", _text(_schema_of(WrittenScheme, "What counts after the exam"))
    yield f"{FOLDER}/settings.json", _text(settings_schema())
    yield (
        ".taplo.toml",
        _TAPLO.format(questions=QUESTIONS.as_posix(), answers=ANSWERS.as_posix(), folder=FOLDER),
    )


def questions_schema() -> dict[str, object]:
    """What may stand in a file of questions."""
    types = [kind_named(name).question_type for name in sorted(kind_names())]
    (*references, prediction), parts = msgspec.json.schema_components(
        [*types, Prediction], ref_template="#/$defs/{name}"
    )
    for name in (*(kind.__name__ for kind in types), Prediction.__name__):
        parts[name]["properties"].pop("chapter", None)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "The questions of a chapter",
        "type": "object",
        "properties": {
            "title": {"type": "string", "description": "the chapter's title"},
            "question": {"type": "array", "items": {"anyOf": references}},
            "prediction": {"type": "array", "items": prediction},
            "story": {
                "type": "object",
                "description": "numbers that questions share, by the story's name",
                "additionalProperties": parts[types[0].__name__]["properties"]["variables"],
            },
        },
        "required": ["title"],
        "additionalProperties": False,
        "$defs": parts,
    }


def answers_schema() -> dict[str, object]:
    """What may stand in a file of answers: for each question its key."""
    kinds = [kind_named(name) for name in sorted(kind_names())]
    types = [kind.answer_type for kind in kinds]
    (*references,), parts = msgspec.json.schema_components(types, ref_template="#/$defs/{name}")
    for kind in kinds:
        fields = parts[kind.answer_type.__name__]["properties"]
        fields.pop("id", None)
        alternative = fields["alternative"]["items"]["$ref"].rpartition("/")[2]
        for name in kind.formulas:  # of a question's variables, or plain values
            plain = parts[alternative]["properties"][name]
            parts[alternative]["properties"][name] = {"anyOf": [plain, {"type": "string"}]}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "The key to a chapter",
        "type": "object",
        "additionalProperties": {"anyOf": references},
        "$defs": parts,
    }


def settings_schema() -> dict[str, object]:
    """What may stand in a pyproject.toml: anything, but in ``[tool.autograder]`` only settings."""
    settings = _schema_of(WrittenSettings, "The settings of a course")
    parts = settings.pop("$defs")
    dialect = settings.pop("$schema")
    return {
        "$schema": dialect,
        "title": "A course's pyproject.toml",
        "type": "object",
        "properties": {"tool": {"type": "object", "properties": {"autograder": settings}}},
        "$defs": parts,
    }


def _schema_of(kind: type[Written], title: str) -> dict[str, object]:
    """The schema of a whole file; TOML's own dates are plain texts to the editors' validators."""
    (reference,), parts = msgspec.json.schema_components([kind], ref_template="#/$defs/{name}")
    for part in parts.values():
        for field in part.get("properties", {}).values():
            for form in (field, *field.get("anyOf", ())):
                if form.get("format") == "date-time":
                    del form["format"]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        "$ref": reference["$ref"],
        "$defs": parts,
    }


def _text(schema: dict[str, object]) -> str:
    return json.dumps(_cleaned(schema), indent=2, ensure_ascii=False) + "\n"


def _cleaned(part: object) -> object:
    """Descriptions without the indentation of docstrings, which newer Pythons remove themselves."""
    if isinstance(part, dict):
        return {
            name: inspect.cleandoc(inner)
            if name == "description" and isinstance(inner, str)
            else _cleaned(inner)
            for name, inner in part.items()
        }
    return [_cleaned(inner) for inner in part] if isinstance(part, list) else part
