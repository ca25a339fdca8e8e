"""Who a submission says it is from: kept with the responses, as one more of them.

The numbers of a student follow from it, so it is the student's word for themselves, and a hint: who
handed something in is settled by the class list.
"""

from __future__ import annotations

from collections.abc import Mapping

VARIANTS = "AUTOGRADER_VARIANTS"  # tells the process that marks which numbers a notebook has
FILE = "student"  # the name of the file beside those of the chapters, and of the entry in it
MOST = 200  # characters


def said_to_be(sidecars: Mapping[str, Mapping[str, object]]) -> str:
    """The name or number that a student gave; empty if none."""
    entry = sidecars.get(FILE, {}).get(FILE, {})
    name = entry.get("response") if isinstance(entry, dict) else None
    return clean(name) if isinstance(name, str) else ""


def clean(name: str) -> str:
    """A name on one line, of bounded length and without control characters."""
    return " ".join("".join(c if c.isprintable() else " " for c in name).split())[:MOST]
