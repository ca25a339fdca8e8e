"""The course's Markdown with its formulas, as HTML without scripts: formulas become MathML."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from html import escape
from typing import Any

from latex2mathml.converter import convert
from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin

from autograder.exchange.printable import printable


def formula(latex: str, block: bool = False) -> str:
    """A LaTeX formula as MathML; what cannot be converted is shown as it is written."""
    try:
        converted = str(convert(latex, display="block" if block else "inline"))
    except Exception:  # latex2mathml raises what its parser stumbled over
        converted = "href="
    # A formula needs no link; LaTeX's \\href would take any address.
    return f"<code>{escape(latex)}</code>" if "href=" in converted else converted


def _parser() -> MarkdownIt:
    parser = MarkdownIt("commonmark", {"html": False}).enable("table").disable("image")
    parser.use(dollarmath_plugin, allow_digits=False, double_inline=True)

    def render(block: bool) -> Any:
        def rule(
            self: object, tokens: Sequence[Token], index: int, options: object, env: object
        ) -> str:
            return formula(tokens[index].content.strip(), block)

        return rule

    for name, block in (("math_inline", False), ("math_inline_double", True), ("math_block", True)):
        parser.add_render_rule(name, render(block))
    return parser


_PARSER = _parser()


@lru_cache(maxsize=4096)  # a class shares most of its feedback
def markdown(text: str) -> str:
    """Paragraphs, lists, tables and formulas; raw HTML and pictures stay text."""
    return str(_PARSER.render(readable(text))).strip()


@lru_cache(maxsize=4096)
def inline(text: str) -> str:
    """The same without a paragraph round it."""
    return str(_PARSER.renderInline(readable(text))).strip()


def text(value: str) -> str:
    """Text of anybody's, as HTML that shows it and does nothing."""
    return escape(readable(value))


def isolated(value: str) -> str:
    """A name that keeps its own direction of writing, whatever stands around it."""
    return f"<bdi>{text(value)}</bdi>"


def readable(value: str) -> str:
    """Text whose control characters, except line breaks, are shown as a replacement sign."""
    return printable(value, "�", keep="\n")
