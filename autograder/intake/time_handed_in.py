"""When something was handed in: which of the times that are known counts.

In this order: a time in the class list, the layout's own, ``times.csv``, what `submit()` wrote into
the zip (a hint: students can change it), and the file's own time only when that is asked for, since
a download sets it.
"""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime

from autograder.intake.changed_files import snapshot
from autograder.intake.file_or_zip import DiskPlace
from autograder.intake.match_people import Match
from autograder.intake.origin import (
    CLASS_LIST,
    FILE,
    INSIDE,
    LAYOUT,
    TIMES_FILE,
    Origin,
)
from autograder.intake.submissions import Submission
from autograder.intake.time_submit_wrote import hinted_time


def origin_with_time(
    submission: Submission,
    match: Match,
    times: Mapping[str, datetime],
    trust_times: bool,
) -> Origin:
    """The origin with the first time that is known, in the order that the times module gives."""
    origin = submission.origin
    for person in match.people:
        if person.handed_in is not None:
            return origin.at(person.handed_in, CLASS_LIST)
    if origin.time_from == LAYOUT:
        return origin
    for person in match.people:
        if person.noted_time is not None:
            return origin.at(person.noted_time, LAYOUT)
    for name in names_in_a_table(submission, match):
        if name.casefold() in times:
            return origin.at(times[name.casefold()], TIMES_FILE)
    if origin.time_from == TIMES_FILE and not times:
        return origin  # as an earlier run was told
    if origin.time_from == INSIDE:
        return origin
    hint = hinted_time(submission.pieces)
    if hint is not None:
        return origin.at(hint, INSIDE)
    if trust_times:
        return origin.at(_file_time(submission), FILE)
    return origin.at(None, "")


def names_in_a_table(submission: Submission, match: Match) -> list[str]:
    """Everything that a row of times.csv may call a submission."""
    names = [submission.student, submission.origin.prefix]
    for piece in submission.pieces:
        names += [piece.name, piece.name.rpartition(".")[0]]
    for claim in submission.origin.claims:
        names += [claim.login, claim.email, claim.id, claim.number, claim.called]
    for person in match.people:
        names += [*person.identifiers(), person.number]
    if match.people:
        names.append(match.people[0].name)
    return [name for name in dict.fromkeys(names) if name]


def _file_time(submission: Submission) -> datetime | None:
    """The newest file of a submission; a zip's entries have no zone, so the zip's own time."""
    seen = snapshot([piece.path for piece in submission.pieces])
    times = [DiskPlace(path).time for path in seen]
    return max((time for time in times if time is not None), default=None)
