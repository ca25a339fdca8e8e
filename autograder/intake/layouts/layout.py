"""What a layout is: how a download is recognised and taken apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime, tzinfo
from typing import Protocol

from autograder.course import Settings
from autograder.intake.autograder_files import SIDE, is_side_file
from autograder.intake.file_kinds import is_notebook_name, is_system
from autograder.intake.file_or_zip import Place, is_zip
from autograder.intake.handout import Handout
from autograder.intake.long_list import LongList
from autograder.intake.names_in_sentences import shown
from autograder.intake.origin import Origin, Piece
from autograder.intake.person import Person


@dataclass(frozen=True)
class Context:
    """What is known before a download is read.

    ``due`` is the time until which a commit counts, ``zone`` that of times which name none (None:
    this machine's).
    """

    settings: Settings
    handout: Handout = field(default_factory=lambda: Handout({}))
    people: tuple[Person, ...] = ()
    due: datetime | None = None
    zone: tzinfo | None = None


@dataclass(frozen=True)
class Entry:
    """One submission as a layout finds it; ``key`` is its name, ``apart`` tells two of one name."""

    key: str
    origin: Origin
    apart: str = ""
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class PassedOver:
    """Something that is not a submission, and why; a person should look at it, or need not."""

    place: str
    reason: str
    needs_person: bool = True


@dataclass
class Found:
    """What a layout found in a folder, and the rule by which it was read."""

    layout: str = ""
    rule: str = ""
    entries: LongList[Entry] = field(default_factory=lambda: LongList(Entry))
    passed_over: list[PassedOver] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)

    def pass_over(self, place: Place, reason: str, needs_person: bool = True) -> None:
        """Note something that is not a submission."""
        self.passed_over.append(PassedOver(shown(place.text()), reason, needs_person))


class Layout(Protocol):
    """One way in which a system gives a class's work."""

    name: str
    rule: str  # one sentence for a person: how the folder was read

    def recognises(self, folder: Place) -> bool:
        """Whether a folder has the marks of the layout: names and side files, nothing else."""
        ...

    def read(self, folder: Place, context: Context) -> Found:
        """The submissions in it, and what was passed over."""
        ...


def side_entry(place: Place, found: Found, expected: bool = False) -> None:
    """Pass over something that does not fit the layout, with the reason."""
    if is_system(place.name):
        found.pass_over(place, "made by an operating system or an editor", False)
    elif is_side_file(place):
        found.pass_over(place, SIDE, False)
    elif place.name.startswith("."):
        found.pass_over(place, "a hidden file")
    elif expected:
        found.pass_over(place, "a side file of the download", False)
    else:
        found.pass_over(place, "its name does not match the rest of this download")


def fit_most(fitting: Sequence[Place], folder: Place) -> bool:
    """Whether the places that fit a layout are most of what could have been handed in.

    One student's choice of a name must not change how all others are read.
    """
    relevant = [
        place
        for place in visible(folder)
        if place.is_folder or is_zip(place) or is_notebook_name(place.name)
    ]
    names = {place.name for place in fitting}
    others = [place for place in relevant if place.name not in names]
    return bool(fitting) and len(fitting) > len(others)


def visible(folder: Place) -> list[Place]:
    """The children that no operating system made."""
    return [place for place in folder.children() if not is_system(place.name)]


def local_time(text: str, format: str, context: Context) -> datetime | None:
    """A time without a zone, in the context's zone or this machine's; None if it is no time."""
    try:
        time = datetime.strptime(text, format)
        if context.zone is not None:
            return time.replace(tzinfo=context.zone)
        return time.astimezone(UTC)
    except (ValueError, OverflowError, OSError):
        return None


def pieces_of(places: Sequence[Place]) -> tuple[Piece, ...]:
    """The places as the pieces of one submission."""
    return tuple(place.piece for place in places)
