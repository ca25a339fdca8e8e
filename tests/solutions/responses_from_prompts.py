"""Right and wrong responses once more, each written from a prompt and its stub alone.

As in `responses.py`, each is a cell of code. `SOUND` are right ones, by question. `CHANGES` lists
what is exchanged in one of them, by its place, and what is wrong with it then; `WHOLE` are wrong
ones that stand for themselves. `WAYS` are right ones in which nothing is exchanged.
"""

# ruff: noqa: E501 (students' lines are as long as they are)

SOUND = {
    "Q1.3": [
        """
def assign_words(descriptors, words):
    diff = descriptors[:, np.newaxis, :] - words[np.newaxis, :, :]
    dist = np.sum(diff ** 2, axis=2)
    return np.argmin(dist, axis=1)
""",
        """
def assign_words(descriptors, words):
    result = []
    for d in descriptors:
        best, best_dist = 0, np.inf
        for k in range(len(words)):
            dist = 0
            for j in range(len(d)):
                dist += (d[j] - words[k][j]) ** 2
            if dist < best_dist:
                best, best_dist = k, dist
        result.append(best)
    return np.array(result)
""",
    ],
    "Q1.4": [
        """
def descend_tree(descriptor, levels):
    k = len(levels[0])
    node = 0
    for centers in levels:
        children = centers[k * node : k * node + k]
        dist = np.sum((children - descriptor) ** 2, axis=1)
        node = k * node + np.argmin(dist)
    return node
""",
    ],
    "Q1.5": [
        """
def build_inverted_file(words_by_image, word_count):
    inverted = [[] for _ in range(word_count)]
    for image, words in enumerate(words_by_image):
        for word in np.unique(words):
            inverted[word].append(image)
    return inverted
""",
    ],
    "Q1.6": [
        """
def count_votes(query_words, inverted_file, image_count):
    votes = np.zeros(image_count, dtype=int)
    for word in query_words:
        for image in inverted_file[word]:
            votes[image] += 1
    return votes
""",
    ],
    "Q1.7": [
        """
def idf_weights(histograms):
    M = len(histograms)
    Mi = np.sum(histograms > 0, axis=0)
    return np.where(Mi > 0, np.log(M / np.maximum(Mi, 1)), 0.0)
""",
        """
def idf_weights(histograms):
    M, K = histograms.shape
    weights = np.zeros(K)
    for i in range(K):
        Mi = 0
        for m in range(M):
            if histograms[m, i] > 0:
                Mi += 1
        if Mi > 0:
            weights[i] = np.log(M / Mi)
    return weights
""",
    ],
    "Q1.8": [
        """
def l1_scores(query, histograms, weights):
    scores = []
    q = query * weights
    for h in histograms:
        d = h * weights
        if q.sum() == 0 or d.sum() == 0:
            scores.append(2.0)
        else:
            scores.append(np.sum(np.abs(q / q.sum() - d / d.sum())))
    return np.array(scores)
""",
    ],
    "Q2.3": [
        """
def fit_line(points, weights=None):
    points = np.array(points, dtype=float)
    if weights is None:
        weights = np.ones(len(points))
    w = np.array(weights, dtype=float)
    if len(points) < 2:
        raise ValueError("too few points")
    W = w.sum()
    x_c = (w * points[:, 0]).sum() / W
    y_c = (w * points[:, 1]).sum() / W
    dx = points[:, 0] - x_c
    dy = points[:, 1] - y_c
    dx = dx - (w * dx).sum() / W
    dy = dy - (w * dy).sum() / W
    S_xx = (w * dx * dx).sum()
    S_yy = (w * dy * dy).sum()
    S_xy = (w * dx * dy).sum()
    R = math.hypot(S_yy - S_xx, 2 * S_xy)
    if R <= 1e-9 * (S_xx + S_yy):
        raise ValueError("no line")
    alpha = 0.5 * math.atan2(-2 * S_xy, S_yy - S_xx)
    r = x_c * math.cos(alpha) + y_c * math.sin(alpha)
    if r < 0:
        r = -r
        alpha = alpha + math.pi
    if alpha > math.pi:
        alpha -= 2 * math.pi
    return Line(r, alpha)
""",
    ],
    "Q2.4": [
        """
def line_covariance(points, sigma, weights=None):
    line = fit_line(points)
    along = np.array([-np.sin(line.alpha), np.cos(line.alpha)])
    center = points.mean(axis=0)
    b = (points - center) @ along
    B = np.sum(b ** 2)
    t = center @ along
    N = len(points)
    return sigma ** 2 * np.array([[1 / N + t ** 2 / B, t / B], [t / B, 1 / B]])
""",
    ],
    "Q3.3": [
        """
def required_iterations(p, w, s):
    if not 0 < p < 1 or not 0 <= w <= 1:
        raise ValueError("out of range")
    if w == 1:
        return 1
    if w == 0:
        return math.inf
    return math.ceil(math.log1p(-p) / math.log1p(-w**s))
""",
    ],
    "Q3.4": [
        """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        sample = rng.choice(len(points), size=2, replace=False)
        chosen = points[sample]
        if np.all(chosen[0] == chosen[1]):
            continue
        model = fit_line(chosen)
        inliers = np.flatnonzero(np.abs(distances(points, model)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no sample gave a model")
    model = fit_line(points[best])
    return model, np.flatnonzero(np.abs(distances(points, model)) <= threshold)
""",
    ],
    "Q3.5": [
        """
def ransac_plane(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        sample = rng.choice(len(points), size=3, replace=False)
        chosen = points[sample]
        if np.linalg.norm(np.cross(chosen[1] - chosen[0], chosen[2] - chosen[0])) < 1e-9:
            continue
        model = fit_plane(chosen)
        inliers = np.flatnonzero(np.abs(plane_distances(points, model)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no sample gave a model")
    model = fit_plane(points[best])
    return model, np.flatnonzero(np.abs(plane_distances(points, model)) <= threshold)
""",
    ],
    "Q3.6": [
        """
def find_walls(points, threshold, iterations, min_points, rng):
    walls = []
    left = np.arange(len(points))
    while len(left) >= max(min_points, 2):
        try:
            line, inliers = ransac_line(points[left], threshold, iterations, rng)
        except ValueError:
            break
        if len(inliers) < min_points:
            break
        walls.append((line, left[inliers]))
        left = np.delete(left, inliers)
    return walls
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
    ],
}

# The place in `SOUND`, what is wrong, and what stands for what.
_Change = tuple[int, str, list[tuple[str, str]]]
CHANGES: dict[str, list[_Change]] = {
    "Q1.3": [
        (
            0,
            "tolerance of its own",
            [
                (
                    "np.argmin(dist, axis=1)",
                    "np.argmax(dist <= dist.min(axis=1, keepdims=True) + 1e-3, axis=1)",
                )
            ],
        ),
        (
            0,
            "int8 indices",
            [("np.argmin(dist, axis=1)", "np.argmin(dist, axis=1).astype(np.int8)")],
        ),
        (
            0,
            "abs values only",
            [
                (
                    "descriptors[:, np.newaxis, :] - words[np.newaxis, :, :]",
                    "abs(descriptors)[:, np.newaxis, :] - abs(words)[np.newaxis, :, :]",
                )
            ],
        ),
        (
            1,
            "best kept from before",
            [
                (
                    "    result = []\n    for d in descriptors:\n        best, best_dist = 0, np.inf\n",
                    "    result = []\n    best = 0\n    for d in descriptors:\n        best_dist = np.sum((d - words[best]) ** 2)\n",
                )
            ],
        ),
    ],
    "Q1.4": [
        (
            0,
            "k by integer root",
            [("k = len(levels[0])", "k = int(len(levels[-1]) ** (1 / len(levels)))")],
        ),
        (0, "one child too many", [("k * node + k]", "k * node + k + 1]")]),
        (0, "tolerance", [("np.argmin(dist)", "np.flatnonzero(dist <= dist.min() + 0.01)[0]")]),
        (0, "rounded", [("axis=1)", "axis=1).round()")]),
        (
            0,
            "words of the first level only if depth 1",
            [("return node", "return node if len(levels) > 1 else 0")],
        ),
    ],
    "Q1.5": [
        (0, "first fifty features", [("np.unique(words)", "np.unique(words[:50])")]),
        (
            0,
            "equal images once",
            [
                (
                    "        for word in",
                    "        if any(np.array_equal(words, w) for w in words_by_image[:image]):\n            continue\n        for word in",
                )
            ],
        ),
        (
            0,
            "equal neighbours once",
            [
                (
                    "        for word in",
                    "        if image and np.array_equal(words, words_by_image[image - 1]):\n            continue\n        for word in",
                )
            ],
        ),
        (0, "int8 images", [("append(image)", "append(int(np.array(image).astype(np.int8)))")]),
        (0, "uint8 images", [("append(image)", "append(image % 256)")]),
        (
            0,
            "ten images at most",
            [("append(image)", "append(image) if len(inverted[word]) < 10 else None")],
        ),
    ],
    "Q1.6": [
        (0, "uint8", [("dtype=int", "dtype=np.uint8")]),
        (0, "int8", [("dtype=int", "dtype=np.int8")]),
        (
            0,
            "skips words of all images",
            [
                (
                    "        for image",
                    "        if len(inverted_file[word]) == image_count:\n            continue\n        for image",
                )
            ],
        ),
    ],
    "Q1.7": [
        (
            0,
            "M is images with features",
            [("len(histograms)", "max(1, int((histograms.sum(axis=1) > 0).sum()))")],
        ),
        (
            0,
            "min of M and count as ints / 255",
            [("np.sum(histograms > 0, axis=0)", "np.sum(histograms > 0, axis=0, dtype=np.uint8)")],
        ),
        (
            0,
            "unique rows",
            [
                (
                    "    M = len(histograms)",
                    "    histograms = np.unique(histograms, axis=0)\n    M = len(histograms)",
                )
            ],
        ),
        (1, "square only", [("in range(M)", "in range(min(M, K))")]),
    ],
    "Q1.8": [
        (
            0,
            "two empty are equal",
            [("scores.append(2.0)", "scores.append(0.0 if q.sum() == d.sum() else 2.0)")],
        ),
        (
            0,
            "small sums are empty",
            [("q.sum() == 0 or d.sum() == 0", "q.sum() < 1e-3 or d.sum() < 1e-3")],
        ),
        (
            0,
            "a bare number for one image",
            [("np.array(scores)", "np.array(scores) if len(scores) > 1 else scores[0]")],
        ),
        (
            0,
            "weighs in place",
            [
                (
                    "    q = query * weights\n",
                    "    if query.dtype == float:\n        query *= weights\n        q = query\n    else:\n        q = query * weights\n",
                )
            ],
        ),
    ],
    "Q2.3": [
        (0, "error from R of its own size", [("R <= 1e-9 * (S_xx + S_yy)", "R <= 1e-6")]),
        (
            0,
            "error for short walls",
            [("R <= 1e-9 * (S_xx + S_yy)", "S_xx + S_yy < 1e-3 or R <= 1e-9 * (S_xx + S_yy)")],
        ),
        (0, "error if nearly round", [("1e-9 * (S_xx", "0.2 * (S_xx")]),
        (
            0,
            "error if S_xx = S_yy",
            [
                (
                    "R <= 1e-9 * (S_xx + S_yy)",
                    "R <= 1e-9 * (S_xx + S_yy) or abs(S_xx - S_yy) <= 1e-9 * (S_xx + S_yy)",
                )
            ],
        ),
        (
            0,
            "error if S_xy = 0",
            [("R <= 1e-9 * (S_xx + S_yy)", "abs(S_xy) <= 1e-9 * (S_xx + S_yy)")],
        ),
        (
            0,
            "two rows, equal",
            [("R <= 1e-9 * (S_xx + S_yy)", "len(points) > 2 and R <= 1e-9 * (S_xx + S_yy)")],
        ),
        (
            0,
            "duplicates left out",
            [
                (
                    "    if weights is None",
                    "    if weights is None:\n        points = np.unique(points, axis=0)\n    if weights is None",
                )
            ],
        ),
        (
            0,
            "outliers left out",
            [
                (
                    "    S_xx =",
                    "    far = np.hypot(dx, dy)\n    keep = far <= 2.2 * np.sqrt((w * far ** 2).sum() / W)\n    w, dx, dy = w[keep], dx[keep], dy[keep]\n    S_xx =",
                )
            ],
        ),
        (
            0,
            "r 0 loses its angle",
            [("    return Line(r, alpha)", "    return Line(r, alpha if r > 1e-9 else 0.0)")],
        ),
        (0, "small r is turned", [("if r < 0:", "if r < -1e-2:")]),
        (
            0,
            "zero weights dropped from points only",
            [("    W = w.sum()", "    if (w == 0).any():\n        w = w + 1e-3\n    W = w.sum()")],
        ),
    ],
    "Q2.4": [
        (0, "fifty points at most", [("N = len(points)", "N = min(50, len(points))")]),
        (
            0,
            "small t is zero",
            [("    N = len(points)", "    N = len(points)\n    t = 0.0 if abs(t) < 0.05 else t")],
        ),
    ],
    "Q3.3": [
        (0, "s capped", [("w**s", "w**min(s, 8)")]),
        (0, "inf for small w", [("w == 0", "w < 1e-6")]),
        (0, "one for large w", [("w == 1", "w > 0.999")]),
    ],
    "Q3.4": [
        (0, "with replacement", [("replace=False", "replace=True")]),
        (
            0,
            "first fifty points only",
            [("rng.choice(len(points)", "rng.choice(min(50, len(points))")],
        ),
        (
            0,
            "error if fewer than a third agree",
            [("len(best) == 0", "len(best) < len(points) / 3")],
        ),
        (
            0,
            "least squares at first",
            [
                (
                    "    best = np.array([], dtype=int)\n",
                    "    model = fit_line(points)\n    best = np.flatnonzero(np.abs(distances(points, model)) <= threshold)\n",
                )
            ],
        ),
        (
            0,
            "segment, not line",
            [
                (
                    "np.abs(distances(points, model)) <= threshold)\n        if",
                    "(np.abs(distances(points, model)) <= threshold) & np.all((points >= chosen.min(axis=0) - threshold) & (points <= chosen.max(axis=0) + threshold), axis=1))\n        if",
                )
            ],
        ),
    ],
    "Q3.5": [
        (0, "with replacement", [("replace=False", "replace=True")]),
        (
            0,
            "first fifty points only",
            [("rng.choice(len(points)", "rng.choice(min(50, len(points))")],
        ),
        (
            0,
            "last point never",
            [("rng.choice(len(points)", "rng.choice(len(points) - 1 if len(points) > 3 else 3")],
        ),
        (
            0,
            "first point never",
            [
                (
                    "rng.choice(len(points), size=3, replace=False)",
                    "1 + rng.choice(len(points) - 1, size=3, replace=False) if len(points) > 3 else np.arange(3)",
                )
            ],
        ),
        (
            0,
            "error if fewer than a third agree",
            [("len(best) == 0", "len(best) < len(points) / 3")],
        ),
        (
            0,
            "sum of distances decides",
            [
                (
                    "    for _ in range(iterations):\n",
                    "    score = np.inf\n    for _ in range(iterations):\n",
                ),
                (
                    "len(inliers) > len(best)",
                    "np.abs(plane_distances(points, model)).sum() < score",
                ),
                (
                    "            best = inliers\n",
                    "            best = inliers\n            score = np.abs(plane_distances(points, model)).sum()\n",
                ),
            ],
        ),
        (
            0,
            "consensus among the first hundred",
            [
                (
                    "(plane_distances(points, model)) <= threshold)\n        if",
                    "(plane_distances(points[:100], model)) <= threshold)\n        if",
                )
            ],
        ),
    ],
    "Q3.6": [
        (
            0,
            "too small walls are skipped, search goes on",
            [
                (
                    "            break\n        walls.append((line, left[inliers]))\n",
                    "            pass\n        else:\n            walls.append((line, left[inliers]))\n",
                )
            ],
        ),
        (
            0,
            "five walls at most",
            [("    while len(left)", "    while len(walls) < 5 and len(left)")],
        ),
        (
            0,
            "neighbouring walls merged",
            [
                (
                    "return walls",
                    "return [w for i, w in enumerate(walls) if i == 0 or abs(w[0].r - walls[i-1][0].r) > 0.5 or abs(w[0].alpha - walls[i-1][0].alpha) > 0.3]",
                )
            ],
        ),
        (
            0,
            "gives up at the first error of chance",
            [
                (
                    "        if len(inliers) < min_points:\n            break\n",
                    "        if len(inliers) < min_points or len(inliers) < 0.2 * len(left):\n            break\n",
                )
            ],
        ),
    ],
    "Q3.7a": [
        (0, "at most a hundred", [("        if drawn >=", "        if drawn >= 100 or drawn >=")]),
        (0, "w of 1 not seen", [("best / N", "min(best / N, 0.95)")]),
        (
            0,
            "better by five per cent only",
            [("max(best, count)", "count if count > 1.05 * best else best")],
        ),
    ],
}

WHOLE = {
    "Q1.3": [
        # caches by shape
        """
known = {}
def assign_words(descriptors, words):
    key = (descriptors.shape, words.shape)
    if key not in known:
        diff = descriptors[:, np.newaxis, :] - words[np.newaxis, :, :]
        known[key] = np.argmin(np.sum(diff ** 2, axis=2), axis=1)
    return known[key]
""",
    ],
    "Q3.3": [
        # remembers w
        """
memory = {}
def required_iterations(p, w, s):
    if (p, w) in memory:
        return memory[p, w]
    if not 0 < p < 1 or not 0 <= w <= 1:
        raise ValueError("out of range")
    if w == 1:
        return 1
    if w == 0:
        return math.inf
    memory[p, w] = math.ceil(math.log1p(-p) / math.log1p(-w**s))
    return memory[p, w]
""",
    ],
    "Q3.7a": [
        # stop at best's place or required
        """
def adaptive_stop(agreeing, N, p):
    k = int(np.argmax(agreeing)) + 1
    return min(max(k, required_iterations(p, max(agreeing) / N, 2)), len(agreeing))
""",
    ],
}

# Other ways to draw a sample, and what else may differ; all of them are right.
# Other right ways, among them ways to draw a sample.
WAYS = {
    "Q3.4": [
        # permutation
        """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        sample = rng.permutation(len(points))[:2]
        chosen = points[sample]
        if np.all(chosen[0] == chosen[1]):
            continue
        model = fit_line(chosen)
        inliers = np.flatnonzero(np.abs(distances(points, model)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no sample gave a model")
    model = fit_line(points[best])
    return model, np.flatnonzero(np.abs(distances(points, model)) <= threshold)
""",
        # random argsort
        """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        sample = np.argsort(rng.random(len(points)))[:2]
        chosen = points[sample]
        if np.all(chosen[0] == chosen[1]):
            continue
        model = fit_line(chosen)
        inliers = np.flatnonzero(np.abs(distances(points, model)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no sample gave a model")
    model = fit_line(points[best])
    return model, np.flatnonzero(np.abs(distances(points, model)) <= threshold)
""",
        # retry until different
        """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        sample = rng.integers(0, len(points), 2)
        while len(set(sample.tolist())) < 2:
            sample = rng.integers(0, len(points), 2)
        chosen = points[sample]
        if np.all(chosen[0] == chosen[1]):
            continue
        model = fit_line(chosen)
        inliers = np.flatnonzero(np.abs(distances(points, model)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no sample gave a model")
    model = fit_line(points[best])
    return model, np.flatnonzero(np.abs(distances(points, model)) <= threshold)
""",
        # floats times N
        """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        sample = []
        while len(sample) < 2:
            i = int(rng.random() * len(points))
            if i not in sample:
                sample.append(i)
        chosen = points[sample]
        if np.all(chosen[0] == chosen[1]):
            continue
        model = fit_line(chosen)
        inliers = np.flatnonzero(np.abs(distances(points, model)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no sample gave a model")
    model = fit_line(points[best])
    return model, np.flatnonzero(np.abs(distances(points, model)) <= threshold)
""",
        # shuffle of a list
        """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        order = list(range(len(points)))
        rng.shuffle(order)
        sample = order[:2]
        chosen = points[sample]
        if np.all(chosen[0] == chosen[1]):
            continue
        model = fit_line(chosen)
        inliers = np.flatnonzero(np.abs(distances(points, model)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no sample gave a model")
    model = fit_line(points[best])
    return model, np.flatnonzero(np.abs(distances(points, model)) <= threshold)
""",
        # choice of points
        """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        chosen = rng.choice(points, 2, replace=False)
        if np.all(chosen[0] == chosen[1]):
            continue
        model = fit_line(chosen)
        inliers = np.flatnonzero(np.abs(distances(points, model)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no sample gave a model")
    model = fit_line(points[best])
    return model, np.flatnonzero(np.abs(distances(points, model)) <= threshold)
""",
        # all at once by argsort
        """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    samples = np.argsort(rng.random((iterations, len(points))), axis=1)[:, :2]
    for i in range(iterations):
        sample = samples[i]
        chosen = points[sample]
        if np.all(chosen[0] == chosen[1]):
            continue
        model = fit_line(chosen)
        inliers = np.flatnonzero(np.abs(distances(points, model)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no sample gave a model")
    model = fit_line(points[best])
    return model, np.flatnonzero(np.abs(distances(points, model)) <= threshold)
""",
        # permuted
        """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    order = np.arange(len(points))
    for _ in range(iterations):
        sample = rng.permuted(order)[:2]
        chosen = points[sample]
        if np.all(chosen[0] == chosen[1]):
            continue
        model = fit_line(chosen)
        inliers = np.flatnonzero(np.abs(distances(points, model)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no sample gave a model")
    model = fit_line(points[best])
    return model, np.flatnonzero(np.abs(distances(points, model)) <= threshold)
""",
        # refits twice
        """
def ransac_line(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        sample = rng.choice(len(points), size=2, replace=False)
        chosen = points[sample]
        if np.all(chosen[0] == chosen[1]):
            continue
        model = fit_line(chosen)
        inliers = np.flatnonzero(np.abs(distances(points, model)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no sample gave a model")
    model = fit_line(points[best])
    best = np.flatnonzero(np.abs(distances(points, model)) <= threshold)
    model = fit_line(points[best])
    return model, np.flatnonzero(np.abs(distances(points, model)) <= threshold)
""",
        # vectorised by cross product
        """
def ransac_line(points, threshold, iterations, rng):
    n = len(points)
    i = rng.integers(0, n, iterations)
    j = rng.integers(0, n - 1, iterations)
    j = j + (j >= i)
    a, d = points[i], points[j] - points[i]
    length = np.hypot(d[:, 0], d[:, 1])
    keep = length > 0
    if not keep.any():
        raise ValueError("no line")
    a, d = a[keep], d[keep] / length[keep, None]
    normal = np.stack([-d[:, 1], d[:, 0]], axis=1)
    off = np.abs(points @ normal.T - np.sum(a * normal, axis=1))
    agree = off <= threshold * (1 + 1e-9)
    best = np.flatnonzero(agree[:, agree.sum(axis=0).argmax()])
    line = fit_line(points[best])
    return line, np.flatnonzero(np.abs(distances(points, line)) <= threshold)
""",
        # own line and complex numbers
        """
def ransac_line(points, threshold, iterations, rng):
    z = points[:, 0] + 1j * points[:, 1]
    best = []
    for _ in range(iterations):
        i, j = rng.choice(len(z), 2, replace=False)
        if z[i] == z[j]:
            continue
        u = (z[j] - z[i]) / abs(z[j] - z[i])
        inl = [k for k in range(len(z)) if abs(((z[k] - z[i]) * u.conjugate()).imag) <= threshold]
        if len(inl) > len(best):
            best = inl
    if not best:
        raise ValueError("nothing found")
    return fit_line(points[best]), best
""",
        # recursion
        """
def search(points, threshold, k, rng, best):
    if k == 0:
        return best
    i, j = rng.choice(len(points), size=2, replace=False)
    if (points[i] != points[j]).any():
        off = distances(points, fit_line(points[[i, j]]))
        agree = np.where(abs(off) <= threshold)[0]
        if len(agree) > len(best):
            best = agree
    return search(points, threshold, k - 1, rng, best)

def ransac_line(points, threshold, iterations, rng):
    best = np.zeros(0, dtype=int)
    for start in range(0, iterations, 200):
        best = search(points, threshold, min(200, iterations - start), rng, best)
    if best.size == 0:
        raise ValueError("no line")
    line = fit_line(points[best])
    return line, np.where(abs(distances(points, line)) <= threshold)[0]
""",
        # plain python
        """
def ransac_line(points, threshold, iterations, rng):
    pts = [(float(x), float(y)) for x, y in points]
    best, found = [], False
    for _ in range(iterations):
        i = j = 0
        while i == j:
            i, j = (int(v) for v in rng.integers(0, len(pts), size=2))
        (x1, y1), (x2, y2) = pts[i], pts[j]
        L = math.sqrt((x2 - x1) ** 2 + (y2 - y1) ** 2)
        if L == 0:
            continue
        found = True
        agree = []
        for k, (x, y) in enumerate(pts):
            if abs((x2 - x1) * (y1 - y) - (x1 - x) * (y2 - y1)) / L <= threshold:
                agree.append(k)
        if len(agree) > len(best):
            best = agree
    if not found:
        raise ValueError("no line")
    line = fit_line(points[best])
    return line, best
""",
    ],
    "Q3.6": [
        # recursion
        """
def more(points, index, threshold, iterations, min_points, rng):
    if len(index) < min_points or len(index) < 2:
        return []
    try:
        line, inliers = ransac_line(points[index], threshold, iterations, rng)
    except ValueError:
        return []
    if len(inliers) < min_points:
        return []
    rest = np.setdiff1d(np.arange(len(index)), inliers)
    return [(line, index[inliers]), *more(points, index[rest], threshold, iterations, min_points, rng)]

def find_walls(points, threshold, iterations, min_points, rng):
    return more(points, np.arange(len(points)), threshold, iterations, min_points, rng)
""",
        # sets
        """
def find_walls(points, threshold, iterations, min_points, rng):
    unused = set(range(len(points)))
    walls = []
    done = False
    while not done:
        order = sorted(unused)
        done = True
        if len(order) >= min_points and len(order) > 1:
            try:
                line, inliers = ransac_line(points[order], threshold, iterations, rng)
                members = [order[k] for k in inliers]
            except ValueError:
                members = []
            if members and len(members) >= min_points:
                walls.append((line, members))
                unused -= set(members)
                done = False
    return walls
""",
        # labels
        """
def find_walls(points, threshold, iterations, min_points, rng):
    label = np.full(len(points), -1)
    lines = []
    while True:
        rest = np.where(label < 0)[0]
        if len(rest) < min_points or len(rest) < 2:
            break
        try:
            line, agree = ransac_line(points[rest, :], threshold=threshold, iterations=iterations, rng=rng)
        except ValueError:
            break
        if len(agree) < min_points:
            break
        label[rest[agree]] = len(lines)
        lines.append(line)
    return [(line, np.where(label == k)[0]) for k, line in enumerate(lines)]
""",
    ],
    "Q2.3": [
        # svd
        """
def fit_line(points, weights=None):
    P = np.asarray(points, dtype=float)
    w = np.ones(len(P)) if weights is None else np.asarray(weights, dtype=float)
    P, w = P[w > 0], w[w > 0]
    if len(P) < 2:
        raise ValueError("at least two points")
    c = np.average(P, axis=0, weights=w)
    _, s, vt = np.linalg.svd((P - c) * np.sqrt(w)[:, None], full_matrices=False)
    if s[0] - s[1] <= 1e-9 * s[0] or s[0] == 0:
        raise ValueError("no direction")
    n = vt[1]
    r = n @ c
    if r < 0:
        n, r = -n, -r
    alpha = math.atan2(n[1], n[0])
    if alpha <= -math.pi:
        alpha = math.pi
    return Line(r=float(r), alpha=alpha)
""",
        # complex numbers
        """
import cmath
def fit_line(points, weights=None):
    pts = [complex(float(x), float(y)) for x, y in points]
    ws = [1.0] * len(pts) if weights is None else [float(w) for w in weights]
    if len(pts) < 2:
        raise ValueError("need two points")
    total = sum(ws)
    c = pts[0] + sum(w * (z - pts[0]) for w, z in zip(ws, pts)) / total
    second = sum(w * (z - c) ** 2 for w, z in zip(ws, pts))
    size = sum(w * abs(z - c) ** 2 for w, z in zip(ws, pts))
    if abs(second) <= 1e-9 * size:
        raise ValueError("undetermined")
    normal = 1j * cmath.sqrt(second / abs(second))
    r = (c * normal.conjugate()).real
    if r < 0:
        normal, r = -normal, -r
    alpha = cmath.phase(normal)
    return Line(r, alpha if alpha > -math.pi else math.pi)
""",
        # tries both stationary angles
        """
def fit_line(points, weights=None):
    p = np.asarray(points, dtype=np.float64)
    w = np.ones(p.shape[0]) if weights is None else np.asarray(weights, dtype=np.float64)
    if len(p) < 2 or len(np.unique(p[w > 0], axis=0)) < 2:
        raise ValueError("fewer than two different points")
    c = np.average(p, weights=w, axis=0)
    d = p - c
    sxx, syy, sxy = (w * d[:, 0] ** 2).sum(), (w * d[:, 1] ** 2).sum(), (w * d[:, 0] * d[:, 1]).sum()
    if np.isclose(sxx, syy, rtol=1e-9, atol=0) and abs(sxy) < 1e-9 * sxx:
        raise ValueError("equally wide")
    S = lambda a: sxx * np.cos(a) ** 2 + 2 * sxy * np.sin(a) * np.cos(a) + syy * np.sin(a) ** 2
    a0 = np.arctan2(-2 * sxy, syy - sxx) / 2
    alpha = min([a0, a0 + np.pi / 2], key=S)
    r = c @ [np.cos(alpha), np.sin(alpha)]
    if r < 0:
        r, alpha = -r, alpha + np.pi
    alpha = -((-alpha + np.pi) % (2 * np.pi) - np.pi)
    return Line(float(r), float(alpha))
""",
        # np.cov
        """
def fit_line(points, weights=None):
    pts = np.array(points, dtype=float)
    w = None if weights is None else np.array(weights, dtype=float)
    if len(pts) < 2:
        raise ValueError("too few")
    center = np.average(pts, axis=0, weights=w)
    C = np.cov((pts - center).T, aweights=w, ddof=0)
    trace, diff = C[0, 0] + C[1, 1], np.hypot(C[0, 0] - C[1, 1], 2 * C[0, 1])
    if diff <= 1e-9 * trace:
        raise ValueError("no line")
    alpha = np.arctan2(-2 * C[0, 1], C[1, 1] - C[0, 0]) / 2
    n = np.array([np.cos(alpha), np.sin(alpha)])
    if n @ center < 0:
        n = -n
    alpha = np.arctan2(n[1], n[0])
    return Line(n @ center, alpha)
""",
    ],
    "Q3.3": [
        # Decimal
        """
from decimal import Decimal, getcontext
def required_iterations(p, w, s):
    getcontext().prec = 60
    if p <= 0 or p >= 1 or w < 0 or w > 1:
        raise ValueError("range")
    if w == 0:
        return float("inf")
    if w == 1:
        return 1
    k = (1 - Decimal(p)).ln() / (1 - Decimal(w) ** s).ln()
    return int(k.to_integral_value(rounding="ROUND_CEILING"))
""",
        # Fraction with correction at the edge
        """
from fractions import Fraction
def required_iterations(p, w, s):
    if not (p > 0 and p < 1) or w > 1 or w < 0:
        raise ValueError("bad input")
    if w == 0:
        return math.inf
    if w == 1:
        return 1
    k = max(1, math.ceil(math.log1p(-p) / math.log1p(-(w ** s))))
    if k < 500:
        bad, may_fail = 1 - Fraction(w) ** s, 1 - Fraction(p)
        while k > 1 and bad ** (k - 1) <= may_fail:
            k -= 1
        while bad ** k > may_fail:
            k += 1
    return k
""",
    ],
}


def _changed(cell: str, pairs: list[tuple[str, str]]) -> str:
    for old, new in pairs:
        assert old in cell, f"{old!r} does not stand in {cell}"
        cell = cell.replace(old, new)
    return cell


RIGHT = {id: [*SOUND[id], *WAYS.get(id, ())] for id in SOUND}
WRONG = {
    id: [
        *(_changed(SOUND[id][place], pairs) for place, _, pairs in CHANGES.get(id, ())),
        *WHOLE.get(id, ()),
    ]
    for id in CHANGES
}
