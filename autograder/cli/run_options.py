"""What a command line asks of a run, with types: no command hands its bare arguments on."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from autograder.grading.dask_address import ClusterAddress
    from autograder.sandbox.launcher import Isolation


@dataclass(frozen=True, kw_only=True)
class GradingWanted:
    """How to grade, and what to write of it.

    ``questions`` are ids, none for all; ``explanations`` and ``seed`` are None where those of the
    last run go on. A ``trial`` writes nothing. ``regrade`` asks for a new run in any case.
    """

    out: Path
    questions: tuple[str, ...]
    isolation: Isolation
    jobs: int
    cluster: ClusterAddress | None
    seed: int | None
    explanations: bool | None
    trial: bool
    regrade: bool
    strict: bool
    for_github: bool
    for_machines: bool


@dataclass(frozen=True, kw_only=True)
class IntakeWanted:
    """Where to look for work, how to read it, and where its times come from.

    ``layout`` is None where the marks of a download say it, ``trust_times`` where the last run's
    answer goes on. A ``trial`` keeps no such answer.
    """

    out: Path
    paths: tuple[Path, ...]
    layout: str | None
    times: Path | None
    trust_times: bool | None
    trial: bool


def grading_wanted(parsed: argparse.Namespace, regrade: bool) -> GradingWanted:
    """What `grade` and `regrade` are asked for."""
    return GradingWanted(
        out=parsed.out,
        questions=tuple(parsed.question or ()),
        isolation="none" if parsed.no_sandbox else "auto",
        jobs=parsed.jobs,
        cluster=parsed.cluster,
        seed=parsed.seed,
        explanations=parsed.explanations,
        trial=parsed.dry_run,
        regrade=regrade,
        strict=parsed.strict,
        for_github=getattr(parsed, "summary", None) == "github",
        for_machines=parsed.json,
    )


def intake_wanted(parsed: argparse.Namespace) -> IntakeWanted:
    """What `grade`, `regrade` and `intake` are asked for; `regrade` names no paths."""
    return IntakeWanted(
        out=parsed.out,
        paths=tuple(getattr(parsed, "paths", ())),
        layout=getattr(parsed, "layout", None),
        times=parsed.times,
        trust_times=parsed.trust_times,
        trial=getattr(parsed, "dry_run", False),
    )
