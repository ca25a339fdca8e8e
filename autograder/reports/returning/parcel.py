"""What is packed, and what had to be left out."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from autograder.gradebook.record import Record
from autograder.reports.whole_files import replacing


@dataclass(frozen=True)
class Page:
    """One student's page of feedback, as HTML."""

    record: Record
    html: str


@dataclass(frozen=True)
class Left:
    """A submission whose feedback goes to nobody, and why."""

    record: Record
    reason: str


@dataclass(frozen=True)
class Parcel:
    """Files by their path inside the zip or the folder, and what was left out."""

    files: Mapping[str, bytes] = field(default_factory=dict)
    left: Sequence[Left] = ()

    def write_zip(self, path: Path) -> None:
        """Write the files as a zip, whole or not at all."""
        with (
            replacing(path) as unfinished,
            zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as archive,
        ):
            for name, content in self.files.items():
                archive.writestr(name, content)

    def write_folder(self, folder: Path) -> None:
        """Write the files below a folder."""
        for name, content in self.files.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            with replacing(path) as unfinished:
                unfinished.write_bytes(content)
