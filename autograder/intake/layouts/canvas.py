"""Canvas, "Download submissions": all files of all students in one folder.

``lovelaceada_98765_4711_submission-1.zip``: the sortable name without spaces and punctuation,
``_LATE`` if Canvas says so, the student's number, the file's, and the student's own name for it, to
which Canvas adds ``-1`` when a file of the name was there. The times are those of the download.
(lib/content_zipper.rb of instructure/canvas-lms)
"""

from __future__ import annotations

import re
from pathlib import PurePosixPath

from autograder.intake.download_names import SystemName, canvas_name
from autograder.intake.file_or_zip import Place
from autograder.intake.layouts.layout import Context, Entry, Found, fit_most, pieces_of, side_entry
from autograder.intake.origin import Origin

_VERSION = re.compile(r"-(\d{1,4})\Z")


class Canvas:
    """Files whose names hold a student's number and a file's."""

    name = "canvas"
    rule = "Canvas's download: one student for each number, the newest version of each file"

    def recognises(self, folder: Place) -> bool:
        files = [place for place in folder.children() if not place.is_folder]
        return fit_most([place for place in files if canvas_name(place.name)], folder)

    def read(self, folder: Place, context: Context) -> Found:
        found = Found(self.name, self.rule)
        students: dict[str, list[tuple[SystemName, Place]]] = {}
        for place in folder.children():
            name = None if place.is_folder else canvas_name(place.name)
            if name is None:
                side_entry(place, found, place.name.lower().endswith(".csv"))
            else:
                key = name.claim.id or name.prefix
                students.setdefault(key, []).append((name, place))
        for files in students.values():
            files.sort(key=lambda file: file[0].file)
            name = files[-1][0]
            newest = [file for file in files if not _is_older(file[0], files)]
            for version in files:
                if version not in newest:
                    found.pass_over(version[1], "an older version of the same file", False)
            origin = Origin(
                self.name,
                name.prefix,
                (name.claim,),
                _attempt(newest),
                called_late=any(file[0].late for file in files),
                pieces=pieces_of([place for _, place in newest]),
            )
            key = name.claim.name or name.prefix
            found.entries.append(Entry(key, origin, name.claim.id))
        return found


def _is_older(name: SystemName, files: list[tuple[SystemName, Place]]) -> bool:
    """Whether a newer version of the same file is there.

    ``part-1`` and ``part-2`` are two versions only if ``part`` is there too or they are zips, of
    which a student has one: otherwise it is the students' own numbering.
    """
    stem, number, suffix = _version(name.rest)
    versions = [(other, *_version(other.rest)) for other, _ in files if other is not name]
    same = [(o, n) for o, s, n, x in versions if (s, x) == (stem, suffix)]
    has_base = number == 0 or any(n == 0 for _, n in same)
    if not (has_base or suffix == ".zip"):
        return False
    return any((n, other.file) > (number, name.file) for other, n in same)


def _version(rest: str) -> tuple[str, int, str]:
    path = PurePosixPath(rest.casefold())
    found = _VERSION.search(path.stem)
    if found is None:
        return path.stem, 0, path.suffix
    return path.stem[: found.start()], int(found[1]), path.suffix


def _attempt(files: list[tuple[SystemName, Place]]) -> str:
    most = max((_version(name.rest)[1] for name, _ in files), default=0)
    return f"version {most + 1}" if most else ""
