"""The sheet's derivation of the line fit (question 2.2), step by step, with sympy.

Sums over the points are linear, so only sums of products of the coordinates survive; each
becomes one symbol. `derive()` goes from the squared error to the closed form that
`solutions.lines.line_fitting.fit_line` computes. The sheet stops at a plain arctan, which is a
stationary point; two more steps find out which stationary point is the minimum.
"""

from typing import NamedTuple

import numpy as np
import sympy as sp

from solutions.lines.line_fitting import Line

r, alpha = sp.symbols("r alpha", real=True)
x, y = sp.symbols("x y", real=True)  # one point
dx, dy = sp.symbols("dx dy", real=True)  # one centred point: dx = x_c - x, dy = y_c - y
N = sp.Symbol("N", positive=True)
x_c, y_c = sp.symbols("x_c y_c", real=True)  # the centre
S_xx, S_xy, S_yy = sp.symbols("S_xx S_xy S_yy", real=True)  # sums of dx², dx dy, dy²


class Step(NamedTuple):
    """One line of the derivation: `left` = `right`, and why."""

    reason: str
    left: sp.Expr
    right: sp.Expr


def sum_over_points(term: sp.Expr) -> sp.Expr:
    """Return the sum over all points of a polynomial in one point's coordinates.

    Plain coordinates up to degree 1 and centred ones up to degree 2, which is all the
    derivation needs; the centred ones add up to zero.
    """
    sums = {
        (0, 0, 0, 0): N,
        (1, 0, 0, 0): N * x_c,
        (0, 1, 0, 0): N * y_c,
        (0, 0, 1, 0): sp.Integer(0),
        (0, 0, 0, 1): sp.Integer(0),
        (0, 0, 2, 0): S_xx,
        (0, 0, 1, 1): S_xy,
        (0, 0, 0, 2): S_yy,
    }
    polynomial = sp.Poly(sp.expand(term), x, y, dx, dy)
    return sp.Add(*(factor * sums[powers] for powers, factor in polynomial.terms()))


def derive() -> list[Step]:
    """Return the derivation; the last two steps give r and alpha of the best line."""
    cos, sin = sp.cos(alpha), sp.sin(alpha)
    S, dS_dr, dS_dalpha = sp.symbols("S dS_dr dS_dalpha")

    # First r: the error is a parabola in r, so there is one stationary point.
    error = (r - x * cos - y * sin) ** 2
    slope_r = sum_over_points(sp.diff(error, r))
    (best_r,) = sp.solve(slope_r, r)

    # With it, only centred coordinates are left.
    centered = error.subs({r: best_r, x: x_c - dx, y: y_c - dy})
    centered = sp.factor(sp.expand(centered))
    slope = sum_over_points(sp.diff(centered, alpha))

    # Half angles become double angles: sin cos = sin(2a)/2 and cos² - sin² = cos(2a).
    double = sp.sin(2 * alpha) * (S_yy - S_xx) + 2 * sp.cos(2 * alpha) * S_xy
    assert sp.simplify(sp.expand_trig(double) - slope) == 0
    tangent = -2 * S_xy / (S_yy - S_xx)

    # Which stationary point? The second derivative tells.
    curvature = sp.diff(double, alpha)
    R = sp.sqrt((S_yy - S_xx) ** 2 + 4 * S_xy**2)
    at_minimum = {sp.sin(2 * alpha): -2 * S_xy / R, sp.cos(2 * alpha): (S_yy - S_xx) / R}
    curvature_there = sp.simplify(curvature.subs(at_minimum))

    return [
        Step("the squared error of one point", S, error),
        Step("derive by r and sum over the points", dS_dr, slope_r),
        Step("set it to zero: the line goes through the centre", r, best_r),
        Step("put r in: what remains is centred", S, centered),
        Step("derive by alpha and sum over the points", dS_dalpha, slope),
        Step("write it with the double angle", dS_dalpha, double),
        Step("set it to zero", sp.tan(2 * alpha), tangent),
        Step("the sheet's result, a stationary point", alpha, sp.atan(tangent) / 2),
        Step("the second derivative", sp.Symbol("d2S_dalpha2"), curvature),
        Step("it is positive for sin 2a = -2 S_xy / R", sp.Symbol("d2S_dalpha2"), curvature_there),
        Step("the minimum: atan2 keeps both signs", alpha, sp.atan2(-2 * S_xy, S_yy - S_xx) / 2),
        Step("the distance from the origin", r, best_r),
    ]


def fit_line_symbolically(points: np.ndarray) -> Line:
    """Put the sums of (N, 2) points into the derived formulas; for checking `fit_line`."""
    *_, alpha_step, r_step = derive()
    center = points.mean(axis=0)
    sums = (center - points).T @ (center - points)
    values = {S_xx: sums[0, 0], S_xy: sums[0, 1], S_yy: sums[1, 1]}
    best_alpha = float(alpha_step.right.subs(values))
    values = {x_c: center[0], y_c: center[1], alpha: best_alpha}
    best_r = float(r_step.right.subs(values))
    if best_r < 0:
        best_r, best_alpha = -best_r, best_alpha + np.pi
    return Line(best_r, best_alpha - 2 * np.pi if best_alpha > np.pi else best_alpha)
