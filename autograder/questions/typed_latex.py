r"""LaTeX that says plainly what is meant: ``\frac{1}{2}\sin\alpha`` as ``((1)/(2)) sin alpha``."""

from __future__ import annotations

import re

from autograder.errors import UsageError
from autograder.language import _

_NOTHING = re.compile(
    r"\\(?:left|right|displaystyle|limits|[bB]igg?[lr]?|q?quad)(?![a-zA-Z])|\\[,;:! ]|~"
)
_SIGNS = {
    "cdot": "*", "times": "*", "div": "/", "pm": "±", "infty": "∞", "approx": "≈", "sum": "∑",
    "int": "∫", "leq": "≤", "geq": "≥", "le": "≤", "ge": "≥", "lceil": "⌈", "rceil": "⌉",
    "lfloor": "⌊", "rfloor": "⌋", "lvert": "|", "rvert": "|", "vert": "|", "circ": "°",
    "varphi": " phi ", "vartheta": " theta ", "varepsilon": " epsilon ", "lambda": " lambda_ ",
}  # fmt: skip
_PLAIN = (
    *("alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "kappa", "mu", "nu"),
    *("xi", "pi", "rho", "sigma", "tau", "phi", "chi", "psi", "omega", "Delta", "Sigma"),
    *("sin", "cos", "tan", "cot", "sec", "csc", "arcsin", "arccos", "arctan", "sinh", "cosh"),
    *("tanh", "exp", "log", "ln", "lg", "min", "max"),
)
_FRACTION = re.compile(r"\\([dt]?frac|[dt]?binom|sqrt)(?![a-zA-Z])")
_ONLY_UPRIGHT = re.compile(r"\\(?:operatorname|mathrm|mathit|mathbf|text)\*?\s*\{([^{}]*)\}")
_INDEX = re.compile(r"_(?:\{(\w+)\}|\((\w+)\))")


def without_latex(text: str) -> str:
    """The text with its commands as signs and names, and the braces round an index gone.

    Raises:
        UsageError: at a command that is not understood; the sentence names it.
    """
    text = _INDEX.sub(lambda found: "_" + (found[1] or found[2]), text)
    if "\\" not in text:
        return text
    text = _ONLY_UPRIGHT.sub(r" \1 ", _NOTHING.sub(" ", text)).replace("\\%", "%")
    text = text.replace("\\{", "(").replace("\\}", ")").replace("^\\circ", "°")
    while found := _FRACTION.search(text):
        text = _arguments_in_place(text, found)
    return re.sub(r"\\([a-zA-Z]+|.|$)", _command, text, flags=re.DOTALL)


def _arguments_in_place(text: str, found: re.Match[str]) -> str:
    """The first fraction, binomial or root as a division or a call."""
    command = found[1].lstrip("dt")
    first, at = _argument(text, found.end(), found[0])
    if command == "sqrt":
        return f"{text[: found.start()]} sqrt({first}){text[at:]}"
    second, at = _argument(text, at, found[0])
    made = f"(({first})/({second}))" if command == "frac" else f" comb({first}, {second})"
    return text[: found.start()] + made + text[at:]


def _argument(text: str, at: int, command: str) -> tuple[str, int]:
    r"""What stands in the braces at ``at``, or the one sign there, as in ``\frac12``."""
    while text[at : at + 1].isspace():
        at += 1
    if at == len(text) or text[at] in "[}":
        sentence = _("“{sign}” is not understood here; write {instead}.")
        raise UsageError(sentence.format(sign=command, instead=_("a/b, sqrt(x) or comb(n, k)")))
    if text[at] != "{":
        single = re.compile(r"\\[a-zA-Z]+|.", re.DOTALL).match(text, at)
        assert single is not None
        return single[0], single.end()
    depth = 0
    for end in range(at, len(text)):
        depth += (text[end] == "{") - (text[end] == "}")
        if depth == 0:
            return text[at + 1 : end], end + 1
    raise UsageError(_("A bracket is missing: add “{sign}”.").format(sign="}"))


def _command(found: re.Match[str]) -> str:
    name = found[1]
    if name in _SIGNS:
        return _SIGNS[name]
    if name in _PLAIN:
        return f" {name} "
    sentence = _("“{sign}” is not understood here; write {instead}.")
    instead = _("the formula as one line of text, such as 2*x or x**2")
    raise UsageError(sentence.format(sign=found[0], instead=instead))
