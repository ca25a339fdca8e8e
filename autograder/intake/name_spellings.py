"""How systems write a person's name: either order, run together, with and without accents."""

from __future__ import annotations

import re
import unicodedata

_PARTICIPANTS = {
    *("participant", "teilnehmer in", "teilnehmerin", "teilnehmer", "participante"),
    *("partecipante", "deelnemer", "anon"),
}


def plain_name(name: str) -> str:
    """A name for comparing: one case, one space between words, no punctuation, accents kept.

    Letters that Unicode writes in two ways, and marks that only join or direct them, do not count.
    """
    text = unicodedata.normalize("NFKC", name).casefold()
    text = "".join(c for c in text if unicodedata.category(c) != "Cf")
    text = unicodedata.normalize("NFC", text)
    return " ".join(re.sub(r"(?:[^\w]|_)+", " ", text).split())


def is_anonymous(name: str) -> bool:
    """Whether a system gave the name because names are hidden from markers."""
    return plain_name(name) in _PARTICIPANTS


def spellings(name: str) -> set[str]:
    """The ways in which systems write a name: both orders, and run together as Canvas does."""
    ways = {name, first_name_first(name)}
    if "," not in name:
        # The family name is not marked: any cut may be the right one.
        words = plain_name(name).split()
        ways |= {" ".join(words[n:] + words[:n]) for n in range(1, len(words))}
    plain = {plain_name(way) for way in ways}
    plain |= {way.replace(" ", "") for way in plain}
    return plain - {""}


def first_name_first(name: str) -> str:
    """``Lovelace, Ada`` as ``Ada Lovelace``."""
    last, _, first = (part.strip() for part in name.partition(","))
    return f"{first} {last}".strip()


def without_accents(name: str) -> str:
    """The name with ``é`` as ``e``; what Unicode does not take apart, such as ``ø``, stays."""
    text = unicodedata.normalize("NFKD", name)
    return "".join(c for c in text if not unicodedata.combining(c))


def bare_letters(name: str) -> str:
    """The letters alone: Moodle leaves the apostrophe out of ``Seán O'Brien``, with no space."""
    return without_accents(name).replace(" ", "")


# Letters that Unicode does not take apart.
_TYPED = str.maketrans({"ł": "l", "ø": "o", "đ": "d", "ı": "i", "æ": "a", "œ": "o", "ð": "d"})


def typed_letters(name: str) -> str:
    """The letters as one types them on another keyboard: enough to suggest a person, no more.

    ``Joerg Mueller`` and ``Jorg Muller`` have those of Jörg Müller, ``Lukasz`` those of Łukasz.
    """
    return re.sub("(?<=[aou])e", "", bare_letters(plain_name(name).translate(_TYPED)))
