"""One submission or a class: what a folder (or a zip) that has no system's marks holds.

This is the rule, which is printed:

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

from autograder.errors import UsageError
from autograder.intake.autograder_files import is_reports
from autograder.intake.file_kinds import is_notebook_name, is_system
from autograder.intake.file_or_zip import Place, as_folder_if_readable, is_zip
from autograder.intake.layouts.layout import Context, visible
from autograder.intake.layouts.person_or_thing import COPIED, is_generic, is_person, stem_of
from autograder.intake.names_in_sentences import shown

_NUMBERED = re.compile(r"\d{1,2}[ _-]+\w")


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


def signs_in(folder: Place, context: Context) -> Signs:
    """What lies in a folder, sorted by what it speaks for."""
    signs = Signs([], [], [])
    for place in visible(folder):
        if place.name.startswith(".") or is_reports(place):
            continue
        if is_notebook_name(place.name):
            if is_named_as_handed_out(place, context):
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


def is_named_as_handed_out(place: Place, context: Context) -> bool:
    """Whether a notebook has a name of the handout, maybe that of a copy."""
    stem = COPIED.sub("", COPIED.sub("", stem_of(place).casefold()))
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


def _are_notebooks(places: Sequence[Place]) -> bool:
    return all(is_notebook_name(place.name) for place in places)


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
