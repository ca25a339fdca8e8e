"""The proof by mutants and by variants: which small changes of what is right marking misses.

The work is shared out to processes, one for each processor, that can be ended: a mutant may loop
for ever. What came out is kept, and holds as long as the files that it came from are the same.
"""

from __future__ import annotations

import hashlib
import importlib
import inspect
import json
import multiprocessing
import os
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import asdict, dataclass
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any

import msgspec

from autograder.course import Course, load_course
from autograder.course.questions import Question
from autograder.errors import CourseError
from autograder.kinds.answer import Answer
from autograder.kinds.registry import kind_of
from autograder.marking.draw import random_numbers
from autograder.marking.marker import Marker
from autograder.marking.mutants.clones import course_sources
from autograder.marking.mutants.mutant import MOST_SECONDS, Mutant, OutOfTime, Trial
from autograder.sandbox.inside.evaluate import evaluate

MUTANT_SEEDS = range(1, 11)
VARIANT_SEEDS = range(1, 26)
VARIANTS = Path("solutions/variants")
_CACHE = Path(".mutants_cache")
_PATIENCE = 120.0  # seconds without an answer after which a process is ended
_PACKAGE = Path(__file__).parents[1]


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


def try_all(
    course: Course, report: Callable[[str], None] = lambda step: None
) -> dict[str, Findings]:
    """The findings for every question that has something to change, by its id.

    Raises:
        CourseError: if the key or a variant cannot be loaded.
    """
    found: dict[str, Findings] = {}
    waiting: dict[str, str] = {}
    for question in course.questions.values():
        digest = _digest(course, question)
        kept = _read(course, question, digest)
        if kept is not None:
            found[question.id] = kept
        else:
            waiting[question.id] = digest
    if not waiting:
        return found
    jobs: list[tuple[str, str, Any]] = []
    mutants: dict[str, list[Mutant]] = {}
    for id in waiting:
        trial = _trial(course, course.question(id))
        mutants[id] = list(trial.mutants) if trial is not None else []
        jobs += [(id, "mutant", index) for index in range(len(mutants[id]))]
        jobs += [(id, "variant", name) for name in _variants(course, course.question(id))]
    survivors: dict[str, list[Survivor]] = {id: [] for id in waiting}
    variants: dict[str, dict[str, str]] = {id: {} for id in waiting}
    for done, ((id, what, which), result) in enumerate(_share_out(course.root, jobs), 1):
        report(f"mutants ({done} of {len(jobs)})")
        if what == "variant":
            variants[id][which] = result if isinstance(result, str) else "it never ends"
        elif result:
            survivors[id].append(Survivor(mutants[id][which], tuple(result)))
    for id, digest in waiting.items():
        names = tuple(mutant.name for mutant in mutants[id])
        left = tuple(sorted(survivors[id], key=lambda entry: names.index(entry.mutant.name)))
        found[id] = Findings(len(names), names, left, variants[id])
        _write(course, id, digest, found[id])
    return {id: found[id] for id in course.questions}


def variant_names(course: Course, question: Question) -> list[str]:
    """The functions in ``solutions/variants`` that respond to a question in other clothes."""
    return list(_variants(course, question))


def has_variants(course: Course, chapter: str) -> bool:
    """Whether the course has right responses in other clothes for a chapter."""
    return (course.root / VARIANTS / f"{chapter}.py").is_file()


def _trial(course: Course, question: Question) -> Trial | None:
    answer = course.key[question.id]
    references = [name for id in course.key for name in _references(course, id)]
    return kind_of(question).trial(
        question,
        answer,
        references,
        course.root,
        lambda seed: random_numbers(question, seed),
    )


def _references(course: Course, id: str) -> tuple[str, ...]:
    return kind_of(course.question(id)).solutions(course.key[id])[:1]


def _variants(course: Course, question: Question) -> dict[str, Callable[..., Any]]:
    """By name: the functions called ``NAME__STYLE`` for the NAME that the question asks for."""
    if question.name is None or not has_variants(course, question.chapter):
        return {}
    module = ".".join([*VARIANTS.parts, question.chapter])
    try:
        names = vars(importlib.import_module(module))
    except Exception as error:
        raise CourseError(f"{VARIANTS / question.chapter}.py cannot be loaded: {error}.") from error
    return {
        name: value
        for name, value in names.items()
        if name.startswith(f"{question.name}__") and inspect.isfunction(value)
    }


# -- one job --------------------------------------------------------------------------------------


class _Bench:
    """What one process tries mutants and variants with."""

    def __init__(self, root: Path) -> None:
        self._course = load_course(root)
        self._trials: dict[str, Trial | None] = {}
        self._markers: dict[int, Marker] = {}

    def work(self, job: tuple[str, str, Any]) -> Any:
        id, what, which = job
        question = self._course.question(id)
        if what == "variant":
            return self._variant(question, which)
        if id not in self._trials:
            self._trials[id] = _trial(self._course, question)
        trial = self._trials[id]
        assert trial is not None
        for seed in MUTANT_SEEDS:
            try:
                with _time_limit(MOST_SECONDS):
                    if trial.passes(which, seed):
                        return list(trial.cases(seed))
            except (OutOfTime, MemoryError):
                return []  # a student's function that does this earns nothing
        return []

    def _variant(self, question: Question, name: str) -> str:
        function = _variants(self._course, question)[name]
        kind = kind_of(question)
        for seed in VARIANT_SEEDS:
            if seed not in self._markers:
                self._markers[seed] = Marker(self._course, seed)
            marker = self._markers[seed]
            try:
                response = kind.variant(question, function)
            except Exception as error:
                return f"it cannot be made: {type(error).__name__}: {error}"
            mark = marker.mark(question.id, evaluate(response, marker.drawn(question.id).probe))
            if mark.credit != 1:
                return f"with seed {seed} it gets {mark.credit:g} credit: {mark.feedback}"
        return ""


class _time_limit:  # noqa: N801
    """Raises `OutOfTime` in the main thread after so much of a processor's time."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds

    def __enter__(self) -> None:
        signal.signal(signal.SIGPROF, self._stop)
        # Once more every second: the first may come where an exception is passed over.
        signal.setitimer(signal.ITIMER_PROF, self._seconds, 1.0)

    def __exit__(self, *_: object) -> None:
        signal.setitimer(signal.ITIMER_PROF, 0)

    @staticmethod
    def _stop(*_: object) -> None:
        raise OutOfTime


def _serve(root: Path, pipe: Connection) -> None:
    import resource
    import sys

    with suppress(OSError), open(os.devnull, "w") as nowhere:
        sys.stdout = nowhere  # a mutant may print
        bench = _Bench(root)
        size = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        limit = size + 2 * 2**30
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        while True:
            try:
                job = pipe.recv()
            except EOFError:
                return
            pipe.send(bench.work(job))


# -- many jobs ------------------------------------------------------------------------------------


class _Process:
    def __init__(self, root: Path) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(root, theirs), daemon=True)
        self._process.start()
        theirs.close()
        self.job: Any = None
        self.since = time.monotonic()

    def give(self, job: Any) -> None:
        self.job, self.since = job, time.monotonic()
        self.pipe.send(job)

    def end(self) -> None:
        self.pipe.close()
        self._process.kill()
        self._process.join()


def _share_out(root: Path, jobs: list[Any]) -> Iterator[tuple[Any, Any]]:
    """Each job with its result, None for one that had to be ended."""
    if not jobs:
        return
    left = iter(jobs)
    count = min(len(jobs), len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 2)
    processes: list[_Process] = []
    try:
        for _ in range(count):
            processes.append(_Process(root))
            processes[-1].give(next(left))
        while processes:
            ready = wait([process.pipe for process in processes], timeout=5.0)
            for process in list(processes):
                try:
                    if process.pipe in ready:
                        result = process.pipe.recv()
                    elif time.monotonic() - process.since > _PATIENCE:
                        raise EOFError
                    else:
                        continue
                except (EOFError, OSError):
                    result = None
                    process.end()
                    processes[processes.index(process)] = new = _Process(root)
                    new.job, process = process.job, new
                yield process.job, result
                following = next(left, None)
                if following is None:
                    processes.remove(process)
                    process.end()
                else:
                    process.give(following)
    finally:
        for process in processes:
            process.end()


# -- what is kept ---------------------------------------------------------------------------------


def _digest(course: Course, question: Question) -> str:
    """A fingerprint of all that the findings for a question come from."""
    answer = course.key[question.id]
    names = [*kind_of(question).code_names(answer)]
    if has_variants(course, question.chapter):
        names.append(".".join([*VARIANTS.parts, question.chapter]))
    engine = [
        *(_PACKAGE / "kinds").rglob("*.py"),
        *(_PACKAGE / "marking").rglob("*.py"),
        *(_PACKAGE / "sandbox/inside").glob("*.py"),
        Path(__file__),
    ]
    digest = hashlib.sha256(f"{question}\0{_without_words(answer)}".encode())
    for path in [*course_sources(names, course.root), *sorted(engine)]:
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _without_words(answer: Answer) -> dict[str, Any]:
    fields: dict[str, Any] = msgspec.to_builtins(answer)
    for name in ("explanation", "equivalent", "code"):
        fields.pop(name, None)
    return fields


def _read(course: Course, question: Question, digest: str) -> Findings | None:
    path = course.root / _CACHE / f"{question.id}.json"
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


def _write(course: Course, id: str, digest: str, findings: Findings) -> None:
    folder = course.root / _CACHE
    with suppress(OSError):  # a course that cannot be written to is proven again each time
        folder.mkdir(exist_ok=True)
        text = json.dumps({"digest": digest, **asdict(findings)})
        (folder / f"{id}.json").write_text(text, encoding="utf-8")
