"""Whether a name is somebody's, or says only what a thing is, such as ``final (2)``."""

from __future__ import annotations

import re
from pathlib import PurePath

from autograder.intake.file_or_zip import Place
from autograder.intake.layouts.layout import Context
from autograder.intake.origin import Claim, Origin
from autograder.intake.submissions import student_name

COPIED = re.compile(r"(\s*\(\d{1,9}\)|[ _-]+copy[ _-]?\d{0,9}|[ _.-]*v?\d{1,3})\Z", re.IGNORECASE)
# What students and instructors call things that are no person.
_GENERIC = frozenset(
    (
        *("submission", "submissions", "submit", "submitted", "abgabe", "handin", "hand"),
        *("notebook", "notebooks", "response", "responses", "backup", "backups", "final"),
        *("finale", "finished", "old", "older", "new", "newer", "copy", "draft", "drafts"),
        *("version", "versions", "work", "homework", "assignment", "exercise", "exercises"),
        *("solution", "solutions", "task", "tasks", "data", "figures", "explorers", "images"),
        *("img", "pictures", "plots", "src", "code", "project", "archive", "download"),
        *("downloads", "upload", "uploads", "file", "files", "attempt", "first", "second"),
        *("last", "part", "untitled", "unnamed", "questions", "source", "in"),
    )
)


def stem_of(place: Place) -> str:
    """The name without what says what kind of file it is."""
    if place.is_folder and not (place.name.lower().endswith(".zip")):
        return place.name
    name = place.name
    cut = name.lower().rfind(".ipynb")
    if cut > 0:
        # Browsers write 3_ransac.ipynb (1).json, and the number tells copies apart.
        number = re.search(r"\s*\(\d{1,9}\)", name[cut:])
        return name[:cut] + (number[0] if number else "")
    return PurePath(name).stem or name


def is_generic(stem: str, context: Context) -> bool:
    """Whether a name says what something is, and not whose: ``final (2)``, or a chapter."""
    plain = stem.casefold()
    for _ in range(3):
        plain = COPIED.sub("", plain).strip(" _-.")
    words = [word for word in re.split(r"[\W_]+", plain) if word and not word.isdigit()]
    names = _GENERIC | {chapter.casefold() for chapter in context.handout}
    return plain in names or plain in context.handout.stems or set(words) <= names


def is_person(place: Place, context: Context) -> bool:
    """Whether a place is called like somebody in the class list."""
    from autograder.intake.match_people import match_all

    if not context.people:
        return False
    name = student_name(stem_of(place))
    match = match_all(context.people, {name: Origin(claims=(Claim(called=name),))})[name]
    return bool(match.people or match.candidates)
