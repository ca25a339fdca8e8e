"""Other right ways to fit a line."""

import cmath
import math

import numpy as np

from solutions.lines.line_fitting import Line


def _towards_the_line(nx, ny, x, y):
    r = nx * x + ny * y
    if r < 0:
        r, nx, ny = -r, -nx, -ny
    return r, math.atan2(ny, nx)


def singular_values(points, weights=None):
    weights = np.ones(len(points)) if weights is None else weights
    center = (weights[:, None] * points).sum(axis=0) / weights.sum()
    spread = np.sqrt(weights)[:, None] * (points - center)
    _, values, directions = np.linalg.svd(np.vstack([spread, np.zeros((2, 2))]))
    if np.isclose(values[0], values[1]):
        raise ValueError("no direction is better than another")
    return Line(*_towards_the_line(*directions[1], *center))


def eigenvectors(points, weights=None):
    if weights is None:
        weights = np.ones(len(points))
    center = np.average(points, axis=0, weights=weights)
    centered = points - center
    values, vectors = np.linalg.eigh(centered.T @ np.diag(weights) @ centered)
    if values[1] - values[0] <= 1e-12 * values[1]:
        raise ValueError("No line")
    return np.array(_towards_the_line(*vectors[:, 0], *center))


def plain_loops(points, weights=None):
    points = [(float(x), float(y)) for x, y in points]
    weights = [1.0] * len(points) if weights is None else list(weights)
    total = sum(weights)
    x_c = sum(w * x for w, (x, _) in zip(weights, points, strict=True)) / total
    y_c = sum(w * y for w, (_, y) in zip(weights, points, strict=True)) / total
    S_xx = S_xy = S_yy = 0.0
    for w, (x, y) in zip(weights, points, strict=True):
        S_xx += w * (x - x_c) ** 2
        S_xy += w * (x - x_c) * (y - y_c)
        S_yy += w * (y - y_c) ** 2
    if S_xx == S_yy and S_xy == 0:
        raise ValueError("every line fits as well")
    alpha = math.atan2(-2 * S_xy, S_yy - S_xx) / 2
    r = x_c * math.cos(alpha) + y_c * math.sin(alpha)
    if r < 0:
        r, alpha = -r, alpha + math.pi
    return [r, alpha - 2 * math.pi if alpha > math.pi else alpha]


def complex_numbers(points, weights=None):
    z = points[:, 0] + 1j * points[:, 1]
    weights = np.ones(len(z)) if weights is None else weights
    center = (weights * z).sum() / weights.sum()
    turn = (weights * (z - center) ** 2).sum()  # twice the direction of the wall
    if turn == 0:
        raise ValueError("isotropic")
    normal = 1j * cmath.sqrt(turn)
    normal /= abs(normal)
    r = (center * normal.conjugate()).real
    return abs(r), cmath.phase(normal if r >= 0 else -normal)


def the_better_of_two_angles(points, weights=None):
    weights = np.ones(len(points)) if weights is None else np.asarray(weights)
    center = np.average(points, axis=0, weights=weights)
    dx, dy = (points - center).T
    S_xx, S_xy, S_yy = (weights * dx * dx).sum(), (weights * dx * dy).sum(), weights @ (dy * dy)
    if S_xx == S_yy and S_xy == 0:
        raise ValueError("no line")
    first = 0.5 * np.arctan(-2 * S_xy / (S_yy - S_xx)) if S_yy != S_xx else math.pi / 4

    def cost(a):
        return np.sum(weights * (dx * np.cos(a) + dy * np.sin(a)) ** 2)

    alpha = min(first, first + math.pi / 2, key=cost)
    return _towards_the_line(np.cos(alpha), np.sin(alpha), *center)
