"""That no isolation works on this machine."""

from __future__ import annotations

from autograder.errors import AutograderError


class SandboxError(AutograderError):
    """Student code cannot be isolated here; the sentence says why and what to do."""
