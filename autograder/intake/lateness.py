"""What lateness costs: the days that have begun since the due time, and a percentage for each."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta


@dataclass(frozen=True)
class LatePolicy:
    """What lateness costs; all times know their zone."""

    due: datetime
    grace: timedelta
    percent_a_day: float
    most_percent: float

    def days_late(self, handed_in: datetime, extension_days: float = 0.0) -> int:
        """The days that have begun since the due time; none within the grace."""
        # In the zone's own clock: three days later is the same hour, also when summer time ends.
        due = (self.due + timedelta(days=extension_days)).astimezone(UTC)
        late = handed_in.astimezone(UTC) - due
        return 0 if late <= self.grace else math.ceil(late / timedelta(days=1))

    def percent(self, days: int) -> float:
        """What that many days cost, in percent of the points earned."""
        return min(self.most_percent, days * self.percent_a_day)
