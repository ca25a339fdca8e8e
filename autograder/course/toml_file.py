"""Reading a TOML file of the course, and saying what keeps one from being read."""

from __future__ import annotations

import errno
import tomllib
from pathlib import Path

from autograder.errors import AutograderError, CourseError, machine_error


def read_toml(path: Path, missing: str) -> tuple[str, dict[str, object]]:
    """A file's text, and what it says; ``missing`` is what to do where there is none.

    Raises:
        CourseError: if it is missing or is not TOML.
        AutograderError: if this machine keeps it from being read.
    """
    try:
        text = path.read_text(encoding="utf-8")
        return text, tomllib.loads(text)
    except FileNotFoundError:
        raise CourseError(f"{path} is missing; {missing}.") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise CourseError(f"{path} cannot be read: {error}.") from None
    except OSError as error:
        raise unreadable(path, error) from None


def unreadable(path: Path, error: OSError) -> AutograderError:
    """What keeps a file of the course from being read: this machine, its permissions, its kind."""
    plain = CourseError(
        f"{path} cannot be read ({error.strerror or error}); make it a file that you may read."
    )
    return plain if error.errno in (errno.EACCES, errno.EPERM) else machine_error(error) or plain
