"""The reference changed a little, as hypotheses of what a student's function does.

The mutant that gives the student's outcomes on every case tells the line and the change. Its line
is for the instructor; a student reads the kind of change in words, or what the author remarks on
the line by ``# names: without its centring``. Nothing of a student's is run.

What a mutant gives on a case is found out once for all responses. It is asked only as long as it
agrees with a response, the cheapest of the cases that the response has wrong first.
"""

from __future__ import annotations

import ast
import inspect
import linecache
import re
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np

from autograder.kinds.function.marking import Compare, Outcome, agrees
from autograder.kinds.function.slips import in_words, slips
from autograder.kinds.function.trial import mutants_of, outcome_of
from autograder.marking.diagnosis.relations import Diagnosis
from autograder.marking.mutants.clones import reachable
from autograder.marking.mutants.mutant import Mutant, OutOfTime

MOST_SECONDS = 0.1  # of a processor, for one response, beside what is found out for all
_TO_FIND_OUT = 4.0  # for all responses to a question together
_A_CASE = 0.25  # for a mutant and a case
_REMARK = re.compile(r"#\s*names:\s*(.+?)\s*$")
_LOST: Outcome = {"unusable": "not plain"}

Call = Callable[..., object]


class Hypotheses:
    """The changed references of one question and the hidden inputs of one seed."""

    def __init__(
        self, reference: Call, cases: Sequence[dict[str, Any]], compare: Compare, root: Path
    ) -> None:
        self._reference, self._cases, self._compare, self._root = reference, cases, compare, root
        self._made: list[tuple[Mutant, Call]] | None = None
        self._outcomes: dict[tuple[int, int], tuple[Outcome, bool]] = {}
        self._seconds: dict[int, float] = {}
        self._spent = 0.0
        self._until = 0.0  # when the mutant that runs must end, by its thread's clock
        self._lock = threading.Lock()

    def explain(
        self, right: Sequence[Outcome], outcomes: Sequence[Any], verdicts: Sequence[bool]
    ) -> Diagnosis | None:
        """The change with which the reference gives these outcomes, if there is one."""
        with self._lock:
            return self._explain(right, outcomes, verdicts)

    def _explain(
        self, right: Sequence[Outcome], outcomes: Sequence[Any], verdicts: Sequence[bool]
    ) -> Diagnosis | None:
        begin, before = time.thread_time(), self._spent
        made = self._changes()
        order = self._order(verdicts)
        fitting = []
        for index in range(len(made)):
            if time.thread_time() - begin - (self._spent - before) > MOST_SECONDS:
                break
            if all(self._fits(index, case, right, outcomes, verdicts) for case in order):
                fitting.append(made[index][0])
        if not fitting:
            return None
        remarked = [(mutant, self._remark(mutant)) for mutant in fitting]
        chosen, remark = next(((m, r) for m, r in remarked if r), (fitting[0], ""))
        evidence = "; or ".join(
            f"line {mutant.line}: {mutant.name}" if mutant.line else mutant.name
            for mutant in fitting[:3]
        )
        if remark:
            return Diagnosis(
                remark, f"It looks as if yours is the right function {remark}.", evidence
            )
        argument = re.match(r"begin with (\w+) = ", chosen.name)
        words = in_words(chosen.operator, argument[1] if argument else "")
        name = chosen.operator + (f" ({argument[1]})" if argument else "")
        return Diagnosis(name, f"It looks as if {words}.", evidence)

    def _fits(
        self,
        index: int,
        case: int,
        right: Sequence[Outcome],
        outcomes: Sequence[Any],
        verdicts: Sequence[bool],
    ) -> bool:
        """Whether a changed reference and a response do the same on a case."""
        found = self._outcome(index, case, right[case])
        if found is None:
            return False
        outcome, is_right = found
        if is_right != verdicts[case]:
            return False
        if is_right:
            return True
        return agrees(self._compare, self._cases[case], outcome, outcomes[case])

    def _outcome(self, index: int, case: int, right: Outcome) -> tuple[Outcome, bool] | None:
        if (index, case) not in self._outcomes:
            if self._spent > _TO_FIND_OUT:
                return None
            begin = time.thread_time()
            outcome = self._run(self._changes()[index][1], case)
            is_right = agrees(self._compare, self._cases[case], right, outcome)
            self._outcomes[index, case] = outcome, is_right
            self._spent += time.thread_time() - begin
        return self._outcomes[index, case]

    def _run(self, call: Call, case: int) -> Outcome:
        self._until = time.thread_time() + _A_CASE
        try:
            return outcome_of(call, self._cases[case])
        except (OutOfTime, MemoryError):
            return _LOST

    def _order(self, verdicts: Sequence[bool]) -> list[int]:
        """The cases: wrong ones first, and the cheap ones among them."""
        for case in range(len(self._cases)):
            if case not in self._seconds:
                begin = time.thread_time()
                self._run(self._reference, case)
                self._seconds[case] = time.thread_time() - begin
                self._spent += self._seconds[case]
        return sorted(self._seconds, key=lambda case: (verdicts[case], self._seconds[case]))

    def _changes(self) -> list[tuple[Mutant, Call]]:
        if self._made is None:
            begin = time.thread_time()
            self._made = list(self._all_changes())
            self._spent += time.thread_time() - begin
        return self._made

    def _all_changes(self) -> Iterator[tuple[Mutant, Call]]:
        if not isinstance(self._reference, FunctionType):
            return
        yield from _called_otherwise(self._reference, self._cases)
        # What stands in another module is another question's work, or nobody's.
        others = {
            function
            for function in reachable(self._reference, self._root)
            if function.__module__ != self._reference.__module__
        }
        yield from mutants_of(
            self._reference,
            others,
            list(self._cases),
            self._root,
            more_edits=slips,
            more_names={"_tick": self._tick},
            prepare=_with_ticks,
        )

    def _tick(self) -> None:
        if time.thread_time() > self._until:
            raise OutOfTime

    def _remark(self, mutant: Mutant) -> str:
        """What the author says of the changed line."""
        if not mutant.line:
            return ""
        path = inspect.getsourcefile(self._reference)
        found = _REMARK.search(linecache.getline(path, mutant.line)) if path else None
        return found[1] if found else ""


def _with_ticks(tree: ast.FunctionDef) -> ast.FunctionDef:
    """A function that looks at the clock in each turn of its loops: a mutant may never end."""
    for node in ast.walk(tree):
        if isinstance(node, ast.While | ast.For):
            node.body.insert(0, ast.parse("_tick()").body[0])
    return ast.fix_missing_locations(tree)


# -- the reference itself, called otherwise ------------------------------------------------------


def _called_otherwise(
    reference: Call, cases: Sequence[dict[str, Any]]
) -> Iterator[tuple[Mutant, Call]]:
    """The reference with two of its arguments exchanged, or one of them turned."""
    first = cases[0]["args"]
    names = list(inspect.signature(reference).parameters)[: len(first)]
    for one in range(len(first)):
        for other in range(one + 1, len(first)):
            if isinstance(first[one], dict) or isinstance(first[other], dict):
                continue  # the generator
            name = f"{names[one]} and {names[other]} exchanged"
            yield Mutant(name, name, ""), _exchanging(reference, one, other)
    for place, value in enumerate(first):
        if isinstance(value, np.ndarray) and value.ndim == 2:
            for words, change in (
                ("its columns in reverse order", lambda x: x[:, ::-1]),
                ("its rows and columns exchanged", lambda x: x.T),
            ):
                name = f"{names[place]} with {words}"
                yield Mutant(name, name, ""), _changing(reference, place, change)
        if isinstance(value, float) and 0 < value < 1:
            name = f"1 - {names[place]} for {names[place]}"
            yield Mutant(name, name, ""), _changing(reference, place, lambda x: 1 - x)


def _exchanging(reference: Call, one: int, other: int) -> Call:
    def called(*args: Any, **kwargs: Any) -> Any:
        given = list(args)
        given[one], given[other] = given[other], given[one]
        return reference(*given, **kwargs)

    return called


def _changing(reference: Call, place: int, change: Callable[[Any], Any]) -> Call:
    def called(*args: Any, **kwargs: Any) -> Any:
        return reference(*args[:place], change(args[place]), *args[place + 1 :], **kwargs)

    return called
