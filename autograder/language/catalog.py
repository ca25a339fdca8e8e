"""Catalogs of gettext: ``.po`` as people edit it, ``.mo`` as the standard library reads it.

The formats are those of GNU gettext's manual, "The Format of PO Files" and "The Format of GNU MO
Files". They are compiled when they are read, so that nothing has to be built.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping

Catalog = dict[str, str]
_CONTEXT_FREE = ("msgid", "msgid_plural", "msgstr")
_MAGIC = 0x950412DE


def read_po(text: str) -> Catalog:
    """Translations by sentence; of a plural both forms with a zero byte between, as in ``.mo``.

    Raises:
        ValueError: if a line is not understood.
    """
    catalog: Catalog = {}
    entry: dict[str, str] = {}
    key = ""
    for number, line in enumerate([*text.splitlines(), 'msgid ""'], 1):
        line = line.strip()
        if not line or line.startswith("#"):
            continue
        if not line.startswith('"'):
            key, _, line = line.partition(" ")
            if key.partition("[")[0] not in _CONTEXT_FREE:
                raise ValueError(f"line {number} of the catalog begins with {key!r}")
            if key == "msgid":
                _keep(catalog, entry)
                entry = {}
            entry[key] = ""
        said = json.loads(line)  # a text in quotes is written alike in both
        if not isinstance(said, str):
            raise ValueError(f"line {number} of the catalog is not a text")
        entry[key] += said
    return catalog


def _keep(catalog: Catalog, entry: Mapping[str, str]) -> None:
    if "msgid_plural" in entry:
        forms = [text for key, text in entry.items() if key.startswith("msgstr[")]
        if all(forms):
            catalog[f"{entry['msgid']}\0{entry['msgid_plural']}"] = "\0".join(forms)
    elif entry.get("msgstr"):
        catalog[entry["msgid"]] = entry["msgstr"]


def as_mo(catalog: Catalog) -> bytes:
    """The catalog as the bytes of a ``.mo`` file."""
    pairs = sorted((key.encode(), value.encode()) for key, value in catalog.items())
    start = 28 + 16 * len(pairs)
    texts = b""
    tables: list[list[int]] = [[], []]
    for side in (0, 1):
        for pair in pairs:
            tables[side] += [len(pair[side]), start + len(texts)]
            texts += pair[side] + b"\0"
    header = [_MAGIC, 0, len(pairs), 28, 28 + 8 * len(pairs), 0, start]
    numbers = [*header, *tables[0], *tables[1]]
    return struct.pack(f"<{len(numbers)}I", *numbers) + texts
