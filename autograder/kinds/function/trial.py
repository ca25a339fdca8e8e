"""Mutants of a function question's reference, marked as a student's function would be."""

from __future__ import annotations

import ast
import math
import time
import warnings
from collections.abc import Callable, Collection, Iterator, Sequence
from pathlib import Path
from types import FunctionType

import numpy as np

from autograder.course.loading import load_object
from autograder.exchange.messages import Value, Values
from autograder.kinds.function.answer import FunctionAnswer
from autograder.kinds.function.inside.evaluate import evaluate
from autograder.kinds.function.marking import Outcome, agrees, close
from autograder.mutants.changed_functions import codes_of, reachable, tree_of, with_changed
from autograder.mutants.code_edits import MoreEdits, begin_with, described, edited
from autograder.mutants.mutant import Mutant, Trial
from autograder.mutants.time_limit import time_limit

# A mutant has lost that takes longer for a case than this, and so many times the reference's time.
_LEAST_SECONDS = 0.5  # of a processor
_TIMES_AS_LONG = 20

Call = Callable[..., object]


class FunctionTrial(Trial):
    """The mutants of a reference and of the helpers it calls, but not of other questions' work.

    ``proven`` are the references of the course: one that another calls is proven by its own
    question.
    """

    def __init__(
        self,
        answer: FunctionAnswer,
        proven: Sequence[str],
        root: Path,
        draw: Callable[[int], np.random.Generator],
    ) -> None:
        self._draw_cases = load_object(answer.cases, root)
        self._compare = load_object(answer.compare, root) if answer.compare else close
        self._draw = draw
        self._reference: Call = load_object(answer.reference, root)
        self._seeds: dict[int, list[dict[str, Value]]] = {}
        self._right: dict[tuple[int, int], Outcome] = {}
        self._told_by: dict[int, int] = {}  # the case that told a mutant with another seed
        self._cheapest: list[int] = []  # the cases, those first that took least time with one seed
        self._seconds: dict[tuple[int, int], float] = {}  # that the reference took for a case
        others = {load_object(name, root) for name in proven} - {self._reference}
        made = list(mutants_of(self._reference, others, self._cases_of(0), root))
        self.mutants = [mutant for mutant, _ in made]
        self.calls = [call for _, call in made]

    def passes(self, index: int, seed: int) -> bool:
        cases = self._cases_of(seed)
        for case in self._order(index, seed):
            right = self.right(seed, case)
            with time_limit(_LEAST_SECONDS + _TIMES_AS_LONG * self._seconds[seed, case]):
                outcome = outcome_of(self.calls[index], cases[case])
            if not agrees(self._compare, cases[case], right, outcome):
                self._told_by[index] = case
                return False
        return True

    def _order(self, index: int, seed: int) -> list[int]:
        """The cases: first the one that told the mutant before, then those that take least time.

        Nothing has to come after the first that tells.
        """
        count = len(self._cases_of(seed))
        if not self._cheapest:
            for case in range(count):
                self.right(seed, case)
            self._cheapest = sorted(range(count), key=lambda case: self._seconds[seed, case])
        first = [self._told_by[index]] if index in self._told_by else []
        order = dict.fromkeys([*first, *self._cheapest, *range(count)])
        return [case for case in order if case < count]

    def cases(self, seed: int) -> Sequence[str]:
        return list(dict.fromkeys(case["name"] for case in self._cases_of(seed)))

    def right(self, seed: int, case: int) -> Outcome:
        """What the reference makes of a case."""
        if (seed, case) not in self._right:
            begin = time.process_time()
            self._right[seed, case] = outcome_of(self._reference, self._cases_of(seed)[case])
            self._seconds[seed, case] = time.process_time() - begin
        return self._right[seed, case]

    def _cases_of(self, seed: int) -> list[dict[str, Value]]:
        if seed not in self._seeds:
            self._seeds[seed] = self._draw_cases(self._draw(seed))
        return self._seeds[seed]


def outcome_of(call: Call, case: dict[str, object]) -> Outcome:
    """What a function of the course makes of one case."""
    # A mutant may divide by nothing or average nothing: no instructor has to read of it.
    with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
        try:
            outcome: Outcome = evaluate(call, {"cases": [case]})["outcomes"][0]
            return outcome
        except NotImplementedError:
            return {"raised": "NotImplementedError"}


def mutants_of(
    reference: Call,
    others: Collection[Call],
    cases: list[dict[str, Value]],
    root: Path,
    more_edits: MoreEdits | None = None,
    more_names: Values | None = None,
    prepare: Callable[[ast.FunctionDef], ast.FunctionDef] | None = None,
) -> Iterator[tuple[Mutant, Call]]:
    """The mutants of a reference and of what it calls but ``others``, ready to be called.

    ``more_edits`` are changes beyond those that a key is proven with; ``prepare`` makes the tree of
    each function ready, and ``more_names`` are what it then uses.
    """
    if not isinstance(reference, FunctionType):
        return
    every = reachable(reference, root)
    codes = codes_of(every, prepare) if prepare else {}
    for function in every:
        if function in others:
            continue
        tree = tree_of(function)
        prefix = "" if function is reference else f"{function.__name__}: "
        # What a helper refuses is the helper's promise, not this question's.
        trees = list(edited(tree, prefix, guards=function is reference, more=more_edits))
        if function is reference:
            trees += _with_arguments(tree, cases[0])
        for mutant, changed in trees:
            more = {
                "_fixed_rng": lambda: np.random.default_rng(0),
                "_scaled": _scaled,
                **(more_names or {}),
            }
            ready = prepare(changed) if prepare else changed
            try:
                call = with_changed(reference, every, function, ready, more, codes)
            except SyntaxError:  # a change that is no Python is nobody's
                continue
            yield mutant, call
    arguments = dict(zip(_names(tree_of(reference)), cases[0]["args"], strict=False))
    for name, value in {**arguments, **cases[0].get("kwargs", {})}.items():
        if isinstance(value, np.ndarray | list):
            text = f"{name} changed in place"
            diff = f"+{name} is not the same afterwards"
            yield Mutant(text, "input changed in place", diff), _changes(reference, name)


def _with_arguments(
    tree: ast.FunctionDef, public: dict[str, Value]
) -> Iterator[tuple[Mutant, ast.FunctionDef]]:
    """An argument ignored, or put to use otherwise than asked."""
    names = _names(tree)
    given = {**dict(zip(names, public["args"], strict=False)), **public.get("kwargs", {})}
    defaults = tree.args.defaults
    optional = names[len(names) - len(defaults) :] if defaults else []
    statements: list[tuple[str, str]] = [
        ("argument ignored", f"{name} = {ast.unparse(default)}")
        for name, default in zip(optional, defaults, strict=False)
    ]
    for name, value in given.items():
        if isinstance(value, dict) and value.keys() == {"rng"}:
            statements.append(("random numbers that are always the same", f"{name} = _fixed_rng()"))
        if isinstance(value, bool | str):
            statements.append(("argument ignored", f"{name} = {value!r}"))
        elif isinstance(value, int | float) and math.isfinite(value):
            statements.append(("argument ignored", f"{name} = {value!r}"))
            if isinstance(value, int):
                statements += [
                    ("argument one more", f"{name} = {name} + 1"),
                    ("argument one less", f"{name} = {name} - 1"),
                ]
        if _is_number_like(value):
            statements += [
                (f"argument {words}", f"{name} = _scaled({name}, {how!r})")
                for words, how in (
                    ("doubled", "2*"),
                    ("halved", "/2"),
                    ("squared", "**2"),
                    ("rooted", "sqrt"),
                )
            ]
    for operator, statement in statements:
        changed = begin_with(tree, statement)
        yield described(f"begin with {statement}", operator, tree, changed, tree.lineno), changed


def _names(tree: ast.FunctionDef) -> list[str]:
    return [entry.arg for entry in (*tree.args.posonlyargs, *tree.args.args)]


def _is_number_like(value: object) -> bool:
    if isinstance(value, np.ndarray):
        return value.dtype.kind == "f" and value.size > 0
    return isinstance(value, int | float) and not isinstance(value, bool)


def _scaled(value: Value, how: str) -> object:
    """An argument, changed; whole numbers stay whole, and nothing stays nothing."""
    if value is None:
        return None
    whole = isinstance(value, int | np.integer)
    with np.errstate(all="ignore"):
        if how == "2*":
            return 2 * value
        if how == "/2":
            return value // 2 if whole else value / 2
        if how == "**2":
            return value**2
        root = np.sqrt(np.abs(value))
    return int(root) if whole else root


def _changes(reference: Call, name: str) -> Call:
    """The reference, which afterwards changes one of its inputs."""
    names = _names(tree_of(reference))  # type: ignore[arg-type]

    def changed(*args: object, **kwargs: object) -> Value:
        result = reference(*args, **kwargs)
        value = {**dict(zip(names, args, strict=False)), **kwargs}.get(name)
        if isinstance(value, np.ndarray) and value.size and value.flags.writeable:
            value.flat[0] += 1
        elif isinstance(value, list) and value:
            value.append(value[0])
        return result

    return changed
