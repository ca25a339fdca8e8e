"""``autograder.zip`` for Gradescope: this grader with the key, and how to start it there.

The layout is that of Gradescope's autograder specification: ``setup.sh`` and ``run_autograder`` at
the root of the archive, which is unpacked to ``/autograder/source``.
"""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Sequence
from pathlib import Path

from autograder.authoring.bundle_pyproject import bundle_pyproject
from autograder.course import Course
from autograder.course.places import FILE as PLACES
from autograder.gradebook.record import Record
from autograder.release.file_rules import grader_files
from autograder.release.gradescope.results import results
from autograder.reports.whole_files import file_name, write_text

_SETUP = """#!/usr/bin/env bash
# Runs once, when Gradescope builds the image.
set -euo pipefail
apt-get update -q
apt-get install -y -q python3-pip bubblewrap
python3 -m pip install -q uv || python3 -m pip install -q --break-system-packages uv
uv venv --python 3.12 /autograder/venv
uv pip install --python /autograder/venv/bin/python -e /autograder/source/course
# Student code runs under another user id, for which the key and the results are closed.
chmod -R o-rwx /autograder/source/course/solutions
"""
_RUN = """#!/usr/bin/env bash
# Runs for every submission; results.json is written whatever happens.
set -u
mkdir -p /autograder/results
chmod o-rwx /autograder/results
cd /autograder
PYTHONPATH=/autograder/source/course /autograder/venv/bin/python \\
    -m autograder.release.gradescope.run --root /autograder{options}
"""
_EPOCH = (2020, 1, 1, 0, 0, 0)  # the same files make the same archive


def write_gradescope(
    folder: Path, course: Course, records: Sequence[Record], explanations: bool = False
) -> int:
    """Write ``autograder.zip`` and a ``results.json`` for each submission; returns how many."""
    folder.mkdir(parents=True, exist_ok=True)
    write_autograder_zip(folder / "autograder.zip", course, explanations)
    for record in records:
        text = json.dumps(results(course, record, explanations), indent=1)
        write_text(folder / "results" / file_name(record.student) / "results.json", text + "\n")
    return len(records)


def write_autograder_zip(path: Path, course: Course, explanations: bool = False) -> None:
    """Write the archive that Gradescope builds its image from. It holds the key: keep it safe."""
    unfinished = path.with_name(path.name + ".tmp")
    with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as archive:
        _add(archive, "setup.sh", _SETUP.encode(), 0o755)
        options = " --explanations" if explanations else ""
        _add(archive, "run_autograder", _RUN.format(options=options).encode(), 0o755)
        for name, file in grader_files(course):
            _add(archive, f"course/{name}", file.read_bytes(), 0o644)
        _add(archive, "course/pyproject.toml", bundle_pyproject(course, "-grader").encode(), 0o644)
        if course.personal and course.places is not None:
            _add(archive, f"course/{PLACES}", course.places.text().encode(), 0o644)
    os.replace(unfinished, path)


def _add(archive: zipfile.ZipFile, name: str, content: bytes, mode: int) -> None:
    entry = zipfile.ZipInfo(name, _EPOCH)
    entry.external_attr = mode << 16
    entry.create_system = 3  # Unix, so that the mode counts
    entry.compress_type = zipfile.ZIP_DEFLATED
    archive.writestr(entry, content)
