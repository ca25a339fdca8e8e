"""What people read, in their language: gettext, with a catalog ``LANGUAGE.po`` in this folder.

``[tool.autograder] language`` says which language a course speaks. Where it says nothing, a
notebook follows the environment variable ``LANGUAGE``, as gettext does; grading does not, so that
all students read the same whoever grades. What has no translation stays English.
"""

from __future__ import annotations

import gettext
import io
import os
from functools import lru_cache
from pathlib import Path

from autograder.language.catalog import as_mo, read_po

__all__ = ["N_", "_", "chosen", "follow_environment", "languages", "n_", "use"]

_HERE = Path(__file__).parent
_state = {"course": "", "person": ""}


def use(language: str) -> None:
    """Speak the language of a course; empty if it says nothing."""
    _state["course"] = language


def follow_environment() -> None:
    """Where the course says nothing, speak the first language in ``LANGUAGE`` that is known."""
    wanted = os.environ.get("LANGUAGE", "").split(":")
    plain = [name.partition(".")[0].partition("_")[0] for name in wanted]
    _state["person"] = next((name for name in plain if name in languages()), "")


def chosen() -> str:
    """The language that is spoken, such as ``de``."""
    return _state["course"] or _state["person"] or "en"


@lru_cache(maxsize=1)
def languages() -> tuple[str, ...]:
    """The languages that are known: English, and those with a catalog."""
    return ("en", *sorted(path.stem for path in _HERE.glob("*.po")))


def _(sentence: str) -> str:
    """The sentence in the language that is spoken; fields in braces are filled in after that."""
    return _catalog(chosen()).gettext(sentence)


def n_(one: str, many: str, count: float) -> str:
    """The one or the other sentence, as the language has it for a count."""
    whole = int(count) if float(count).is_integer() else 2
    return _catalog(chosen()).ngettext(one, many, whole)


def N_(sentence: str) -> str:  # noqa: N802 -- gettext's name for it
    """The sentence as it is: it is translated where it is shown."""
    return sentence


@lru_cache(maxsize=8)
def _catalog(language: str) -> gettext.NullTranslations:
    path = _HERE / f"{language}.po"
    if not path.exists():
        return gettext.NullTranslations()
    return gettext.GNUTranslations(io.BytesIO(as_mo(read_po(path.read_text(encoding="utf-8")))))
