"""A sentence in the language that is spoken; what has no translation stays English."""

from __future__ import annotations

import gettext
import io
from functools import lru_cache
from pathlib import Path

from autograder.language.catalog import as_mo, read_po
from autograder.language.which_language import chosen

_HERE = Path(__file__).parent


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
