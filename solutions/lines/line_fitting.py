"""The line that is closest to a set of points, by total least squares.

A line is kept in polar form (the sheet's equation 1), so that vertical walls are as easy as
all others, and the distances are measured at right angles to the line.

Source of the closed form: the sheet's question 2.2, derived step by step in
`solutions.lines.line_derivation`; atan2 in place of its plain arctan picks the minimum.
"""

import math
from typing import NamedTuple

import numpy as np


class Line(NamedTuple):
    """A line x cos(alpha) + y sin(alpha) = r."""

    r: float  # m, distance from the origin, never negative
    alpha: float  # rad, direction of the normal, in (-pi, pi]


def fit_line(points: np.ndarray, weights: np.ndarray | None = None) -> Line:
    """Return the line with the least sum of squared distances to the points.

    `points` is an (N, 2) array of x and y in metres, all finite, with N at least 1. `weights` are
    N numbers, none of them negative and not all of them 0; each multiplies the squared distance of
    its point. Without them all points count the same. The line has r >= 0 and -pi < alpha <= pi.
    Points that are 1000 km away from the origin give as exact a line as points near it. Both
    arrays stay as they are.

    Raises:
        ValueError: if the points do not determine a line: there are fewer than two different
            points, or the cloud is equally wide in all directions, as the corners of a square are.
    """
    if np.ma.is_masked(points) or np.ma.is_masked(weights):  # or the mask would be dropped
        raise ValueError("No line: some points are masked; leave them out first.")
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2:
        raise ValueError(f"A line needs an (N, 2) array of two points or more, not {points.shape}.")
    if not np.isfinite(points).all():
        raise ValueError("No line: some coordinates are not finite; remove those points.")
    N = len(points)
    weights = np.ones(N) if weights is None else np.asarray(weights, dtype=float)
    if weights.shape != (N,) or weights.min() < 0 or not 0 < weights.sum() < math.inf:
        raise ValueError(f"The weights must be {N} finite numbers >= 0, not all of them 0.")

    # Sums of centred coordinates: squares of large coordinates would lose their last digits.
    W = weights.sum()
    center = weights @ points / W
    dx, dy = (points - center).T
    S_xx, S_xy, S_yy = weights @ (dx * dx), weights @ (dx * dy), weights @ (dy * dy)

    # R says how much longer than wide the cloud is. With R = 0 every direction fits as well.
    R = math.hypot(S_yy - S_xx, 2 * S_xy)
    size = math.sqrt((S_xx + S_yy) / W)
    rounding = 2e-15 * (size + math.hypot(*center))  # of the coordinates, in float64
    if not W * size * rounding < R:
        raise ValueError("No line: the points are all equal, or equally wide in all directions.")

    # atan2 keeps the quadrant, which makes this the minimum; arctan may give the maximum.
    alpha = 0.5 * math.atan2(-2 * S_xy, S_yy - S_xx)
    r = float(center @ [math.cos(alpha), math.sin(alpha)])
    if r < 0:  # the same line, with its normal turned round
        r, alpha = -r, alpha + math.pi
    if alpha > math.pi:
        alpha -= 2 * math.pi
    return Line(r, alpha)


def line_covariance(
    points: np.ndarray, sigma: float | np.ndarray, weights: np.ndarray | None = None
) -> np.ndarray:
    """Return the (2, 2) covariance of (r, alpha) of the fitted line, in m², m rad and rad².

    `points` is an (N, 2) array in metres. `sigma` is the standard deviation of their coordinates in
    metres, not negative and the same in all directions: one number, or one for each point.
    `weights` are those of `fit_line`. The formula holds as long as sigma is small compared with
    the length of the cloud.
    """
    if not np.all(np.ma.filled(sigma, -1.0) >= 0):
        raise ValueError(f"A standard deviation is a number >= 0, not {sigma}.")
    alpha = fit_line(points, weights).alpha
    points = np.asarray(points, dtype=float)
    weights = np.ones(len(points)) if weights is None else np.asarray(weights, dtype=float)
    center = np.average(points, axis=0, weights=weights)

    # Coordinates across and along the line, from the centre.
    normal = np.array([math.cos(alpha), math.sin(alpha)])
    along = np.array([-math.sin(alpha), math.cos(alpha)])
    a, b = (points - center) @ normal, (points - center) @ along

    # alpha solves sum(weights a b) = 0: its derivative by each point's x and y is (N, 2).
    d_alpha = -weights[:, None] * (np.outer(b, normal) + np.outer(a, along))
    d_alpha /= np.sum(weights * (b * b - a * a))
    # r = normal . center: the centre moves, and the normal turns under it.
    d_r = np.outer(weights / weights.sum(), normal) + (along @ center) * d_alpha

    jacobian = np.stack([d_r, d_alpha]) * np.broadcast_to(sigma, len(points))[:, None]
    return np.einsum("inx,jnx->ij", jacobian, jacobian)


def distances(points: np.ndarray, line: Line) -> np.ndarray:
    """Return signed distances (N,) of (N, 2) points in metres, positive where the normal points."""
    return points @ [math.cos(line.alpha), math.sin(line.alpha)] - line.r


def positions_along(points: np.ndarray, line: Line) -> np.ndarray:
    """Return how far the foot of each of (N, 2) points lies along the line: (N,), in metres.

    Zero is the point of the line that is closest to the origin; positive is to the left of
    the normal.
    """
    return points @ [-math.sin(line.alpha), math.cos(line.alpha)]


def point_at(position: float | np.ndarray, line: Line) -> np.ndarray:
    """Return the point, or the (N, 2) points, at a position along the line."""
    normal = np.array([math.cos(line.alpha), math.sin(line.alpha)])
    along = np.array([-math.sin(line.alpha), math.cos(line.alpha)])
    return line.r * normal + np.multiply.outer(position, along)
