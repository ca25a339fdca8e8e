"""What came out of the proof by mutants and variants, and how it is kept until a source changes."""

from __future__ import annotations

import hashlib
import json
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path

import msgspec

from autograder.course import Course
from autograder.course.questions import Question
from autograder.course.right_work import module_of, right_work_of
from autograder.mutants.changed_functions import course_sources
from autograder.mutants.mutant import Mutant
from autograder.questions.answer import Answer
from autograder.questions.registry import kind_of

_CACHE = Path(".mutants_cache")
_PACKAGE = Path(__file__).parents[1]
# What decides on a proof, beside the course: how mutants are made, tried and marked.
_ENGINE = ("questions", "kinds", "mutants", "diagnosis", "marking", "sandbox/inside", "authoring")


@dataclass(frozen=True)
class Survivor:
    """A mutant that earned everything, and what it passed."""

    mutant: Mutant
    passed: tuple[str, ...]


@dataclass(frozen=True)
class Findings:
    """What came out for one question: how many were tried, and what must not be."""

    tried: int
    names: tuple[str, ...]
    survivors: tuple[Survivor, ...]
    variants: dict[str, str]  # by name: what is wrong, nothing if it earns everything


def digest_of(course: Course, question: Question) -> str:
    """A fingerprint of all that the findings for a question come from."""
    answer = course.key[question.id]
    names = [*kind_of(question).code_names(answer)]
    module = module_of(course, question)
    texts = [] if module else [*right_work_of(course, question)]
    engine = [path for folder in _ENGINE for path in (_PACKAGE / folder).rglob("*.py")]
    digest = hashlib.sha256(f"{question}\0{_without_words(answer)}\0{texts}".encode())
    names += [module] if module else []
    for path in [*course_sources(names, course.root), *sorted(engine)]:
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _without_words(answer: Answer) -> dict[str, object]:
    fields: dict[str, object] = msgspec.to_builtins(answer)
    for name in ("explanation", "equivalent", "code"):
        fields.pop(name, None)
    return fields


def read_findings(course: Course, id: str, digest: str) -> Findings | None:
    """What is kept for a question, None if it comes from other sources."""
    path = course.root / _CACHE / f"{id}.json"
    try:
        kept = json.loads(path.read_text(encoding="utf-8"))
        if kept["digest"] != digest:
            return None
        survivors = tuple(
            Survivor(Mutant(**entry["mutant"]), tuple(entry["passed"]))
            for entry in kept["survivors"]
        )
        return Findings(kept["tried"], tuple(kept["names"]), survivors, kept["variants"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def keep_findings(course: Course, id: str, digest: str, findings: Findings) -> None:
    """Keep what came out for a question."""
    folder = course.root / _CACHE
    with suppress(OSError):  # a course that cannot be written to is proven again each time
        folder.mkdir(exist_ok=True)
        text = json.dumps({"digest": digest, **asdict(findings)})
        (folder / f"{id}.json").write_text(text, encoding="utf-8", newline="\n")
