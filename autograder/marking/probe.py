"""What is sent into a student's process to find out about a response, and what stays here."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from autograder.marking.expression import Points
from autograder.marking.function import Expected


@dataclass(frozen=True)
class Probe:
    """A question made ready to be put: ``sent`` crosses to the student, the rest never does."""

    sent: dict[str, Any]
    points: Points = field(default_factory=dict)
    expected: Expected | None = None
