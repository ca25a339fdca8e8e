"""Why a question looks broken, by what a class made of it."""

from __future__ import annotations

from collections import Counter

from autograder.language import _
from autograder.reports.correlations import FEWEST

LOW_DISCRIMINATION = 0.15
STOPPED = ("error", "timeout", "killed", "unreadable")


def troubles_of(
    statuses: Counter[str],
    attempted: int,
    difficulty: float | None,
    discrimination: float | None,
    unnamed: int,
) -> list[str]:
    """Why a question looks broken, in sentences."""
    if attempted < FEWEST or difficulty is None:
        return []
    troubles = []
    if discrimination is not None and discrimination < 0:
        troubles.append(
            _("Students who do well elsewhere do badly here: check the key and the wording.")
        )
    elif discrimination is not None and discrimination < LOW_DISCRIMINATION:
        troubles.append(
            _("Doing well here says little about doing well elsewhere: is it ambiguous?")
        )
    if difficulty == 0:
        troubles.append(_("Nobody earned a point: check the key."))
    elif difficulty < 0.2:
        troubles.append(_("Very few points are earned: is something missing from the prompt?"))
    stopped = sum(statuses[status] for status in STOPPED)
    if stopped >= 0.2 * attempted:
        troubles.append(
            _(
                "{count} of {all} responses stopped with an exception or at a limit: is the stub "
                "clear, is the limit long enough?"
            ).format(count=stopped, all=attempted)
        )
    if unnamed >= 0.25 * attempted:
        troubles.append(
            _(
                "{count} of {all} responses are wrong in ways that no mistake in the key names: "
                "read some, and add the common ones."
            ).format(count=unnamed, all=attempted)
        )
    return troubles
