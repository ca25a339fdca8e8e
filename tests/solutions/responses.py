"""Right and wrong responses as students write them, beside the variants and the known mistakes.

Each is a cell of code, by the question's id. `RIGHT` must earn everything and `WRONG` less,
whatever the hidden inputs. A function's name does not matter: what a cell defines last counts.
"""

RIGHT = {
    "Q1.3": [
        """
def f(descriptors, words):
    d2 = np.einsum("nkd,nkd->nk", descriptors[:, None] - words, descriptors[:, None] - words)
    return d2.argmin(1).astype(np.uint16)
""",
        """
def f(descriptors, words):
    return np.array([np.argmin([math.dist(x, w) for w in words]) for x in descriptors])
""",
        """
def f(descriptors, words):
    out = np.empty(len(descriptors), dtype=np.int16)
    for i in range(len(descriptors)):
        order = np.argsort(np.sum(np.abs(words - descriptors[i]) ** 2, axis=1), kind="stable")
        out[i] = order[0]
    return out
""",
    ],
    "Q1.4": [
        """
def f(descriptor, levels):
    k, i = levels[0].shape[0], 0
    for level in levels:
        kids = np.split(level, len(level) // k)[i]
        i = i * k + np.argmin([np.dot(c - descriptor, c - descriptor) for c in kids])
    return np.int32(i)
""",
        """
def f(descriptor, levels):
    k = len(levels[0])
    start = 0
    for level in levels:
        d = np.full(len(level), np.inf)
        d[start:start + k] = np.linalg.norm(level[start:start + k] - descriptor, axis=1)
        node = d.argmin()
        start = node * k
    return int(node)
""",
    ],
    "Q1.5": [
        """
def f(words_by_image, word_count):
    file = [np.zeros(0, dtype=int)] * word_count
    for i, words in enumerate(words_by_image):
        for w in np.unique(words):
            file[w] = np.append(file[w], i)
    return file
""",
        """
def f(words_by_image, word_count):
    pairs = sorted({(int(w), i) for i, ws in enumerate(words_by_image) for w in ws})
    return tuple([i for w, i in pairs if w == k] for k in range(word_count))
""",
    ],
    "Q1.6": [
        """
def f(query_words, inverted_file, image_count):
    return [sum(image in inverted_file[w] for w in query_words) for image in range(image_count)]
""",
        """
def f(query_words, inverted_file, image_count):
    votes = dict.fromkeys(range(image_count), 0)
    words, counts = np.unique(query_words, return_counts=True)
    for w, c in zip(words, counts):
        for image in inverted_file[w]:
            votes[image] += int(c)
    return np.array(list(votes.values()))
""",
    ],
    "Q1.7": [
        """
def f(histograms):
    M = histograms.shape[0]
    n = np.sum(histograms.astype(bool), axis=0)
    w = np.zeros(n.shape)
    w[n > 0] = np.log2(M / n[n > 0]) * np.log(2)
    return w
""",
        """
def f(histograms):
    present = np.minimum(histograms, 1)
    return [float(-np.log(c)) if c else 0 for c in present.mean(axis=0)]
""",
    ],
    "Q1.8": [
        """
def f(query, histograms, weights):
    def norm(v):
        v = v * weights
        return v / v.sum() if v.sum() > 0 else None
    q = norm(query)
    out = []
    for h in histograms:
        d = norm(h)
        out.append(2.0 if q is None or d is None else np.abs(q - d).sum())
    return tuple(out)
""",
        """
def f(query, histograms, weights):
    H = np.vstack([query, histograms]) @ np.diag(weights)
    s = np.abs(H).sum(1, keepdims=True)
    H = np.where(s > 0, H / np.where(s == 0, 1, s), 0)
    score = np.abs(H[1:] - H[0]).sum(1)
    score[(s[1:, 0] == 0) | (s[0] == 0)] = 2
    return score
""",
    ],
    "Q2.2a": [
        "dS_dr = sp.Matrix([2*N*r - 2*N*x_c*sp.cos(alpha) - 2*N*y_c*sp.sin(alpha)])",
        "dS_dr = sp.factor(2*N*r - 2*sum_x*sp.cos(alpha) - 2*sum_y*sp.sin(alpha))",
    ],
    "Q2.2b": [
        "r_opt = sp.solveset(N*r - sum_x*sp.cos(alpha) - sum_y*sp.sin(alpha), r)",
        "r_opt = sp.Matrix([[x_c, y_c]]) * sp.Matrix([sp.cos(alpha), sp.sin(alpha)])",
        "r_opt = sp.re((x_c + sp.I*y_c) * sp.exp(-sp.I*alpha))",
    ],
    "Q2.2c": [
        "c, s = sp.cos(alpha), sp.sin(alpha)\n"
        "S = sp.Matrix([[c, s]]) * sp.Matrix([[S_xx, S_xy], [S_xy, S_yy]]) * sp.Matrix([c, s])",
        "S = S_xx*sp.cos(alpha)**2 + S_yy*(1 - sp.cos(alpha)**2) + S_xy*sp.sin(2*alpha)",
    ],
    "Q2.2d": [
        "d = sp.expand_trig((S_yy - S_xx)*sp.sin(2*alpha) + 2*S_xy*sp.cos(2*alpha))",
        "d = sp.Derivative(S_xx*sp.cos(alpha)**2 + S_xy*sp.sin(2*alpha)"
        " + S_yy*sp.sin(alpha)**2, alpha)",
    ],
    "Q2.2e": [
        "a = sp.atan2(-2*S_xy, S_yy - S_xx)/2\na = [a, a + sp.pi/2, a - sp.pi/2]",
        "a = -sp.acot((S_yy - S_xx)/(2*S_xy))/2",
        "a = sp.arg(S_xx - S_yy + 2*sp.I*S_xy)/2",
    ],
    "Q2.2f1": ["d = (S_yy - S_xx)*(4*sp.cos(alpha)**2 - 2) - 4*S_xy*sp.sin(2*alpha)"],
    "Q2.2f2": [
        "a = sp.pi/2 - sp.atan2(S_yy - S_xx, -2*S_xy)/2 - sp.pi/4",
        "a = sp.atan2(2*S_xy, S_xx - S_yy)/2 - sp.pi/2",
    ],
    "Q2.3": [
        """
def f(points, weights=None):
    w = np.ones(len(points)) if weights is None else np.asarray(weights, float)
    if len(points) < 2:
        raise ValueError("too few")
    c = np.average(points, axis=0, weights=w)
    C = np.cov((points - c).T, aweights=w, bias=True)
    values, vectors = np.linalg.eigh(C)
    if np.isclose(values[0], values[1], rtol=1e-9):
        raise ValueError("no direction")
    n = vectors[:, 0]
    n = n if n @ c >= 0 else -n
    return {"r": 0}["r"] + n @ c, np.angle(n[0] + 1j * n[1])
""",
        """
def f(points, weights=None):
    p = np.repeat(points, 1, axis=0)
    w = np.ones(len(p)) if weights is None else weights
    c = (p * w[:, None]).sum(0) / w.sum()
    q = p - c
    M = q.T @ (w[:, None] * q)
    if np.allclose(M, np.eye(2) * M[0, 0], rtol=0, atol=1e-12 * max(1e-300, M.trace())):
        raise ValueError("undetermined")
    a = math.atan2(-2 * M[0, 1], M[1, 1] - M[0, 0]) / 2
    r = c[0] * math.cos(a) + c[1] * math.sin(a)
    if r < 0:
        r = -r
        a = a + math.pi if a <= 0 else a - math.pi
    return Line(r=r, alpha=a)
""",
    ],
    "Q2.4": [
        """
def f(points, sigma, weights=None):
    r, alpha = fit_line(points)
    R = np.array([[math.cos(alpha), math.sin(alpha)], [-math.sin(alpha), math.cos(alpha)]])
    b = (R @ points.T)[1]
    A = np.column_stack([np.ones(len(b)), -b])
    return np.linalg.pinv(A) @ (sigma**2 * np.eye(len(b))) @ np.linalg.pinv(A).T
""",
    ],
    "Q3.2.1": [
        "k = 74",
        "k = np.int64(74)",
        "k = 74.0",
        "k = math.ceil(math.log(.05)/math.log(.96))",
        "k = sp.ceiling(sp.log(.05)/sp.log(.96))",
        "k = np.array([74])",
    ],
    "Q3.2.2": ["n = 499500", "n = 1000*999/2", "n = sp.binomial(1000, 2)"],
    "Q3.2.3a": ["q = 1 - sp.Symbol('w')**2", "q = sp.Poly(1 - w**2, w).as_expr()"],
    "Q3.2.3b": ["p = 0.18", "p = 0.96**42", "p = sp.Rational(24, 25)**42", "p = 0.18005"],
    "Q3.2.4": ["p = 0.98", "p = 1 - 0.96**100", "p = 0.983", "p = np.float32(1 - 0.96**100)"],
    "Q3.2.5": ["k = 373", "k = 378", "k = np.ceil(np.log(0.05)/np.log1p(-0.008))"],
    "Q3.3": [
        """
def f(p, w, s):
    if not 0 < p < 1 or not 0 <= w <= 1: raise ValueError("probabilities")
    if w == 1: return 1
    if w == 0: raise ValueError("no inliers")
    return math.ceil(math.log1p(-p) / math.log1p(-math.exp(s * math.log(w))))
""",
        """
def f(p, w, s):
    if p <= 0 or p >= 1 or w < 0 or w > 1:
        raise ValueError
    if w == 0:
        return float("inf")
    if w == 1:
        return np.int64(1)
    return int(np.ceil(np.log1p(-p) / np.log1p(-np.power(w, s))))
""",
        """
def f(p, w, s):
    assert_ok = 0 < p < 1 and 0 <= w <= 1
    if not assert_ok:
        raise ValueError(f"{p} {w}")
    q = w**s
    if q == 1.0:
        return 1
    if q == 0.0:
        return np.inf
    k = np.log1p(-p) / np.log1p(-q)
    return max(1, -int(-k // 1))
""",
    ],
    "Q3.4": [
        """
def f(points, threshold, iterations, rng):
    best_line, best_count = None, -1
    for k in range(iterations):
        i, j = rng.permutation(len(points))[:2]
        if (points[i] == points[j]).all():
            continue
        line = fit_line(np.stack([points[i], points[j]]))
        count = int((abs(distances(points, line)) <= threshold).sum())
        if count > best_count:
            best_line, best_count = line, count
    if best_line is None:
        raise ValueError("no line found")
    mask = abs(distances(points, best_line)) <= threshold
    return fit_line(points[mask]), np.arange(len(points))[mask].tolist()
""",
        """
def f(points, threshold, iterations, rng):
    best = set()
    k = 0
    while k < iterations:
        k += 1
        pair = rng.choice(points, 2, replace=False, axis=0)
        d = pair[1] - pair[0]
        if not d.any():
            continue
        n = np.array([-d[1], d[0]]) / np.sqrt(d @ d)
        agree = set(np.where(((points - pair[0]) @ n) ** 2 <= threshold**2)[0])
        best = agree if len(agree) >= len(best) else best
    if not best:
        raise ValueError("nothing")
    inliers = np.array(sorted(best, reverse=True))
    return fit_line(points[inliers]), inliers
""",
    ],
    "Q3.5": [
        """
def f(points, threshold, iterations, rng):
    best = np.zeros(len(points), bool)
    for _ in range(iterations):
        triple = points[rng.choice(len(points), 3, replace=False)]
        if np.linalg.svd(triple - triple[0], compute_uv=False)[1] < 1e-12:
            continue
        plane = fit_plane(triple)
        agree = np.abs(plane_distances(points, plane)) <= threshold
        if agree.sum() > best.sum():
            best = agree
    if not best.any():
        raise ValueError("no plane")
    return fit_plane(points[best]), np.flatnonzero(best)
""",
    ],
    "Q3.6": [
        """
def f(points, threshold, iterations, min_points, rng):
    walls, index = [], list(range(len(points)))
    while index and len(index) >= min_points:
        try:
            line, inliers = ransac_line(points[index], threshold, iterations, rng)
        except ValueError:
            return walls
        if not len(inliers) >= min_points:
            return walls
        mine = [index[i] for i in inliers]
        walls.append((line, mine))
        index = [i for i in index if i not in mine]
    return walls
""",
        """
def f(points, threshold, iterations, min_points, rng):
    walls = []
    taken = np.zeros(len(points), dtype=bool)
    for _ in range(len(points)):
        rest = np.nonzero(~taken)[0]
        if len(rest) < min_points:
            break
        line, inliers = ransac_line(points[rest], threshold, iterations, rng)
        if len(inliers) < min_points:
            break
        taken[rest[inliers]] = True
        walls.append({"w": (line, rest[inliers])}["w"])
    return np.array(walls, dtype=object) if False else walls
""",
    ],
}

_LINE = """
def f(points, threshold, iterations, rng):
    best = None
    for _ in range({count}):
        i, j = rng.choice(len(points), 2, replace=False)
        d = points[j] - points[i]; n = np.hypot(*d)
        if n == 0: continue
        dist = (points - points[i]) @ np.array([-d[1], d[0]]) / n
        inliers = np.flatnonzero({agree})
        if best is None or len(inliers) > len(best): best = inliers
    if best is None: raise ValueError("no line")
    return {result}
"""


def _line(
    count="iterations", agree="abs(dist) <= threshold", result="fit_line(points[best]), best"
):
    return _LINE.format(count=count, agree=agree, result=result)


_PLANE = """
def f(points, threshold, iterations, rng):
    best = []
    for _ in range({count}):
        a, b, c = points[rng.choice(len(points), 3, replace=False)]
        n = np.cross(b - a, c - a)
        if not n.any(): continue
        n = n / np.linalg.norm(n)
        inliers = np.flatnonzero({agree})
        if len(inliers) > len(best): best = inliers
    if len(best) == 0: raise ValueError("no plane")
    return {result}
"""


def _plane(
    count="iterations",
    agree="abs((points - a) @ n) <= threshold",
    result="fit_plane(points[best]), best",
):
    return _PLANE.format(count=count, agree=agree, result=result)


_WALLS = """
def f(points, threshold, iterations, min_points, rng):
    walls, left = [], np.arange(len(points))
    while len(left) >= {enough}:
        try:
            line, inliers = ransac_line({call})
        except ValueError:
            break
        if len(inliers) < {enough}: break
        walls.append({wall})
        left = {rest}
    return {result}
"""


def _walls(
    enough="min_points",
    call="points[left], threshold, iterations, rng",
    wall="(line, left[inliers])",
    rest="np.delete(left, inliers)",
    result="walls",
):
    return _WALLS.format(enough=enough, call=call, wall=wall, rest=rest, result=result)


_FIT = """
def f(points, weights=None):
    w = np.ones(len(points)) if weights is None else np.asarray(weights, float)
    c = w @ points / {total}
    x, y = (points - c).T
    Sxx, Sxy, Syy = w @ (x*x), w @ (x*y), w @ (y*y)
    if {refused}: raise ValueError("no line")
    a = {angle}
    r = c[0]*math.cos(a) + c[1]*math.sin(a)
    if r < 0: r, a = -r, a + math.pi
    if a > math.pi: a -= 2*math.pi
    return {result}
"""


def _fit(
    total="w.sum()",
    refused="math.hypot(Syy - Sxx, 2*Sxy) <= 1e-12*(Sxx + Syy)",
    angle="math.atan2(-2*Sxy, Syy - Sxx)/2",
    result="Line(r, a)",
):
    return _FIT.format(total=total, refused=refused, angle=angle, result=result)


_COVARIANCE = """
def f(points, sigma, weights=None):
    _, a = fit_line(points)
    b = points @ np.array([-math.sin(a), math.cos(a)])
    N, t = len(b), b.mean()
    B = ((b - t)**2).sum()
    return {result}
"""
_ITERATIONS = """
def f(p, w, s):
    if not 0 < p < 1 or not 0 <= w <= 1: raise ValueError("probabilities")
    if w == 1: return {one}
    if w == 0: return {none}
    return {count}
"""


def _iterations(count="math.ceil(math.log1p(-p)/math.log1p(-w**s))", one="1", none="math.inf"):
    return _ITERATIONS.format(count=count, one=one, none=none)


_NEAREST = "def f(descriptors, words):\n    d = {d}\n    return {result}\n"
_SCORES = """
def f(query, histograms, weights):
    q, d = query * weights, histograms * weights
    sq, sd = q.sum(), d.sum(1)
    with np.errstate(all="ignore"):
        q, d = q / (sq or 1), d / np.where(sd > 0, sd, 1)[:, None]
    return {result}
"""

# The templates themselves are right: what makes a response wrong is the one thing put into them.
RIGHT["Q1.8"].append(_SCORES.format(result="2 - 2*np.minimum(q, d).sum(1)"))
RIGHT["Q2.3"].append(_fit())
RIGHT["Q2.4"].append(
    _COVARIANCE.format(result="sigma**2*np.array([[1/N + t*t/B, t/B], [t/B, 1/B]])")
)
RIGHT["Q3.3"].append(_iterations())
RIGHT["Q3.4"].append(_line())
RIGHT["Q3.5"].append(_plane())
RIGHT["Q3.6"].append(_walls())

_SQUARED = "((descriptors[:, None] - words)**2).sum(2)"

WRONG = {
    "Q1.3": [
        _NEAREST.format(d=_SQUARED, result="d.argmin(1) + 1"),
        _NEAREST.format(d=_SQUARED, result="d.min(1)"),
        _NEAREST.format(d=_SQUARED, result="d.argmax(1)"),
        _NEAREST.format(d=_SQUARED, result="d.shape[1] - 1 - d[:, ::-1].argmin(1)"),
        _NEAREST.format(d="abs(descriptors[:, None] - words).sum(2)", result="d.argmin(1)"),
        _NEAREST.format(d="abs(descriptors[:, None] - words).max(2)", result="d.argmin(1)"),
        _NEAREST.format(
            d="descriptors @ words.T / np.linalg.norm(words, axis=1)", result="d.argmax(1)"
        ),
        _NEAREST.format(d=_SQUARED, result="words[d.argmin(1)]"),
    ],
    "Q1.4": [
        """
def f(descriptor, levels):
    return int(((levels[-1] - descriptor)**2).sum(1).argmin())
""",
        """
def f(descriptor, levels):
    k, node = len(levels[0]), 0
    for c in levels:
        node = k*node + int(abs(c[k*node:k*node + k] - descriptor).sum(1).argmin())
    return node
""",
        """
def f(descriptor, levels):
    k, node = 2, 0
    for c in levels:
        node = k*node + int(((c[k*node:k*node + k] - descriptor)**2).sum(1).argmin())
    return node
""",
        """
def f(descriptor, levels):
    k, node = len(levels[0]), 0
    for c in levels[:2]:
        node = k*node + int(((c[k*node:k*node + k] - descriptor)**2).sum(1).argmin())
    return node
""",
        """
def f(descriptor, levels):
    k, node = len(levels[0]), 0
    for c in levels:
        d = ((c[k*node:k*node + k] - descriptor)**2).sum(1)
        node = k*node + k - 1 - int(d[::-1].argmin())
    return node
""",
    ],
    "Q1.5": [
        """
def f(words_by_image, word_count):
    file = [[] for _ in range(word_count)]
    for i, ws in enumerate(words_by_image):
        for w in ws: file[w].append(i)
    return file
""",
        """
def f(words_by_image, word_count):
    last = max((int(max(ws)) for ws in words_by_image if len(ws)), default=-1)
    file = [[] for _ in range(last + 1)]
    for i, ws in enumerate(words_by_image):
        for w in set(map(int, ws)): file[w].append(i)
    return file
""",
        """
def f(words_by_image, word_count):
    file = [[] for _ in range(word_count)]
    for i, ws in enumerate(words_by_image):
        for w in np.unique(ws): file[w].append(i + 1)
    return file
""",
        """
def f(words_by_image, word_count):
    file = [[] for _ in range(word_count)]
    for i, ws in enumerate(words_by_image):
        for w in np.unique(ws): file[w].append(i)
    return [images for images in file if images]
""",
        """
def f(words_by_image, word_count):
    file = {}
    for i, ws in enumerate(words_by_image):
        for w in np.unique(ws): file.setdefault(int(w), []).append(i)
    return file
""",
        """
def f(words_by_image, word_count):
    file = [[] for _ in range(word_count)]
    for i, ws in enumerate(words_by_image):
        ws.sort()
        for w in np.unique(ws): file[w].append(i)
    return file
""",
    ],
    "Q1.6": [
        """
def f(query_words, inverted_file, image_count):
    votes = np.zeros(image_count, int)
    for w in set(map(int, query_words)):
        for i in inverted_file[w]: votes[i] += 1
    return votes
""",
        """
def f(query_words, inverted_file, image_count):
    votes = np.zeros(image_count, int)
    votes[[i for w in query_words for i in inverted_file[w]]] += 1
    return votes
""",
        """
def f(query_words, inverted_file, image_count):
    return np.bincount([i for w in query_words for i in inverted_file[w]])
""",
        """
def f(query_words, inverted_file, image_count):
    votes = np.zeros(image_count)
    for w in query_words:
        for i in inverted_file[w]: votes[i] += 1 / len(inverted_file[w])
    return votes
""",
        """
def f(query_words, inverted_file, image_count):
    votes = np.zeros(image_count, int)
    for w in query_words:
        for i in inverted_file[w]: votes[i] += 1
    return np.argsort(-votes)
""",
    ],
    "Q1.7": [
        f"def f(histograms):\n    n = {n}\n    return np.where(n > 0, {value}, {none})\n"
        for n, value, none in (
            ("(histograms > 0).sum(0)", "np.log10(len(histograms) / np.maximum(n, 1))", "0"),
            ("(histograms > 0).sum(0)", "np.log2(len(histograms) / np.maximum(n, 1))", "0"),
            ("histograms.sum(0)", "np.log(len(histograms) / np.maximum(n, 1))", "0"),
            ("(histograms > 0).sum(0)", "np.log(len(histograms) / (n + 1))", "0"),
            ("(histograms > 0).sum(0)", "np.log(np.maximum(n, 1) / len(histograms))", "0"),
            (
                "(histograms > 0).sum(0)",
                "np.log(len(histograms) / np.maximum(n, 1))",
                "np.log(len(histograms))",
            ),
            ("(histograms > 0).sum(0)", "np.log(histograms.shape[1] / np.maximum(n, 1))", "0"),
            ("(histograms > 1).sum(0)", "np.log(len(histograms) / np.maximum(n, 1))", "0"),
        )
    ],
    "Q1.8": [
        _SCORES.format(result=result)
        for result in (
            "((q - d)**2).sum(1)",
            "np.sqrt(((q - d)**2).sum(1))",
            "np.minimum(q, d).sum(1)",
            "abs(q - d).sum(1)",
            "np.where(sd > 0, abs(q - d).sum(1), 2)",
            "np.where(sd > 0, abs(q - d).sum(1), np.nan)",
            "abs(q - d).sum(1) / 2",
            "abs(query*weights - histograms*weights).sum(1)",
            "2 - 2*np.minimum(query/max(query.sum(), 1), histograms"
            "/np.maximum(histograms.sum(1), 1)[:, None]).sum(1)",
        )
    ],
    "Q2.2a": [
        "d = 2*N*r - sum_x*sp.cos(alpha) - sum_y*sp.sin(alpha)",
        "d = 0",
        "d = '2*(N*r - sum_x*cos(alpha) - sum_y*sin(alpha))'",
        "d = 2*(N*r - sum_x*sp.sin(alpha) - sum_y*sp.cos(alpha))",
    ],
    "Q2.2b": [
        "r_opt = x_c + y_c",
        "r_opt = sp.solve(N*r - x_c*sp.cos(alpha) - y_c*sp.sin(alpha), r)",
        "r_opt = r",
        "r_opt = [x_c*sp.cos(alpha) + y_c*sp.sin(alpha), 0]",
    ],
    "Q2.2c": [
        "S = S_xx*sp.cos(alpha)**2 + 2*S_xy*sp.sin(2*alpha) + S_yy*sp.sin(alpha)**2",
        "S = (S_xx*sp.cos(alpha) + S_yy*sp.sin(alpha))**2",
        "S = S_xx + S_yy + 2*S_xy",
    ],
    "Q2.2d": [
        "d = (S_yy + S_xx)*sp.sin(2*alpha) + 2*S_xy*sp.cos(2*alpha)",
        "d = 2*(S_yy - S_xx)*sp.sin(2*alpha) + 2*S_xy*sp.cos(2*alpha)",
    ],
    "Q2.2e": [
        "a = sp.atan2(-2*S_xy, S_yy - S_xx)",
        "a = sp.pi/4",
        "a = sp.atan(S_xy/(S_xx - S_yy))",
        "a = sp.atan2(-2*S_xy, S_yy - S_xx)/2 + sp.pi/3",
        "a = [sp.atan2(-2*S_xy, S_yy - S_xx)/2, 0]",
    ],
    "Q2.2f1": [
        "d = 2*(S_yy - S_xx)*sp.cos(2*alpha) - 2*S_xy*sp.sin(2*alpha)",
        "d = 4*(S_yy - S_xx)*sp.cos(2*alpha) - 4*S_xy*sp.sin(2*alpha)",
    ],
    "Q2.2f2": [
        "a = sp.atan2(-2*S_xy, S_yy - S_xx)/2 + sp.pi/2",
        "a = sp.atan2(2*S_xy, S_yy - S_xx)/2",
        "a = sp.Piecewise((sp.atan(-2*S_xy/(S_yy - S_xx))/2, S_yy < S_xx),"
        " (sp.atan(-2*S_xy/(S_yy - S_xx))/2 + sp.pi/2, True))",
        "a = sp.acos((S_yy - S_xx)/sp.sqrt((S_yy - S_xx)**2 + 4*S_xy**2))/2",
    ],
    "Q2.3": [
        _fit(total="len(points)"),
        _fit(refused="False"),
        _fit(refused="True"),
        _fit(refused="len(points) < 2"),
        _fit(angle="math.atan(-2*Sxy/(Syy - Sxx))/2 if Syy != Sxx else 0.0"),
        _fit(angle="math.atan2(-2*Sxy, Sxx - Syy)/2"),
        _fit(result="Line(a, r)"),
        _fit(result="Line(r, math.degrees(a))"),
        _fit(result="Line(r, a % (2*math.pi))"),
        _fit(result="Line(r, round(a, 3))"),
        _fit().replace("x, y =", "points -= c; x, y =").replace("(points - c).T", "points.T"),
        _fit().replace("w @ (x*x)", "w**2 @ (x*x)").replace("w @ (y*y)", "w**2 @ (y*y)"),
        _fit().replace("    if r < 0: r, a = -r, a + math.pi\n", ""),
        _fit().replace("    if a > math.pi: a -= 2*math.pi\n", ""),
        "def f(points, weights=None):\n    m, b = np.polyfit(points[:, 0], points[:, 1], 1)\n"
        "    n = np.hypot(m, 1)\n    return abs(b)/n, math.atan2(np.sign(b), -m*np.sign(b))\n",
    ],
    "Q2.4": [
        _COVARIANCE.format(result=result)
        for result in (
            "sigma**2*np.array([[1/N + t*t/B, -t/B], [-t/B, 1/B]])",
            "sigma*np.array([[1/N + t*t/B, t/B], [t/B, 1/B]])",
            "sigma**2*np.array([[1/N, 0], [0, 1/B]])",
            "sigma**2*np.array([[1/N + t*t/B, 0], [0, 1/B]])",
            "sigma**2*np.array([[1/(N - 1) + t*t/B, t/B], [t/B, 1/B]])",
            "sigma**2*np.array([[1/B, t/B], [t/B, 1/N + t*t/B]])",
            "sigma**2*np.array([[1/N + t*t/B, t/B], [t/B, 1/B]])*N",
            "0.1**2*np.array([[1/N + t*t/B, t/B], [t/B, 1/B]])",
            "sigma**2*np.array([1/N + t*t/B, t/B, t/B, 1/B])",
            "sigma**2*np.array([[t*t/B, t/B], [t/B, 1/B]])",
        )
    ],
    "Q3.2.1": ["k = 73", "k = 73.38", "k = 75", "k = 14", "k = '74'"],
    "Q3.2.2": ["n = 999000", "n = 500500", "n = 1000**2/2"],
    "Q3.2.3a": ["q = (1 - w)**2", "q = 1 - w", "q = w**2", "q = 1 - 2*w", "q = 1 - 0.2**2"],
    "Q3.2.3b": ["p = 0.82", "p = 18", "p = 0.17", "p = 0.2"],
    "Q3.2.4": ["p = 0.02", "p = 98.31", "p = 0.99", "p = 1.0"],
    "Q3.2.5": ["k = 372", "k = 74", "k = 374", "k = 372.97"],
    "Q3.3": [
        _iterations(one="0"),
        _iterations(one="0", none="0"),
        _iterations(none="0"),
        _iterations(none="1"),
        _iterations(none="10**9"),
        _iterations("math.floor(math.log1p(-p)/math.log1p(-w**s))"),
        _iterations("math.floor(math.log1p(-p)/math.log1p(-w**s)) + 1"),
        _iterations("round(math.log1p(-p)/math.log1p(-w**s))"),
        _iterations("math.log1p(-p)/math.log1p(-w**s)"),
        _iterations("math.ceil(math.log1p(-p)/math.log1p(-w**s)) + 1"),
        _iterations("math.ceil(math.log1p(-p)/math.log1p(-w**2))"),
        _iterations("math.ceil(math.log(p)/math.log1p(-w**s))"),
        _iterations("math.ceil(math.log1p(-p)/math.log1p(-(1 - w)**s))"),
        _iterations("min(10**6, math.ceil(math.log1p(-p)/math.log1p(-w**s)))"),
        _iterations("math.ceil(math.log(1 - p)/math.log(1 - w**s)) if w**s > 1e-16 else math.inf"),
        _iterations().replace("0 < p < 1", "0 <= p <= 1.5"),
        _iterations().replace("0 <= w <= 1", "w <= 1"),
    ],
    "Q3.4": [
        _line(agree="dist**2 <= threshold"),
        _line(agree="abs(dist) <= threshold / 2"),
        _line(agree="abs(dist) <= 2 * threshold"),
        _line(agree="abs(dist) <= 5 * threshold"),
        _line(agree="abs(dist) <= 0.1"),
        _line(agree="dist <= threshold"),
        _line(count="40"),
        _line(count="300"),
        _line(count="3"),
        _line(count="max(1, iterations)"),
        _line(count="iterations + 1"),
        _line(count="iterations // 2"),
        _line(count="iterations ** 2"),
        _line(result="fit_line(points[[i, j]]), best"),
        _line(result="fit_line(points), best"),
        _line(result="best, fit_line(points[best])"),
        _line(result="fit_line(points[best]), points[best]"),
        _line(result="fit_line(points[best])"),
        _line(result="fit_line(points[best]), best[:-1]"),
        _line(result="fit_line(points[best]), len(best)"),
        _line().replace("rng.choice", "np.random.default_rng(0).choice"),
        _line().replace('raise ValueError("no line")', "return None"),
        _line().replace('raise ValueError("no line")', 'raise IndexError("no line")'),
        _line().replace("if n == 0: continue", "n = n or 1.0"),
    ],
    "Q3.5": [
        _plane(agree="((points - a) @ n)**2 <= threshold"),
        _plane(agree="abs((points - a) @ n) <= 0.05"),
        _plane(agree="abs((points - a) @ n) <= 5 * threshold"),
        _plane(agree="abs((points - a) @ n) <= threshold / 2"),
        _plane(agree="(points - a) @ n <= threshold"),
        _plane(count="400"),
        _plane(count="40"),
        _plane(result="(tuple(n), float(n @ a)), best"),
        _plane(result="fit_plane(points), best"),
        _plane().replace("n = n / np.linalg.norm(n)", "pass"),
    ],
    "Q3.6": [
        _walls(enough="20"),
        _walls(enough="min_points + 1"),
        _walls(enough="(min_points - 1)"),
        _walls(enough="2"),
        _walls(call="points[left], 0.05, iterations, rng"),
        _walls(call="points[left], 2 * threshold, iterations, rng"),
        _walls(call="points[left], threshold, 300, rng"),
        _walls(call="points[left], threshold, 40, rng"),
        _walls(wall="(line, inliers)"),
        _walls(wall="line"),
        _walls(result="walls[:1]"),
        _walls(result="walls[::-1]"),
        _walls(
            wall="(line, np.flatnonzero(abs(distances(points, line)) <= threshold))",
        ),
    ],
}

# Three draws for hundreds: now and then they find what all the draws would find.
CHANCE = {
    "Q3.4": _line(count="min(3, iterations)"),
    "Q3.5": _plane(count="min(3, iterations)"),
    "Q3.6": _walls(call="points[left], threshold, min(3, iterations), rng"),
}
