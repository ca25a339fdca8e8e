"""Puts the modules that stand in no room into the engine's wheel.

Its settings name the rooms one by one, and can do so for folders only. A checkout that is installed
to be edited must not get copies of these modules, which would hide the checkout.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class EngineWheel(BuildHookInterface):  # type: ignore[type-arg]
    """Includes the loose files of the package in a standard wheel, and not this one."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Include them, unless the build is of an editable install."""
        if version == "standard":
            root = Path(self.root)
            modules = set(root.glob("*.py")) - {root / Path(__file__).name}
            for path in (*sorted(modules), root / "LICENSE"):
                build_data["force_include"][str(path)] = f"autograder/{path.name}"
