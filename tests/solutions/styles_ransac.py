"""Right functions of chapter 3 in many styles, and slips that make them wrong, as in chapter 1."""

# ruff: noqa: E501 (students' lines are as long as they are)

STYLES = {
    "Q3.3": [
        """
def required_iterations(p, w, s):
    if p <= 0 or p >= 1:
        raise ValueError("p lies between 0 and 1")
    if w < 0 or w > 1:
        raise ValueError("w lies between 0 and 1")
    if w == 0:
        return math.inf
    if w == 1:
        return 1
    return math.ceil(math.log1p(-p) / math.log1p(-(w ** s)))
""",
        # the smallest number by halving
        """
def required_iterations(p, w, s):
    if not 0 < p < 1 or not 0 <= w <= 1:
        raise ValueError("out of range")
    if w == 0:
        raise ValueError("no number is enough")
    if w == 1:
        return 1
    one = math.log1p(-(w ** s))
    goal = math.log1p(-p)
    high = 1
    while high * one > goal:
        high *= 2
    low = high // 2
    while high - low > 1:
        middle = (low + high) // 2
        if middle * one > goal:
            low = middle
        else:
            high = middle
    return high
""",
        # NumPy
        """
def required_iterations(p, w, s):
    if not (0 < p < 1 and 0 <= w <= 1):
        raise ValueError(f"p = {p}, w = {w}")
    with np.errstate(divide="ignore"):
        k = np.log(1 - p) / np.log1p(-np.power(float(w), s))
    return np.inf if w == 0 else max(1, int(np.ceil(k)))
""",
        # many digits
        """
def required_iterations(p, w, s):
    for share in (p, w):
        if share < 0 or share > 1:
            raise ValueError("a share")
    if p == 0 or p == 1:
        raise ValueError("p")
    if w == 0:
        return float("inf")
    if w == 1:
        return 1
    p, w = sp.Rational(p), sp.Rational(w)
    k = (sp.log(1 - p) / sp.log(1 - w ** s)).evalf(60)
    return int(sp.ceiling(k))
""",
        # a series where the share is tiny
        """
def required_iterations(p, w, s):
    if p >= 1 or p <= 0 or w > 1 or w < 0:
        raise ValueError("p or w is out of range")
    good = w ** s
    if good == 1:
        return 1
    if good == 0:
        return math.inf
    log_bad = math.log(1 - good) if good > 1e-3 else -sum(good ** n / n for n in range(1, 9))
    return math.ceil(math.log(1 - p) / log_bad)
""",
        # trying small numbers, the formula for large ones
        """
def required_iterations(p, w, s):
    if p <= 0 or 1 <= p or w < 0 or 1 < w:
        raise ValueError
    if w == 0:
        return math.inf
    bad = 1 - w ** s
    if w > 0.1 and s < 4:
        k, fails = 1, bad
        while fails > 1 - p:
            fails *= bad
            k += 1
        return k
    return 1 if w == 1 else -int(math.log1p(-p) // -math.log1p(-(w ** s)))
""",
    ],
    "Q3.4": [
        """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        pair = rng.choice(len(points), size=2, replace=False)
        a, b = points[pair]
        if (a == b).all():
            continue
        line = fit_line(points[pair])
        agreeing = np.flatnonzero(np.abs(distances(points, line)) <= threshold)
        if len(agreeing) > len(best):
            best = agreeing
    if len(best) == 0:
        raise ValueError("no sample gave a line")
    return fit_line(points[best]), best
""",
        # a line from two points by hand; the indices of the last line
        """
def ransac_line(points, threshold, iterations, rng):
    best_count, best_inliers = 0, None
    for i in range(iterations):
        i, j = rng.choice(len(points), 2, replace=False)
        dx, dy = points[j] - points[i]
        length = math.hypot(dx, dy)
        if length == 0:
            continue
        d = ((points[:, 0] - points[i, 0]) * dy - (points[:, 1] - points[i, 1]) * dx) / length
        inliers = abs(d) <= threshold
        if inliers.sum() > best_count:
            best_count, best_inliers = inliers.sum(), inliers
    if best_inliers is None:
        raise ValueError("no line found")
    line = fit_line(points[best_inliers])
    return line, np.where(abs(distances(points, line)) <= threshold)[0]
""",
        # all hypotheses at once
        """
def ransac_line(points, threshold, iterations, rng):
    pairs = np.array([rng.permutation(len(points))[:2] for _ in range(iterations)], dtype=int).reshape(-1, 2)
    a, b = points[pairs[:, 0]], points[pairs[:, 1]]
    keep = np.any(a != b, axis=1)
    if not keep.any():
        raise ValueError("nothing but equal points")
    a, d = a[keep], (b - a)[keep]
    n = np.column_stack([-d[:, 1], d[:, 0]]) / np.linalg.norm(d, axis=1)[:, None]
    agree = np.abs(n @ points.T - (n * a).sum(axis=1)[:, None]) <= threshold
    best = np.flatnonzero(agree[agree.sum(axis=1).argmax()])
    return fit_line(points[best]), best
""",
        # another sample in place of one without a line
        """
def ransac_line(points, threshold, iterations, rng):
    if iterations < 1 or len(points) < 2 or np.all(points == points[0]):
        raise ValueError("no line")
    best = []
    for _ in range(iterations):
        while True:
            i = rng.integers(len(points))
            j = rng.integers(len(points) - 1)
            if j >= i:
                j += 1
            if np.any(points[i] != points[j]):
                break
        line = fit_line(points[[i, j]])
        inliers = [k for k, d in enumerate(distances(points, line)) if -threshold <= d <= threshold]
        if len(inliers) > len(best):
            best = inliers
    return fit_line(points[best]), best
""",
        # the last fit by eigenvectors
        """
def ransac_line(points, threshold, iterations, rng):
    winners = np.zeros(len(points), dtype=bool)
    for _ in range(iterations):
        p, q = rng.choice(points, size=2, replace=False, axis=0)
        normal = np.array([p[1] - q[1], q[0] - p[0]])
        if not normal.any():
            continue
        normal = normal / np.linalg.norm(normal)
        inside = np.abs((points - p) @ normal) <= threshold
        if np.count_nonzero(inside) > np.count_nonzero(winners):
            winners = inside
    if not winners.any():
        raise ValueError("no sample gave a line")
    center = points[winners].mean(axis=0)
    _, vectors = np.linalg.eigh(np.cov(points[winners].T))
    normal = vectors[:, 0]
    r = center @ normal
    if r < 0:
        r, normal = -r, -normal
    return Line(r, math.atan2(normal[1], normal[0])), np.nonzero(winners)[0]
""",
        # candidates kept in a list, the largest at the end
        """
def ransac_line(points, threshold, iterations, rng):
    def consensus(line):
        return np.flatnonzero(distances(points, line) ** 2 <= threshold ** 2)
    candidates = []
    indices = list(range(len(points)))
    for _ in range(iterations):
        rng.shuffle(indices)
        pair = points[indices[:2]]
        if not np.array_equal(pair[0], pair[1]):
            candidates.append(consensus(fit_line(pair)))
    if not candidates:
        raise ValueError("no candidates")
    inliers = max(candidates, key=len)
    line = fit_line(points[inliers])
    return line, consensus(line)
""",
    ],
    "Q3.5": [
        """
def ransac_plane(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        triple = rng.choice(len(points), size=3, replace=False)
        a, b, c = points[triple]
        if np.linalg.norm(np.cross(b - a, c - a)) < 1e-12:
            continue
        plane = fit_plane(points[triple])
        agreeing = np.flatnonzero(np.abs(plane_distances(points, plane)) <= threshold)
        if len(agreeing) > len(best):
            best = agreeing
    if len(best) == 0:
        raise ValueError("no sample gave a plane")
    return fit_plane(points[best]), best
""",
        # cross products; the points within the threshold of the last plane
        """
def ransac_plane(points, threshold, iterations, rng):
    most, mask = 0, None
    for _ in range(iterations):
        a, b, c = points[rng.choice(len(points), 3, replace=False)]
        n = np.cross(b - a, c - a)
        size = np.linalg.norm(n)
        if size <= 1e-10 * np.linalg.norm(b - a) * np.linalg.norm(c - a):
            continue
        n /= size
        close = abs((points - a) @ n) <= threshold
        if close.sum() > most:
            most, mask = close.sum(), close
    if mask is None:
        raise ValueError("all on one line")
    plane = fit_plane(points[mask])
    return plane, np.flatnonzero(abs(plane_distances(points, plane)) <= threshold)
""",
        # rank
        """
def ransac_plane(points, threshold, iterations, rng):
    best = None
    for _ in range(iterations):
        sample = rng.permutation(points)[:3]
        if np.linalg.matrix_rank(sample[1:] - sample[0], tol=1e-9) < 2:
            continue
        inliers = [i for i, d in enumerate(plane_distances(points, fit_plane(sample))) if abs(d) <= threshold]
        if best is None or len(inliers) > len(best):
            best = inliers
    if best is None:
        raise ValueError("no plane")
    return fit_plane(points[best]), np.array(best)
""",
        # all hypotheses at once
        """
def ransac_plane(points, threshold, iterations, rng):
    if iterations < 1:
        raise ValueError("no sample")
    triples = np.stack([rng.choice(len(points), 3, replace=False) for _ in range(iterations)])
    a, b, c = points[triples[:, 0]], points[triples[:, 1]], points[triples[:, 2]]
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    good = lengths > 1e-12
    if not good.any():
        raise ValueError("points on one line")
    normals = normals[good] / lengths[good, None]
    offsets = np.einsum("ij,ij->i", normals, a[good])
    agree = np.abs(normals @ points.T - offsets[:, None]) <= threshold
    inliers = np.flatnonzero(agree[np.argmax(agree.sum(1))])
    return fit_plane(points[inliers]), inliers
""",
        # eigenvectors for the last fit
        """
def ransac_plane(points, threshold, iterations, rng):
    best = set()
    for _ in range(iterations):
        i, j, k = rng.choice(np.arange(len(points)), size=3, replace=False)
        u, v = points[j] - points[i], points[k] - points[i]
        n = np.array([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])
        norm = math.sqrt(n @ n)
        if norm < 1e-12:
            continue
        found = {m for m, p in enumerate(points) if abs((p - points[i]) @ n) <= threshold * norm}
        if len(found) > len(best):
            best = found
    if not best:
        raise ValueError("no plane")
    index = sorted(best)
    center = points[index].mean(axis=0)
    _, vectors = np.linalg.eigh((points[index] - center).T @ (points[index] - center))
    normal = vectors[:, 0]
    r = normal @ center
    if r < 0:
        normal, r = -normal, -r
    return Plane(tuple(normal), r), index
""",
        # another sample in place of one without a plane
        """
def ransac_plane(points, threshold, iterations, rng):
    tried, best = 0, np.array([], int)
    for _ in range(20 * iterations):
        if tried == iterations:
            break
        triple = points[rng.choice(len(points), size=3, replace=False)]
        if np.linalg.svd(triple - triple.mean(axis=0), compute_uv=False)[1] < 1e-9:
            continue
        tried += 1
        off = plane_distances(points, fit_plane(triple))
        inliers = np.where((off >= -threshold) & (off <= threshold))[0]
        best = inliers if inliers.size > best.size else best
    if tried == 0:
        raise ValueError("no plane")
    return fit_plane(points[best]), best
""",
    ],
    "Q3.6": [
        """
def find_walls(points, threshold, iterations, min_points, rng):
    walls = []
    left = np.arange(len(points))
    while len(left) >= min_points:
        line, inliers = ransac_line(points[left], threshold, iterations, rng)
        if len(inliers) < min_points:
            break
        walls.append((line, left[inliers]))
        left = np.delete(left, inliers)
    return walls
""",
        # a mask, and an end where no line is left
        """
def find_walls(points, threshold, iterations, min_points, rng):
    free = np.ones(len(points), dtype=bool)
    walls = []
    while True:
        index = np.flatnonzero(free)
        if len(index) < max(min_points, 2):
            return walls
        try:
            line, inliers = ransac_line(points[index], threshold, iterations, rng)
        except ValueError:
            return walls
        if len(inliers) < min_points:
            return walls
        free[index[inliers]] = False
        walls.append((line, index[inliers]))
""",
        # one wall, then the rest
        """
def find_walls(points, threshold, iterations, min_points, rng):
    def among(left):
        if len(left) < min_points or len(left) < 2:
            return []
        line, inliers = ransac_line(points[left], threshold, iterations, rng)
        if len(inliers) < min_points:
            return []
        wall = left[inliers]
        return [(line, wall)] + among(np.setdiff1d(left, wall))
    return among(np.arange(len(points)))
""",
        # lists
        """
def find_walls(points, threshold, iterations, min_points, rng):
    left = list(range(len(points)))
    result = []
    while len(left) > 1 and len(left) >= min_points:
        line, found = ransac_line(points[left], threshold, iterations, rng)
        wall = [left[i] for i in found]
        if len(wall) < min_points:
            break
        result.append((line, wall))
        left = [i for i in left if i not in set(wall)]
    return result
""",
        # points with their numbers beside them
        """
def find_walls(points, threshold, iterations, min_points, rng):
    table = np.column_stack([points, np.arange(len(points))])
    walls = []
    for _ in range(len(points)):
        if len(table) < min_points or len(table) < 2:
            break
        line, inliers = ransac_line(table[:, :2], threshold, iterations, rng)
        if not len(inliers) >= min_points:
            break
        walls += [(line, table[inliers, 2].astype(int))]
        keep = np.ones(len(table), bool)
        keep[inliers] = False
        table = table[keep]
    return walls
""",
        # labels
        """
def find_walls(points, threshold, iterations, min_points, rng):
    label = np.full(len(points), -1)
    lines = []
    while np.sum(label == -1) >= min_points:
        left = np.where(label == -1)[0]
        line, inliers = ransac_line(points[left], threshold, iterations, rng)
        if len(inliers) < min_points:
            break
        label[left[inliers]] = len(lines)
        lines.append(line)
    return [(line, np.where(label == number)[0]) for number, line in enumerate(lines)]
""",
    ],
    "Q3.7a": [
        """
def adaptive_stop(agreeing, N, p):
    best = 0
    for drawn, count in enumerate(agreeing, start=1):
        best = max(best, count)
        if drawn >= required_iterations(p, best / N, 2):
            return drawn
    return len(agreeing)
""",
        """
def adaptive_stop(agreeing, N, p):
    best = np.maximum.accumulate(agreeing)
    required = np.array([required_iterations(p, b / N, 2) for b in best])
    enough = np.flatnonzero(np.arange(1, len(best) + 1) >= required)
    return int(enough[0]) + 1 if len(enough) else len(agreeing)
""",
        """
def adaptive_stop(agreeing, N, p):
    k, i, best = math.inf, 0, 0
    while i < k and i < len(agreeing):
        if agreeing[i] > best:
            best = agreeing[i]
            k = required_iterations(p, best / N, 2)
        i += 1
    return i
""",
        """
def adaptive_stop(agreeing, N, p):
    return next((k for k in range(1, len(agreeing)) if k >= required_iterations(p, max(agreeing[:k]) / N, 2)), len(agreeing))
""",
        """
from itertools import accumulate
def adaptive_stop(agreeing, N, p):
    n = 0
    for best in accumulate(agreeing, max):
        n += 1
        if required_iterations(p, float(best) / N, 2) <= n:
            break
    return n
""",
        """
def adaptive_stop(agreeing, N, p):
    w = 0
    for n in range(len(agreeing)):
        w = max(w, agreeing[n] / N)
        if w >= 1 or n + 1 >= required_iterations(p, w, 2):
            return np.int64(n + 1)
    return np.int64(len(agreeing))
""",
    ],
    "Q3.7b": [
        """
def msac_cost(offsets, threshold):
    return float(np.minimum(offsets ** 2, threshold ** 2).sum())
""",
        """
def msac_cost(offsets, threshold):
    return np.where(np.abs(offsets) <= threshold, offsets ** 2, threshold ** 2).sum()
""",
        """
def msac_cost(offsets, threshold):
    cost = 0
    for d in offsets:
        cost += d * d if -threshold <= d <= threshold else threshold * threshold
    return cost
""",
        """
def msac_cost(offsets, threshold):
    capped = np.clip(offsets, -threshold, threshold)
    return capped @ capped
""",
        """
def msac_cost(offsets, threshold):
    inside = np.abs(offsets) < threshold
    return np.sum(offsets[inside] ** 2) + np.count_nonzero(~inside) * threshold ** 2
""",
        """
def msac_cost(offsets, threshold):
    return math.fsum(min(abs(float(d)), threshold) ** 2 for d in offsets)
""",
        """
def msac_cost(offsets, threshold):
    squares = np.sort(offsets ** 2)
    inside = np.searchsorted(squares, threshold ** 2)
    return squares[:inside].sum() + (len(squares) - inside) * threshold ** 2
""",
    ],
}

_LOOP_SLIPS = [
    ("on either side", "np.abs(distances(points, line))", "distances(points, line)"),
    (
        "the distance, not its square",
        "np.abs(distances(points, line))",
        "distances(points, line) ** 2",
    ),
    ("the threshold, not half of it", "<= threshold", "<= threshold / 2"),
    ("the threshold, not twice", "<= threshold", "<= 2 * threshold"),
    ("the threshold, not its square", "<= threshold", "<= threshold ** 2"),
    ("the threshold, not its root", "<= threshold", "<= threshold ** 0.5"),
    ("any threshold", "<= threshold", "<= 0.1"),
    ("any threshold", "<= threshold", "<= 0.2"),
    ("near, not far", "<= threshold", ">= threshold"),
    ("as many iterations as wanted", "range(iterations)", "range(100)"),
    ("as many iterations as wanted", "range(iterations)", "range(min(iterations, 10))"),
    ("as many iterations as wanted", "range(iterations)", "range(iterations - 1)"),
    ("as many iterations as wanted", "range(iterations)", "range(iterations + 1)"),
    ("as many iterations as wanted", "range(iterations)", "range(10 * iterations)"),
    ("as many iterations as wanted", "range(iterations)", "range(iterations // 2)"),
    (
        "one iteration is allowed",
        "    best = np",
        "    if iterations < 2:\n        raise ValueError\n    best = np",
    ),
    ("the largest set", "len(agreeing) > len(best)", "len(agreeing) < len(best) or not len(best)"),
    ("the largest set, not the last", "if len(agreeing) > len(best):", "if True:"),
    (
        "the largest set, not the first",
        "            best = agreeing\n",
        "            best = agreeing\n            break\n",
    ),
    (
        "the drawing goes on",
        "            best = agreeing\n",
        "            best = agreeing\n        if len(best) > len(points) / 2:\n            break\n",
    ),
    ("drawn with rng", "rng.choice", "np.random.default_rng(0).choice"),
    ("drawn with rng", "rng.choice", "np.random.choice"),
    (
        "drawn at random",
        "rng.choice(len(points), size={size}, replace=False)",
        "np.arange({size}) + _ % (len(points) - {size} + 1)",
    ),
    ("drawn from all points", "rng.choice(len(points)", "rng.choice(min(len(points), 20)"),
]


def _slips(size: int, fit: str, model: str, off: str) -> list[tuple]:
    """Slips of the loop that both questions ask for, in the first style of each."""
    made = []
    for what, *pairs in _LOOP_SLIPS:
        pairs = [text.replace("{size}", str(size)) for text in pairs]
        pairs = [
            text.replace("distances(points, line)", f"{off}(points, {model})") for text in pairs
        ]
        made.append((what, 0, *pairs))
    kept = f"            best = agreeing\n            kept = {model}\n"
    return [
        *made,
        (
            "fitted again",
            0,
            "            best = agreeing\n",
            kept,
            f"return {fit}(points[best])",
            "return kept",
        ),
        (
            "fitted to the set, not to all points",
            0,
            f"{fit}(points[best]), best",
            f"{fit}(points), best",
        ),
        ("the best, not the last model", 0, f"return {fit}(points[best])", f"return {model}"),
        ("indices, not a mask", 0, ", best\n", ", np.isin(np.arange(len(points)), best)\n"),
        ("indices, not the points", 0, ", best\n", ", points[best]\n"),
        ("indices, not their number", 0, ", best\n", ", len(best)\n"),
        ("the indices as well", 0, ", best\n", "\n"),
        (
            "the model first",
            0,
            f"return {fit}(points[best]), best",
            f"return best, {fit}(points[best])",
        ),
        ("indices count from 0", 0, ", best\n", ", best + 1\n"),
        (
            "an error if no sample gave a model",
            0,
            "        raise ValueError",
            "        return None, best\n        raise ValueError",
        ),
        ("a ValueError", 0, "        raise ValueError(", "        raise RuntimeError("),
    ]


SLIPS = {
    "Q3.3": [
        ("rounded up", 0, "math.ceil", "round"),
        ("rounded up", 0, "math.ceil", "math.floor"),
        ("rounded up", 0, "math.ceil", ""),
        ("one more only where it is needed", 0, "math.ceil(", "1 + int("),
        ("rounded up once", 0, "math.ceil(", "1 + math.ceil("),
        ("right where w**s is small", 0, "math.log1p(-(w ** s))", "math.log(1 - w ** s)"),
        (
            "right where w**s is small",
            0,
            "math.log1p(-(w ** s))",
            "(math.log(1 - w ** s) or -1e-16)",
        ),
        ("the sample's size counts", 0, "w ** s", "w ** 2"),
        ("the sample's size counts", 0, "w ** s", "w"),
        ("w to the power s", 0, "w ** s", "w * s / (s + 1)"),
        ("a share of inliers, not of outliers", 0, "-(w ** s)", "-((1 - w) ** s)"),
        ("p is the success", 0, "math.log1p(-p)", "math.log(p)"),
        ("p counts", 0, "math.log1p(-p)", "math.log1p(-0.99)"),
        ("w counts", 0, "w ** s", "0.5 ** s"),
        ("for w = 1 one is enough", 0, "    if w == 1:\n        return 1\n", ""),
        ("for w = 1 one is enough", 0, "        return 1\n", "        return 0\n"),
        ("for w = 1 one is enough", 0, "        return 1\n", "        return math.inf\n"),
        ("w = 1 is in range", 0, "w > 1", "w >= 1"),
        ("for w = 0 no number is enough", 0, "        return math.inf\n", "        return 0\n"),
        ("for w = 0 no number is enough", 0, "        return math.inf\n", "        return -1\n"),
        ("for w = 0 a ValueError or infinity", 0, "    if w == 0:\n        return math.inf\n", ""),
        (
            "for w = 0 no number is enough",
            0,
            "        return math.inf\n",
            "        return 10 ** 9\n",
        ),
        (
            "p out of range",
            0,
            '    if p <= 0 or p >= 1:\n        raise ValueError("p lies between 0 and 1")\n',
            "",
        ),
        ("p above 0", 0, "p <= 0", "p < 0"),
        ("p above 0", 0, "p <= 0 or p >= 1", "p >= 1"),
        ("p below 1", 2, "0 < p < 1", "0 < p <= 1"),
        ("w not negative", 0, "w < 0 or w > 1", "w > 1"),
        ("w at most 1", 0, "w < 0 or w > 1", "w < 0", "w == 1", "w >= 1"),
        (
            "a ValueError for w",
            0,
            '        raise ValueError("w',
            '        return math.inf\n        raise ValueError("w',
        ),
        (
            "a ValueError, no AssertionError",
            0,
            '    if p <= 0 or p >= 1:\n        raise ValueError("p lies between 0 and 1")\n',
            "    assert 0 < p < 1\n",
        ),
        (
            "a very large number is right as well",
            0,
            "return math.ceil(math.log1p(-p) / math.log1p(-(w ** s)))",
            "return min(math.ceil(math.log1p(-p) / math.log1p(-(w ** s))), 10 ** 6)",
        ),
        (
            "a very large number is right as well",
            0,
            "return math.ceil(math.log1p(-p) / math.log1p(-(w ** s)))",
            "return min(math.ceil(math.log1p(-p) / math.log1p(-(w ** s))), 2 ** 31 - 1)",
        ),
        (
            "small where the share is large",
            4,
            "if good > 1e-3 else -sum(good ** n / n for n in range(1, 9))",
            "if good > 2 else -good",
        ),
    ],
    "Q3.4": [
        *_slips(2, "fit_line", "line", "distances"),
        (
            "a sample of two",
            0,
            "size=2",
            "size=3",
            "a, b = points[pair]",
            "a, b = points[pair[:2]]",
        ),
        ("distance to the line, not along y", 1, "/ length", "/ abs(dx or 1e-12)"),
        ("a distance in metres", 1, "/ length", ""),
        (
            "the same band for each hypothesis as in the end",
            1,
            "<= threshold\n        if",
            "<= threshold / 2\n        if",
        ),
        (
            "the same band for each hypothesis as in the end",
            1,
            "<= threshold\n        if",
            "<= threshold / 3\n        if",
        ),
        (
            "the same band for each hypothesis as in the end",
            1,
            "<= threshold\n        if",
            "<= 2 * threshold\n        if",
        ),
        (
            "no line if all points are equal",
            0,
            "        if (a == b).all():\n            continue\n",
            "",
        ),
        ("no iteration gives no line", 3, "iterations < 1 or ", ""),
        (
            "equal points give no line",
            3,
            'if iterations < 1 or len(points) < 2 or np.all(points == points[0]):\n        raise ValueError("no line")',
            "if iterations < 1 or len(points) < 2 or np.all(points == points[0]):\n        return Line(0.0, 0.0), []",
        ),
        ("r is not negative", 4, "    if r < 0:\n        r, normal = -r, -normal\n", ""),
        ("the normal, not the direction", 4, "vectors[:, 0]", "vectors[:, 1]"),
        ("the largest set", 2, "argmax()", "argmin()"),
        ("the largest set", 5, "max(candidates, key=len)", "candidates[-1]"),
        ("the largest set", 5, "max(candidates, key=len)", "max(candidates, key=np.sum)"),
        (
            "one set, not all of them",
            5,
            "max(candidates, key=len)",
            "np.unique(np.concatenate(candidates))",
        ),
        ("the points agree, not the sample", 0, "best = agreeing\n", "best = pair\n"),
        (
            "least distance to all points is another thing",
            0,
            "if len(agreeing) > len(best):",
            "cost = np.abs(distances(points, line)).sum()\n        if _ == 0 or cost < least:\n            least = cost",
        ),
    ],
    "Q3.5": [
        *_slips(3, "fit_plane", "plane", "plane_distances"),
        (
            "three points on one line give no plane",
            0,
            "        if np.linalg.norm(np.cross(b - a, c - a)) < 1e-12:\n            continue\n",
            "",
        ),
        ("a unit normal", 1, "        n /= size\n", ""),
        ("a unit normal: the length, not its square", 1, "n /= size\n", "n /= size ** 2\n"),
        (
            "the same band for each hypothesis as in the end",
            1,
            "<= threshold\n        if",
            "<= threshold / 3\n        if",
        ),
        (
            "the same band for each hypothesis as in the end",
            1,
            "<= threshold\n        if",
            "<= 2 * threshold\n        if",
        ),
        ("a unit normal: the length, not the area", 1, "n /= size\n", "n /= size / 2\n"),
        (
            "the distance from the plane, not from the point",
            1,
            "abs((points - a) @ n)",
            "np.linalg.norm(points - a, axis=1)",
        ),
        ("the distance from the plane, not from the origin", 1, "(points - a) @ n", "points @ n"),
        (
            "the plane's, not the line's, distance",
            1,
            "np.cross(b - a, c - a)",
            "np.cross(b - a, c - b) + (b - a) * 0.1",
        ),
        ("not the sum of the sides", 1, "np.cross(b - a, c - a)", "(b - a) + (c - a)"),
        ("not the corners themselves", 1, "np.cross(b - a, c - a)", "np.cross(b, c)"),
        ("height is not distance", 1, "n /= size\n", "n /= (n[2] or 1e-12)\n"),
        ("r and the normal belong together", 4, "normal, r = -normal, -r", "r = -r"),
        ("the normal of least spread", 4, "vectors[:, 0]", "vectors[:, 2]"),
        (
            "no plane among points on one line",
            2,
            '    if best is None:\n        raise ValueError("no plane")\n',
            "    if best is None:\n        return fit_plane(points), []\n",
        ),
        (
            "no iteration gives no plane",
            3,
            '        raise ValueError("no sample")',
            "        return fit_plane(points), np.arange(len(points))",
        ),
    ],
    "Q3.6": [
        ("indices are counted in points", 0, "left[inliers]))", "inliers))"),
        ("min_points counts", 0, "        if len(inliers) < min_points:\n            break\n", ""),
        ("min_points counts", 0, "min_points, rng):\n", "min_points, rng):\n    min_points = 2\n"),
        ("min_points counts", 0, "min_points, rng):\n", "min_points, rng):\n    min_points = 10\n"),
        (
            "exactly min_points are enough",
            0,
            "len(inliers) < min_points",
            "len(inliers) <= min_points",
        ),
        (
            "one fewer is not enough",
            0,
            "len(inliers) < min_points",
            "len(inliers) < min_points - 1",
        ),
        (
            "exactly min_points left are enough",
            0,
            "len(left) >= min_points",
            "len(left) > min_points",
        ),
        ("min_points left are enough", 0, "len(left) >= min_points", "len(left) >= 2 * min_points"),
        (
            "min_points left are enough",
            0,
            "len(left) >= min_points",
            "len(left) >= len(points) / 2",
        ),
        (
            "a last wall that is too small is none",
            0,
            "        if len(inliers) < min_points:\n            break\n        walls.append((line, left[inliers]))\n",
            "        walls.append((line, left[inliers]))\n        if len(inliers) < min_points:\n            break\n",
        ),
        ("all walls", 0, "while len(left) >= min_points:", "for _ in range(1):"),
        ("all walls", 0, "while len(left) >= min_points:", "for _ in range(2):"),
        (
            "all walls",
            0,
            "while len(left) >= min_points:",
            "for _ in range(3):\n        if len(left) < min_points:\n            break",
        ),
        (
            "each point in one wall",
            0,
            "        left = np.delete(left, inliers)\n",
            "        left = np.delete(left, inliers[:-1])\n",
        ),
        (
            "each point in one wall",
            0,
            "walls.append((line, left[inliers]))",
            "walls.append((line, np.flatnonzero(np.abs(distances(points, line)) <= threshold)))",
        ),
        ("each point in one wall", 0, "np.delete(left, inliers)", "left[5:]"),
        ("what is found first stands in front", 0, "return walls", "return walls[::-1]"),
        ("the line first", 0, "(line, left[inliers])", "(left[inliers], line)"),
        ("the indices as well", 0, "(line, left[inliers])", "line"),
        ("indices, not points", 0, "(line, left[inliers])", "(line, points[left[inliers]])"),
        (
            "the threshold counts",
            0,
            "threshold, iterations, rng)\n        if",
            "0.1, iterations, rng)\n        if",
        ),
        (
            "the threshold counts",
            0,
            "threshold, iterations, rng)\n        if",
            "threshold / 2, iterations, rng)\n        if",
        ),
        (
            "the threshold counts",
            0,
            "threshold, iterations, rng)\n        if",
            "2 * threshold, iterations, rng)\n        if",
        ),
        (
            "iterations count",
            0,
            "threshold, iterations, rng)\n        if",
            "threshold, 100, rng)\n        if",
        ),
        (
            "iterations count",
            0,
            "threshold, iterations, rng)\n        if",
            "threshold, 10, rng)\n        if",
        ),
        (
            "iterations count",
            0,
            "threshold, iterations, rng)\n        if",
            "threshold, iterations // 2, rng)\n        if",
        ),
        (
            "rng counts",
            0,
            "threshold, iterations, rng)\n        if",
            "threshold, iterations, np.random.default_rng(1))\n        if",
        ),
        (
            "left is translated each time",
            0,
            "walls.append((line, left[inliers]))\n        left = np.delete(left, inliers)",
            "walls.append((line, left[inliers]))\n        left = np.delete(np.arange(len(left)), inliers)",
        ),
        (
            "the points that are left",
            0,
            "ransac_line(points[left]",
            "ransac_line(points[:len(left)]",
        ),
        ("a list of all walls, not the last", 0, "return walls", "return walls[-1:]"),
        ("the walls, not those without the first", 0, "return walls", "return walls[1:]"),
        ("indices count from 0", 0, "left[inliers]))", "left[inliers] + 1))"),
        (
            "indices, not a mask",
            0,
            "left[inliers]))",
            "np.isin(np.arange(len(points)), left[inliers])))",
        ),
    ],
    "Q3.7a": [
        ("the best so far, not the last", 0, "max(best, count)", "count"),
        ("later samples are unknown", 0, "max(best, count)", "max(agreeing)"),
        (
            "the best, not the worst",
            0,
            "best = 0",
            "best = N",
            "max(best, count)",
            "min(best, count)",
        ),
        ("the best, not the first", 0, "max(best, count)", "best or count"),
        ("the best, not the mean", 0, "max(best, count)", "np.mean(agreeing[:drawn])"),
        ("the best, not the median", 0, "max(best, count)", "max(2, np.median(agreeing[:drawn]))"),
        ("as soon as enough are drawn", 0, "drawn >= required", "drawn > required"),
        ("samples are counted from 1", 0, "start=1", "start=0"),
        ("samples are counted from 1", 0, "return drawn", "return drawn - 1"),
        ("one is drawn after the other", 0, "return drawn", "return drawn + 1"),
        (
            "it has drawn more than are required",
            0,
            "return drawn",
            "return required_iterations(p, best / N, 2)",
        ),
        (
            "it never draws more than k",
            0,
            "return len(agreeing)",
            "return required_iterations(p, best / N, 2)",
        ),
        ("it has drawn all k", 0, "return len(agreeing)", "return None"),
        ("it has drawn all k", 0, "return len(agreeing)", "return math.inf"),
        ("it has drawn all k", 0, "return len(agreeing)", "return len(agreeing) - 1"),
        ("it has drawn all k", 0, "return len(agreeing)", "return 0"),
        ("samples of two points", 0, "N, 2)", "N, 1)"),
        ("samples of two points", 0, "N, 2)", "N, 3)"),
        ("p counts", 0, "required_iterations(p", "required_iterations(0.99"),
        ("p counts", 0, "required_iterations(p", "required_iterations(0.95"),
        ("p is not 1 - p", 0, "required_iterations(p", "required_iterations(1 - p"),
        ("N counts", 0, "best / N", "best / 100"),
        ("N is not k", 0, "best / N", "min(1, best / len(agreeing))"),
        ("the share of inliers", 0, "best / N", "1 - best / N"),
        ("the share is not whole", 0, "best / N", "round(best / N, 1)"),
        ("the sample itself agrees", 0, "best / N", "(best - 2) / N"),
        (
            "not all at once",
            0,
            "        if drawn >= required_iterations(p, best / N, 2):\n            return drawn\n    return len(agreeing)\n",
            "    return min(len(agreeing), required_iterations(p, best / N, 2))\n",
        ),
        ("not all samples", 0, "        if drawn", "        if drawn > 1 and drawn"),
        ("the first sample's share is not enough", 2, "if agreeing[i] > best:", "if i == 0:"),
        (
            "the last change counts too",
            2,
            "        i += 1\n    return i\n",
            "        i += 1\n    return min(k, len(agreeing))\n",
        ),
    ],
    "Q3.7b": [
        ("the squared threshold", 0, "threshold ** 2", "threshold"),
        ("the squared distance", 0, "offsets ** 2", "np.abs(offsets)"),
        ("both are squared", 0, "offsets ** 2, threshold ** 2", "np.abs(offsets), threshold"),
        (
            "on either side",
            0,
            "np.minimum(offsets ** 2, threshold ** 2)",
            "(np.minimum(offsets, threshold) ** 2)",
        ),
        ("on either side", 1, "np.abs(offsets)", "offsets"),
        ("capped", 0, "np.minimum(offsets ** 2, threshold ** 2)", "(offsets ** 2)"),
        ("capped from above", 0, "np.minimum", "np.maximum"),
        ("the sum, not the mean", 0, ".sum()", ".mean()"),
        ("the sum, not the largest", 0, ".sum()", ".max(initial=0)"),
        (
            "no points cost 0",
            0,
            "return float",
            "return float(np.nan) if len(offsets) == 0 else float",
        ),
        ("no points cost 0", 0, "return float", "offsets[0]\n    return float"),
        ("a square, not half of it", 0, "return ", "return 0.5 * "),
        ("not its root", 0, "return float(", "return math.sqrt("),
        ("any threshold", 0, "threshold ** 2", "0.3 ** 2"),
        ("any threshold", 0, "threshold ** 2", "0.09"),
        ("a point outside costs too", 1, "offsets ** 2, threshold ** 2)", "offsets ** 2, 0)"),
        (
            "a point outside costs the squared threshold",
            1,
            "offsets ** 2, threshold ** 2)",
            "offsets ** 2, 1)",
        ),
        (
            "a point within costs its squared distance",
            1,
            "offsets ** 2, threshold ** 2)",
            "0, threshold ** 2)",
        ),
        ("points are not counted", 1, "offsets ** 2, threshold ** 2)", "0, 1)"),
        (
            "the distance, not its square, is within",
            1,
            "np.abs(offsets) <= threshold",
            "offsets ** 2 <= threshold",
        ),
        (
            "no matter how far",
            1,
            "offsets ** 2, threshold ** 2)",
            "offsets ** 2, threshold * (2 * np.abs(offsets) - threshold))",
        ),
        ("one number", 1, ".sum()", ""),
        ("not a whole number", 0, "float(", "round("),
        ("a cost, not a gain", 0, "return float", "return -float"),
        ("all points", 2, "in offsets:", "in offsets[1:]:"),
        (
            "the cap comes after squaring",
            3,
            "np.clip(offsets, -threshold, threshold)",
            "np.clip(offsets, 0, threshold)",
        ),
        ("the number of points outside", 4, " * threshold ** 2", " * threshold"),
    ],
}
