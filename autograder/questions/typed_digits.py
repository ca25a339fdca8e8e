"""Numbers as people write them: groups of thousands, decimal commas, percentages.

``499 500``, ``0,18`` and ``1.234,56`` say plainly what is meant; ``1,500`` and ``log(8,2)`` do not.
"""

from __future__ import annotations

import re

from autograder.errors import UsageError
from autograder.language import _
from autograder.questions.typed_characters import TWO_MEANINGS

_SPACE = "[ \u00a0\u2007\u2009\u202f]"
_NUMBER = r"(?:\d+\.?\d*|\.\d+)"
_ALONE = r"(?<![\w.,])"  # not within a name or another number
_WITH_COMMAS = re.compile(r"(?<!\w)(?:\d[\d.]*(?:,\d[\d.]*)+(?![\d,])|\d+(?:\.\d+){2,})")
_TWO_ARGUMENTS = ("atan2", "arctan2", "comb", "perm", "binom", "binomial", "C", "nCr", "pow")
_PERCENT = r"[Pp]rozent|per ?cent|pct|p\.c\."
_ONE_OR_TWO = ("log", "round")
_CALLS = re.compile(r"([^\W\d]\w*)\s*(?:(?:\^|\*\*)\s*(?:[\w-]+|\([\w-]*\)))?\s*$")


def numbers_in_full(text: str) -> str:
    """The text with a point for the decimals of its numbers and nothing else within them.

    Raises:
        UsageError: at a number that has two meanings or is none; the sentence says what to write.
    """
    text = re.sub(rf"{_ALONE}\d+(?:_\d+)+(?!\w)", lambda found: found[0].replace("_", ""), text)
    grouped = rf"{_ALONE}\d{{1,3}}(?:(?:{_SPACE}|')\d{{3}})+(?![\w'])"
    text = re.sub(grouped, lambda found: re.sub(rf"{_SPACE}|'", "", found[0]), text)
    if side := re.search(rf"{_ALONE}\d(?:[\d.,]*[\d.])?{_SPACE}+[.,]?\d[\d.,]*", text):
        sentence = _("Two numbers stand side by side at “{part}”; write the sign between.")
        raise UsageError(sentence.format(part=side[0]))
    text = _without_commas(re.sub(rf"{_ALONE}0+(?=\d)", "", text))
    if found := re.search(r"(?<!\w)\d*\.\d*\.[\d.]*", text):
        sentence = _("“{part}” has more than one point: write a number with one, such as 0.5.")
        raise UsageError(sentence.format(part=found[0]))
    _refuse_what_is_said_twice(text)
    return _percentages(text)


def _without_commas(text: str) -> str:
    """Commas that belong to numbers as points, or gone; those between arguments stay."""
    if re.search(r"\([^()]*;", text):  # atan2(0,5; 1)
        text = re.sub(r"(?<=\d),(?=\d)", ".", text).replace(";", ",")
    made, at = "", 0
    for found in _WITH_COMMAS.finditer(text):
        made += text[at : found.start()]
        before, after = text[: found.start()], text[found.end() :]
        called = _called(before)
        pair = before.endswith("(") and after.startswith(")") and not called
        made += found[0] if pair else _number(found[0], called)
        at = found.end()
    return made + text[at:]


def _called(before: str) -> str:
    """The function in whose brackets the text ends, if any."""
    depth = 0
    for at in range(len(before) - 1, -1, -1):
        depth += (before[at] == ")") - (before[at] == "(")
        if depth < 0:
            found = _CALLS.search(before[:at])
            return found[1] if found else ""
    return ""


def _number(part: str, called: str) -> str:
    """What digits with commas and points mean as the argument of a function, or in none."""
    if called.lower() in map(str.lower, _TWO_ARGUMENTS):
        return part
    if re.fullmatch(r"\d{1,3}(,\d{3})+\.\d+|[1-9]\d{0,2}(,\d{3}){2,}", part):
        return part.replace(",", "")
    if re.fullmatch(r"\d{1,3}(\.\d{3})+,\d+|[1-9]\d{0,2}(\.\d{3}){2,}", part):
        return part.replace(".", "").replace(",", ".")
    whole, _comma, rest = part.partition(",")
    if "." in part or "," in rest:
        return part
    point = f"{whole}.{rest}"
    if called.lower() in _ONE_OR_TWO and whole != "0" and not re.match(r"0\d", rest):
        one, other = f"{called}({point})", f"{called}({whole}, {rest})"
    elif len(rest) == 3 and re.fullmatch(r"[1-9]\d{0,2}", whole):
        one, other = whole + rest, point
    else:
        return point
    raise UsageError(_(TWO_MEANINGS).format(part=part, one=one, other=other))


def _refuse_what_is_said_twice(text: str) -> None:
    """``0.18 (18 %)`` and ``74 (73.4)`` are no products."""
    twice = rf"{_ALONE}{_NUMBER}(?:\s*\(\s*{_NUMBER}\s*%\s*\)|\s+\(\s*{_NUMBER}\s*\))"
    if found := re.search(twice, text):
        sentence = _("“{part}” has two meanings: write one value, or * for a product.")
        raise UsageError(sentence.format(part=found[0]))


def without_percent(text: str) -> str:
    """A number without the percent sign or word behind it, where the unit says so already."""
    return re.sub(rf"\s*(?:%|{_PERCENT})$", "", text)


def _percentages(text: str) -> str:
    text = re.sub(rf"(?<=\d)\s*(?:{_PERCENT})(?!\w)", " %", text)
    text = re.sub(rf"{_ALONE}({_NUMBER})\s*‰", r"(\1/1000)", text)
    behind = rf"(?<![\w.^])(?<!\^-)(?<!\*\*)(?<!\*\*-)(?P<n>{_NUMBER})\s*%(?=\s*(?:$|[-+)*/,]))"
    text = re.sub(behind, r"(\g<n>/100)", text)
    if "%" in text:
        raise UsageError(_("“%” is understood only behind a number, such as 18 %; write 0.18."))
    return text
