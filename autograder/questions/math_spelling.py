"""What people type, in the spelling that the reader of formulas knows.

``N(N-1)/2``, ``2 sin²(α)``, ``0,18`` and ``18 %`` say plainly what is meant, so they are read;
``1/2x`` and ``1,500`` do not, so they are refused with the spellings that would be plain.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from typing import NamedTuple

from autograder.errors import UsageError
from autograder.language import N_, _
from autograder.questions.typed_characters import ONE_NUMBER, TWO_MEANINGS, plain
from autograder.questions.typed_digits import numbers_in_full
from autograder.questions.typed_latex import without_latex

CheckName = Callable[[str], object]  # raises a UsageError for a name that means nothing here

# What is not read, and what to write for it.
_INSTEAD = {
    "|": N_("abs(x) for |x|"),
    "!": N_("the product, or comb(n, k)"),
    ":": N_("/ for a division"),
    ";": N_("a comma between arguments"),
    "∞": N_("a finite number"),
    "∑": N_("the sum itself"),
    "∫": N_("the integral itself"),
    **dict.fromkeys("≈~≤≥<>?…", N_("only the value")),
    **dict.fromkeys("→⇒", N_("only the result")),
    **dict.fromkeys("€$", N_("only the number, without a unit")),
    ".": N_("a point only between digits, and * for a product"),
    "°": N_("the angle in radians, such as 30*pi/180"),
    "±": N_("one of the two"),
    **dict.fromkeys("∛∜", N_("x**(1/3) for a cube root")),
    **dict.fromkeys("'\"", N_("the formula without quotes and primes")),
}
_INSTEAD_OF_WORDS = {
    **dict.fromkeys(["choose", "over", "über"], N_("the product, or comb(n, k)")),
    **dict.fromkeys(["squared", "hoch"], N_("x**2 for a power")),
    **dict.fromkeys(
        ["degrees", "degree", "deg", "Grad"], N_("the angle in radians, such as 30*pi/180")
    ),
    **dict.fromkeys(["or", "oder", "and", "und", "to", "bis"], N_("only the value")),
}
_SAME = {
    "arcsin": "asin", "arccos": "acos", "arctan": "atan", "arctg": "atan", "arctan2": "atan2",
    "ln": "log", "tg": "tan", "lb": "log2", "Abs": "abs", "absolute": "abs", "fabs": "abs",
    "wurzel": "sqrt", "ceiling": "ceil", "binom": "comb", "binomial": "comb", "nCr": "comb",
    "C": "comb", "power": "pow", "sgn": "sign", "lg": "log10", "log_10": "log10", "log_2": "log2",
}  # fmt: skip
_CONSTANTS = {"Pi": "pi", "PI": "pi"}
_INVERSE = {"sin": "asin", "cos": "acos", "tan": "atan"}
_MODULES = ("np", "numpy", "sp", "sympy", "math", "scipy.special")
_TOKEN = re.compile(
    r"\s*(?:(?P<digits>\ue000[^\ue001]*\ue001|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[^\W\d]\w*[\u0300-\u036f]*)"
    r"|(?P<sign>\*\*|//|<=|>=|->|\S[\u0300-\u036f]*))"
)
_OPERATORS = ("+", "-", "*", "/", "**", "^")

_MODULE = rf"(?<![\w.])(?:{'|'.join(map(re.escape, _MODULES))})\.(?=[^\W\d])"
# An assignment, an attribute, an index: Python, and no mathematics.
_CODE = re.compile(r"=|\blambda\b|__|\]\[|[^\W\d]\w*\.[^\W\d]")


class _Token(NamedTuple):
    kind: str
    text: str


def is_code(text: str) -> bool:
    """Whether it is Python rather than mathematics, so that the parser has to say what is wrong."""
    return bool(_CODE.search(re.sub(_MODULE, "", text)))


def spelt(text: str, functions: Collection[str], check_name: CheckName) -> str:
    """The text as arithmetic with ``*`` for every product, of the functions' own names.

    What is neither plain nor refused here is left to the parser.

    Raises:
        UsageError: if it has two meanings, or a sign or name that is not known; the sentence says
            what to write.
    """
    text = numbers_in_full(plain(without_latex(text)))
    if text.count("|") == 2:
        text = text.replace("|", " abs(", 1).replace("|", ")")
    text = re.sub(r"(?<=[\d)])(?<!\b0)\s*[xX]\s*(?=\d)", "*", text)  # 1000x999, but not 0x10
    tokens = _known(_tokens(text), functions, check_name)
    _check_order(tokens, functions)
    powers = [_Token("sign", "**") if token.text == "^" else token for token in tokens]
    return _products(powers, functions)


def _tokens(text: str) -> list[_Token]:
    text = re.sub(_MODULE, "", text.replace("√", " sqrt "))
    parts = ((str(part.lastgroup), part[str(part.lastgroup)]) for part in _TOKEN.finditer(text))
    brackets = str.maketrans(dict(zip(ONE_NUMBER, "()", strict=True)))
    return [_Token(kind, part.translate(brackets)) for kind, part in parts]


def _instead_of(sign: str) -> str:
    if sign in ("->", "//"):
        return _("only the result") if sign == "->" else _("/ for a division")
    common = N_("numbers and names with + - * / ** and round brackets")
    return _(_INSTEAD.get(sign[0], common))


def _not_understood(sign: str, instead: str) -> str:
    sentence = _("“{sign}” is not understood here; write {instead}.")
    return sentence.format(sign=sign, instead=instead)


def _known(tokens: list[_Token], functions: Collection[str], check_name: CheckName) -> list[_Token]:
    """The tokens with each name as it is known here, and an ``x`` between two factors as ``*``.

    Raises:
        UsageError: at the first name or sign that is not known.
    """
    read = {*_OPERATORS, "(", ")", ",", *("!" for name in functions if name == "factorial")}
    made: list[_Token] = []
    for at, token in enumerate(tokens):
        if token.kind == "sign" and token.text not in read:
            raise UsageError(_not_understood(token.text, _instead_of(token.text)))
        if token.kind != "name":
            made.append(token)
            continue
        calls = at + 1 < len(tokens) and tokens[at + 1].text == "("
        name = _name(token.text, calls, functions, check_name)
        between = bool(made) and made[-1].text not in ("(", ",", *_OPERATORS)
        if name is None and token.text in "xX" and between and at + 1 < len(tokens):
            made.append(_Token("sign", "*"))
        else:
            made.append(_Token("name", name or _unknown(token.text, calls, functions, check_name)))
    return made


def _name(text: str, calls: bool, functions: Collection[str], check_name: CheckName) -> str | None:
    """A name as it is known, whatever its case where it is called; None if it is not."""
    if text in functions:
        return text
    known = _is_known(text, check_name)
    same = _SAME.get(text)
    if same in functions and not known and (calls or text != "C"):
        return same
    lower = _SAME.get(text.lower(), text.lower())
    if calls and not known and lower in functions:
        return lower
    if text in _CONSTANTS and not known:
        text = _CONSTANTS[text]
        known = _is_known(text, check_name)
    return text if known else None


def _is_known(name: str, check_name: CheckName) -> bool:
    try:
        check_name(name)
    except UsageError:
        return False
    return True


def _unknown(name: str, calls: bool, functions: Collection[str], check_name: CheckName) -> str:
    if name in _INSTEAD_OF_WORDS:
        raise UsageError(_not_understood(name, _(_INSTEAD_OF_WORDS[name])))
    called = re.fullmatch(r"([a-z]+?)(\d+)", name)
    if called and called[1] in functions:  # sin2α
        one, other = f"{called[1]}({called[2]}*x)", f"{called[1]}(x)**{called[2]}"
        raise UsageError(_(TWO_MEANINGS).format(part=name, one=one, other=other))
    for function in functions:
        rest = name.removeprefix(function)
        if rest not in ("", name) and _is_known(rest, check_name):
            sentence = _("Put the argument of {name} in brackets: {call}.")
            raise UsageError(sentence.format(name=function, call=f"{function}({rest})"))
    if calls and len(name) > 1 and functions:
        sentence = _("{name} is not understood; use {functions}.")
        raise UsageError(sentence.format(name=name, functions=", ".join(sorted(functions))))
    check_name(name)
    return name


def _check_order(tokens: list[_Token], functions: Collection[str]) -> None:
    """Refuse an operator or a bracket that lacks its left, its right or its other half."""
    if not tokens:
        raise UsageError(_("This is not finished: nothing is written yet."))
    depth = 0
    for before, token, after in zip(
        [_Token("", ""), *tokens], tokens, [*tokens[1:], _Token("", "")], strict=False
    ):
        sign = token.text if token.kind == "sign" else ""
        depth += (sign == "(") - (sign == ")")
        if depth < 0:
            raise UsageError(_("A bracket is missing: add “{sign}”.").format(sign="("))
        needs_left = sign in ("!", ",", *_OPERATORS[2:])
        if needs_left and before.text in ("", "(", ",", *_OPERATORS):
            sentence = _("This is not finished: nothing stands before “{sign}”.")
            raise UsageError(sentence.format(sign=sign))
        if sign in (",", *_OPERATORS) and after.text in ("", ")"):
            sentence = _("This is not finished: nothing follows “{sign}”.")
            raise UsageError(sentence.format(sign=sign))
        if sign == "!" and after.text == "!":
            one, other = "factorial(x)", "factorial(factorial(x))"
            raise UsageError(_(TWO_MEANINGS).format(part="!!", one=one, other=other))
        if sign == "(" and after.text == ")" and before.text not in functions:
            raise UsageError(_("This is not finished: the brackets are empty."))
        alone = after.text not in ("(", "^", "**") and after.kind in ("", "sign")
        if token.kind == "name" and token.text in functions and alone:
            sentence = _("Put the argument of {name} in brackets: {call}.")
            raise UsageError(sentence.format(name=token.text, call=f"{token.text}(...)"))
    if depth > 0:
        raise UsageError(_("A bracket is missing: add “{sign}”.").format(sign=")"))


def _products(tokens: list[_Token], functions: Collection[str]) -> str:
    """The text again, with a ``*`` where one factor follows another."""
    made: list[str] = []
    at = 0
    divided = False  # whether the factor before is what something is divided by
    while at < len(tokens):
        token = tokens[at]
        calls = token.kind == "name" and token.text in functions
        if made and token.text == "!":
            made[-1], at = f"factorial({made[-1]})", at + 1
            continue
        if made and _ends_a_factor(made[-1], functions) and _begins_a_factor(token):
            if divided:
                after = _shown(token, functions)
                part, one = f"/ {made[-1]} {after}", f"/ {made[-1]}*{after}"
                other = f"/ ({made[-1]}*{after})"
                raise UsageError(_(TWO_MEANINGS).format(part=part, one=one, other=other))
            if token.kind == "digits":  # perhaps a power that has lost its height
                one, other = f"{made[-1]}*{token.text}", f"{made[-1]}**{token.text}"
                part = f"{made[-1]} {token.text}"
                raise UsageError(_(TWO_MEANINGS).format(part=part, one=one, other=other))
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


def _shown(token: _Token, functions: Collection[str]) -> str:
    """A factor, in short."""
    if token.text == "(":
        return "(...)"
    return f"{token.text}(...)" if token.text in functions else token.text


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
    raise UsageError(_("A bracket is missing: add “{sign}”.").format(sign=")"))


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
    elif at < len(tokens) and tokens[at].kind == "name" and tokens[at].text in functions:
        argument, at = _call(tokens, at, functions)
    elif at < len(tokens) and tokens[at].kind != "sign":
        argument, at = tokens[at].text, at + 1
        _check_end(name, argument, tokens[at : at + 2], functions)
        goes_on = at < len(tokens) and _begins_a_factor(tokens[at])
        if goes_on and tokens[at].text not in functions:
            goes_to = argument if tokens[at].text == "(" else f"{argument}*{tokens[at].text}"
            sentence = _("Where does {name} end? Put its argument in brackets: {call}.")
            raise UsageError(sentence.format(name=name, call=f"{name}({goes_to})"))
    elif power:
        sentence = _("Put the argument of {name} in brackets: {call}.")
        raise UsageError(sentence.format(name=name, call=f"{name}(x)**{power}"))
    else:
        return name, at  # alone: the parser says what is wrong
    called = f"{name}({argument})"
    return (f"({called}**{power})" if power else called), at


def _check_end(name: str, argument: str, after: list[_Token], functions: Collection[str]) -> None:
    """Refuse ``sin x^2``, ``sin 2*x`` and ``ln 1/2``: where their argument ends is not plain."""
    if len(after) < 2:
        return
    sign, factor = after[0].text, _shown(after[1], functions)
    a_number = not argument.isidentifier() or argument in ("pi", "e")
    product = sign in ("*", "/") and a_number and name != "sqrt"
    if sign == "**" or (product and after[1].text not in functions):
        inside, outside = f"{name}({argument}{sign}{factor})", f"{name}({argument}){sign}{factor}"
        part = f"{name} {argument}{sign}{factor}"
        raise UsageError(_(TWO_MEANINGS).format(part=part, one=inside, other=outside))


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
