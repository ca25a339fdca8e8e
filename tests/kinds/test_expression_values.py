"""Values of expressions by walking the tree, compared with sympy's own slow evaluation."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.kinds.expression.inside.values import NotInTable, values_at
from autograder.sandbox.inside.plain_data import is_plain

x, y = sp.symbols("x y", real=True)
POINTS = {"x": np.array([0.3, 1.7, 2.9]), "y": np.array([1.1, 0.2, 0.7])}
_LEAVES = st.sampled_from([x, y, sp.Integer(2), sp.Rational(-1, 3), sp.Float(0.7), sp.pi, sp.E])


def _combine(inner):
    return (
        st.builds(lambda a, b: a + b, inner, inner)
        | st.builds(lambda a, b: a * b, inner, inner)
        | st.builds(lambda a, n: a**n, inner, st.sampled_from([2, 3, -1, sp.Rational(1, 2)]))
        | st.builds(lambda f, a: f(a), st.sampled_from([sp.sin, sp.cos, sp.atan, sp.Abs]), inner)
        | st.builds(sp.atan2, inner, inner)
    )


@settings(max_examples=60, deadline=None)
@given(st.recursive(_LEAVES, _combine, max_leaves=8))
def test_the_tree_has_the_values_that_sympy_gives(expression):
    if expression.has(sp.zoo, sp.nan, sp.oo, sp.I):
        return
    with np.errstate(all="ignore"):
        try:
            found = np.broadcast_to(np.asarray(values_at(expression, POINTS), complex), (3,))
        except NotInTable:
            return  # left to sympy's own way
    for position in range(3):
        at = {x: POINTS["x"][position], y: POINTS["y"][position]}
        expected = complex(expression.evalf(30, subs=at))
        if abs(expected.imag) < 1e-12 and abs(expected) < 1e12:
            assert found[position] == pytest.approx(expected, rel=1e-6, abs=1e-6)


def test_what_is_not_in_the_table_is_left_to_sympy():
    with pytest.raises(NotInTable):
        values_at(sp.gamma(x), POINTS)
    with pytest.raises(NotInTable):
        values_at(sp.I * x, POINTS)


def test_an_expression_with_a_students_class_in_it_is_not_plain():
    class Sly(sp.Function):
        pass

    assert is_plain(sp.sin(x) ** 2 + y)
    assert not is_plain(sp.sin(x) + Sly(y))
    assert not is_plain("x")
    assert not is_plain(sp.Add(*(x**n for n in range(3000))))  # `sum` would take half a minute
