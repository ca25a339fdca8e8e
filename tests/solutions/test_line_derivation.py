from functools import cache

import numpy as np
import pytest
import sympy as sp

from solutions.lines import line_derivation as derivation
from solutions.lines.line_fitting import fit_line


@cache
def steps() -> list[derivation.Step]:
    """The derivation; not when the tests are collected, or a mutant of it would not be seen."""
    return derivation.derive()


def clouds(count: int = 12) -> list[np.ndarray]:
    rng = np.random.default_rng(3)
    return [
        rng.normal(size=(9, 2)) @ rng.normal(size=(2, 2)) + rng.normal(size=2) * 3
        for _ in range(count)
    ]


def numbers(points: np.ndarray, angle: float, radius: float) -> dict:
    center = points.mean(axis=0)
    (S_xx, S_xy), (_, S_yy) = (center - points).T @ (center - points)
    symbols = [
        derivation.N,
        derivation.x_c,
        derivation.y_c,
        derivation.alpha,
        derivation.r,
        derivation.S_xx,
        derivation.S_xy,
        derivation.S_yy,
    ]
    return dict(zip(symbols, [len(points), *center, angle, radius, S_xx, S_xy, S_yy], strict=True))


def squared_error(points: np.ndarray, radius: float, angle: float) -> float:
    return float(np.sum((radius - points @ [np.cos(angle), np.sin(angle)]) ** 2))


def right_side(reason: str) -> sp.Expr:
    (step,) = (step for step in steps() if step.reason.startswith(reason))
    return step.right


@pytest.mark.parametrize("points", clouds(3))
def test_the_derivative_by_r_is_a_difference_quotient(points):
    h = 1e-6
    quotient = (squared_error(points, 0.7 + h, 0.4) - squared_error(points, 0.7 - h, 0.4)) / (2 * h)
    symbolic = right_side("derive by r").subs(numbers(points, 0.4, 0.7))
    assert float(symbolic) == pytest.approx(quotient, rel=1e-6)


@pytest.mark.parametrize("points", clouds(3))
@pytest.mark.parametrize("reason", ["derive by alpha", "write it with the double angle"])
def test_the_derivative_by_alpha_is_a_difference_quotient(points, reason):
    def least(angle):  # r follows alpha: the line goes through the centre
        return squared_error(points, points.mean(axis=0) @ [np.cos(angle), np.sin(angle)], angle)

    h = 1e-6
    quotient = (least(0.4 + h) - least(0.4 - h)) / (2 * h)
    symbolic = right_side(reason).subs(numbers(points, 0.4, 0.0))
    assert float(symbolic) == pytest.approx(quotient, rel=1e-6)


def test_the_result_of_the_sheet_is_stationary_but_half_of_the_time_a_maximum():
    maxima = 0
    for points in clouds():
        values = numbers(points, 0.0, 0.0)
        angle = float(right_side("the sheet's result").subs(values))
        values[derivation.alpha] = angle
        assert float(right_side("write it with").subs(values)) == pytest.approx(0, abs=1e-9)
        maxima += float(right_side("the second derivative").subs(values)) < 0
    assert 0 < maxima < len(clouds())


def test_the_second_derivative_at_the_result_is_positive():
    S_xx, S_xy, S_yy = derivation.S_xx, derivation.S_xy, derivation.S_yy
    R = sp.sqrt((S_yy - S_xx) ** 2 + 4 * S_xy**2)
    assert sp.simplify(right_side("it is positive") - 2 * R) == 0


@pytest.mark.parametrize("points", clouds())
def test_the_derived_formulas_fit_line_and_svd_agree(points):
    line = derivation.fit_line_symbolically(points)
    assert line == pytest.approx(fit_line(points))
    center = points.mean(axis=0)
    normal = np.linalg.svd(points - center)[2][1]
    assert line.r == pytest.approx(abs(normal @ center))
    assert abs(normal @ [np.cos(line.alpha), np.sin(line.alpha)]) == pytest.approx(1.0)


def test_sums_over_the_points_are_linear_and_centred_coordinates_add_up_to_nothing():
    x, y, dx, dy = derivation.x, derivation.y, derivation.dx, derivation.dy
    a, N = derivation.alpha, derivation.N
    for term, total in (
        (sp.Integer(3), 3 * N),
        (a * x, a * N * derivation.x_c),
        (y - x, N * (derivation.y_c - derivation.x_c)),
        (5 * dx + 2 * dy, sp.Integer(0)),
        ((dx + a * dy) ** 2, derivation.S_xx + 2 * a * derivation.S_xy + a**2 * derivation.S_yy),
        (7 + dx + dy**2, 7 * N + derivation.S_yy),
    ):
        assert sp.expand(derivation.sum_over_points(term) - total) == 0
    for beyond in (x**2, x * dx, y * dy, dx**3):
        with pytest.raises(KeyError):
            derivation.sum_over_points(beyond)


def test_each_step_says_what_is_equal_to_what_and_why():
    assert [(str(step.left), step.reason.split()[0]) for step in steps()] == [
        ("S", "the"),
        ("dS_dr", "derive"),
        ("r", "set"),
        ("S", "put"),
        ("dS_dalpha", "derive"),
        ("dS_dalpha", "write"),
        ("tan(2*alpha)", "set"),
        ("alpha", "the"),
        ("d2S_dalpha2", "the"),
        ("d2S_dalpha2", "it"),
        ("alpha", "the"),
        ("r", "the"),
    ]
    assert len({step.reason for step in steps()}) == 12
    assert all(isinstance(step.right, sp.Expr) for step in steps())


def test_with_the_best_r_nothing_but_centered_coordinates_is_left():
    dx, dy, alpha = derivation.dx, derivation.dy, derivation.alpha
    assert right_side("put r in").free_symbols == {dx, dy, alpha}
    across = dx * sp.cos(alpha) + dy * sp.sin(alpha)
    assert sp.expand(right_side("put r in") - across**2) == 0


@pytest.mark.parametrize("x", [-1.0, 0.0, 1.0])
def test_the_normal_of_a_vertical_line_is_that_of_fit_line(x):
    """To the left it is pi and not -pi, and through the origin it is not turned round."""
    points = np.array([[x, 0.0], [x, 1.0], [x, 2.0]])
    expected = (abs(x), np.pi if x < 0 else 0.0)
    assert derivation.fit_line_symbolically(points) == pytest.approx(expected)
    assert fit_line(points) == pytest.approx(expected)
