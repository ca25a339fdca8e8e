"""What is sent into a student's process to find out about a response, and what stays here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Probe:
    """A question made ready to be put: ``sent`` crosses to the student, the rest never does.

    ``kept`` is whatever the question's kind needs to mark what comes back.

    ``shows_first`` says that students are shown what their function returns for the first case. The
    case is then asked in a message of its own, `opening`, and the others later, in `rest`: student
    code can look into its callers, and would find the hidden inputs that come with the public one.
    """

    sent: dict[str, Any]
    kept: Any = None
    shows_first: bool = False

    @property
    def opening(self) -> dict[str, Any] | None:
        """What is to be sent before anything hidden is, if there is such a part."""
        return {**self.sent, "cases": self.sent["cases"][:1]} if self.shows_first else None

    @property
    def rest(self) -> dict[str, Any]:
        """What is to be sent after the opening; ``sent`` where there is none."""
        return {**self.sent, "cases": self.sent["cases"][1:]} if self.shows_first else self.sent
