"""What has no system's marks: ``login.zip``, ``login/``, bare notebooks.

A folder (or a zip) is one submission or a class by this rule, which is printed:

- one submission, if it holds the course's notebooks under the names of the handout, or a folder
  ``notebooks`` or ``responses``, or only things that are called ``submission``, ``backup``,
  ``final`` and the like;
- a class otherwise, and also if two or more zips, folders or notebooks of other names lie beside
  these: then each of them is one student's;
- where exactly one such thing lies beside the course's notebooks, both could be meant, and the
  autograder asks for ``--layout class`` or ``--layout one``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import PurePath

from autograder.errors import UsageError
from autograder.intake.autograder_files import OWN, SIDE, is_reports, is_side_file
from autograder.intake.file_kinds import is_notebook_name, is_system
from autograder.intake.file_or_zip import Place, as_folder_if_readable, is_zip
from autograder.intake.layouts.layout import Context, Entry, Found, visible
from autograder.intake.names_in_sentences import shown
from autograder.intake.notebook_reader import Unreadable, read_notebook
from autograder.intake.origin import Claim, Origin
from autograder.intake.submissions import student_name

CLASS, ONE = "class", "one"
RULE = "a class: one student for each zip, folder or notebook"
RULE_ONE = "one submission"
_COPIED = re.compile(r"(\s*\(\d{1,9}\)|[ _-]+copy[ _-]?\d{0,9}|[ _.-]*v?\d{1,3})\Z", re.IGNORECASE)
_NUMBERED = re.compile(r"\d{1,2}[ _-]+\w")
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
# Files that a student may have meant to hand in, though nothing in them can be read.
_MEANT = (
    *(".rar", ".7z", ".tar", ".tgz", ".gz", ".bz2", ".xz", ".zipx", ".py", ".doc", ".docx"),
    *(".pdf", ".odt", ".pages", ".ipynb~", ".part", ".crdownload", ".lnk", ".html", ".htm"),
)


class Verdict(Enum):
    """What a folder is."""

    EMPTY, ONE, CLASS, UNCLEAR = range(4)


@dataclass(frozen=True)
class Signs:
    """What in a folder speaks for one submission and what for a class."""

    of_one: list[Place]
    of_class: list[Place]
    generic: list[Place]


def judge(folder: Place, context: Context, is_archive: bool = False) -> Verdict:
    """Whether a folder, or what a zip holds, is one submission or a class."""
    signs = signs_in(folder, context)
    people = [place for place in signs.of_class if is_person(place, context)]
    count = len(signs.of_class)
    if not signs.of_one:
        if not count:
            return Verdict.ONE if signs.generic else Verdict.EMPTY
        if is_archive and not people and all(place.is_folder for place in signs.of_class):
            # A student's own folders look like those of a class, but for their number.
            if signs.generic or count == 1:
                return Verdict.ONE
            return Verdict.UNCLEAR if count == 2 else Verdict.CLASS
        if is_archive and not people and count == 1 and not is_zip(signs.of_class[0]):
            return Verdict.ONE
        if is_archive and not people and _are_notebooks(signs.of_class):
            return Verdict.ONE if count < 3 else Verdict.CLASS
        return Verdict.CLASS
    if count >= 2:
        return Verdict.CLASS
    if count == 1:
        return Verdict.CLASS if people else Verdict.UNCLEAR
    return Verdict.ONE


def unclear(folder: Place, context: Context) -> UsageError:
    """The question to the person who grades."""
    signs = signs_in(folder, context)
    named = [shown(place.name) for place in (*signs.of_one, *signs.of_class)][:4]
    return UsageError(
        f"{shown(folder.text())} may be one submission or a class: it holds "
        f"{', '.join(named)}. Say --layout one or --layout class."
    )


def read_class(folder: Place, context: Context) -> Found:
    """Every zip, folder and notebook in a folder as the submission of one student."""
    found = Found("plain", RULE)
    for place in folder.children():
        reason, needs_person = why_not(place, context)
        if reason:
            found.pass_over(place, reason, needs_person)
        else:
            found.entries.append(one_entry(place))
    return found


def one_entry(place: Place) -> Entry:
    """A place as the submission of the student whose name it has."""
    stem = stem_of(place)
    origin = Origin("plain", place.name, (Claim(called=student_name(stem)),), pieces=(place.piece,))
    return Entry(student_name(stem), origin)


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


def why_not(place: Place, context: Context) -> tuple[str, bool]:
    """Why an entry of a class is not a submission, and whether a person should look at it."""
    name = place.name
    if is_system(name):
        return "made by an operating system or an editor", False
    is_work = place.is_folder or is_zip(place) or is_notebook_name(name)
    if name.startswith("."):
        return "its name begins with a dot, so it is hidden", is_work and name != ".git"
    if is_reports(place):
        return OWN, False
    if place.is_link:
        return "", False  # reading it says that it is a link
    if _is_handout(place, context):
        return "the notebooks as they were handed out", False
    if is_work or is_person(place, context):
        return "", False
    lower = name.lower()
    if is_side_file(place):
        return SIDE, False
    if lower.endswith(_MEANT) and not lower.startswith("readme"):
        return "", False  # reading it says why it cannot be
    return "neither a zip nor a notebook nor a folder", True


def signs_in(folder: Place, context: Context) -> Signs:
    """What lies in a folder, sorted by what it speaks for."""
    signs = Signs([], [], [])
    for place in visible(folder):
        if place.name.startswith(".") or is_reports(place):
            continue
        if is_notebook_name(place.name):
            if _is_named_as_handed_out(place, context):
                signs.of_one.append(place)
            elif not place.is_folder:
                signs.of_class.append(place)
        elif place.is_folder and place.name.lower() in ("notebooks", "responses"):
            if place.name.lower() == "responses" or _holds_work(place):
                signs.of_one.append(place)
        elif is_zip(place) or (place.is_folder and _holds_work(place)):
            generic = is_generic(stem_of(place), context) and not is_person(place, context)
            (signs.generic if generic else signs.of_class).append(place)
    return signs


def _is_named_as_handed_out(place: Place, context: Context) -> bool:
    stem = _COPIED.sub("", _COPIED.sub("", stem_of(place).casefold()))
    if context.handout.stems:
        return stem.removeprefix("copy of ") in context.handout.stems or stem in {
            chapter.casefold() for chapter in context.handout
        }
    return bool(_NUMBERED.match(place.name))


def _holds_work(folder: Place, depth: int = 0) -> bool:
    below = folder.children()
    if any(is_notebook_name(place.name) or is_zip(place) for place in below):
        return True
    return depth < 2 and any(
        place.is_folder and not is_system(place.name) and _holds_work(place, depth + 1)
        for place in below
    )


def is_generic(stem: str, context: Context) -> bool:
    """Whether a name says what something is, and not whose: ``final (2)``, or a chapter."""
    plain = stem.casefold()
    for _ in range(3):
        plain = _COPIED.sub("", plain).strip(" _-.")
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


def _are_notebooks(places: Sequence[Place]) -> bool:
    return all(is_notebook_name(place.name) for place in places)


def _is_handout(place: Place, context: Context) -> bool:
    """Whether a place holds untouched notebooks of the handout and nothing of anybody's."""
    if not context.handout.cells:
        return False
    if place.is_folder:
        if place.name.lower() != "notebooks":
            return False
        books = [child for child in place.children() if is_notebook_name(child.name)]
        return bool(books) and all(_is_untouched(book, context) for book in books)
    return _is_named_as_handed_out(place, context) and _is_untouched(place, context)


def _is_untouched(place: Place, context: Context) -> bool:
    stem = stem_of(place).casefold()
    chapter = next((c for c in context.handout if c.casefold() in stem), None)
    if chapter is None:
        return stem in context.handout.stems
    try:
        limit = context.settings.submission_mb * 2**20
        notebook = read_notebook(place.read(limit)[:limit], place.name)
    except (Unreadable, OSError):
        return False
    return context.handout.is_untouched(chapter, notebook)


def is_wrapped(folder: Place) -> Place | None:
    """The one folder or zip that a folder holds, if there is nothing else to hand in."""
    work = [
        place
        for place in visible(folder)
        if not place.name.startswith(".")
        and not is_reports(place)
        and (place.is_folder or is_zip(place) or is_notebook_name(place.name))
    ]
    if len(work) != 1 or is_notebook_name(work[0].name):
        return None
    return as_folder_if_readable(work[0])
