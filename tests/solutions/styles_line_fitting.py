"""Right functions of chapter 2 in many styles, and slips that make them wrong, as in chapter 1."""

# ruff: noqa: E501 (students' lines are as long as they are)

STYLES = {
    "Q2.3": [
        # the derivation, step by step
        """
def fit_line(points, weights=None):
    w = np.ones(len(points)) if weights is None else np.asarray(weights, dtype=float)
    x, y = points[:, 0], points[:, 1]
    if len(points) < 2:
        raise ValueError("two points are needed")
    x_c = (w * x).sum() / w.sum()
    y_c = (w * y).sum() / w.sum()
    dx, dy = x - x_c, y - y_c
    S_xx, S_yy, S_xy = (w * dx * dx).sum(), (w * dy * dy).sum(), (w * dx * dy).sum()
    if math.hypot(S_yy - S_xx, 2 * S_xy) <= 1e-9 * (S_xx + S_yy):
        raise ValueError("no direction is better than another")
    alpha = 0.5 * math.atan2(-2 * S_xy, S_yy - S_xx)
    r = x_c * math.cos(alpha) + y_c * math.sin(alpha)
    if r < 0:
        r = -r
        alpha = alpha + math.pi
    if alpha > math.pi:
        alpha = alpha - 2 * math.pi
    return Line(r, alpha)
""",
        # singular values
        """
def fit_line(points, weights=None):
    if weights is None:
        weights = np.ones(len(points))
    used = points[weights > 0]
    w = weights[weights > 0]
    if len(used) < 2 or (used == used[0]).all():
        raise ValueError("all points are equal")
    center = np.average(used, axis=0, weights=w)
    _, s, vt = np.linalg.svd(np.sqrt(w)[:, None] * (used - center), full_matrices=False)
    if s[0] - s[1] < 1e-7 * s[0]:
        raise ValueError("the cloud is round")
    n = vt[1]
    r = n @ center
    if r < 0:
        n, r = -n, -r
    return Line(float(r), float(np.arctan2(n[1], n[0])))
""",
        # eigenvectors
        """
def fit_line(points, weights=None):
    points = np.array(points, dtype=float)
    if len(np.unique(points, axis=0)) < 2:
        raise ValueError("fewer than two different points")
    w = np.ones(len(points)) if weights is None else np.array(weights, dtype=float)
    w /= w.sum()
    c = w @ points
    points -= c
    values, vectors = np.linalg.eigh((w[:, None] * points).T @ points)
    if np.isclose(values[0], values[1], rtol=1e-8, atol=0):
        raise ValueError("no direction")
    normal = vectors[:, 0]
    if normal @ c < 0:
        normal = -normal
    return Line(normal @ c, math.atan2(normal[1], normal[0]))
""",
        # complex numbers
        """
import cmath
def fit_line(points, weights=None):
    z = np.asarray(points) @ [1, 1j]
    w = np.full(len(z), 1.0) if weights is None else weights
    if len(z) == 0:
        raise ValueError("no points")
    c = (w * z).sum() / np.sum(w)
    d = z - c
    moment, spread = (w * d * d).sum(), (w * abs(d) ** 2).sum()
    if abs(moment) <= 1e-8 * spread:
        raise ValueError("isotropic or a single point")
    n = 1j * cmath.exp(0.5j * cmath.phase(moment))
    r = (c * n.conjugate()).real
    if r < 0:
        r, n = -r, -n
    return Line(r, cmath.phase(n))
""",
        # both stationary angles, compared by what they cost
        """
def fit_line(points, weights=None):
    n = len(points)
    w = [1.0] * n if weights is None else [float(v) for v in weights]
    pts = [(float(x), float(y), v) for (x, y), v in zip(points, w) if v > 0]
    if len({(x, y) for x, y, _ in pts}) < 2:
        raise ValueError("a line needs two different points")
    total = math.fsum(v for _, _, v in pts)
    xc = math.fsum(v * x for x, _, v in pts) / total
    yc = math.fsum(v * y for _, y, v in pts) / total
    sxx = math.fsum(v * (x - xc) ** 2 for x, _, v in pts)
    syy = math.fsum(v * (y - yc) ** 2 for _, y, v in pts)
    sxy = math.fsum(v * (x - xc) * (y - yc) for x, y, v in pts)
    def cost(a):
        return sxx * math.cos(a) ** 2 + syy * math.sin(a) ** 2 + 2 * sxy * math.sin(a) * math.cos(a)
    first = math.pi / 4 if sxx == syy else math.atan(-2 * sxy / (syy - sxx)) / 2
    second = first + math.pi / 2
    if abs(cost(first) - cost(second)) <= 1e-9 * (sxx + syy):
        raise ValueError("every angle is as good")
    alpha = min(first, second, key=cost)
    r = xc * math.cos(alpha) + yc * math.sin(alpha)
    if r < 0:
        r, alpha = -r, alpha + math.pi
    while alpha > math.pi:
        alpha -= 2 * math.pi
    return Line(r, alpha)
""",
        # NumPy's covariance
        """
def fit_line(points, weights=None):
    if len(points) < 2:
        raise ValueError("too few points")
    if weights is None:
        weights = np.ones(len(points))
    mean = np.average(points, axis=0, weights=weights)
    C = np.cov((points - mean).T, aweights=weights, ddof=0)
    a, b, c = C[0, 0], C[0, 1], C[1, 1]
    if not np.hypot(c - a, 2 * b) > 1e-8 * (a + c):
        raise ValueError("equally wide in all directions")
    alpha = np.arctan2(-2 * b, c - a) / 2
    r = mean @ [np.cos(alpha), np.sin(alpha)]
    if r < 0:
        r, alpha = -r, alpha + (np.pi if alpha <= 0 else -np.pi)
    return Line(r, alpha)
""",
        # the direction of the line first
        """
def fit_line(points, weights=None):
    points = np.asarray(points, float)
    weights = np.ones(points.shape[0]) if weights is None else np.asarray(weights, float)
    keep = weights != 0
    points, weights = points[keep], weights[keep]
    if len(points) < 2 or np.ptp(points, axis=0).max() == 0:
        raise ValueError("no line")
    center = (points * weights[:, None]).sum(0) / weights.sum()
    x, y = (points - center).T
    xx, yy, xy = weights @ (x * x), weights @ (y * y), weights @ (x * y)
    if (xx - yy) ** 2 + 4 * xy ** 2 < 1e-16 * (xx + yy) ** 2:
        raise ValueError("no direction")
    theta = 0.5 * np.arctan2(2 * xy, xx - yy)
    nx, ny = -np.sin(theta), np.cos(theta)
    r = nx * center[0] + ny * center[1]
    s = 1 if r >= 0 else -1
    return Line(s * r, np.arctan2(s * ny, s * nx))
""",
    ],
    "Q2.4": [
        """
def line_covariance(points, sigma, weights=None):
    r, alpha = fit_line(points)
    u = np.array([-np.sin(alpha), np.cos(alpha)])
    s = points @ u
    t = s.mean()
    B = ((s - t) ** 2).sum()
    return sigma ** 2 * np.array([[1 / len(points) + t ** 2 / B, t / B], [t / B, 1 / B]])
""",
        # the normal equations of small errors
        """
def line_covariance(points, sigma, weights=None):
    line = fit_line(points)
    s = points @ np.array([-math.sin(line.alpha), math.cos(line.alpha)])
    A = np.column_stack([np.ones(len(s)), -s])
    return sigma ** 2 * np.linalg.inv(A.T @ A)
""",
        # what an error of each point does
        """
def line_covariance(points, sigma, weights=None):
    alpha = fit_line(points).alpha
    center = np.mean(points, axis=0)
    along = np.array([-np.sin(alpha), np.cos(alpha)])
    b = (points - center) @ along
    t = center @ along
    d_alpha = b / np.sum(b ** 2)
    d_r = np.full(len(b), 1 / len(b)) + t * d_alpha
    J = np.array([d_r, d_alpha])
    return J @ (sigma ** 2 * np.eye(len(b))) @ J.T
""",
        # loops
        """
def line_covariance(points, sigma, weights=None):
    alpha = fit_line(points)[1]
    n = len(points)
    xc = sum(p[0] for p in points) / n
    yc = sum(p[1] for p in points) / n
    B = 0
    for x, y in points:
        b = -(x - xc) * math.sin(alpha) + (y - yc) * math.cos(alpha)
        B += b ** 2
    t = -xc * math.sin(alpha) + yc * math.cos(alpha)
    v = sigma * sigma
    return [[v / n + v * t * t / B, v * t / B], [v * t / B, v / B]]
""",
        # the cloud turned into the line's own axes, by complex numbers
        """
def line_covariance(points, sigma, weights=None):
    line = fit_line(points)
    turned = (points @ [1, 1j]) * np.exp(-1j * line.alpha)
    t, B = turned.imag.mean(), len(points) * turned.imag.var()
    C = np.zeros((2, 2))
    C[0, 0] = 1 / len(points)
    C += np.outer([t, 1], [t, 1]) / B
    return C * sigma ** 2
""",
        # turning about the centre, then moving the foot
        """
def line_covariance(points, sigma, weights=None):
    _, alpha = fit_line(points)
    center = points.mean(axis=0)
    c, s = np.cos(alpha), np.sin(alpha)
    R = np.array([[c, s], [-s, c]])
    t = (R @ center)[1]
    B = (((points - center) @ R.T)[:, 1] ** 2).sum()
    at_center = np.diag([sigma ** 2 / len(points), sigma ** 2 / B])
    F = np.array([[1, t], [0, 1]])
    return F @ at_center @ F.T
""",
        # the spread from the sums
        """
def line_covariance(points, sigma, weights=None):
    x, y = np.transpose(points)
    alpha = fit_line(points).alpha
    ca, sa = np.cos(alpha), np.sin(alpha)
    C = np.cov(x, y, bias=True) * len(x)
    B = sa ** 2 * C[0, 0] - 2 * sa * ca * C[0, 1] + ca ** 2 * C[1, 1]
    t = y.mean() * ca - x.mean() * sa
    var_alpha = sigma ** 2 / B
    cov = t * var_alpha
    var_r = sigma ** 2 / len(x) + t * cov
    return np.array([[var_r, cov], [cov, var_alpha]])
""",
    ],
}

SLIPS = {
    "Q2.3": [
        (
            "the minimum, not any stationary angle",
            0,
            "math.atan2(-2 * S_xy, S_yy - S_xx)",
            "math.atan(-2 * S_xy / (S_yy - S_xx))",
        ),
        (
            "the minimum, not the maximum",
            0,
            "math.atan2(-2 * S_xy, S_yy - S_xx)",
            "math.atan2(2 * S_xy, S_xx - S_yy)",
        ),
        ("the sign of S_xy", 0, "atan2(-2 * S_xy", "atan2(2 * S_xy"),
        ("twice S_xy", 0, "atan2(-2 * S_xy", "atan2(-S_xy"),
        ("half the angle", 0, "alpha = 0.5 * math", "alpha = math"),
        (
            "r is not negative",
            0,
            "    if r < 0:\n        r = -r\n        alpha = alpha + math.pi\n",
            "",
        ),
        ("the normal turns with r", 0, "        alpha = alpha + math.pi\n", ""),
        ("turned, not mirrored", 0, "alpha = alpha + math.pi\n", "alpha = -alpha\n"),
        (
            "alpha at most pi",
            0,
            "    if alpha > math.pi:\n        alpha = alpha - 2 * math.pi\n",
            "",
        ),
        (
            "alpha above -pi, not from 0 to 2 pi",
            0,
            "    if alpha > math.pi:\n        alpha = alpha - 2 * math.pi\n",
            "    alpha = alpha % (2 * math.pi)\n",
        ),
        ("radians", 0, "Line(r, alpha)", "Line(r, math.degrees(alpha))"),
        ("r first", 0, "Line(r, alpha)", "Line(alpha, r)"),
        ("weights count", 0, "if weights is None else np.asarray(weights, dtype=float)", ""),
        (
            "weights count in the sums",
            0,
            "(w * dx * dx).sum(), (w * dy * dy).sum(), (w * dx * dy).sum()",
            "(dx * dx).sum(), (dy * dy).sum(), (dx * dy).sum()",
        ),
        (
            "weights count in the centre",
            0,
            "(w * x).sum() / w.sum()",
            "x.mean()",
            "(w * y).sum() / w.sum()",
            "y.mean()",
        ),
        ("the weight itself, not its square", 0, "    x, y =", "    w = w ** 2\n    x, y ="),
        ("the weight itself, not its root", 0, "    x, y =", "    w = np.sqrt(w)\n    x, y ="),
        (
            "the weight, not its inverse",
            0,
            "    x, y =",
            "    w = 1 / np.maximum(w, 1e-9)\n    x, y =",
        ),
        (
            "weights need not be whole",
            0,
            "np.asarray(weights, dtype=float)",
            "np.asarray(weights).astype(int)",
        ),
        (
            "all weights, as small as they are",
            0,
            "np.asarray(weights, dtype=float)",
            "(np.asarray(weights) > 0) * 1.0",
        ),
        (
            "the mean, not the median",
            0,
            "(w * x).sum() / w.sum()",
            "np.median(x)",
            "(w * y).sum() / w.sum()",
            "np.median(y)",
        ),
        ("centred sums", 0, "dx, dy = x - x_c, y - y_c", "dx, dy = x, y"),
        (
            "exact far from the origin",
            0,
            "(w * dx * dx).sum(), (w * dy * dy).sum(), (w * dx * dy).sum()",
            "(w * x * x).sum() - w.sum() * x_c**2, (w * y * y).sum() - w.sum() * y_c**2, (w * x * y).sum() - w.sum() * x_c * y_c",
        ),
        (
            "exact far from the origin",
            0,
            "x, y = points[:, 0], points[:, 1]",
            "x, y = np.float32(points).T",
        ),
        (
            "a single point raises",
            0,
            '    if len(points) < 2:\n        raise ValueError("two points are needed")\n',
            "    if len(points) < 2:\n        return Line(math.hypot(*points[0]), math.atan2(points[0, 1], points[0, 0]))\n",
        ),
        (
            "equal points and a round cloud raise",
            0,
            '    if math.hypot(S_yy - S_xx, 2 * S_xy) <= 1e-9 * (S_xx + S_yy):\n        raise ValueError("no direction is better than another")\n',
            "",
        ),
        (
            "a round cloud raises",
            1,
            '    if s[0] - s[1] < 1e-7 * s[0]:\n        raise ValueError("the cloud is round")\n',
            "",
        ),
        (
            "a round cloud raises",
            2,
            '    if np.isclose(values[0], values[1], rtol=1e-8, atol=0):\n        raise ValueError("no direction")\n',
            "",
        ),
        ("a small cloud has a line", 0, "<= 1e-9 * (S_xx + S_yy)", "<= 1e-2"),
        ("a cloud that is nearly round has a line", 0, "1e-9", "0.3"),
        ("two points are enough", 0, "len(points) < 2", "len(points) < 3"),
        ("a ValueError, no other", 0, 'raise ValueError("no', 'raise ZeroDivisionError("no'),
        ("an error is raised, not returned", 0, 'raise ValueError("no', 'return ValueError("no'),
        (
            "nothing instead of an error",
            0,
            'raise ValueError("no direction is better than another")',
            "return None",
        ),
        ("the points stay as they are", 2, "np.array(points, dtype=float)", "np.asarray(points)"),
        (
            "the weights stay as they are",
            2,
            "np.array(weights, dtype=float)",
            "np.asarray(weights)",
        ),
        ("the normal of least spread", 2, "vectors[:, 0]", "vectors[:, 1]"),
        ("eigenvectors are columns", 2, "vectors[:, 0]", "vectors[1]"),
        ("a normal, not the direction", 1, "n = vt[1]", "n = vt[0]"),
        ("roots of weights in the matrix of points", 1, "np.sqrt(w)[:, None] * ", "w[:, None] * "),
        ("atan2 takes y first", 1, "np.arctan2(n[1], n[0])", "np.arctan2(n[0], n[1])"),
        ("both quadrants", 1, "np.arctan2(n[1], n[0])", "np.arctan(n[1] / n[0])"),
        ("least cost", 4, "min(first, second, key=cost)", "max(first, second, key=cost)"),
        ("both stationary angles are compared", 4, "min(first, second, key=cost)", "first"),
        (
            "S_yy = S_xx is a line at 45 degrees",
            4,
            "math.pi / 4 if sxx == syy else ",
            "0.0 if sxx == syy else ",
        ),
    ],
    "Q2.4": [
        ("sigma is squared", 0, "sigma ** 2", "sigma"),
        ("sigma counts", 0, "sigma ** 2", "0.01"),
        ("sigma comes in once", 0, "sigma ** 2", "sigma ** 4"),
        ("sigma, not half of it", 0, "sigma ** 2", "sigma ** 2 / 2"),
        ("1/N", 0, "1 / len(points)", "1 / (len(points) - 1)"),
        ("1/N", 0, "1 / len(points) + ", ""),
        ("1/N", 0, "1 / len(points)", "1"),
        ("t is squared", 0, "t ** 2 / B", "t / B"),
        (
            "t is positive to the left",
            0,
            "[-np.sin(alpha), np.cos(alpha)]",
            "[np.sin(alpha), -np.cos(alpha)]",
        ),
        (
            "along the wall, not across",
            0,
            "[-np.sin(alpha), np.cos(alpha)]",
            "[np.cos(alpha), np.sin(alpha)]",
        ),
        (
            "sine and cosine in their places",
            0,
            "[-np.sin(alpha), np.cos(alpha)]",
            "[np.cos(alpha), -np.sin(alpha)]",
        ),
        (
            "the turn is to the left",
            0,
            "[-np.sin(alpha), np.cos(alpha)]",
            "[np.sin(alpha), np.cos(alpha)]",
        ),
        ("b is measured from the centre", 0, "((s - t) ** 2)", "(s ** 2)"),
        ("B is a sum, not a mean", 0, "((s - t) ** 2).sum()", "((s - t) ** 2).mean()"),
        ("B is a sum of squares", 0, "((s - t) ** 2).sum()", "np.abs(s - t).sum()"),
        ("B is not squared", 0, "((s - t) ** 2).sum()", "((s - t) ** 2).sum() ** 2"),
        ("B is not the length", 0, "((s - t) ** 2).sum()", "np.ptp(s) ** 2"),
        (
            "t is not r",
            0,
            "    B =",
            "    B =",
            "t ** 2 / B, t / B], [t / B",
            "r ** 2 / B, r / B], [r / B",
        ),
        ("t is measured from the foot", 0, "    return", "    t = 0\n    return"),
        (
            "t is the centre's place, not the first point's",
            0,
            "    return",
            "    t = s[0]\n    return",
        ),
        ("the mean, not the median", 0, "s.mean()", "np.median(s)"),
        ("the covariance has t's sign", 0, ", t / B], [t / B, ", ", -t / B], [-t / B, "),
        ("the covariance is not 0", 0, ", t / B], [t / B, ", ", 0], [0, "),
        ("the covariance is not symmetric otherwise", 0, ", t / B], [t / B, ", ", t / B], [0, "),
        (
            "r first",
            0,
            "[[1 / len(points) + t ** 2 / B, t / B], [t / B, 1 / B]]",
            "[[1 / B, t / B], [t / B, 1 / len(points) + t ** 2 / B]]",
        ),
        (
            "variances, not standard deviations",
            5,
            "F @ at_center @ F.T",
            "np.sqrt(np.abs(F @ at_center @ F.T))",
        ),
        ("a 2 × 2 array", 5, "F @ at_center @ F.T", "np.diag(F @ at_center @ F.T)"),
        ("F, then its transpose", 5, "F @ at_center @ F.T", "F.T @ at_center @ F"),
        ("not a correlation", 5, "F @ at_center @ F.T", "np.corrcoef(F @ at_center @ F.T)"),
        ("the inverse", 1, "np.linalg.inv(A.T @ A)", "(A.T @ A)"),
        ("the turn lowers s", 1, ", -s]", ", s]"),
        (
            "radians squared",
            2,
            "d_alpha = b / np.sum(b ** 2)",
            "d_alpha = np.degrees(b / np.sum(b ** 2))",
        ),
        ("a var with N", 4, "turned.imag.var()", "turned.imag.var(ddof=1)"),
    ],
}
