"""Reading a TOML file of the course, and saying what keeps one from being read."""

from __future__ import annotations

import errno
import tomllib
from pathlib import Path

from autograder.errors import AutograderError, CourseError, machine_error

# What to write where TOML stops reading, by how its sentence begins.
_CURES = {
    "Unescaped '\\'": r"; write two backslashes, as in \\alpha, or the text in single quotes",
    "Invalid hex value": r"; write two backslashes, as in \\upsilon, or the text in single quotes",
    "Invalid value": "; write a text in quotes, a number, true, false or a list in [...]",
    "Illegal character": "; a text in quotes ends on its line: close it, or use three quotes",
    "Unclosed array": "; close the list by ], and see that each of its texts has two quotes",
    "Cannot overwrite a value": "; this is there already: remove one of the two",
    "Cannot declare": "; this is there already: the tables of a list begin with [[...]] each",
    "Cannot mutate": "; this is there already: the tables of a list begin with [[...]] each",
    "Expected newline": "; write one name = value a line, and each text within two quotes",
    "Expected '='": "; write name = value",
}


def read_toml(path: Path, missing: str) -> tuple[str, dict[str, object]]:
    """A file's text, and what it says; ``missing`` is what to do where there is none.

    Raises:
        CourseError: if it is missing or is not TOML.
        AutograderError: if this machine keeps it from being read.
    """
    try:
        text = path.read_text(encoding="utf-8")
        if text.startswith("\ufeff"):  # pip and uv would not read it either
            raise CourseError(
                f"{path} begins with a byte order mark; save it as UTF-8 without one."
            )
        return text, tomllib.loads(text)
    except FileNotFoundError:
        raise CourseError(f"{path} is missing; {missing}.") from None
    except tomllib.TOMLDecodeError as error:
        said = str(error)
        cure = next((cure for begin, cure in _CURES.items() if said.startswith(begin)), "")
        raise CourseError(f"{path} cannot be read: {said}{cure}.") from None
    except UnicodeDecodeError as error:
        raise CourseError(f"{path} cannot be read: {error}; save it as UTF-8.") from None
    except OSError as error:
        raise unreadable(path, error) from None


def unreadable(path: Path, error: OSError) -> AutograderError:
    """What keeps a file of the course from being read: this machine, its permissions, its kind."""
    plain = CourseError(
        f"{path} cannot be read ({error.strerror or error}); make it a file that you may read."
    )
    return plain if error.errno in (errno.EACCES, errno.EPERM) else machine_error(error) or plain
