"""Times that look like a download's or a wrong zone's, or that students can change.

They cost nobody points until somebody has looked.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta

from autograder.intake.long_list import LongList
from autograder.intake.origin import (
    CLASS_LIST,
    INSIDE,
)
from autograder.intake.summary import Row, Summary, has_time

_TOGETHER = timedelta(minutes=10)
_FEWEST = 3  # of whom times can look alike


@dataclass(frozen=True)
class Doubt:
    """Why the times should be looked at before anybody loses points; empty if they need not be."""

    sentence: str = ""

    def __bool__(self) -> bool:
        return bool(self.sentence)


def doubt(times: Sequence[tuple[datetime, bool]]) -> Doubt:
    """Whether times (each with whether it is late) look like a download's or a wrong zone's."""
    if len(times) < _FEWEST:
        return Doubt()
    span = max(time for time, _ in times) - min(time for time, _ in times)
    if span <= _TOGETHER:
        minutes = max(1, round(span.total_seconds() / 60))
        return Doubt(
            f"All {len(times)} times lie within {minutes} minutes of each other, as after a "
            "download; no penalty is taken. Give --times FILE, or --trust-times if they are right."
        )
    if all(late for _, late in times):
        return Doubt(
            f"All {len(times)} with a known time are late; no penalty is taken. Check the due time "
            "and its zone, then say --trust-times if it is so."
        )
    return Doubt()


def look_at_times(summary: Summary, trust_times: bool) -> None:
    """Say what is odd about the times, and take nothing off for what is not sure."""
    if summary.class_list.late is None:
        return
    # What a person wrote into the class list, or said to trust, is not doubted.
    watched = [row for row in summary.rows if has_time(row) and row.origin.time_from != CLASS_LIST]
    doubted = doubt([(row.origin.handed_in, bool(row.days)) for row in watched if has_time(row)])  # type: ignore[misc]
    if doubted and not trust_times:
        summary.warnings.append(doubted.sentence)
    hints = [row for row in watched if row.origin.time_from == INSIDE and row.days]
    if hints and not trust_times:
        summary.warnings.append(
            f"{_some(hints)} may be late, but only the submission itself says when, which students "
            "can change; no penalty is taken. Give --times FILE, or --trust-times."
        )
    if not trust_times:
        withheld = watched if doubted else hints
        students = {row.submission.student for row in withheld}
        withheld_rows = (
            replace(row, percent=0.0) if row.submission.student in students else row
            for row in summary.rows
        )
        summary.rows = LongList(Row, withheld_rows)
    marked = [row for row in summary.rows if row.only_called_late]
    if marked:
        summary.warnings.append(
            f"{_some(marked)}: the download calls this late and does not say when it was handed "
            "in, so no penalty is taken. Give --times FILE."
        )
    unknown = [row for row in summary.rows if not has_time(row) and not row.origin.called_late]
    if unknown:
        summary.warnings.append(
            f"Nothing says when {_some(unknown)} handed in, so nothing is late there. Give --times "
            "FILE, or --trust-times to take the times of the files."
        )


def _some(rows: Sequence[Row]) -> str:
    names = [row.submission.student for row in rows[:4]]
    more = f" and {len(rows) - 4} more" if len(rows) > 4 else ""
    return ", ".join(names) + more
