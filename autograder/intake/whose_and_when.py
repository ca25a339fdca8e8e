"""Whose each submission is and when it was handed in, as one summary."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import datetime

from autograder.intake.class_list import ClassList
from autograder.intake.long_list import LongList
from autograder.intake.submissions import Submission
from autograder.intake.summary import Row, Summary
from autograder.intake.time_handed_in import names_in_a_table, origin_with_time
from autograder.intake.times_to_doubt import look_at_times


def summarise(
    submissions: Sequence[Submission],
    class_list: ClassList,
    times: Mapping[str, datetime] | None = None,
    trust_times: bool = False,
) -> Summary:
    """Whose each submission is and when it was handed in; `Summary.rows` has the times.

    ``times`` is what a ``times.csv`` says; with ``trust_times`` the times of files count where
    nothing better is known, and penalties are taken whatever the times look like.
    """
    matches = {}
    if class_list.students:  # whose one is depends on whose the others may be
        matches = class_list.match_all({entry.student: entry.origin for entry in submissions})
    rows: LongList[Row] = LongList(Row)
    called: set[str] = set()
    for submission in submissions:
        key = submission.student
        match = matches.get(key) or class_list.match_all({key: submission.origin})[key]
        origin = origin_with_time(submission, match, times or {}, trust_times)
        called |= {name.casefold() for name in names_in_a_table(submission, match)}
        days = 0
        if origin.handed_in is not None:
            days = class_list.days_late(origin.handed_in, match.people)
        percent = class_list.late.percent(days) if class_list.late else 0.0
        rows.append(Row(replace(submission, origin=origin), match, days, percent))
    summary = Summary(class_list, rows)
    found = {person for row in rows for person in row.match.people}
    summary.missing = tuple(person for person in class_list.students if person not in found)
    called |= {
        name.casefold()
        for person in summary.missing
        for name in (*person.identifiers(), person.name)
    }
    strange = sorted(set(times or {}) - called)
    if strange:
        more = f" and {len(strange) - 5} more" if len(strange) > 5 else ""
        summary.warnings.append(
            f"The table of times names {', '.join(strange[:5])}{more}, from whom nothing was "
            "handed in. Correct the names there, or take the lines out."
        )
    look_at_times(summary, trust_times)
    return summary
