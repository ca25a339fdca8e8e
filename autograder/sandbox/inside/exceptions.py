"""What can be told of an exception to the student who wrote the code: words and the line.

This runs where the student's code runs. It is asked only before anything hidden has been sent
there, so a message carries nothing that students may not see.
"""

from __future__ import annotations

import ast
import traceback

from autograder.exchange.messages import Message

MOST_MESSAGE = 300
_CELLS = ("<ipython-input", "ipykernel")
_TOP = ("<module>", "<cell line")  # IPython 7 calls a cell's own code by its first line


def tell(error: BaseException) -> Message:
    """The message, and the last line of a cell on the way to the error with its number."""
    told: dict[str, object] = {"kind": type(error).__name__, "message": _message(error)}
    if isinstance(error, NotImplementedError) and not told["message"]:
        told["message"] = _what_is_not_written(error)
    if isinstance(error, ModuleNotFoundError) and isinstance(error.name, str):
        told["module"] = error.name[:100]
    if isinstance(error, SyntaxError):
        told |= {"line": error.lineno or 0, "source": _short(error.text)}
        return told
    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        if any(name in frame.filename for name in _CELLS):
            told |= {"line": frame.lineno or 0, "source": _short(frame.line)}
            break
    return told


def after_import(code: str, error: BaseException) -> str | None:
    """What is left to run of a cell whose import failed, each line where it was; else None.

    ``code`` is Python, without magics. Names beside the missing one in the same statement are
    imported; what needs the missing one will say so itself.
    """
    if not isinstance(error, ModuleNotFoundError):
        return None
    lines = [
        frame.lineno
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.name.startswith(_TOP) and any(name in frame.filename for name in _CELLS)
    ]
    try:
        statements = ast.parse(code).body
    except (SyntaxError, ValueError, RecursionError):
        return None
    for statement in statements:
        if not (lines and statement.lineno <= (lines[0] or 0) <= (statement.end_lineno or 0)):
            continue
        if not isinstance(statement, ast.Import | ast.ImportFrom):
            return None
        rest = code.splitlines()[statement.end_lineno :]
        others = ""
        if isinstance(statement, ast.Import):
            others = "; ".join(
                ast.unparse(ast.Import([alias]))
                for alias in statement.names[_failed(statement, error) + 1 :]
            )
        return "\n" * ((statement.end_lineno or 1) - 1) + "\n".join([others, *rest])
    return None


def _failed(statement: ast.Import, error: ModuleNotFoundError) -> int:
    """Which of the names that a statement imports is missing; the last, if that is not clear."""
    for position, alias in enumerate(statement.names):
        if error.name and f"{alias.name}.".startswith(f"{error.name}."):
            return position
    return len(statement.names) - 1


def _what_is_not_written(error: BaseException) -> str:
    """Which function is still a stub: the last line alone would not say whose it is."""
    frames = traceback.extract_tb(error.__traceback__)
    if not frames or frames[-1].name.startswith(_TOP):
        return ""
    return _short(f"{frames[-1].name} is not written yet")


def _message(error: BaseException) -> str:
    try:
        return _short(str(error), MOST_MESSAGE)
    except BaseException:
        return ""


def _short(text: object, most: int = 200) -> str:
    return text.strip()[:most] if isinstance(text, str) else ""
