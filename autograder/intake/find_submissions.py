"""Finds submissions: which layout a download has, and who handed in what in it.

The layout is recognised by its own marks or given; what has none is read by the rule of
`autograder.intake.layouts.one_or_class`. A zip is looked into only where it was given itself or is
the only thing there: what a student's zip holds can never become somebody else's submission.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from autograder.course import Settings
from autograder.errors import UsageError
from autograder.intake.autograder_files import OWN, is_reports, without_own_files
from autograder.intake.file_kinds import is_notebook_name
from autograder.intake.file_or_zip import DiskPlace, Group, Place, as_folder_if_readable, is_zip
from autograder.intake.layouts import LAYOUTS, plain
from autograder.intake.layouts.layout import Context, Entry, Found, PassedOver, visible
from autograder.intake.layouts.one_or_class import Verdict, is_wrapped, judge, unclear
from autograder.intake.layouts.person_or_thing import is_person
from autograder.intake.long_list import LongList
from autograder.intake.names_in_sentences import shown
from autograder.intake.signs_of_a_download import (
    ask_which_download,
    has_marks,
    is_class,
    is_download,
)
from autograder.intake.student_keys import with_unique_keys
from autograder.intake.submissions import Submission

LAYOUT_NAMES = (*(layout.name for layout in LAYOUTS), plain.CLASS, plain.ONE)
_DEEPEST = 4  # folders above the one that holds the class
_FEW_DOWNLOADS = 6  # side by side; more zips are students'


@dataclass
class Intake:
    """What was found: the submissions, what was passed over and why, and how it was read."""

    submissions: LongList[Submission] = field(default_factory=lambda: LongList(Submission))
    passed_over: list[PassedOver] = field(default_factory=list)
    rules: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)


def take_in(
    paths: Collection[Path],
    settings: Settings,
    context: Context | None = None,
    layout: str | None = None,
    known_keys: Mapping[tuple[str, str], str] | None = None,
) -> Intake:
    """The submissions at the given paths, each of them a submission, a class or a download.

    ``layout`` says how to read them, whatever their marks. ``known_keys`` are the students' keys
    that a gradebook has already, by layout and prefix, so that nobody gets a second one.

    Raises:
        UsageError: if a path does not exist, or if it is not clear what it is.
    """
    context = context or Context(settings)
    for path in paths:
        if not path.exists() and not path.is_symlink():
            raise UsageError(
                f"{path} does not exist; give a submission or a folder of submissions."
            )
    groups: dict[Path, list[Place]] = {}
    for path in dict.fromkeys(_absolute(path) for path in paths):
        groups.setdefault(path.parent, []).append(DiskPlace(path))
    found = [_find_group(places, context, layout) for places in groups.values()]
    rules = list(dict.fromkeys(one.rule for one in found if one.entries))
    entries = found[0].entries if found else LongList(Entry)
    for other in found[1:]:
        entries += other.entries
    return Intake(
        with_unique_keys(entries, known_keys or {}),
        [passed for one in found for passed in one.passed_over],
        rules,
        [warning for one in found for warning in one.warnings],
    )


def find_submissions(paths: Collection[Path], settings: Settings) -> Sequence[Submission]:
    """The submissions at the given paths; `take_in` says more about them.

    Raises:
        UsageError: if a path does not exist, or if it is not clear what it is.
    """
    return take_in(paths, settings).submissions


def _absolute(path: Path) -> Path:
    """The path from the root; a link in its last part stays one."""
    if path.name in ("", ".."):
        return path.resolve()
    return path.parent.resolve() / path.name


def _find_group(places: Sequence[Place], context: Context, layout: str | None) -> Found:
    """What is at paths that lie side by side."""
    first = places[0]
    parent = first.piece.path.parent
    group = Group(parent.name, places, replace(first.piece, path=parent))
    if layout == plain.ONE:
        return Found("plain", plain.RULE_ONE, LongList(Entry, map(plain.one_entry, places)))
    if len(places) > 1:
        return _find(group, context, layout)
    # A single path may have the mark itself, as a student's folder out of a Moodle download has.
    if layout is None:
        if first.is_folder and not first.is_link and visible(first) == []:
            raise UsageError(f"There is nothing in {shown(first.text())}.")
        for known in LAYOUTS:
            if known.recognises(group):
                return known.read(group, context)
    return _find_single(first, context, layout)


def _find_single(place: Place, context: Context, layout: str | None) -> Found:
    """A path given by itself: a zip may hold a class."""
    if place.is_link or not (place.is_folder or is_zip(place)):
        return Found("plain", plain.RULE_ONE, LongList(Entry, [plain.one_entry(place)]))
    if place.is_folder:
        return _find(place, context, layout)
    if layout is None and is_person(place, context):
        return Found("plain", plain.RULE_ONE, LongList(Entry, [plain.one_entry(place)]))
    inside = as_folder_if_readable(place)
    if inside is None:
        return Found("plain", plain.RULE_ONE, LongList(Entry, [plain.one_entry(place)]))
    found = _look(inside, context, layout, is_archive=True)
    return found or Found("plain", plain.RULE_ONE, LongList(Entry, [plain.one_entry(place)]))


def _find(folder: Place, context: Context, layout: str | None) -> Found:
    found = _look(folder, context, layout, is_archive=False)
    return found or Found("plain", plain.RULE_ONE, LongList(Entry, [plain.one_entry(folder)]))


def _look(
    folder: Place, context: Context, layout: str | None, is_archive: bool, depth: int = 0
) -> Found | None:
    """The class in a folder or just below it; None if it is one submission."""
    rest, own = without_own_files(folder)
    found = _look_at(rest, context, layout, is_archive, depth)
    if found is None:
        return None
    for place in own:
        found.pass_over(place, OWN, needs_person=False)
    return found


def _look_at(
    folder: Place, context: Context, layout: str | None, is_archive: bool, depth: int
) -> Found | None:
    for known in LAYOUTS:
        if known.recognises(folder) if layout is None else known.name == layout:
            found = (
                known.read(folder, context) if layout is None else _forced(known, folder, context)
            )
            if found is not None:
                return found
    if layout == plain.CLASS:
        return plain.read_class(folder, context)
    if depth < _DEEPEST:
        below = _look_below(folder, context, layout, is_archive, depth)
        if below is not None:
            return below
    if layout is not None:
        raise UsageError(
            f"{shown(folder.text())} does not look like a download of {layout}: nothing in it is "
            "named so."
        )
    verdict = judge(folder, context, is_archive)
    if verdict is Verdict.UNCLEAR:
        raise unclear(folder, context)
    if verdict is Verdict.CLASS or (verdict is Verdict.EMPTY and not is_archive and depth == 0):
        return plain.read_class(folder, context)
    return None


def _forced(known: object, folder: Place, context: Context) -> Found | None:
    """A layout that is asked for, where at least one entry fits it."""
    found: Found = known.read(folder, context)  # type: ignore[attr-defined]
    return found if found.entries else None


def _look_below(
    folder: Place, context: Context, layout: str | None, is_archive: bool, depth: int
) -> Found | None:
    """The class one folder further down, where there is nothing else; or several downloads."""
    wrapped = is_wrapped(folder)
    if wrapped is not None:
        if is_person(wrapped, context) and layout is None:
            return None
        inner = is_archive or not isinstance(wrapped, DiskPlace)
        found = _look_or_none(wrapped, context, layout, inner, depth + 1)
        return _beside(folder, found, wrapped)
    work = [
        place
        for place in visible(folder)
        if (place.is_folder and not is_reports(place)) or is_zip(place)
    ]
    if len(work) < 2:
        if layout is None and any(is_notebook_name(place.name) for place in visible(folder)):
            inside = [as_folder_if_readable(place) or place for place in work]
            ask_which_download(folder, inside, context)
        return None
    folders = [place for place in work if place.is_folder]
    if len(folders) < len(work):
        if layout is None and len(work) <= _FEW_DOWNLOADS:
            return _look_into_zips(folder, work, context, is_archive, depth)
        return None
    if not all(has_marks(place) or is_class(place, context) for place in folders):
        if layout is None and len(work) <= _FEW_DOWNLOADS:
            ask_which_download(folder, folders, context)
        return None
    return _look_at_several(folders, context, layout, is_archive, depth)


def _look_into_zips(
    folder: Place, work: Sequence[Place], context: Context, is_archive: bool, depth: int
) -> Found | None:
    """Several downloads, each a zip as it came; a person is asked if one of them lies unpacked."""
    inside = [as_folder_if_readable(place) or place for place in work]
    if all(map(is_zip, work)) and all(map(has_marks, inside)) and any(map(is_download, inside)):
        return _look_at_several(inside, context, None, is_archive, depth)
    ask_which_download(folder, inside, context)
    return None


def _look_at_several(
    places: Sequence[Place], context: Context, layout: str | None, is_archive: bool, depth: int
) -> Found | None:
    """Downloads that lie side by side, as one for each section of a class, read as one."""
    if any(is_person(place, context) for place in places):
        return None
    several = [_look_or_none(place, context, layout, is_archive, depth + 1) for place in places]
    joined = Found()
    for found in several:
        if not found:
            return None
        joined.layout, joined.rule = found.layout, found.rule
        joined.entries += found.entries
        joined.passed_over += found.passed_over
        joined.warnings += found.warnings
    return joined


def _look_or_none(
    folder: Place, context: Context, layout: str | None, is_archive: bool, depth: int
) -> Found | None:
    try:
        return _look(folder, context, layout, is_archive, depth)
    except UsageError:
        if layout is None and depth < 2:
            raise
        return None


def _beside(folder: Place, found: Found | None, wrapped: Place) -> Found | None:
    """Names also what lies beside the folder of the class."""
    if found is None:
        return None
    for place in folder.children():
        if place.name != wrapped.name:
            reason, needs_person = plain.why_not(place, Context(Settings()))
            found.pass_over(place, reason or "lies beside the folder of the class", needs_person)
    return found
