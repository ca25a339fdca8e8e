"""The settings of a course, from ``[tool.autograder]`` in its pyproject.toml."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from autograder.course.toml_file import read_toml
from autograder.questions.author_tables import FieldError, Written
from autograder.questions.nearest_name import nearest
from autograder.questions.strict_reader import Place, read_table

_LARGEST = 1_000_000  # beyond all use, and within what timers and counters can take

Seconds = Annotated[float, Meta(gt=0, le=_LARGEST)]
Limit = Annotated[int, Meta(ge=1, le=_LARGEST)]


class Settings(Written, frozen=True, kw_only=True):
    """The limits on student code and on what is handed in."""

    submission_seconds: Seconds = 600.0  # all notebooks and questions of one student together
    notebook_seconds: Seconds = 120.0  # all cells of one notebook together
    cell_seconds: Seconds = 30.0
    question_seconds: Seconds = 20.0
    cpu_seconds: Limit = 130  # of a processor, in each process that student code runs in
    memory_mb: Limit = 1024  # beyond what the libraries need
    processes: Limit = 64  # threads count too
    files: Limit = 5000
    files_mb: Limit = 64  # what the student's code may write
    output_mb: Limit = 8  # what one response may come to
    submission_mb: Limit = 100
    submission_files: Limit = 2000
    # What notebooks may import beyond what the course itself does; loaded before anything runs.
    packages: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in self.packages:
            if not all(part.isidentifier() for part in name.split(".")):
                raise FieldError(
                    f"packages names {name!r}; give names as they are imported, such as "
                    'packages = ["pandas"]',
                    "packages",
                )


class WrittenSettings(Settings, frozen=True, kw_only=True):
    """The whole table: the limits, and how the course deals with variants and kinds."""

    kinds: tuple[str, ...] = ()  # packages of the kinds of question that it brings along
    variants: Literal["sheet", "student"] = "sheet"
    others_numbers: Literal["count", "nothing"] = "count"
    language: Literal["", "de", "en"] = ""  # of the sentences that are not the course's own

    @property
    def limits(self) -> Settings:
        """The limits alone."""
        return Settings(**{name: getattr(self, name) for name in Settings.__struct_fields__})


def changed_limits(settings: Settings) -> dict[str, int | float]:
    """The limits that are not the default ones, by their names."""
    return {
        field.name: getattr(settings, field.name)
        for field in msgspec.structs.fields(Settings)
        if isinstance(field.default, int | float) and getattr(settings, field.name) != field.default
    }


def setting_lines(root: Path) -> list[str]:
    """The table ``[tool.autograder]`` for a bundle: what the course at ``root`` has changed in it.

    All of it goes along: with other numbers, another language or other limits than the course's,
    students would see what the grader does not mean. Empty if the course has changed nothing.
    """
    settings = read_settings(root)
    lines = [
        f"{field.name} = {json.dumps(getattr(settings, field.name))}"
        for field in msgspec.structs.fields(settings)
        if getattr(settings, field.name) != field.default
    ]
    return ["[tool.autograder]", *lines] if lines else []


def read_settings(root: Path) -> WrittenSettings:
    """The settings of the course at ``root``; the defaults where it says nothing.

    Raises:
        CourseError: if the file cannot be read, or a setting is unknown or of a wrong type.
    """
    path = root / "pyproject.toml"
    if not path.exists():
        return WrittenSettings()
    text, table = read_toml(path, "")
    tools = table.get("tool", {})
    settings = tools.get("autograder", {}) if isinstance(tools, dict) else {}
    for name in tools if isinstance(tools, dict) and "autograder" not in tools else ():
        if nearest(name, ["autograder"]):
            place = Place(f"[tool.{name}] in {path}", text, ("tool", name))
            raise place.error("nobody reads this table; perhaps [tool.autograder] is meant")
    place = Place(f"[tool.autograder] in {path}", text, ("tool", "autograder"))
    return read_table(settings, WrittenSettings, place)
