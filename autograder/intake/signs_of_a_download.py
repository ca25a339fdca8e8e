"""Whether a folder is a download of a whole class; a person is asked where more lies beside it."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.errors import UsageError
from autograder.intake.file_kinds import is_notebook_name
from autograder.intake.file_or_zip import Place, is_zip
from autograder.intake.layouts import LAYOUTS
from autograder.intake.layouts.layout import Context, visible
from autograder.intake.layouts.one_or_class import Verdict, is_wrapped, judge, signs_in
from autograder.intake.layouts.person_or_thing import is_generic, is_person, stem_of
from autograder.intake.names_in_sentences import shown

_SURELY_A_CLASS = 3  # submissions; fewer may be one student's drafts
_NAMED = 4


def ask_which_download(folder: Place, work: Sequence[Place], context: Context) -> None:
    """Stop where a download lies beside something else that is nobody's of the list."""
    downloads = [place for place in work if is_download(place)]
    books = [place for place in visible(folder) if is_notebook_name(place.name)]
    downloads = downloads or [place for place in work if _is_whole_class(place, work, context)]
    if downloads and not any(is_person(place, context) for place in work):
        others = [place for place in (*work, *books) if place is not downloads[0]]
        beside = ", ".join(shown(place.name) for place in others[:_NAMED])
        raise UsageError(
            f"{shown(downloads[0].text())} looks like a download of a whole class, and beside it "
            f"lies {beside}. Give the download alone, or say --layout class if each of them is one "
            "student's, or --layout one if all of it is."
        )


def has_marks(place: Place) -> bool:
    """Whether a folder, or the only one in it, has the marks of a system."""
    folder = is_wrapped(place) or place if place.is_folder else place
    return folder.is_folder and any(known.recognises(folder) for known in LAYOUTS)


def is_download(place: Place) -> bool:
    """Whether it has a system's marks, and holds more than one student's folder in a class has."""
    folder = is_wrapped(place) or place if place.is_folder else place
    handed_in = [p for p in visible(folder) if p.is_folder or is_zip(p) or is_notebook_name(p.name)]
    return len(handed_in) >= 2 and has_marks(place)


def _is_whole_class(place: Place, beside: Sequence[Place], context: Context) -> bool:
    """Whether a folder can hardly be one student's, by what lies in it and what it is called."""
    if not place.is_folder or not is_class(place, context, _SURELY_A_CLASS):
        return False
    known = [p for p in visible(place) if is_person(p, context)]
    called = is_generic(stem_of(place), context)
    return len(beside) == 1 or called or len(known) >= _SURELY_A_CLASS


def is_class(place: Place, context: Context, fewest: int = 2) -> bool:
    """Whether a folder holds the work of several students, by what lies in it."""
    many = len(signs_in(place, context).of_class) >= fewest
    return many and judge(place, context) is Verdict.CLASS
