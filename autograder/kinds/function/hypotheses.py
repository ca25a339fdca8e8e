"""The reference changed a little, as hypotheses of what a student's function does.

The mutant that gives the student's outcomes on every case tells the line and the change. Its line
is for the instructor; a student reads the kind of change in words, or what the author remarks on
the line by ``# names: without its centring``. Nothing of a student's is run.

Right work in other clothes (``solutions/variants``) is changed in the same way, after the
reference: students write a function otherwise than its author, and slip where their own lines are.

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

import numpy as np

from autograder.exchange.messages import Value
from autograder.kinds.function.marking import Compare, Outcome, agrees
from autograder.kinds.function.slips import VAGUE, in_words, slips
from autograder.kinds.function.trial import mutants_of, outcome_of
from autograder.language import _
from autograder.marking.diagnosis.relations import Diagnosis, looks_as_if
from autograder.marking.mutants.clones import reachable
from autograder.marking.mutants.mutant import Mutant, OutOfTime

MOST_SECONDS = 0.1  # of a processor, for one response, beside what is found out for all
_TO_FIND_OUT = 6.0  # for all responses to a question together
_A_CASE = 0.25  # for a mutant and a case, at most
_TIMES_AS_LONG = 20  # as the right function, which a mutant may take beside the next
_AT_LEAST = 0.01
_SLOW = 0.2  # for right work in other clothes on all cases: it is not changed if it takes longer
_REMARK = re.compile(r"#\s*names:\s*(.+?)\s*$")
_LOST: Outcome = {"unusable": "not plain"}

Call = Callable[..., object]


class Hypotheses:
    """The changed references of one question and the hidden inputs of one seed."""

    def __init__(
        self,
        reference: Call,
        cases: Sequence[dict[str, Value]],
        compare: Compare,
        root: Path,
        other_clothes: Callable[[], Sequence[Call]] = list,
    ) -> None:
        self._reference, self._cases, self._compare, self._root = reference, cases, compare, root
        self._other_clothes = other_clothes  # loaded when the first name is looked for
        self._made: list[tuple[Mutant, Call]] | None = None
        self._origins: list[Call] = []  # what each of them was made of
        self._outcomes: dict[tuple[int, int], tuple[Outcome, bool]] = {}
        self._seconds: dict[int, float] = {}
        self._spent = 0.0
        self._until = 0.0  # when the mutant that runs must end, by its thread's clock
        self._lock = threading.Lock()

    def explain(
        self, right: Sequence[Outcome], outcomes: Sequence[Value], verdicts: Sequence[bool]
    ) -> Diagnosis | None:
        """The change with which the reference gives these outcomes, if there is one."""
        with self._lock:
            return self._explain(right, outcomes, verdicts)

    def _explain(
        self, right: Sequence[Outcome], outcomes: Sequence[Value], verdicts: Sequence[bool]
    ) -> Diagnosis | None:
        begin, before = time.thread_time(), self._spent
        made = self._changes()
        order = self._order(verdicts)
        fitting: list[int] = []
        for index in range(len(made)):
            if time.thread_time() - begin - (self._spent - before) > MOST_SECONDS:
                break
            begins = index and self._origins[index] is not self._origins[index - 1]
            if begins and any(made[found][0].operator not in VAGUE for found in fitting):
                break  # the same work in yet other clothes would say nothing new
            if all(self._fits(index, case, right, outcomes, verdicts) for case in order):
                fitting.append(index)
        if not fitting:
            return None
        # What says least stands last; otherwise the order in which they were made.
        fitting.sort(key=lambda index: made[index][0].operator in VAGUE)
        remarked = [(made[index][0], self._remark(index)) for index in fitting]
        chosen, remark = next(((m, r) for m, r in remarked if r), (remarked[0][0], ""))
        evidence = "; or ".join(self._evidence(index) for index in fitting[:3])
        if remark:
            said = _("It looks as if yours is the right function {remark}.")
            return Diagnosis(remark, said.format(remark=remark), evidence)
        argument = re.match(r"begin with (\w+) = ", chosen.name)
        words = in_words(chosen.operator, argument[1] if argument else "")
        name = chosen.operator + (f" ({argument[1]})" if argument else "")
        return Diagnosis(name, looks_as_if(words), evidence)

    def _fits(
        self,
        index: int,
        case: int,
        right: Sequence[Outcome],
        outcomes: Sequence[Value],
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
        usual = self._seconds.get(case, _A_CASE)
        self._until = time.thread_time() + min(_A_CASE, _AT_LEAST + _TIMES_AS_LONG * usual)
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
            self._made = []
            quick = [function for function in self._other_clothes() if self._is_quick(function)]
            for function in (self._reference, *quick):
                made = list(self._all_changes(function))
                self._made += made
                self._origins += [function] * len(made)
            self._spent += time.thread_time() - begin
        return self._made

    def _is_quick(self, function: Call) -> bool:
        """Whether many changes of a function can be tried: some are written to be exact."""
        begin = time.thread_time()
        for case in self._order([True] * len(self._cases)):
            self._run(function, case)
            if time.thread_time() - begin > _SLOW:
                return False
        return True

    def _all_changes(self, function: Call) -> Iterator[tuple[Mutant, Call]]:
        if not isinstance(function, FunctionType):
            return
        if function is self._reference:
            yield from _called_otherwise(function, self._cases)
        # What stands in another module is another question's work, or nobody's.
        others = {
            other
            for other in reachable(function, self._root)
            if other.__module__ != function.__module__
        }
        yield from mutants_of(
            function,
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

    def _evidence(self, index: int) -> str:
        """The line and its change, for the instructor."""
        mutant, origin = self._changes()[index][0], self._origins[index]
        of = "" if origin is self._reference else f"{origin.__module__}:{origin.__name__}, "
        return f"{of}line {mutant.line}: {mutant.name}" if mutant.line else f"{of}{mutant.name}"

    def _remark(self, index: int) -> str:
        """What the author says of the changed line."""
        mutant = self._changes()[index][0]
        if not mutant.line:
            return ""
        path = inspect.getsourcefile(self._origins[index])
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
    reference: Call, cases: Sequence[dict[str, Value]]
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
    yield from _with_others_changed(reference, cases)


def _with_others_changed(
    reference: Call, cases: Sequence[dict[str, Value]]
) -> Iterator[tuple[Mutant, Call]]:
    """What the first case leaves to its default, squared or rooted wherever it is given."""
    signature = inspect.signature(reference)
    names = list(signature.parameters)
    given: dict[str, Value] = {}
    for case in cases:
        given |= dict(zip(names, case["args"], strict=False)) | case.get("kwargs", {})
    first = {*names[: len(cases[0]["args"])], *cases[0].get("kwargs", {})}
    for name, value in given.items():
        if name in first or not isinstance(value, np.ndarray) or value.dtype.kind != "f":
            continue
        for words, change in (("squared", np.square), ("rooted", np.sqrt)):
            operator = f"argument {words}"
            made = _changing_named(reference, signature, name, change)
            yield Mutant(f"begin with {name} = {words} {name}", operator, ""), made


def _changing_named(
    reference: Call, signature: inspect.Signature, name: str, change: Callable[[Value], Value]
) -> Call:
    def called(*args: Value, **kwargs: Value) -> Value:
        bound = signature.bind(*args, **kwargs).arguments
        if bound.get(name) is not None:
            bound[name] = change(bound[name])
        return reference(**bound)

    return called


def _exchanging(reference: Call, one: int, other: int) -> Call:
    def called(*args: Value, **kwargs: Value) -> Value:
        given = list(args)
        given[one], given[other] = given[other], given[one]
        return reference(*given, **kwargs)

    return called


def _changing(reference: Call, place: int, change: Callable[[Value], Value]) -> Call:
    def called(*args: Value, **kwargs: Value) -> Value:
        return reference(*args[:place], change(args[place]), *args[place + 1 :], **kwargs)

    return called
