"""Tells pip where the engine is: in the folder beside, if this course is installed from a checkout.

uv reads the same from ``[tool.uv.sources]``; pip has no such table. A wheel that is built for
others names the engine without a place.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

ENGINE = "course-autograder"


class EngineBeside(BuildHookInterface):  # type: ignore[type-arg]
    """Gives the requirement of the engine the place of its folder."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Do so only while pip installs: pip alone sets the variable, in all its builds."""
        folder = Path(self.root, "autograder")
        if "PIP_BUILD_TRACKER" not in os.environ or not (folder / "pyproject.toml").is_file():
            return
        needed = self.metadata.core.dependencies
        needed[:] = [
            f"{ENGINE} @ {folder.as_uri()}" if requirement.startswith(ENGINE) else requirement
            for requirement in needed
        ]
