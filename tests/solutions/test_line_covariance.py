import math

import numpy as np
import pytest

from solutions.lines.line_fitting import Line, fit_line, line_covariance, point_at

SIGMA = 0.01
LINES = [Line(2.0, 0.5), Line(3.0, -2.5), Line(0.5, math.pi / 2), Line(4.0, 3.1)]


def seen_from_one_side(line: Line, count: int = 30) -> np.ndarray:
    """Points off centre along the wall, where r and alpha are correlated."""
    rng = np.random.default_rng(2)
    points = point_at(np.linspace(1.0, 5.0, count), line)
    return points + rng.normal(0.0, SIGMA, points.shape)


@pytest.mark.parametrize("line", LINES)
@pytest.mark.parametrize("weighted", [False, True])
def test_covariance_agrees_with_finite_differences(line, weighted):
    points = seen_from_one_side(line)
    rng = np.random.default_rng(3)
    weights = rng.uniform(0.2, 2.0, len(points)) if weighted else None
    sigmas = rng.uniform(0.5, 1.5, len(points)) * SIGMA
    h = 1e-6
    jacobian = np.empty((2, points.size))
    for column in range(points.size):
        step = np.zeros(points.size)
        step[column] = h
        ahead = fit_line(points + step.reshape(points.shape), weights)
        back = fit_line(points - step.reshape(points.shape), weights)
        jacobian[:, column] = np.subtract(ahead, back) / (2 * h)
    expected = jacobian * np.repeat(sigmas**2, 2) @ jacobian.T
    covariance = line_covariance(points, sigmas, weights)
    assert covariance == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("line", LINES)
def test_covariance_agrees_with_monte_carlo(line):
    rng = np.random.default_rng(6)
    exact = point_at(np.linspace(1.0, 5.0, 20), line)
    fits = np.array([fit_line(exact + rng.normal(0.0, SIGMA, exact.shape)) for _ in range(10000)])
    fits[:, 1] = line.alpha + np.remainder(fits[:, 1] - line.alpha + math.pi, 2 * math.pi) - math.pi
    observed = np.cov(fits.T)
    predicted = line_covariance(exact, SIGMA)
    scale = np.sqrt(np.outer(np.diag(predicted), np.diag(predicted)))
    assert observed / scale == pytest.approx(predicted / scale, abs=0.06)  # 4 standard errors


def test_a_wall_seen_symmetrically_has_the_textbook_variances():
    # x = 2, y = -1, 0, 1: var r = sigma²/3, var alpha = sigma²/sum(y²), no correlation.
    points = np.array([[2.0, -1.0], [2.0, 0.0], [2.0, 1.0]])
    expected = np.diag([SIGMA**2 / 3, SIGMA**2 / 2])
    assert line_covariance(points, SIGMA) == pytest.approx(expected)


def test_the_covariance_follows_each_coordinate_of_a_noisy_cloud():
    """By central differences of the fit itself; residuals are a third of the cloud's length."""
    points = np.array([[1.0, 2.0], [2.5, 1.0], [3.0, 3.5], [5.0, 2.0], [6.0, 5.5]])
    step, jacobian = 1e-6, []
    for index in np.ndindex(points.shape):
        up, down = points.copy(), points.copy()
        up[index] += step
        down[index] -= step
        jacobian.append((np.array(fit_line(up)) - np.array(fit_line(down))) / (2 * step))
    expected = 0.01**2 * np.array(jacobian).T @ np.array(jacobian)
    assert line_covariance(points, 0.01) == pytest.approx(expected, rel=1e-6)
    assert line_covariance(points.tolist(), 0.01) == pytest.approx(expected, rel=1e-6)


def test_points_that_are_exact_fix_an_exact_line():
    points = np.array([[1.0, 2.0], [2.5, 1.0], [3.0, 3.5]])
    assert np.array_equal(line_covariance(points, 0.0), np.zeros((2, 2)))
