"""Markdown with formulas as HTML with MathML, which every current browser draws and reads out.

A widget cannot rely on the notebook's own typesetting: JupyterLab 4 offers it to no one else.
"""

from __future__ import annotations

import html
from functools import lru_cache
from typing import Any

from latex2mathml.converter import convert
from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin


@lru_cache(maxsize=512)
def block(markdown: str) -> str:
    """Markdown with paragraphs, as HTML. Raw HTML in it is shown as text."""
    return str(_renderer().render(markdown))


@lru_cache(maxsize=512)
def line(markdown: str) -> str:
    """Markdown without paragraphs, for a line of text."""
    return str(_renderer().renderInline(markdown))


def formula(latex: str, display: bool = False) -> str:
    """A LaTeX formula as MathML; what cannot be converted is shown as it is written."""
    try:
        return str(convert(latex, display="block" if display else "inline"))
    except Exception:
        return f"<code>{html.escape(latex)}</code>"


@lru_cache(maxsize=1)
def _renderer() -> MarkdownIt:
    def render(latex: str, options: dict[str, Any]) -> str:
        return formula(latex, bool(options.get("display_mode")))

    return (
        MarkdownIt("commonmark", {"html": False})
        .enable("table")
        .use(dollarmath_plugin, double_inline=True, renderer=render)
    )
