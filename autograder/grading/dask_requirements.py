"""What a Dask worker must be like to grade, and whether this one is."""

from __future__ import annotations

import os
import platform
from contextlib import suppress
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path

from autograder.course import Course
from autograder.course.read_course import find_course_root
from autograder.errors import AutograderError
from autograder.sandbox.launcher import Isolation

# What draws the hidden inputs and computes the expected results.
_LIBRARIES = ("numpy", "sympy", "opencv-python-headless")


@dataclass(frozen=True)
class Wanted:
    """What a worker must be like; ``parts`` are those of the isolation that was asked for."""

    root: str
    version: str
    software: dict[str, str]
    isolation: Isolation
    parts: tuple[str, ...]

    @property
    def name(self) -> str:
        """The same for the same wish: the name of the plugin and of the resource."""
        return f"autograder-{self.version}-{'+'.join(self.parts) or self.isolation}"


class Refused(AutograderError):
    """A worker is not what is wanted; the sentence says why."""


def software() -> dict[str, str]:
    """The versions of what a mark depends on besides the course and the autograder."""
    found = {"Python": ".".join(platform.python_version_tuple()[:2])}
    for name in _LIBRARIES:
        with suppress(PackageNotFoundError):
            found[name] = version(name)
    return found


def find_root(root: str) -> Path:
    """This worker's course: the one that it was started for, or the same place as elsewhere."""
    if "AUTOGRADER_COURSE" not in os.environ and Path(root).is_dir():
        return Path(root)
    return find_course_root()


_loaded: dict[Path, str] = {}


def compare(wanted: Wanted, course: Course) -> None:
    """Compare this worker with what is wanted.

    Raises:
        Refused: at the first difference.
    """
    if _loaded.setdefault(course.root, course.version) != course.version:
        # What was imported before stays in memory, whatever the files say now.
        raise Refused("it still holds an earlier version of the course; restart it")
    if course.version != wanted.version:
        raise Refused(
            f"its course in {course.root} or its autograder is another version "
            f"({course.version}, not {wanted.version}); bring both up to date there"
        )
    for name in course.settings.packages:
        if not find_spec(name.partition(".")[0]):
            raise Refused(f"it lacks the package {name} that the course allows; install it there")
    here = software()
    for name, expected in wanted.software.items():
        if here.get(name) != expected:
            raise Refused(
                f"it has {name} {here.get(name, 'missing')}, not {expected}, so marks could "
                "differ; install the same version there"
            )
