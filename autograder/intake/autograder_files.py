"""What the autograder itself reads and writes where the work lies; none of it is anybody's work."""

from __future__ import annotations

from autograder.intake.file_kinds import is_notebook_name
from autograder.intake.file_or_zip import Group, Place, is_zip

OWN = "the autograder's own gradebook and reports"
SIDE = "a side file of the autograder's"
_GRADEBOOK = "gradebook.db"
_SIDE_FILES = ("class.toml", "students.toml", "times.csv", "grading.toml", "overrides.csv")
_WRITTEN = (
    *("gradebook.at-work", "grades.csv", "class.html", "feedback", "similar.csv", "gradescope"),
    *("class_questions.csv", "class_mistakes.csv", "class_students.csv"),
    *("canvas.csv", "moodle.csv", "csv.csv"),
)
_DEEPEST = 4  # folders in folders, of those that --out names
_STARTS = (_GRADEBOOK, "feedback_for_")


def is_side_file(place: Place) -> bool:
    """Whether it is a table by which a person tells the autograder something."""
    return place.name.lower() in _SIDE_FILES and not place.is_folder


def is_reports(place: Place, deep: int = 0) -> bool:
    """Whether a folder is one that ``--out`` named: there is a gradebook in it, and nobody's work.

    So is one above it that holds nothing else, as for ``--out grades/monday``. A student who puts
    a file of that name beside a notebook is still a student.
    """
    if not place.is_folder or deep > _DEEPEST:
        return False
    below = place.children()
    if below and all(child.is_folder for child in below):
        return all(is_reports(child, deep + 1) for child in below)
    return any(child.name == _GRADEBOOK for child in below) and not any(
        is_notebook_name(child.name)
        or child.name in ("notebooks", "responses", "submitted")  # the last is nbgrader's
        or (is_zip(child) and not _is_written(child))
        for child in below
    )


def without_own_files(folder: Place) -> tuple[Place, list[Place]]:
    """A folder without what the autograder wrote into it, and that.

    What it writes is known by its names where there is a gradebook among it.
    """
    children = folder.children() if folder.is_folder else []
    has_gradebook = any(child.name == _GRADEBOOK for child in children)
    own = [
        child for child in children if (has_gradebook and _is_written(child)) or is_reports(child)
    ]
    if not own:
        return folder, []
    names = {child.name for child in own}
    rest = [child for child in children if child.name not in names]
    return Group(folder.name, rest, folder.piece), own


def _is_written(place: Place) -> bool:
    return place.name in _WRITTEN or place.name.startswith(_STARTS)
