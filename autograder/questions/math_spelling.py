"""What people type, in the spelling that the reader of formulas knows.

``N(N-1)/2``, ``2 sin²(α)``, ``499 500`` and ``18 %`` say plainly what is meant, so they are read;
``1/2x`` and ``1,500`` do not, so they are refused with the spellings that would be plain.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection
from typing import NamedTuple

from autograder.errors import UsageError
from autograder.language import N_, _

_SUPERSCRIPTS = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁽⁾", "0123456789+-()", strict=True))
_SIGNS = {
    **dict.fromkeys("⋅·×∗✕✖•∙", "*"),
    **dict.fromkeys("÷∕⁄", "/"),
    **dict.fromkeys("–−—‒‐‑﹣", "-"),
    **dict.fromkeys("[{", "("),
    **dict.fromkeys("]}", ")"),
}
# What is not read, and what to write for it.
_INSTEAD = {
    "|": N_("abs(x) for |x|"),
    "!": N_("the product, or comb(n, k)"),
    ":": N_("/ for a division"),
    ";": N_("a comma between arguments"),
    "∞": N_("a finite number"),
    "∑": N_("the sum itself"),
    "∫": N_("the integral itself"),
    "≈": N_("only the value"),
    "≤": N_("only the value"),
    "≥": N_("only the value"),
    "€": N_("only the number, without a unit"),
    "$": N_("only the number, without a unit"),
    "°": N_("the angle in radians, such as 30*pi/180"),
    "±": N_("one of the two"),
}
_GREEK = {
    chr(code): unicodedata.name(chr(code)).rpartition(" ")[2].lower()
    for code in (*range(0x3B1, 0x3C2), *range(0x3C3, 0x3CA))
} | {"λ": "lambda_", "ϕ": "phi", "ϑ": "theta", "ϵ": "epsilon", "Σ": "Sigma", "Δ": "Delta"}
_SAME = {
    "arcsin": "asin", "arccos": "acos", "arctan": "atan", "arctg": "atan", "arctan2": "atan2",
    "ln": "log", "tg": "tan", "lb": "log2", "Abs": "abs", "absolute": "abs", "fabs": "abs",
    "wurzel": "sqrt", "ceiling": "ceil", "binom": "comb", "binomial": "comb", "nCr": "comb",
}  # fmt: skip
_INVERSE = {"sin": "asin", "cos": "acos", "tan": "atan"}
_MODULES = ("np", "numpy", "sp", "sympy", "math", "scipy.special")
_SPACE = "[ \u00a0\u2007\u2009\u202f]"
_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[^\W\d]\w*)|(?P<sign>\*\*|\S))"
)

_MODULE = rf"(?<![\w.])(?:{'|'.join(map(re.escape, _MODULES))})\.(?=[^\W\d])"
# A string, an assignment, an attribute, an index: Python, and no mathematics.
_CODE = re.compile(r"[=\"]|\blambda\b|__|\]\[|(?<!\d)'|'(?!\d{3})|[^\W\d]\w*\.[^\W\d]")


class _Token(NamedTuple):
    kind: str
    text: str


def is_code(text: str) -> bool:
    """Whether it is Python rather than mathematics, so that the parser has to say what is wrong."""
    return bool(_CODE.search(re.sub(_MODULE, "", text)))


def spelt(text: str, functions: Collection[str]) -> str:
    """The text as arithmetic with ``*`` for every product, of the functions' own names.

    What is neither plain nor refused here is left to the parser.

    Raises:
        UsageError: if it has two meanings, or a sign that is not read; the sentence says what to
            write.
    """
    text = _characters(text)
    text = _numbers(text)
    for sign, instead in _INSTEAD.items():
        if sign in text:
            sentence = _("“{sign}” is not understood here; write {instead}.")
            raise UsageError(sentence.format(sign=sign, instead=_(instead)))
    return _products(_tokens(text), functions)


def _characters(text: str) -> str:
    """One character for each meaning: no superscripts, fractions, wide digits, Greek letters."""
    inside = "".join(_SUPERSCRIPTS)
    text = re.sub(
        f"[{re.escape(inside)}]+",
        lambda run: "**(" + "".join(_SUPERSCRIPTS[c] for c in run[0]) + ")",
        text,
    )
    made = []
    for at, sign in enumerate(text):
        folded = unicodedata.normalize("NFKC", sign)
        if "⁄" in folded and len(folded) > 1:  # one half, three quarters
            mixed = at > 0 and text[at - 1].isdigit()
            made.append(f"{'+' if mixed else ''}({folded.replace('⁄', '/')})")
            if mixed:  # 1½ is one and a half
                start = len(made) - 2
                while start > 0 and made[start - 1].isdigit():
                    start -= 1
                made[start:] = ["(", *made[start:], ")"]
        elif sign in _GREEK:
            made.append(f" {_GREEK[sign]} ")
        elif sign in _SIGNS:
            made.append(_SIGNS[sign])
        else:
            made.append(_SIGNS.get(folded, folded) if sign.strip() else sign)
    return "".join(made)


def _numbers(text: str) -> str:
    """Groups of thousands joined, percentages as fractions."""
    grouped = rf"(?<![\d.,])\d{{1,3}}(?:(?:{_SPACE}|['’])\d{{3}})+(?![\d])"
    text = re.sub(grouped, lambda found: re.sub(rf"{_SPACE}|['’]", "", found[0]), text)
    if side := re.search(rf"\d{_SPACE}+\.?\d", text):
        sentence = _("Two numbers stand side by side at “{part}”; write the sign between.")
        raise UsageError(sentence.format(part=side[0]))
    if "(" not in text:
        if re.search(r"(?<![\d.,])\d{1,3}(,\d{3}){2,}(?![\d,])", text):
            text = re.sub(r",(?=\d{3})", "", text)
        elif found := re.search(r"(?<![\d.,])([1-9]\d{0,2}),(\d{3})(?![\d,.])", text):
            whole, point = found[1] + found[2], f"{found[1]}.{found[2]}"
            sentence = _("“{part}” has two meanings; write {one} or {other}.")
            raise UsageError(sentence.format(part=found[0], one=whole, other=point))
    percent = r"(?P<n>(?:\d+\.?\d*|\.\d+))\s*%(?=\s*(?:$|[-+)*/,]))"
    text = re.sub(percent, r"(\g<n>/100)", text)
    if "%" in text:
        raise UsageError(_("“%” is understood only behind a number, such as 18 %; write 0.18."))
    return text


def _tokens(text: str) -> list[_Token]:
    text = text.replace("^", "**").replace("√", " sqrt ")
    text = re.sub(_MODULE, "", text)
    tokens = [
        _Token(str(found.lastgroup), found[str(found.lastgroup)]) for found in _TOKEN.finditer(text)
    ]
    return [
        _Token("name", _SAME[token.text]) if token.kind == "name" and token.text in _SAME else token
        for token in tokens
    ]


def _products(tokens: list[_Token], functions: Collection[str]) -> str:
    """The text again, with a ``*`` where one factor follows another."""
    made: list[str] = []
    at = 0
    divided = False  # whether the factor before is what something is divided by
    while at < len(tokens):
        token = tokens[at]
        calls = token.kind == "name" and token.text in functions
        if made and _ends_a_factor(made[-1], functions) and _begins_a_factor(token):
            if divided:
                sentence = _(
                    "“{part}” has two meanings: put what you divide by in brackets, or write the "
                    "sign between."
                )
                raise UsageError(sentence.format(part=f"/ {made[-1]}{token.text}"))
            made.append("*")
        if calls:
            text, at = _call(tokens, at, functions)
            divided = bool(made) and made[-1] == "/"
            made.append(text)
            continue
        if token.kind != "sign":
            divided = bool(made) and made[-1] == "/"
        elif token.text == "(":
            inside, at = _bracket(tokens, at)
            divided = bool(made) and made[-1] == "/"
            made.append(f"({_products(inside, functions)})")
            continue
        elif token.text != "**":
            divided = False
        made.append(token.text)
        at += 1
    return " ".join(made)


def _ends_a_factor(text: str, functions: Collection[str]) -> bool:
    return text[-1] == ")" or (bool(re.match(r"[\w.]", text[-1])) and text not in functions)


def _begins_a_factor(token: _Token) -> bool:
    return token.kind != "sign" or token.text == "("


def _bracket(tokens: list[_Token], at: int) -> tuple[list[_Token], int]:
    """What stands in the bracket that opens at ``at``, and where it goes on behind it."""
    depth = 0
    for end in range(at, len(tokens)):
        depth += (tokens[end].text == "(") - (tokens[end].text == ")")
        if depth == 0:
            return tokens[at + 1 : end], end + 1
    raise UsageError(_("A bracket is missing."))


def _call(tokens: list[_Token], at: int, functions: Collection[str]) -> tuple[str, int]:
    """A function with its argument: ``sin(x)``, ``sin x``, ``sin^2(x)``, ``tan^-1(x)``."""
    name, at = tokens[at].text, at + 1
    power = ""
    if at < len(tokens) and tokens[at].text == "**":
        power, at = _exponent(tokens, at + 1)
        if power.strip("()").replace(" ", "") == "-1":
            if name not in _INVERSE:
                sentence = _("“{part}” has two meanings; write {instead}.")
                raise UsageError(sentence.format(part=f"{name}^-1", instead=f"1/{name}(...)"))
            name, power = _INVERSE[name], ""
    if at < len(tokens) and tokens[at].text == "(":
        inside, at = _bracket(tokens, at)
        argument = _products(inside, functions)
    elif at < len(tokens) and tokens[at].kind != "sign" and tokens[at].text not in functions:
        argument, at = tokens[at].text, at + 1
        if at < len(tokens) and _begins_a_factor(tokens[at]):
            sentence = _("Where does {name} end? Put its argument in brackets: {call}.")
            raise UsageError(sentence.format(name=name, call=f"{name}(...)"))
    elif power:
        sentence = _("Put the argument of {name} in brackets: {call}.")
        raise UsageError(sentence.format(name=name, call=f"{name}(x)**{power}"))
    else:
        return name, at  # alone: the parser says what is wrong
    called = f"{name}({argument})"
    return (f"({called}**{power})" if power else called), at


def _exponent(tokens: list[_Token], at: int) -> tuple[str, int]:
    sign = ""
    if at < len(tokens) and tokens[at].text in "+-":
        sign, at = tokens[at].text, at + 1
    if at < len(tokens) and tokens[at].text == "(":
        inside, at = _bracket(tokens, at)
        return f"({sign}{''.join(token.text for token in inside)})", at
    if at < len(tokens) and tokens[at].kind != "sign":
        return (f"({sign}{tokens[at].text})" if sign else tokens[at].text), at + 1
    raise UsageError(_("This is not finished: an exponent is missing."))
