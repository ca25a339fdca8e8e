"""One character for each meaning: what keyboards, text processors and web pages make of a sign.

No superscripts, fractions, wide or Arabic digits, Greek letters, and nothing that cannot be seen.
"""

from __future__ import annotations

import re
import unicodedata

from autograder.errors import UsageError
from autograder.language import N_, _

_SUPERSCRIPTS = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁽⁾", "0123456789+-()", strict=True))
_SIGNS = {
    **dict.fromkeys("⋅·×∗✕✖•∙⨯", "*"),
    **dict.fromkeys("÷∕⁄", "/"),
    **dict.fromkeys("–−—‒‐‑﹣", "-"),
    **dict.fromkeys("[{", "("),
    **dict.fromkeys("]}", ")"),
    "∶": ":",
    "∼": "~",
    "…": "…",  # not the three points that it folds to
    "′": "'",
    **dict.fromkeys("º˚", "°"),
    **dict.fromkeys("„“”«»‹›", '"'),
    "’": "'",
    "٫": ".",
    "⌈": " ceil(",
    "⌊": " floor(",
    "⌉": ")",
    "⌋": ")",
}
_GREEK = {
    chr(code): unicodedata.name(chr(code)).rpartition(" ")[2].lower()
    for code in (*range(0x3B1, 0x3C2), *range(0x3C3, 0x3CA))
} | {"λ": "lambda_", "ϕ": "phi", "ϑ": "theta", "ϵ": "epsilon", "Σ": "Sigma", "Δ": "Delta"}
ONE_NUMBER = ("\ue000", "\ue001")  # characters that nobody types
TWO_MEANINGS = N_("“{part}” has two meanings; write {one} or {other}.")
# Letters of other alphabets that look like ours, which nobody can tell apart on a screen.
_LOOK_ALIKES = str.maketrans(
    "асеорхуѕАВЕКМНОРСТХΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "aceopxysABEKMHOPCTXABEZHIKMNOPTYX"
)
# A power of ten whose small digits became large ones on their way through the clipboard.
_LOST_POWER = re.compile(
    r"(?<![\w.,])(\d+(?:[.,]\d+)?) ?[×⋅·∙•✕✖⨯xX] ?10[-−–—‒‐‑](\d{1,2})(?![\w.,])"
)
_WRAPPED = re.compile(r"\$\$?(.*?)\$?\$|\\\((.*)\\\)|\\\[(.*)\\\]|`+(.*?)`+", re.DOTALL)


def bare(text: str) -> str:
    """The text without what stands around a formula: dollars, an equals sign, a full stop."""
    text = "".join(sign for sign in text if unicodedata.category(sign) not in ("Cf", "Co")).strip()
    if found := _WRAPPED.fullmatch(text):
        text = "".join(filter(None, found.groups())).strip()
    text = re.sub(r"^=(?!=)\s*|(?<![=<>!])\s*=$", "", text)
    return re.sub(r"(?<![.…])\s*[.;,]$", "", text).strip()


def plain(text: str) -> str:
    """The text in the characters of a plain keyboard.

    Raises:
        UsageError: if a point, a fraction behind a number, or 10-2 behind a cross has two meanings.
    """
    text = text.translate(_LOOK_ALIKES).replace("...", "…").replace("+/-", "±")
    text = re.sub(r"(?<=\d)[٬'’](?=\d{3})", "'", text)
    if found := re.search(r"(?<![\w.,])0[·⋅∙•](\d+)", text):
        sentence = _(TWO_MEANINGS)
        raise UsageError(sentence.format(part=found[0], one=f"0.{found[1]}", other=f"0*{found[1]}"))
    if found := _LOST_POWER.search(text):
        one, other = f"{found[1]}*10^-{found[2]}", f"{found[1]}*10 - {found[2]}"
        raise UsageError(_(TWO_MEANINGS).format(part=found[0], one=one, other=other))
    text = _raised(text)
    made: list[str] = []
    for at, sign in enumerate(text):
        folded = unicodedata.normalize("NFKC", sign)
        if sign.strip() and not folded[:1].strip():
            folded = sign  # a dot or a stroke that would become a blank with a mark on it
        if "⁄" in folded and len(folded) > 1:  # one half, three quarters
            _add_fraction(made, folded.replace("⁄", "/"), text[:at])
        elif folded in _GREEK:
            made.append(_letter(_GREEK[folded], text[at - 1 : at], text[at + 1 : at + 2]))
        elif sign in _SIGNS:
            made.append(_SIGNS[sign])
        elif folded.isdecimal() and len(folded) == 1:
            made.append(str(unicodedata.decimal(folded)))
        else:
            made.append(_SIGNS.get(folded, folded) if sign.strip() else sign)
    return "".join(made)


def one_number(sum: str) -> str:
    """A number that takes a sign between to write: not to be parted, as a bracket could be."""
    return f"{ONE_NUMBER[0]}{sum}{ONE_NUMBER[1]}"


def _raised(text: str) -> str:
    """Superscripts as powers, and a fraction of small digits as a fraction."""
    inside = re.escape("".join(_SUPERSCRIPTS))
    text = re.sub(
        "([⁰¹²³⁴-⁹]+)[⁄/]([₀-₉]+)",
        lambda part: unicodedata.normalize("NFKC", one_number(f"{part[1]}/{part[2]}")),
        text,
    )
    return re.sub(
        rf"(?:\^|\*\*)?([{inside}]+)",
        lambda run: "**(" + "".join(_SUPERSCRIPTS[c] for c in run[1]) + ")",
        text,
    )


def _add_fraction(made: list[str], fraction: str, before: str) -> None:
    """½, and 1½ as one and a half."""
    found = re.search(r"[\d.,]*\d(\s*)$", before)
    number = found[0].strip() if found else ""
    if found and (found[1] or not number.isdigit()):
        one, other = f"{number} + {fraction}", f"{number}*{fraction}"
        sentence = _(TWO_MEANINGS)
        raise UsageError(sentence.format(part=f"{number} {fraction}", one=one, other=other))
    mixed = f"{number}+{fraction}" if number else fraction
    made[len(made) - len(number) :] = [one_number(mixed)]


def _letter(name: str, before: str, after: str) -> str:
    """A Greek letter by its name, apart from the name beside it, but with its index."""
    apart_before = "" if before == "_" else " "
    apart_after = "" if after == "_" or unicodedata.normalize("NFKC", after).isdigit() else " "
    return f"{apart_before}{name}{apart_after}"
