"""Wrong responses of a class that have no name, in clusters of those that did the same."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass

from autograder.course import Course
from autograder.gradebook.record import Record
from autograder.questions.mark import Mark
from autograder.questions.registry import kind_of


@dataclass(frozen=True)
class Cluster:
    """Responses with equal outcomes on everything hidden; ``typical`` is the shortest of them."""

    question: str
    evidence: str
    students: tuple[str, ...]
    typical: str
    feedback: str


def nameless(records: Iterable[Record], least: int = 1) -> list[Cluster]:
    """The clusters of ``least`` or more responses, the largest first."""
    found: dict[tuple[str, str], list[tuple[str, Mark]]] = {}
    for record in records:
        for mark in record.marks.values():
            if mark.status in ("wrong", "partial") and mark.alternative is None and mark.evidence:
                key = mark.question, mark.evidence
                found.setdefault(key, []).append((record.student, mark))
    clusters = []
    for (question, evidence), given in found.items():
        if len(given) < least:
            continue
        shortest = min((mark for _, mark in given), key=lambda mark: len(mark.code or "x" * 9999))
        clusters.append(
            Cluster(
                question,
                evidence,
                tuple(student for student, _ in given),
                shortest.code or shortest.understood,
                shortest.feedback,
            )
        )
    return sorted(clusters, key=lambda cluster: (-len(cluster.students), cluster.question))


def entry_for(course: Course, cluster: Cluster) -> str:
    """A mistake for the key, with what is the author's to write left to be filled in."""
    kind = kind_of(course.question(cluster.question)).name
    rows = [
        f'[["{cluster.question}".alternative]]',
        'name = "..."',
        "credit = 0.25",
        'feedback = "..."',
    ]
    if kind == "number":
        rows.insert(2, f"value = {cluster.evidence.removeprefix('value ')}")
    elif kind == "expression":
        formula = cluster.typical.partition("=")[2].strip() or cluster.typical
        rows.insert(2, f"expression = {json.dumps(formula.replace('sp.', ''))}")
    elif kind == "function":
        reference = getattr(course.key[cluster.question], "reference", "mistakes:...")
        module = reference.partition(":")[0]
        rows.insert(2, f'function = "{module}:..."  # paste the response into a module of mistakes')
    return "\n".join(rows)
