"""The reference changed a little, as hypotheses of what a student's function does.

The mutant that gives the student's outcomes on every case tells the line and the change. Its line
is for the instructor; a student reads the kind of change in words, or what the author remarks on
the line by ``# names: without its centring``. Nothing of a student's is run.

Right work in other clothes (``solutions/variants``) is changed in the same way, after the
reference: students write a function otherwise than its author, and slip where their own lines are.

What a mutant gives on a case is found out once for all responses. It is asked only as long as it
agrees with a response, the cheapest of the cases that the response has wrong first. What that may
cost is counted in lines of the reference, as if nothing were known yet: the same response has the
same name on every machine, in whatever order a class is marked.
"""

from __future__ import annotations

import ast
import inspect
import linecache
import re
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial, wraps
from pathlib import Path
from types import FunctionType

from autograder.diagnosis.effort import Effort, lines_run, numbers_in
from autograder.diagnosis.relations import Diagnosis, looks_as_if
from autograder.exchange.messages import Value
from autograder.kinds.function.called_otherwise import Call, called_otherwise
from autograder.kinds.function.marking import Compare, Outcome, agrees
from autograder.kinds.function.slips import GUARDS, NO_ERROR, VAGUE, slips
from autograder.kinds.function.trial import mutants_of, outcome_of
from autograder.kinds.function.words_for_slips import OWN_NAMES_EXCHANGED, in_words
from autograder.language import _
from autograder.mutants.changed_functions import codes_of, reachable, tree_of, with_changed
from autograder.mutants.mutant import Mutant, OutOfTime

# In lines that the reference runs, some 2 to 5 million a second of a processor.
_MOST_LINES = 20_000_000  # for one response, as if it were the first
_A_COMPARISON = 50
_NEVER_ENDS = 1_000_000  # lines of right work for a case
_SLOW = 300_000  # for right work in other clothes on all cases: it is not changed if it takes more
_TIMES_AS_MANY = 20  # turns of loops as what it was made of takes, that a mutant may take
_TURNS_AT_LEAST = 1000
_REMARK = re.compile(r"#\s*names:\s*(.+?)\s*$")
_LOST: Outcome = {"unusable": "a change that never ended"}  # which no response's outcome is


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
        known = (
            inspect.signature(reference).parameters if isinstance(reference, FunctionType) else ()
        )
        self._arguments = {*known}
        self._other_clothes = other_clothes  # loaded when the first name is looked for
        self._made: list[tuple[Mutant, Call]] | None = None
        self._origins: list[Call] = []  # what each of them was made of
        self._outcomes: dict[tuple[int, int], tuple[Outcome, bool]] = {}
        self._lines: list[int] = []  # that the reference runs, by case
        self._turns = 0  # of loops, that are left to the mutant that runs
        self._usual_turns: dict[Call, list[int]] = {}  # of right work, by case
        self._names = {"_tick": self._tick}  # what a function calls in each turn of its loops
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
        made = self._changes()
        fitting = list(self._fitting(right, outcomes, verdicts))
        if _only_errors_are_missing(right, outcomes, verdicts):
            # A change of a sum that happens to let such inputs pass says nothing of the thought.
            fitting = [i for i in fitting if made[i][0].operator in GUARDS or self._remark(i)]
            if not fitting:
                return Diagnosis(NO_ERROR, looks_as_if(in_words(NO_ERROR)))
        if _no_value_came(outcomes, verdicts):
            # Many changes raise the same: that it raises is all that is known.
            fitting = [i for i in fitting if made[i][0].operator in GUARDS or self._remark(i)]
        if not fitting:
            return None
        # What says least stands last, what the author remarks first, else as they were made.
        fitting.sort(key=lambda index: self._says_little(made[index][0].operator))
        chosen = next((index for index in fitting if self._remark(index)), fitting[0])
        evidence = "; or ".join(self._evidence(index) for index in fitting[:3])
        return replace(self._said(chosen), evidence=evidence)

    def _said(self, index: int) -> Diagnosis:
        """The name of a change, and what a student reads of it."""
        if remark := self._remark(index):
            sentence = _("It looks as if yours is the right function {remark}.")
            return Diagnosis(remark, sentence.format(remark=remark))
        mutant = self._changes()[index][0]
        argument = re.match(r"begin with (\w+) = ", mutant.name)
        operator = mutant.operator
        if self._exchanges_own_names(operator):
            operator = OWN_NAMES_EXCHANGED
        words = in_words(operator, argument[1] if argument else "")
        name = operator + (f" ({argument[1]})" if argument else "")
        return Diagnosis(name, looks_as_if(words))

    def _says_little(self, operator: str) -> bool:
        return operator in VAGUE or self._exchanges_own_names(operator)

    def _exchanges_own_names(self, operator: str) -> bool:
        """Whether it names what only the author's text has: a student may have no such name."""
        exchanged = re.fullmatch(r"(\w+) and (\w+) exchanged", operator)
        return exchanged is not None and not {*exchanged.groups()} <= self._arguments

    def _fitting(
        self, right: Sequence[Outcome], outcomes: Sequence[Value], verdicts: Sequence[bool]
    ) -> Iterator[int]:
        """The changes that do the same as a response on every case, as far as they are tried."""
        made, lines = self._changes(), self._lines_by_case()
        # Wrong ones first, and the cheap ones among them.
        order = sorted(range(len(lines)), key=lambda case: (verdicts[case], lines[case]))
        costs = [
            _A_COMPARISON + of_case + numbers_in(outcome)
            for of_case, outcome in zip(lines, outcomes, strict=True)
        ]
        effort = Effort(_MOST_LINES)
        named = False
        for index in range(len(made)):
            if named and self._origins[index] is not self._origins[index - 1]:
                return  # the same work in yet other clothes would say nothing new
            for case in order:
                if not effort.spend(costs[case]):
                    return
                if not self._fits(index, case, right, outcomes, verdicts):
                    break
            else:
                named = named or made[index][0].operator not in VAGUE
                yield index

    def _fits(
        self,
        index: int,
        case: int,
        right: Sequence[Outcome],
        outcomes: Sequence[Value],
        verdicts: Sequence[bool],
    ) -> bool:
        """Whether a changed reference and a response do the same on a case."""
        outcome, is_right = self._outcome(index, case, right[case])
        if is_right != verdicts[case]:
            return False
        if is_right:
            return True
        return agrees(self._compare, self._cases[case], outcome, outcomes[case])

    def _outcome(self, index: int, case: int, right: Outcome) -> tuple[Outcome, bool]:
        if (index, case) not in self._outcomes:
            outcome = self._run(index, case)
            is_right = agrees(self._compare, self._cases[case], right, outcome)
            self._outcomes[index, case] = outcome, is_right
        return self._outcomes[index, case]

    def _run(self, index: int, case: int) -> Outcome:
        usual = self._turns_by_case(self._origins[index])[case]
        self._turns = _TURNS_AT_LEAST + _TIMES_AS_MANY * usual
        try:
            return outcome_of(self._changes()[index][1], self._cases[case])
        except (OutOfTime, MemoryError):
            return _LOST

    def _turns_by_case(self, function: Call) -> list[int]:
        """How many turns the loops of right work take.

        A turn may cost much more than a line: of a loop around RANSAC each is a whole search.
        """
        if function not in self._usual_turns:
            counting = self._counting(function) if isinstance(function, FunctionType) else function
            taken = []
            for case in self._cases:
                self._turns = _NEVER_ENDS
                with suppress(OutOfTime):
                    outcome_of(counting, case)
                taken.append(_NEVER_ENDS - max(0, self._turns))
            self._usual_turns[function] = taken
        return self._usual_turns[function]

    def _lines_by_case(self) -> list[int]:
        if not self._lines:
            self._lines = [
                lines_run(partial(outcome_of, self._reference, case), _NEVER_ENDS) or _NEVER_ENDS
                for case in self._cases
            ]
        return self._lines

    def _changes(self) -> list[tuple[Mutant, Call]]:
        if self._made is None:
            quick = [function for function in self._other_clothes() if self._is_quick(function)]
            made = [
                (function, *change)
                for function in (self._reference, *quick)
                for change in self._all_changes(function)
            ]
            self._origins = [function for function, _, _ in made]
            self._made = [(mutant, call) for _, mutant, call in made]
        return self._made

    def _is_quick(self, function: Call) -> bool:
        """Whether many changes of a function can be tried: some are written to be exact."""

        def on_every_case() -> None:
            for case in self._cases:
                outcome_of(function, case)

        return lines_run(on_every_case, _SLOW) is not None

    def _all_changes(self, function: Call) -> Iterator[tuple[Mutant, Call]]:
        if not isinstance(function, FunctionType):
            return
        if function is self._reference:
            yield from called_otherwise(self._counting(function), self._cases)
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
            more_names=self._names,
            prepare=_with_ticks,
        )

    def _counting(self, function: FunctionType) -> Call:
        """The function itself, which can be called with what makes it run for ever."""
        every = reachable(function, self._root)
        tree, codes = _with_ticks(tree_of(function)), codes_of(every, _with_ticks)
        return wraps(function)(with_changed(function, every, function, tree, self._names, codes))

    def _tick(self) -> None:
        self._turns -= 1
        if self._turns < 0:
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


def _only_errors_are_missing(
    right: Sequence[Outcome], outcomes: Sequence[Value], verdicts: Sequence[bool]
) -> bool:
    """Whether a value came wherever something is wrong, and an exception is asked for there."""
    wrong = [i for i, verdict in enumerate(verdicts) if not verdict]
    return bool(wrong) and all(
        "raised" in right[i] and isinstance(outcomes[i], dict) and "value" in outcomes[i]
        for i in wrong
    )


def _no_value_came(outcomes: Sequence[Value], verdicts: Sequence[bool]) -> bool:
    """Whether nothing that could be compared came wherever something is wrong."""
    return not any(
        isinstance(outcome, dict) and "value" in outcome
        for outcome, verdict in zip(outcomes, verdicts, strict=True)
        if not verdict
    )


def _with_ticks(tree: ast.FunctionDef) -> ast.FunctionDef:
    """A function that counts the turns of its loops: a mutant may never end."""
    for node in ast.walk(tree):
        if isinstance(node, ast.While | ast.For):
            node.body.insert(0, ast.parse("_tick()").body[0])
    return ast.fix_missing_locations(tree)
