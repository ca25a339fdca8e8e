"""Patterns over the colours of bands, for those who do not see the hues apart, and for printers."""

from __future__ import annotations

_SIDE = 8
_DRAWN = {
    "stripes": '<path d="M-2,2 l4,-4 M0,8 l8,-8 M6,10 l4,-4" stroke-width="2"/>',
    "crosses": '<path d="M0,0 l8,8 M8,0 l-8,8" stroke-width="1.5"/>',
    "dots": '<circle cx="4" cy="4" r="1.8" fill="var(--paper)" stroke="none"/>',
    "columns": '<path d="M4,0 v8" stroke-width="2"/>',
    "lines": '<path d="M0,4 h8" stroke-width="2"/>',
}


def fill_of(pattern: str) -> str:
    """The fill that lays a pattern over a shape on a page that holds `definitions`."""
    return f"url(#pattern-{pattern})"


def definitions() -> str:
    """All patterns, once for a page."""
    made = "".join(
        f'<pattern id="pattern-{name}" width="{_SIDE}" height="{_SIDE}" '
        f'patternUnits="userSpaceOnUse"><g stroke="var(--paper)" fill="none">{drawn}</g></pattern>'
        for name, drawn in _DRAWN.items()
    )
    return f'<svg width="0" height="0" aria-hidden="true"><defs>{made}</defs></svg>'
