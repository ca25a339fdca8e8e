"""Mutation operators: systematic small changes of a function's tree.

The operators are those of the literature on mutation testing (relational, logical and arithmetic
operator replacement, constant replacement, statement deletion), and what students do: arguments
exchanged, a guard left out, a loop one short, an early ``break``.
"""

from __future__ import annotations

import ast
import difflib
from collections.abc import Callable, Iterator
from itertools import chain

from autograder.mutants.mutant import Mutant
from autograder.mutants.syntax_trees import (
    Function,
    Replace,
    code_of,
    copy_of,
    first_line,
    guards_of,
    has_docstring,
    line_of,
    not_run,
    statement_at,
    statement_of,
)

# What to do to a node of a copy of the tree; a new node stands in for it, None leaves it changed.
Edit = Callable[[ast.AST], ast.AST | None]
MoreEdits = Callable[[ast.AST], Iterator[tuple[str, Edit]]]

_STRICTNESS: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
}
# Their arguments may be exchanged, and nobody can tell.
_SYMMETRIC = {"max", "min", "maximum", "minimum", "hypot", "array_equal", "gcd", "logaddexp"}
_SIGN: dict[type[ast.operator], type[ast.operator]] = {ast.Add: ast.Sub, ast.Sub: ast.Add}


def edited(
    function: Function, prefix: str = "", guards: bool = True, more: MoreEdits | None = None
) -> Iterator[tuple[Mutant, Function]]:
    """Every mutant of a function, with its tree; ``prefix`` goes in front of each name.

    ``more`` gives for a node further changes, with their operators.

    Without ``guards``, conditions that only lead to an exception are left as they are.
    """
    original = list(ast.walk(function))
    parents = {child: node for node in original for child in ast.iter_child_nodes(node)}
    skipped = not_run(function)
    if not guards:
        skipped |= guards_of(function)
    seen: set[str] = {ast.dump(function)}
    for position, node in enumerate(original):
        if node in skipped:
            continue
        for operator, edit in chain(_edits(node), more(node) if more else ()):
            tree = copy_of(function)
            _apply(tree, position, edit)
            if ast.dump(tree) in seen:
                continue
            seen.add(ast.dump(tree))
            ast.fix_missing_locations(tree)
            before = first_line(statement_of(node, parents))
            changed = statement_at(tree, position, original, parents)
            after = first_line(changed) if changed is not None else ""
            name = f"{before} -> {after}" if before != after else f"{before}: {operator}"
            yield described(prefix + name, operator, function, tree, line_of(node)), tree


def described(name: str, operator: str, old: Function, new: Function, line: int) -> Mutant:
    """A mutant with its diff."""
    rows = difflib.unified_diff(
        code_of(old).splitlines(),
        code_of(new).splitlines(),
        n=1,
        lineterm="",
        fromfile="",
        tofile="",
    )
    return Mutant(name, operator, "\n".join(list(rows)[2:]), line)


def begin_with(function: Function, statement: str) -> Function:
    """The function with one statement more, before all others but the docstring."""
    tree = copy_of(function)
    tree.body[has_docstring(tree) : has_docstring(tree)] = ast.parse(statement).body
    return ast.fix_missing_locations(tree)


def _edits(node: ast.AST) -> Iterator[tuple[str, Edit]]:
    match node:
        case ast.Compare(ops=ops):
            for place, kind in enumerate(map(type, ops)):
                if kind in _STRICTNESS:
                    strict = kind in (ast.LtE, ast.GtE)
                    loose = kind in (ast.Lt, ast.Gt)
                    words = "strict" if strict else "loose" if loose else "turned round"
                    yield f"comparison {words}", _with_comparison(place, _STRICTNESS[kind])
        case ast.Constant(value=bool() as value):
            yield "truth value turned round", lambda _: ast.Constant(not value)
        case ast.Constant(value=int() | float() as number):
            yield "constant one more", lambda _: ast.Constant(number + 1)
            yield "constant one less", lambda _: _number(number - 1)
        case ast.BinOp(op=op) | ast.AugAssign(op=op) if type(op) in _SIGN:
            yield "sign turned", _with_operator(_SIGN[type(op)]())
        case ast.UnaryOp(op=ast.USub()):
            yield "sign left out", lambda found: _as_unary(found).operand
        case ast.UnaryOp(op=ast.Not()):
            yield "not left out", lambda found: _as_unary(found).operand
        case ast.BoolOp(op=op):
            other = ast.Or if isinstance(op, ast.And) else ast.And
            words = "or for and" if isinstance(op, ast.And) else "and for or"
            yield words, _with_operator(other())
            for place in range(len(node.values)):
                yield "part of a condition left out", _without_value(place)
        case ast.Call(func=called, args=args) if _name_of(called) not in _SYMMETRIC:
            for place in range(len(args) - 1):
                yield "arguments exchanged", _exchanged("args", place)
        case ast.IfExp():
            yield "always the first", lambda found: found.body  # type: ignore[attr-defined]
            yield "always the second", lambda found: found.orelse  # type: ignore[attr-defined]
        case ast.If(orelse=orelse):
            yield "branch left out", _condition(False)
            yield "branch always taken", _condition(True)
            if orelse:
                yield "other branch left out", _without_else
        case ast.Raise():
            yield "raise left out", lambda _: ast.Pass()
        case ast.Expr() | ast.AugAssign() | ast.Continue() | ast.Break() | ast.Assign():
            yield "statement left out", lambda _: ast.Pass()
        case ast.For(iter=iterated):
            yield "early break", _break_at_end
            if not _is_endless(iterated):
                yield "loop one short", _shortened("[:-1]")
                yield "first turn left out", _shortened("[1:]")
        case ast.While():
            yield "early break", _break_at_end
        case ast.comprehension(iter=iterated) if not _is_endless(iterated):
            yield "loop one short", _shortened("[:-1]")
            yield "first turn left out", _shortened("[1:]")
        case ast.Return(value=ast.Tuple(elts=elements)):
            for place in _to_double(elements):
                yield "returned element changed", _changed_element("elts", place)
            for place in range(len(elements) - 1):
                yield "returned elements exchanged", _exchanged_elements(place)
        case ast.Return(value=ast.Call(func=ast.Name(id=name), args=[_, *_] as args)) if name[
            :1
        ].isupper():
            for place in _to_double(args):
                yield "returned element changed", _changed_element("args", place)
        case ast.Return(value=ast.expr() as value) if not isinstance(value, ast.Constant):
            yield "result changed", _changed_result


def _name_of(called: ast.expr) -> str:
    return ast.unparse(called).rpartition(".")[2]


def _with_comparison(place: int, kind: type[ast.cmpop]) -> Edit:
    def edit(node: ast.AST) -> None:
        assert isinstance(node, ast.Compare)
        node.ops[place] = kind()

    return edit


def _with_operator(operator: ast.AST) -> Edit:
    return lambda node: setattr(node, "op", operator)


def _without_value(place: int) -> Edit:
    def edit(node: ast.AST) -> ast.AST | None:
        assert isinstance(node, ast.BoolOp)
        del node.values[place]
        return node.values[0] if len(node.values) == 1 else None

    return edit


def _exchanged(field: str, place: int) -> Edit:
    def edit(node: ast.AST) -> None:
        entries = getattr(node, field)
        entries[place], entries[place + 1] = entries[place + 1], entries[place]

    return edit


def _exchanged_elements(place: int) -> Edit:
    return lambda node: _exchanged("elts", place)(node.value)  # type: ignore[attr-defined]


def _condition(value: bool) -> Edit:
    return lambda node: setattr(node, "test", ast.Constant(value))


def _without_else(node: ast.AST) -> None:
    assert isinstance(node, ast.If)
    node.orelse = []


def _break_at_end(node: ast.AST) -> None:
    assert isinstance(node, ast.For | ast.While)
    node.body.append(ast.Break())


def _shortened(part: str) -> Edit:
    def edit(node: ast.AST) -> None:
        assert isinstance(node, ast.For | ast.comprehension)
        short = ast.parse(f"list(_){part}", mode="eval").body
        assert isinstance(short, ast.Subscript)
        assert isinstance(short.value, ast.Call)
        short.value.args = [node.iter]
        node.iter = short

    return edit


def _to_double(entries: list[ast.expr]) -> list[int]:
    """The places of those that are one value, not ``*several``, and no 0, twice which is 0."""
    return [
        i
        for i, entry in enumerate(entries)
        if not (isinstance(entry, ast.Starred) or _is_zero(entry))
    ]


def _is_zero(entry: ast.expr) -> bool:
    return isinstance(entry, ast.Constant) and type(entry.value) in (int, float) and not entry.value


def _is_endless(iterated: ast.expr) -> bool:
    """Whether a loop may be over what never ends, so that no list can be made of it."""
    for node in ast.walk(iterated):
        match node:
            case (
                ast.Call(func=ast.Name(id=name))
                | ast.Call(func=ast.Attribute(value=ast.Name(id="itertools"), attr=name))
            ) if name in ("count", "cycle", "repeat", "iter"):
                return True
    return False


def _changed_element(field: str, place: int) -> Edit:
    def edit(node: ast.AST) -> None:
        entries = getattr(node.value, field)  # type: ignore[attr-defined]
        entries[place] = _doubled(entries[place])

    return edit


def _changed_result(node: ast.AST) -> None:
    assert isinstance(node, ast.Return)
    assert node.value is not None
    node.value = _doubled(node.value)


def _doubled(value: ast.expr) -> ast.expr:
    if isinstance(value, ast.Attribute):  # twice infinity is infinity
        return ast.UnaryOp(ast.USub(), value)
    return ast.BinOp(ast.Constant(2), ast.Mult(), value)


def _number(value: float) -> ast.expr:
    return ast.Constant(value) if value >= 0 else ast.UnaryOp(ast.USub(), ast.Constant(-value))


def _as_unary(node: ast.AST) -> ast.UnaryOp:
    assert isinstance(node, ast.UnaryOp)
    return node


def _apply(tree: Function, position: int, edit: Edit) -> None:
    node = list(ast.walk(tree))[position]
    new = edit(node)
    if new is not None:
        Replace(node, new).visit(tree)
