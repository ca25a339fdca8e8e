"""What students write for `fit_line` and `line_covariance`, and what goes wrong."""

import math

import numpy as np

from solutions.lines.line_fitting import Line, fit_line, positions_along


def _centered_sums(points, weights, check=True):
    if check:
        fit_line(points, weights)  # raises where no line is the best one
    weights = np.ones(len(points)) if weights is None else weights
    center = np.average(points, axis=0, weights=weights)
    dx, dy = (points - center).T
    return center, (weights * dx * dx).sum(), (weights * dx * dy).sum(), (weights * dy * dy).sum()


def _line_through(center, alpha):
    r = center[0] * math.cos(alpha) + center[1] * math.sin(alpha)
    if r < 0:
        r, alpha = -r, alpha + math.pi
    return Line(r, alpha - 2 * math.pi if alpha > math.pi else alpha)


def keeps_negative_radius(points, weights=None, check=True):
    """The right line, but r may be negative."""
    center, S_xx, S_xy, S_yy = _centered_sums(points, weights, check)
    alpha = 0.5 * math.atan2(-2 * S_xy, S_yy - S_xx)
    return Line(center[0] * math.cos(alpha) + center[1] * math.sin(alpha), alpha)


def flips_only_the_radius(points, weights=None):
    """Makes r positive without turning the normal round: a line on the other side."""
    r, alpha = keeps_negative_radius(points, weights)
    return Line(abs(r), alpha)


def leaves_alpha_unwrapped(points, weights=None):
    """Turns the normal round, but alpha may be above pi."""
    r, alpha = keeps_negative_radius(points, weights)
    return Line(r, alpha) if r >= 0 else Line(-r, alpha + math.pi)


def plain_arctan(points, weights=None, check=True):
    """The sheet's last formula as it stands: the worst line whenever Syy < Sxx."""
    center, S_xx, S_xy, S_yy = _centered_sums(points, weights, check)
    return _line_through(center, 0.5 * math.atan(-2 * S_xy / (S_yy - S_xx)))


def does_not_center(points, weights=None):
    """Uses sums of x², xy and y² about the origin."""
    fit_line(points, weights)
    weights = np.ones(len(points)) if weights is None else weights
    x, y = points.T
    S_xx, S_xy, S_yy = (weights * x * x).sum(), (weights * x * y).sum(), (weights * y * y).sum()
    alpha = 0.5 * math.atan2(-2 * S_xy, S_yy - S_xx)
    return _line_through(np.average(points, axis=0, weights=weights), alpha)


def regresses_y_on_x(points, weights=None):
    """Fits y = m x + b, so it measures distances along y."""
    center, S_xx, S_xy, _ = _centered_sums(points, weights)
    return _line_through(center, math.atan2(S_xx, -S_xy))  # the normal of (1, m), m = Sxy/Sxx


def ignores_weights(points, weights=None):
    """Treats all points alike."""
    center, S_xx, S_xy, S_yy = _centered_sums(points, None)
    return _line_through(center, 0.5 * math.atan2(-2 * S_xy, S_yy - S_xx))


def subtracts_large_squares(points, weights=None):
    """Centres after squaring (sum of x² - N xc²), which loses the digits of far points."""
    fit_line(points, weights)
    weights = np.ones(len(points)) if weights is None else weights
    x, y = points.T
    N = weights.sum()
    x_c, y_c = (weights * x).sum() / N, (weights * y).sum() / N
    S_xx = (weights * x * x).sum() - N * x_c * x_c
    S_xy = (weights * x * y).sum() - N * x_c * y_c
    S_yy = (weights * y * y).sum() - N * y_c * y_c
    return _line_through((x_c, y_c), 0.5 * math.atan2(-2 * S_xy, S_yy - S_xx))


def centers_in_place(points, weights=None):
    """Subtracts the centre from the array it was given."""
    line = fit_line(points, weights)
    points -= np.average(points, axis=0, weights=weights)
    return line


def fits_anything(points, weights=None):
    """Returns some line even where no line is better than another."""
    r, alpha = keeps_negative_radius(points, weights, check=False)
    if r < 0:
        r, alpha = -r, alpha + math.pi
    return Line(r, alpha - 2 * math.pi if alpha > math.pi else alpha)


def fits_anything_and_keeps_negative_radius(points, weights=None):
    """The formula alone: no check, and r may be negative."""
    return keeps_negative_radius(points, weights, check=False)


def fits_anything_with_arctan(points, weights=None):
    """The sheet's last formula as it stands, on any points."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return plain_arctan(points, weights, check=False)


def fits_a_round_cloud(points, weights=None):
    """Refuses points that are all equal, but not those that are equally wide in all directions."""
    if len(np.unique(points, axis=0)) < 2:
        raise ValueError("fewer than two different points")
    return fits_anything(points, weights)


def stands_at_right_angles(points, weights=None, check=True):
    """Takes the direction along the wall for its normal: the maximum, or the first eigenvector."""
    center, S_xx, S_xy, S_yy = _centered_sums(points, weights, check)
    return _line_through(center, 0.5 * math.atan2(2 * S_xy, S_xx - S_yy))


def stands_at_right_angles_anywhere(points, weights=None):
    """The same, and no error for points that determine no line."""
    return stands_at_right_angles(points, weights, check=False)


def _along_the_wall(points):
    """What the question's formula is made of: N, the lever t, and B."""
    positions = positions_along(points, fit_line(points))
    t = positions.mean()
    return len(points), t, np.sum((positions - t) ** 2)


def covariance_with_the_wrong_sign(points, sigma, weights=None):
    """Lets the normal turn the other way: r and alpha are correlated with the wrong sign."""
    N, t, B = _along_the_wall(points)
    return sigma**2 * np.array([[1 / N + t**2 / B, -t / B], [-t / B, 1 / B]])


def covariance_with_one_point_less(points, sigma, weights=None):
    """Takes sigma²/(N - 1) for the variance of the mean of N points."""
    N, t, B = _along_the_wall(points)
    return sigma**2 * np.array([[1 / (N - 1) + t**2 / B, t / B], [t / B, 1 / B]])


def covariance_with_a_certain_mean(points, sigma, weights=None):
    """Forgets that the centre is uncertain too."""
    _, t, B = _along_the_wall(points)
    return sigma**2 * np.array([[t**2 / B, t / B], [t / B, 1 / B]])


def covariance_without_the_lever(points, sigma, weights=None):
    """Forgets that turning the normal also changes r."""
    N, _, B = _along_the_wall(points)
    return sigma**2 * np.array([[1 / N, 0], [0, 1 / B]])


def covariance_of_sigma(points, sigma, weights=None):
    """Multiplies by sigma instead of its square."""
    N, t, B = _along_the_wall(points)
    return sigma * np.array([[1 / N + t**2 / B, t / B], [t / B, 1 / B]])


def covariance_of_raw_positions(points, sigma, weights=None):
    """Takes the spread along the wall about the foot of the normal, not about the centre."""
    N, t, B = _along_the_wall(points)
    B += N * t**2
    return sigma**2 * np.array([[1 / N + t**2 / B, t / B], [t / B, 1 / B]])


def covariance_with_the_distance_of_the_center(points, sigma, weights=None):
    """Takes the centre's distance from the origin for the lever, not from the foot."""
    N, _, B = _along_the_wall(points)
    t = math.hypot(*points.mean(axis=0))
    return sigma**2 * np.array([[1 / N + t**2 / B, t / B], [t / B, 1 / B]])


def covariance_with_positions_along_y(points, sigma, weights=None):
    """Takes y for the position along the wall, as if every wall were upright."""
    r, alpha = fit_line(points)
    y, center = points[:, 1], points[:, 1].mean()
    B, t = np.sum((y - center) ** 2), center - r * math.sin(alpha)
    return sigma**2 * np.array([[1 / len(points) + t * t / B, t / B], [t / B, 1 / B]])
