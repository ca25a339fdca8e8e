"""What the references say of their arrays, for whoever reads them without running them."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
# Their functions are known mistakes, other people's styles and inputs: nobody calls them by hand.
LEFT_OUT = {"mistakes", "variants", "cases"}
MODULES = [
    path
    for folder in ("solutions", "data")
    for path in sorted((ROOT / folder).rglob("*.py"))
    if not LEFT_OUT & set(path.parts)
]
SHAPE = re.compile(
    r"\((\.\.\., ?)?\w+( \* \w+)?(, ?\w+)*( - 1)?,?\)|\d+ by \d+ pixels|pixels|shape|image"
)


def functions(tree: ast.Module) -> list[ast.FunctionDef]:
    methods = [f for c in tree.body if isinstance(c, ast.ClassDef) for f in c.body]
    return [f for f in [*tree.body, *methods] if isinstance(f, ast.FunctionDef)]


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_a_public_function_of_arrays_says_of_which_shape(path):
    silent = [
        function.name
        for function in functions(ast.parse(path.read_text(encoding="utf-8")))
        if not function.name.startswith("_")
        and re.search(r"ndarray|NDArray", ast.unparse(function.args) + str(_returned(function)))
        and not SHAPE.search(ast.get_docstring(function) or "")
    ]
    assert silent == []


def _returned(function: ast.FunctionDef) -> str:
    return ast.unparse(function.returns) if function.returns else ""
