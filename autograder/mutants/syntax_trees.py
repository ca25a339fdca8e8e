"""A function's syntax tree: copied quickly, parts replaced and found again, and shown as code."""

from __future__ import annotations

import ast
import copy
from typing import TypeVar

Function = ast.FunctionDef
Node = TypeVar("Node", bound=ast.AST)


class Replace(ast.NodeTransformer):
    """Puts one node in another's place."""

    def __init__(self, old: ast.AST, new: ast.AST) -> None:
        self._old, self._new = old, new

    def visit(self, node: ast.AST) -> ast.AST:
        return self._new if node is self._old else self.generic_visit(node)


def not_run(function: Function) -> set[ast.AST]:
    """What a mutant leaves alone: docstrings, annotations, decorators, and what messages say."""
    left: list[ast.AST] = [*function.decorator_list]
    arguments = function.args
    every = (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)
    left += [entry.annotation for entry in every if entry.annotation is not None]
    left += [function.returns] if function.returns is not None else []
    for node in ast.walk(function):
        if isinstance(node, ast.FunctionDef) and has_docstring(node):
            left.append(node.body[0])
        if isinstance(node, ast.JoinedStr):
            left.append(node)
        if isinstance(node, ast.AnnAssign):
            left.append(node.annotation)
        if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
            left += node.exc.args
    return {inner for node in left for inner in ast.walk(node)}


def guards_of(function: Function) -> set[ast.AST]:
    """The conditions that only lead to an exception, with all that is in them."""
    return {
        inner
        for node in ast.walk(function)
        if isinstance(node, ast.If) and all(isinstance(step, ast.Raise) for step in node.body)
        for inner in (node, *ast.walk(node.test), *(n for s in node.body for n in ast.walk(s)))
    }


def has_docstring(function: Function) -> bool:
    """Whether its first statement is a docstring."""
    return ast.get_docstring(function, clean=False) is not None


def statement_of(node: ast.AST, parents: dict[ast.AST, ast.AST]) -> ast.AST:
    """The statement that holds a node."""
    while not isinstance(node, ast.stmt) and node in parents:
        node = parents[node]
    return node


def statement_at(
    tree: Function, position: int, original: list[ast.AST], parents: dict[ast.AST, ast.AST]
) -> ast.AST | None:
    """What has become of the statement that held the node at a position."""
    path: list[tuple[str, int | None]] = []
    node = statement_of(original[position], parents)
    while node in parents:
        parent = parents[node]
        for field, value in ast.iter_fields(parent):
            if value is node:
                path.append((field, None))
            elif isinstance(value, list) and any(entry is node for entry in value):
                path.append((field, next(i for i, e in enumerate(value) if e is node)))
        node = parent
    found: ast.AST = tree
    for field, place in reversed(path):
        value = getattr(found, field)
        found = value if place is None else value[place]
    return found


def first_line(node: ast.AST) -> str:
    """The first line of a statement, as code."""
    return ast.unparse(node).partition("\n")[0].rstrip(":")


def line_of(node: ast.AST) -> int:
    """The line of a node in its file, 0 if it has none."""
    return getattr(node, "lineno", 0)


def code_of(function: Function) -> str:
    """A function as code, without its docstring."""
    bare = copy.copy(function)
    if has_docstring(bare) and len(bare.body) > 1:
        bare.body = bare.body[1:]
    return ast.unparse(bare)


def copy_of(node: Node) -> Node:
    """A copy of a tree, made in a fraction of the time that `copy.deepcopy` takes.

    Nodes that hold nothing, such as operators, are not copied: there is nothing in them to change.
    """
    held = vars(node)
    if not held:
        return node
    copied = copy.copy(node)
    for name, value in held.items():
        if isinstance(value, ast.AST):
            setattr(copied, name, copy_of(value))
        elif isinstance(value, list):
            entries = [copy_of(entry) if isinstance(entry, ast.AST) else entry for entry in value]
            setattr(copied, name, entries)
    return copied
