"""What has no system's marks: ``login.zip``, ``login/``, bare notebooks.

Whether they are one submission or a class is settled by `autograder.intake.layouts.one_or_class`.
"""

from __future__ import annotations

from autograder.intake.autograder_files import OWN, SIDE, is_reports, is_side_file
from autograder.intake.file_kinds import is_notebook_name, is_system
from autograder.intake.file_or_zip import Place, is_zip
from autograder.intake.layouts.layout import Context, Entry, Found
from autograder.intake.layouts.one_or_class import is_named_as_handed_out
from autograder.intake.layouts.person_or_thing import is_person, stem_of
from autograder.intake.notebook_reader import Unreadable, read_notebook
from autograder.intake.origin import Claim, Origin
from autograder.intake.submissions import student_name

CLASS, ONE = "class", "one"
RULE = "a class: one student for each zip, folder or notebook"
RULE_ONE = "one submission"
# Files that a student may have meant to hand in, though nothing in them can be read.
_MEANT = (
    *(".rar", ".7z", ".tar", ".tgz", ".gz", ".bz2", ".xz", ".zipx", ".py", ".doc", ".docx"),
    *(".pdf", ".odt", ".pages", ".ipynb~", ".part", ".crdownload", ".lnk", ".html", ".htm"),
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


def _is_handout(place: Place, context: Context) -> bool:
    """Whether a place holds untouched notebooks of the handout and nothing of anybody's."""
    if not context.handout.cells:
        return False
    if place.is_folder:
        if place.name.lower() != "notebooks":
            return False
        books = [child for child in place.children() if is_notebook_name(child.name)]
        return bool(books) and all(_is_untouched(book, context) for book in books)
    return is_named_as_handed_out(place, context) and _is_untouched(place, context)


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
