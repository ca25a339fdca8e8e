"""The frame of every HTML report: one file, no scripts, nothing loaded from anywhere."""

from __future__ import annotations

import base64
import hashlib
from pathlib import Path

from autograder.reports.markdown import text

STYLE = (Path(__file__).parent / "report.css").read_text(encoding="utf-8")
_DIGEST = base64.b64encode(hashlib.sha256(STYLE.encode()).digest()).decode()
# Nothing may run or load, whatever finds its way into the page; only this very style applies.
POLICY = f"default-src 'none'; style-src 'sha256-{_DIGEST}'; base-uri 'none'; form-action 'none'"


def page(
    title: str,
    header: str,
    main: str,
    footer: str,
    wide: bool = False,
    forms: bool = False,
    language: str = "en",
) -> str:
    """A whole document; all but the title are HTML. It may send ``forms`` to where it is from."""
    policy = POLICY.replace("form-action 'none'", "form-action 'self'") if forms else POLICY
    # Without any referrer a browser says that a form's origin is "null", which the server refuses.
    referrer = "same-origin" if forms else "no-referrer"
    return (
        f'<!DOCTYPE html>\n<html lang="{language}">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<meta name="referrer" content="{referrer}">\n'
        f"<title>{text(title)}</title>\n<style>{STYLE}</style>\n</head>\n"
        f'<body class="{"wide" if wide else "narrow"}">\n'
        f"<header>\n{header}\n</header>\n<main>\n{main}\n</main>\n<footer>\n{footer}\n</footer>\n"
        "</body>\n</html>\n"
    )


def table(
    caption: str, header: list[str], rows: list[list[str]], numeric: set[int], roomy: bool = False
) -> str:
    """A table whose cells are HTML; the first column names the row, ``roomy`` if at length."""

    def cells(tag: str, row: list[str]) -> str:
        made = []
        for index, value in enumerate(row):
            name = "th" if tag == "th" or index == 0 else "td"
            scope = ' scope="col"' if tag == "th" else ' scope="row"' if index == 0 else ""
            style = ' class="number"' if index in numeric else ""
            made.append(f"<{name}{scope}{style}>{value}</{name}>")
        return "<tr>" + "".join(made) + "</tr>"

    classes = "scroll roomy" if roomy else "scroll"
    name = text(caption)
    return (
        # A region that scrolls can be reached, and so scrolled, by keyboard.
        f'<div class="{classes}" role="region" aria-label="{name}" tabindex="0">'
        f"<table><caption>{name}</caption><thead>{cells('th', header)}</thead>"
        f"<tbody>{''.join(cells('td', row) for row in rows)}</tbody></table></div>"
    )
