"""Other right ways to the covariance of a line."""

import math

import numpy as np

from solutions.lines.line_fitting import fit_line


def formula(points, sigma, weights=None):
    _, alpha = fit_line(points)
    along = np.array([-math.sin(alpha), math.cos(alpha)])
    center = points.mean(axis=0)
    b = (points - center) @ along
    B, t, N = (b**2).sum(), center @ along, len(points)
    return sigma**2 * np.array([[1 / N + t**2 / B, t / B], [t / B, 1 / B]])


def plain_loops(points, sigma, weights=None):
    _, alpha = fit_line(points)
    along = [-math.sin(alpha) * x + math.cos(alpha) * y for x, y in points]
    N, t = len(along), sum(along) / len(along)
    B = sum((b - t) ** 2 for b in along)
    s2 = sigma * sigma
    return [[s2 / N + s2 * t * t / B, s2 * t / B], [s2 * t / B, s2 / B]]


def variance_of_a_regression(points, sigma, weights=None):
    # Offsets over positions: intercept and slope of an ordinary regression.
    alpha = fit_line(points).alpha
    b = points @ [-math.sin(alpha), math.cos(alpha)]
    design = np.column_stack([np.ones_like(b), -b])
    C = sigma**2 * np.linalg.inv(design.T @ design)
    return C


def turned_about_the_center(points, sigma, weights=None):
    alpha = fit_line(points).alpha
    b = points @ np.array([-np.sin(alpha), np.cos(alpha)])
    t = np.mean(b)
    about_the_center = np.diag([1 / len(b), 1 / (len(b) * np.var(b))])
    lever = np.array([[1.0, t], [0.0, 1.0]])
    return (sigma**2 * lever @ about_the_center @ lever.T).astype(np.float32)


def finite_differences(points, sigma, weights=None):
    line, step = np.array(fit_line(points)), 1e-6 * np.ptp(points)
    rows = []
    for i in range(points.size):
        moved = points.copy().ravel()
        moved[i] += step
        change = np.array(fit_line(moved.reshape(-1, 2))) - line
        change[1] = math.remainder(change[1], 2 * math.pi)
        rows.append(change / step)
    jacobian = np.array(rows)
    return sigma**2 * jacobian.T @ jacobian
