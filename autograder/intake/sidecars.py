"""The saved responses that were handed in beside the notebooks."""

from __future__ import annotations

from autograder.exchange.responses import Entry, keep_response
from autograder.intake.file_kinds import is_notebook_name
from autograder.intake.limits_on_files import Files
from autograder.intake.names_in_sentences import MOST_NAMES, shown_path
from autograder.intake.notebook_reader import (
    Unreadable,
    parse_json,
)
from autograder.intake.which_notebook_counts import (
    plainest_name,
)


def read_sidecars(files: Files, notes: list[str]) -> dict[str, dict[str, Entry]]:
    """The saved responses by chapter: of the newest piece, the outermost first."""
    sidecars: dict[str, dict[str, Entry]] = {}
    left_out = []
    paths = [path for path in files.kept if not is_notebook_name(path.name)]
    for path in sorted(paths, key=lambda path: (-files.kept[path].order, *plainest_name(path))):
        if path.stem in sidecars:
            continue
        try:
            sidecars[path.stem] = _read_sidecar(files.kept[path].data, shown_path(path))
        except Unreadable as reason:
            left_out.append(f"Saved responses were left out: {reason}")
    notes += left_out[:MOST_NAMES]
    if len(left_out) > MOST_NAMES:
        notes.append(f"So were {len(left_out) - MOST_NAMES:,} more files of saved responses.")
    return sidecars


def _read_sidecar(data: bytes, name: str) -> dict[str, Entry]:
    document = parse_json(data, name)
    responses = document.get("responses") if isinstance(document, dict) else None
    if not isinstance(responses, dict):
        raise Unreadable(f"{name} holds no responses.")
    entries: dict[str, Entry] = {}
    for id, entry in responses.items():
        if isinstance(entry, dict) and "response" in entry:
            kept = keep_response(id, entry)
            entries |= {id: plain for id, plain in kept.items() if isinstance(plain, dict)}
    return entries
