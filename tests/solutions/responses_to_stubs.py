"""More right and wrong responses, written from the prompts and stubs alone.

As in `responses.py`, each is a cell of code. A wrong one is a right one with something exchanged:
`WRONG` lists by question what stands in place of what in the first of its right ones.
"""

RIGHT = {
    "Q2.4": [
        # plain
        """
def f(points, sigma, weights=None):
    r, alpha = fit_line(points)
    u = np.array([-np.sin(alpha), np.cos(alpha)])
    c = points.mean(axis=0)
    b = (points - c) @ u
    B = (b**2).sum()
    t = c @ u
    return sigma**2 * np.array([[1/len(points) + t**2/B, t/B], [t/B, 1/B]])
""",
        # normal equations
        """
def f(points, sigma, weights=None):
    line = fit_line(points)
    x, y = points[:, 0], points[:, 1]
    u = -x*np.sin(line.alpha) + y*np.cos(line.alpha)
    A = np.stack([-np.ones(len(u)), u], axis=1)
    return np.linalg.inv(A.T @ A) * sigma**2
""",
        # polyfit
        """
def f(points, sigma, weights=None):
    line = fit_line(points)
    u = points @ [-math.sin(line.alpha), math.cos(line.alpha)]
    n = points @ [math.cos(line.alpha), math.sin(line.alpha)]
    N = len(u)
    S = np.array([[u @ u, u.sum()], [u.sum(), N]])
    K = np.linalg.solve(S, np.eye(2)) * sigma * sigma    # of slope and intercept of n over u
    return [[K[1, 1], -K[0, 1]], [-K[1, 0], K[0, 0]]]
""",
        # product of matrices
        """
def f(points, sigma, weights=None):
    alpha = fit_line(points).alpha
    n = len(points)
    mx = sum(p[0] for p in points) / n
    my = sum(p[1] for p in points) / n
    s, c = math.sin(alpha), math.cos(alpha)
    t = c*my - s*mx
    B = 0.0
    for px, py in points:
        B += (c*(py - my) - s*(px - mx))**2
    T = np.matrix([[1, t], [0, 1]])
    return T * np.diag([sigma**2/n, sigma**2/B]) * T.T
""",
        # complex
        """
def f(points, sigma, weights=None):
    line = fit_line(points)
    z = (points[:, 0] + 1j*points[:, 1]) * np.exp(-1j*line.alpha)
    pos = z.imag
    B = len(pos) * pos.var()
    t = pos.mean()
    C = np.zeros((2, 2))
    C[0, 0] = sigma**2 * (1/len(pos) + t*t/B)
    C[0, 1] = C[1, 0] = sigma**2 * t/B
    C[1, 1] = sigma**2 / B
    return C
""",
        # eigenvalue
        """
def f(points, sigma, weights=None):
    line = fit_line(points)
    q = points - np.mean(points, 0)
    B = np.linalg.eigvalsh(q.T @ q)[-1]
    t = np.mean(points, 0) @ np.array([-math.sin(line.alpha), math.cos(line.alpha)])
    v = sigma**2
    return ((v/len(points) + v*t**2/B, v*t/B), (v*t/B, v/B))
""",
        # own svd
        """
def f(points, sigma, weights=None):
    P = np.asarray(points, dtype=float)
    c = P.mean(axis=0)
    _, s, Vt = np.linalg.svd(P - c, full_matrices=False)
    n = Vt[1]
    if n @ c < 0:
        n = -n
    d = np.array([-n[1], n[0]])
    t = d @ c
    B = s[0]**2
    return sigma**2 * (np.diag([1/len(P), 0]) + np.outer([t, 1], [t, 1])/B)
""",
        # fsum
        """
def f(points, sigma, weights=None):
    r, a = fit_line(points)
    N = len(points)
    pos = [float(y)*math.cos(a) - float(x)*math.sin(a) for x, y in points]
    t = math.fsum(pos)/N
    B = math.fsum((q - t)**2 for q in pos)
    return np.reshape([sigma**2/N + (sigma*t)**2/B, sigma**2*t/B, sigma**2*t/B, sigma**2/B], (2, 2))
""",
        # total minus across
        """
def f(points, sigma, weights=None):
    line = fit_line(points)
    x, y = points.T
    xc, yc = x.mean(), y.mean()
    across = (x - xc)*np.cos(line.alpha) + (y - yc)*np.sin(line.alpha)
    B = np.sum((x - xc)**2) + np.sum((y - yc)**2) - np.sum(across**2)
    foot = np.array([line.r*np.cos(line.alpha), line.r*np.sin(line.alpha)])
    t = np.dot(np.array([xc, yc]) - foot, [-np.sin(line.alpha), np.cos(line.alpha)])
    return np.array([[1/len(x) + t**2/B, t/B], [t/B, 1/B]]) * sigma**2
""",
        # pinv of weighted design
        """
def f(points, sigma, weights=None):
    line = fit_line(points)
    u = np.einsum("ij,j->i", points, [-np.sin(line.alpha), np.cos(line.alpha)])
    J = np.linalg.pinv(np.c_[np.ones_like(u), -u])
    return J @ (np.eye(len(u))*sigma**2) @ J.T
""",
    ],
    "Q3.4": [
        # plain
        """
def f(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        pair = rng.choice(len(points), size=2, replace=False)
        if (points[pair[0]] == points[pair[1]]).all():
            continue
        line = fit_line(points[pair])
        inliers = np.flatnonzero(np.abs(distances(points, line)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no line")
    return fit_line(points[best]), best
""",
        # last line's indices
        """
def f(points, threshold, iterations, rng):
    best, count = None, 0
    for _ in range(iterations):
        p, q = rng.choice(points, size=2, replace=False)
        d = q - p
        length = math.hypot(d[0], d[1])
        if length == 0:
            continue
        n = np.array([-d[1], d[0]]) / length
        ok = abs((points - p) @ n) <= threshold
        if ok.sum() > count:
            best, count = ok, ok.sum()
    if best is None:
        raise ValueError("all samples were degenerate")
    line = fit_line(points[best])
    return line, np.where(abs(distances(points, line)) <= threshold)[0]
""",
        # vectorised
        """
def f(points, threshold, iterations, rng):
    n = len(points)
    if n < 2 or iterations < 1:
        raise ValueError("nothing to draw")
    i = rng.integers(n, size=iterations)
    j = (i + rng.integers(1, n, size=iterations)) % n
    d = points[j] - points[i]
    length = np.hypot(d[:, 0], d[:, 1])
    good = length > 0
    if not good.any():
        raise ValueError("no line")
    i, d, length = i[good], d[good], length[good]
    normal = np.stack([d[:, 1], -d[:, 0]], axis=1) / length[:, None]
    offset = np.sum(normal * points[i], axis=1)
    agree = np.abs(normal @ points.T - offset[:, None]) <= threshold
    best = agree[np.argmax(agree.sum(axis=1))]
    return fit_line(points[best]), best.nonzero()[0]
""",
        # permutation and lists
        """
def f(points, threshold, iterations, rng):
    best = []
    for k in range(iterations):
        i, j = rng.permutation(len(points))[:2]
        (x1, y1), (x2, y2) = points[i], points[j]
        if x1 == x2 and y1 == y2:
            continue
        a, b = y1 - y2, x2 - x1
        c = -(a*x1 + b*y1)
        inliers = [m for m, (x, y) in enumerate(points)
                   if abs(a*x + b*y + c) / math.sqrt(a*a + b*b) <= threshold]
        if len(inliers) >= len(best):
            best = inliers
    if not best:
        raise ValueError("no sample gave a line")
    return fit_line(points[best]), best[::-1]
""",
        # rejection and svd
        """
def f(points, threshold, iterations, rng):
    def through(pts):
        c = pts.mean(axis=0)
        n = np.linalg.svd(pts - c)[2][-1]
        r = n @ c
        if r < 0:
            n, r = -n, -r
        return Line(float(r), float(np.arctan2(n[1], n[0])))
    best_line, best_set = None, np.empty(0, int)
    done = 0
    while done < iterations:
        i, j = rng.integers(0, len(points), 2)
        if i == j:
            continue
        done += 1
        if np.allclose(points[i], points[j], rtol=0, atol=1e-15):
            continue
        line = through(points[[i, j]])
        inl = np.argwhere(np.abs(distances(points, line)) <= threshold).ravel()
        if best_line is None or inl.size > best_set.size:
            best_line, best_set = line, inl
    if best_line is None:
        raise ValueError
    return through(points[best_set]), best_set
""",
        # functional
        """
def f(points, threshold, iterations, rng):
    def hypothesis():
        a, b = points[rng.choice(len(points), 2, replace=False, shuffle=False)]
        if np.array_equal(a, b):
            return frozenset()
        z = complex(*(b - a))
        z /= abs(z)
        off = [(complex(*(p - a)) * z.conjugate()).imag for p in points]
        return frozenset(i for i, o in enumerate(off) if -threshold <= o <= threshold)
    best = max((hypothesis() for _ in range(iterations)), key=len, default=frozenset())
    if not best:
        raise ValueError("no line found")
    best = sorted(best)
    line = fit_line(points[best])
    return (line.r, line.alpha), best
""",
        # random argsort
        """
def f(points, threshold, iterations, rng):
    pairs = [np.argsort(rng.random(len(points)))[:2] for _ in range(iterations)]
    votes = []
    for i, j in pairs:
        v = points[j] - points[i]
        if not v.any():
            continue
        w = points - points[i]
        cross = v[0]*w[:, 1] - v[1]*w[:, 0]
        votes.append(cross**2 <= threshold**2 * (v @ v))
    if not votes:
        raise ValueError("No pair of different points was drawn.")
    mask = max(votes, key=np.count_nonzero)
    idx, = np.nonzero(mask)
    return [fit_line(points[idx]), idx.tolist()]
""",
        # eigenvectors
        """
def f(points, threshold, iterations, rng):
    n_best, best = -1, None
    for _ in range(iterations):
        i = rng.integers(len(points))
        j = rng.integers(len(points) - 1)
        if j >= i:
            j += 1
        if np.linalg.norm(points[i] - points[j]) < 1e-12:
            continue
        alpha = np.arctan2(points[j, 0] - points[i, 0], points[i, 1] - points[j, 1])
        r = points[i, 0]*np.cos(alpha) + points[i, 1]*np.sin(alpha)
        if r < 0:
            r, alpha = -r, (alpha + np.pi if alpha <= 0 else alpha - np.pi)
        dist = np.fabs(distances(points, Line(r, alpha)))
        agreeing = np.arange(len(points))[dist <= threshold]
        if len(agreeing) > n_best:
            n_best, best = len(agreeing), agreeing
    if best is None:
        raise ValueError("nothing found")
    q = points[best]
    c = q.mean(axis=0)
    w, V = np.linalg.eigh((q - c).T @ (q - c))
    n = V[:, 0]
    r = n @ c
    if r < 0:
        n, r = -n, -r
    return Line(r, np.arctan2(n[1], n[0])), best
""",
        # keeps the model
        """
def f(points, threshold, iterations, rng):
    best_model, best_count = None, 0
    for _ in range(iterations):
        idx = np.arange(len(points))
        rng.shuffle(idx)
        sample = points[idx[:2]]
        if np.all(sample[0] == sample[1]):
            continue
        model = fit_line(sample)
        count = np.count_nonzero(np.abs(distances(points, model)) <= threshold)
        if count > best_count:
            best_model, best_count = model, count
    if best_model is None:
        raise ValueError("no model")
    inliers = np.nonzero(np.abs(distances(points, best_model)) <= threshold)[0]
    refined = fit_line(points[inliers])
    inliers = np.nonzero(np.abs(distances(points, refined)) <= threshold)[0]
    return refined, inliers
""",
    ],
    "Q3.5": [
        # plain
        """
def f(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        a, b, c = points[rng.choice(len(points), size=3, replace=False)]
        n = np.cross(b - a, c - a)
        length = np.linalg.norm(n)
        if length == 0:
            continue
        inliers = np.flatnonzero(np.abs((points - a) @ (n/length)) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no plane")
    return fit_plane(points[best]), best
""",
        # small tolerance
        """
def f(points, threshold, iterations, rng):
    best, plane = None, None
    for _ in range(iterations):
        triple = rng.choice(len(points), 3, replace=False)
        a, b, c = points[triple]
        n = np.cross(b - a, c - a)
        if np.linalg.norm(n) <= 1e-9 * np.linalg.norm(b - a) * np.linalg.norm(c - a):
            continue
        model = fit_plane(points[triple])
        ok = np.abs(plane_distances(points, model)) <= threshold
        if best is None or ok.sum() > best.sum():
            best = ok
    if best is None:
        raise ValueError("no plane")
    plane = fit_plane(points[best])
    return plane, np.flatnonzero(np.abs(plane_distances(points, plane)) <= threshold)
""",
        # rank
        """
def f(points, threshold, iterations, rng):
    best = []
    for _ in range(iterations):
        idx = rng.permutation(len(points))[:3]
        tri = points[idx]
        if np.linalg.matrix_rank(tri - tri.mean(axis=0)) < 2:
            continue
        plane = fit_plane(tri)
        inliers = [i for i in range(len(points))
                   if abs(np.dot(points[i], plane.normal) - plane.r) <= threshold]
        if len(inliers) > len(best):
            best = inliers
    if not best:
        raise ValueError("no plane found")
    return fit_plane(points[best]), best
""",
        # vectorised
        """
def f(points, threshold, iterations, rng):
    if iterations < 1 or len(points) < 3:
        raise ValueError("no sample")
    idx = np.array([rng.choice(len(points), 3, replace=False) for _ in range(iterations)])
    a, b, c = points[idx[:, 0]], points[idx[:, 1]], points[idx[:, 2]]
    n = np.cross(b - a, c - a)
    size = np.sqrt(np.einsum("ij,ij->i", n, n))
    usable = size > 1e-12
    if not usable.any():
        raise ValueError("all samples on one line")
    n, a = n[usable] / size[usable, None], a[usable]
    d = np.abs(points @ n.T - np.sum(n * a, axis=1))
    hits = d <= threshold
    inliers = np.flatnonzero(hits[:, hits.sum(axis=0).argmax()])
    return fit_plane(points[inliers]), inliers
""",
        # determinants
        """
def f(points, threshold, iterations, rng):
    count, found = 0, None
    for _ in range(iterations):
        i, j, k = rng.choice(len(points), 3, replace=False)
        (x1, y1, z1), (x2, y2, z2), (x3, y3, z3) = points[i], points[j], points[k]
        A = (y2-y1)*(z3-z1) - (z2-z1)*(y3-y1)
        B = (z2-z1)*(x3-x1) - (x2-x1)*(z3-z1)
        C = (x2-x1)*(y3-y1) - (y2-y1)*(x3-x1)
        L = (A**2 + B**2 + C**2) ** 0.5
        if L == 0:
            continue
        D = A*x1 + B*y1 + C*z1
        inl = set()
        for m, (x, y, z) in enumerate(points.tolist()):
            if abs(A*x + B*y + C*z - D) <= threshold * L:
                inl.add(m)
        if len(inl) > count:
            count, found = len(inl), inl
    if found is None:
        raise ValueError("only points on a line")
    found = sorted(found)
    return fit_plane(points[found]), tuple(found)
""",
        # own eigh refit
        """
def f(points, threshold, iterations, rng):
    best = None
    for _ in range(iterations):
        s = set()
        while len(s) < 3:
            s.add(int(rng.integers(len(points))))
        a, b, c = points[list(s)]
        u = b - a
        v = c - a
        n = np.array([u[1]*v[2]-u[2]*v[1], u[2]*v[0]-u[0]*v[2], u[0]*v[1]-u[1]*v[0]])
        if np.allclose(n, 0, atol=1e-14):
            continue
        n = n / math.sqrt(n @ n)
        r = n @ a
        if r < 0:
            n, r = -n, -r
        d = plane_distances(points, Plane(tuple(n), r))
        inl = np.where((d >= -threshold) & (d <= threshold))[0]
        if best is None or len(inl) > len(best):
            best = inl
    if best is None:
        raise ValueError("degenerate")
    q = points[best] - points[best].mean(0)
    w, V = np.linalg.eigh(q.T @ q)
    n = V[:, 0]
    r = float(n @ points[best].mean(0))
    if r < 0:
        n, r = -n, -r
    return Plane(n, r), best
""",
        # max over hypotheses
        """
def f(points, threshold, iterations, rng):
    N = len(points)
    sets = []
    for _ in range(iterations):
        t = points[rng.choice(N, size=3, replace=False)]
        s = np.linalg.svd(t - t.mean(axis=0), compute_uv=False)
        if s[1] <= 1e-10 * s[0] or s[0] == 0:
            continue
        sets.append(np.flatnonzero(np.abs(plane_distances(points, fit_plane(t))) <= threshold))
    if len(sets) == 0:
        raise ValueError("no plane")
    best = max(sets, key=len)
    return (fit_plane(points[best]), best)
""",
        # homogeneous
        """
def f(points, threshold, iterations, rng):
    best = np.zeros(len(points), dtype=bool)
    for _ in range(iterations):
        i = rng.choice(len(points), 3, replace=False)
        t = points[i]
        c = t.mean(axis=0)
        A = t - c
        if np.linalg.norm(np.cross(A[1] - A[0], A[2] - A[0])) < 1e-12:
            continue
        n = np.linalg.svd(A)[2][2]
        mask = np.abs(points.dot(n) - n.dot(c)) <= threshold
        if np.sum(mask) > np.sum(best):
            best = mask.copy()
    if not best.any():
        raise ValueError("no sample gave a plane")
    plane = fit_plane(points[best])
    normal, r = plane
    return (list(normal), r), np.flatnonzero(best).astype(np.int32)
""",
    ],
    "Q3.6": [
        # plain
        """
def f(points, threshold, iterations, min_points, rng):
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
        # mask
        """
def f(points, threshold, iterations, min_points, rng):
    free = np.ones(len(points), dtype=bool)
    walls = []
    while free.sum() >= min_points:
        index = np.flatnonzero(free)
        try:
            line, inl = ransac_line(points[free], threshold, iterations, rng)
        except ValueError:
            break
        if len(inl) < min_points:
            break
        free[index[inl]] = False
        walls.append((line, index[inl]))
    return walls
""",
        # recursion
        """
def f(points, threshold, iterations, min_points, rng, names=None):
    if names is None:
        names = list(range(len(points)))
    if len(points) < min_points:
        return []
    line, inl = ransac_line(points, threshold, iterations, rng)
    if len(inl) < min_points:
        return []
    taken = set(int(i) for i in inl)
    rest = [i for i in range(len(points)) if i not in taken]
    wall = (line, [names[i] for i in sorted(taken)])
    names = [names[i] for i in rest]
    return [wall] + f(points[rest], threshold, iterations, min_points, rng, names)
""",
        # setdiff
        """
def f(points, threshold, iterations, min_points, rng):
    left = np.arange(len(points))
    found = []
    while True:
        if len(left) < min_points:
            return found
        line, inliers = ransac_line(points[left], threshold, iterations, rng)
        wall = left[inliers]
        if wall.size < min_points:
            return found
        found.append((line, wall))
        left = np.setdiff1d(left, wall)
""",
        # generator
        """
def f(points, threshold, iterations, min_points, rng):
    def walls():
        left = np.array(range(len(points)))
        while left.size and left.size >= min_points:
            line, inliers = ransac_line(points[left], threshold, iterations, rng)
            if not len(inliers) >= min_points:
                return
            yield line, left[np.asarray(inliers)]
            left = left[~np.isin(np.arange(left.size), inliers)]
    return list(walls())
""",
        # columns
        """
def f(points, threshold, iterations, min_points, rng):
    data = np.column_stack([np.arange(len(points)), points])
    result = []
    for _ in range(len(points)):
        if data.shape[0] < min_points:
            break
        line, inl = ransac_line(data[:, 1:], threshold, iterations, rng)
        if len(inl) < min_points:
            break
        result.append([line, data[inl, 0].astype(int)])
        data = np.delete(data, inl, axis=0)
    return result
""",
        # own indices
        """
def f(points, threshold, iterations, min_points, rng):
    left = list(range(len(points)))
    walls = ()
    while len(left) >= min_points:
        try:
            line, _ = ransac_line(points[left], threshold, iterations, rng)
        except ValueError:
            return list(walls)
        near = np.abs(distances(points[left], line)) <= threshold
        if near.sum() < min_points:
            break
        walls += ((line, np.array(left)[near]),)
        left = [i for i, n in zip(left, near) if not n]
    return walls
""",
        # wall number
        """
def f(points, threshold, iterations, min_points, rng):
    label = np.full(len(points), -1)
    lines = []
    while np.count_nonzero(label == -1) >= min_points:
        open_ = np.nonzero(label == -1)[0]
        line, ind = ransac_line(points[open_], threshold, iterations, rng)
        if len(ind) < min_points:
            break
        label[open_[ind]] = len(lines)
        lines.append(line)
    return [(line, np.nonzero(label == k)[0]) for k, line in enumerate(lines)]
""",
    ],
    "Q3.7a": [
        # plain
        """
def f(agreeing, N, p):
    best = 0
    for drawn, count in enumerate(agreeing, start=1):
        best = max(best, count)
        if drawn >= required_iterations(p, best / N, 2):
            return drawn
    return len(agreeing)
""",
        # accumulate
        """
def f(agreeing, N, p):
    best = np.maximum.accumulate(agreeing)
    need = np.array([required_iterations(p, b/N, 2) for b in best])
    enough = np.flatnonzero(np.arange(1, len(best) + 1) >= need)
    return int(enough[0]) + 1 if len(enough) else len(agreeing)
""",
        # own formula
        """
def f(agreeing, N, p):
    n = 0
    w = 0.0
    k = math.inf
    while n < k and n < len(agreeing):
        w = max(w, agreeing[n] / N)
        k = 1 if w >= 1 else math.ceil(math.log(1 - p) / math.log(1 - w*w))
        n += 1
    return n
""",
        # smallest need
        """
def f(agreeing, N, p):
    need = float("inf")
    for i in range(len(agreeing)):
        need = min(need, required_iterations(p, agreeing[i]/N, 2))
        if i + 1 >= need:
            break
    return i + 1
""",
        # next
        """
def f(agreeing, N, p):
    return next((k for k in range(1, len(agreeing) + 1)
                 if k >= required_iterations(p, max(agreeing[:k]) / N, 2)), len(agreeing))
""",
        # itertools
        """
def f(agreeing, N, p):
    from itertools import accumulate
    for k, best in enumerate(accumulate(agreeing, max), 1):
        if required_iterations(p, float(best) / N, 2) <= k:
            return np.int64(k)
    return np.int64(k)
""",
        # only on improvement computes
        """
def f(agreeing, N, p):
    best, needed = 0, np.inf
    drawn = 0
    for count in agreeing.tolist():
        drawn += 1
        if count > best:
            best = count
            needed = required_iterations(p, best / N, 2)
        if drawn >= needed:
            break
    return drawn
""",
        # probability of failure
        """
def f(agreeing, N, p):
    best = 0
    for k, a in enumerate(agreeing, 1):
        best = a if a > best else best
        if (1 - (best/N)**2)**k <= 1 - p:
            return k
    return len(agreeing)
""",
        # recursion
        """
def f(agreeing, N, p, k=1):
    if k == len(agreeing) or required_iterations(p, np.max(agreeing[:k]) / N, 2) <= k:
        return float(k)
    import sys
    sys.setrecursionlimit(100000)
    return f(agreeing, N, p, k + 1)
""",
    ],
    "Q3.7b": [
        # minimum
        """
def f(offsets, threshold):
    return np.minimum(offsets**2, threshold**2).sum()
""",
        # clip
        """
def f(offsets, threshold):
    return float(np.sum(np.clip(offsets, -threshold, threshold)**2))
""",
        # where
        """
def f(offsets, threshold):
    d = np.abs(offsets)
    return np.where(d <= threshold, d**2, threshold**2).sum()
""",
        # loop
        """
def f(offsets, threshold):
    cost = 0
    for d in offsets:
        if abs(d) < threshold:
            cost += d * d
        else:
            cost += threshold * threshold
    return cost
""",
        # comprehension
        """
def f(offsets, threshold):
    return sum(min(d**2, threshold**2) for d in offsets)
""",
        # copy
        """
def f(offsets, threshold):
    squares = np.square(offsets)
    squares[squares > threshold**2] = threshold**2
    return math.fsum(squares)
""",
        # two sums
        """
def f(offsets, threshold):
    inside = offsets[np.abs(offsets) <= threshold]
    return inside @ inside + (len(offsets) - len(inside)) * threshold**2
""",
        # norm
        """
def f(offsets, threshold):
    return np.linalg.norm(np.minimum(abs(offsets), threshold))**2
""",
        # identity
        """
def f(offsets, threshold):
    a, b = offsets**2, threshold**2
    return np.array(0.5 * (a + b - np.abs(a - b)).sum())
""",
        # scaled
        """
def f(offsets, threshold):
    scaled = offsets / threshold
    return threshold**2 * np.fmin(scaled**2, 1).sum()
""",
        # lists
        """
def f(offsets, threshold):
    squares = list(map(lambda d: pow(float(d), 2), offsets))
    limit = pow(threshold, 2)
    return math.fsum(limit if s >= limit else s for s in squares)
""",
    ],
}

_Pairs = list[tuple[str, str]]

_SIGMA, _LAST = "sigma**2 * np.array", "[[1/len(points) + t**2/B, t/B], [t/B, 1/B]]"
_CHOICE = "rng.choice(len(points), size=2, replace=False)"
_EQUAL = "(points[pair[0]] == points[pair[1]]).all()"
_OFF = "np.abs(distances(points, line)) <= threshold"
_TRIPLE = "rng.choice(len(points), size=3, replace=False)"
_BAND = "np.abs((points - a) @ (n/length)) <= threshold"
_TAKEN = "left[np.abs(distances(points[left], line)) > {} * threshold]"
_LOOKED_UP = "[points[:, {0}].tolist().index(one[{0}]) for one in points[left[inliers]]]"
_LOOP = "range(iterations)"
_BETTER = "len(inliers) > len(best)"
_NO_LINE, _NO_PLANE = 'raise ValueError("no line")', 'raise ValueError("no plane")'
_BEST_LINE, _BEST_PLANE = (
    "return fit_line(points[best]), best",
    "return fit_plane(points[best]), best",
)
_EMPTY = "best = np.array([], dtype=int)"

# One change each, or several at once.
CHANGES: dict[str, list[_Pairs]] = {
    "Q2.4": [
        [("(points - c) @ u", "points @ u")],
        [("(points - c) @ u", "points[:, 0] - c[0]")],
        [("(points - c) @ u", "np.linalg.norm(points - c, axis=1)")],
        [("(points - c) @ u", "points @ u - np.median(points @ u)")],
        [("[-np.sin(alpha), np.cos(alpha)]", "[np.sin(alpha), -np.cos(alpha)]")],
        [("[-np.sin(alpha), np.cos(alpha)]", "[np.cos(alpha), np.sin(alpha)]")],
        [("[-np.sin(alpha), np.cos(alpha)]", "[np.cos(alpha), -np.sin(alpha)]")],
        [("r, alpha = fit_line(points)", "alpha = fit_line(points).alpha % np.pi")],
        [("r, alpha = fit_line(points)", "alpha = abs(fit_line(points).alpha)")],
        [("(b**2).sum()", "(b**2).mean()")],
        [("(b**2).sum()", "b.var(ddof=1)")],
        [("(b**2).sum()", "np.sqrt((b**2).sum())")],
        [("(b**2).sum()", "np.abs(b).sum()**2")],
        [("(b**2).sum()", "np.ptp(b)**2")],
        [("(b**2).sum()", "len(points) * np.ptp(b)**2 / 12")],
        [("(b**2).sum()", "b[0]**2 + b[-1]**2")],
        [("t = c @ u", "t = abs(c @ u)")],
        [("t = c @ u", "t = c @ u - r")],
        [("t = c @ u", "t = b.mean()")],
        [("t = c @ u", "t = (c - points[0]) @ u")],
        [("t = c @ u", "t = np.median(points @ u)")],
        [("t = c @ u", "t = np.linalg.norm(c)")],
        [("t = c @ u", "t = max(c @ u, 0)")],
        [("t = c @ u", "t = min(c @ u, 10)")],
        [("t**2/B", "t/B")],
        [(" + t**2/B", " - t**2/B")],
        [(" + t**2/B", "")],
        [("1/len(points) + ", "")],
        [("1/len(points)", "1/(len(points) - 1)")],
        [("t/B], [t/B", "t/B], [-t/B")],
        [("t/B], [t/B", "t**2/B], [t**2/B")],
        [(_LAST, "[[1/B, t/B], [t/B, 1/len(points) + t**2/B]]")],
        [(_LAST, "[1/len(points) + t**2/B, 1/B]")],
        [("sigma**2", "sigma")],
        [("sigma**2", "2*sigma**2")],
        [("sigma**2", "0.02**2")],
        [("sigma**2", "sigma**2 * len(points)/(len(points) - 2)")],
        [("sigma**2", "np.var(points @ [np.cos(alpha), np.sin(alpha)])")],
        [("b = (points - c)", "points -= c\n    b = points")],
        [("return sigma", "return np.cov(points.T) if len(points) else sigma")],
    ],
    "Q3.4": [
        [(_OFF, "distances(points, line) <= threshold")],
        [(_OFF, "distances(points, line)**2 <= threshold")],
        [(_OFF, "np.sqrt(np.abs(distances(points, line))) <= threshold")],
        [(_OFF, "np.abs(distances(points, line)) <= threshold / 2")],
        [(_OFF, "np.abs(distances(points, line)) <= 1.2 * threshold")],
        [(_OFF, "np.abs(distances(points, line)) <= 0.1")],
        [(_OFF, "np.round(np.abs(distances(points, line)), 1) <= threshold")],
        [(_LOOP, "range(300)")],
        [(_LOOP, "range(10)")],
        [(_LOOP, "range(min(iterations, 50))")],
        [(_LOOP, "range(iterations - 1)")],
        [(_LOOP, "range(iterations + 1)")],
        [(_LOOP, "range(2 * iterations)")],
        [(_LOOP, "range(iterations // 2)")],
        [(_CHOICE, "np.random.choice(len(points), size=2, replace=False)")],
        [(_CHOICE, "rng.choice(len(points) - 1, size=2, replace=False)")],
        [(_CHOICE, "rng.choice(len(points) // 2, size=2, replace=False)")],
        [(_CHOICE, "rng.choice(min(len(points), 26), size=2, replace=False)")],
        [(_CHOICE, "rng.choice(len(points), size=3, replace=False)")],
        [(_CHOICE, "np.array([0, rng.integers(1, len(points))])")],
        [(_CHOICE, "rng.integers(len(points) - 1) + np.arange(2)")],
        [(_EQUAL, "False")],
        [(_EQUAL, "(points[pair[0]] == points[pair[1]]).any()")],
        [(_EQUAL, "points[pair[0], 0] == points[pair[1], 0]")],
        [(_EQUAL, "points[pair[0], 1] == points[pair[1], 1]")],
        [(_EQUAL, "np.linalg.norm(points[pair[0]] - points[pair[1]]) < 0.5")],
        [(_EQUAL, "np.linalg.norm(points[pair[0]] - points[pair[1]]) < threshold")],
        [("continue", "break")],
        [("continue", "raise ValueError('equal points')")],
        [(_BETTER, "True")],
        [(_BETTER, "len(best) == 0")],
        [(_BETTER, "len(best) == 0 or len(inliers) < len(best)")],
        [(_BETTER, f"{_BETTER} and len(inliers) > 2")],
        [(_BETTER, f"{_BETTER} and len(inliers) > len(points) / 2")],
        [("best = inliers", "best = np.union1d(best, inliers)"), (_BETTER, "True")],
        [(_EMPTY, f"{_EMPTY}\n    points -= points.mean(axis=0)")],
        [(_EMPTY, f"{_EMPTY}\n    points.sort(axis=0)")],
        [(_EMPTY, f"{_EMPTY}\n    points = points[np.argsort(points[:, 0])]")],
        [(_EMPTY, f"{_EMPTY}\n    points = np.unique(points, axis=0)")],
        [(_EMPTY, f"{_EMPTY}\n    rng = np.random.default_rng(0)")],
        [(_NO_LINE, "return None")],
        [(_NO_LINE, "return Line(0.0, 0.0), best")],
        [(_NO_LINE, "raise RuntimeError('no line')")],
        [("if len(best) == 0", "if len(best) < 3")],
        [("best = inliers", "best, kept = inliers, line"), (_BEST_LINE, "return kept, best")],
        [(_BEST_LINE, "return fit_line(points), best")],
        [(_BEST_LINE, "return fit_line(points[best])")],
        [(_BEST_LINE, "return fit_line(points[best]), points[best]")],
        [(_BEST_LINE, "return fit_line(points[best]), best + 1")],
        [(_BEST_LINE, "return fit_line(points[best]), np.setdiff1d(best, pair)")],
        [(_BEST_LINE, "return fit_line(points[best]), best.astype(float)")],
        [(_BEST_LINE, "return best, fit_line(points[best])")],
        [(_BEST_LINE, "return fit_line(points[best])[::-1], best")],
        [(_BEST_LINE, "r, a = fit_line(points[best])\n    return Line(-r, a), best")],
        [(_BEST_LINE, "r, a = fit_line(points[best])\n    return Line(r, math.degrees(a)), best")],
        [
            (
                _BEST_LINE,
                f"line = fit_line(points[best])\n    best = {_OFF}\n    return line, best",
            )
        ],
        [
            (
                _BEST_LINE,
                f"line = fit_line(points[best])\n    wide = np.flatnonzero({_OFF} * 3)\n"
                "    return fit_line(points[wide]), best",
            )
        ],
    ],
    "Q3.5": [
        [(_LOOP, "range(2 * iterations)")],
        [(_LOOP, "range(iterations // 2)")],
        [(_BAND, "np.abs((points - a) @ n) <= threshold")],
        [(_BAND, "np.abs((points - a) @ n) <= threshold * length**2")],
        [(_BAND, "(points - a) @ (n/length) <= threshold")],
        [(_BAND, "((points - a) @ (n/length))**2 <= threshold")],
        [(_BAND, "np.abs((points - a) @ (n/length)) <= threshold / 2")],
        [(_BAND, "np.abs((points - a) @ (n/length)) <= 0.05")],
        [(_BAND, "np.abs((points - a) @ (n/n[2])) <= threshold")],
        [(_BAND, "np.linalg.norm(points - a, axis=1) <= threshold")],
        [("np.linalg.norm(n)", "np.linalg.norm(n) / 2")],
        [("np.linalg.norm(n)", "np.abs(n).sum()")],
        [("np.linalg.norm(n)", "np.abs(n).max()")],
        [("np.cross(b - a, c - a)", "np.cross(b, c)")],
        [("np.cross(b - a, c - a)", "np.cross(b - a, c)")],
        [("np.cross(b - a, c - a)", "(b - a) * (c - a)")],
        [("np.cross(b - a, c - a)", "np.linalg.solve([a, b, c], np.ones(3))")],
        [("length == 0", "length < 1e-2")],
        [("length == 0", "length < 1e-3")],
        [("length == 0", "length == 0 or np.linalg.norm(b - a) < threshold")],
        [("length == 0", "length == 0 or abs(a @ n) < threshold * length")],
        [("continue", "break")],
        [("continue", "raise ValueError('on a line')")],
        [(_LOOP, "range(400)")],
        [(_LOOP, "range(20)")],
        [(_LOOP, "range(1, iterations)")],
        [(_TRIPLE, "rng.choice(len(points), size=4, replace=False)[:3]")],
        [(_TRIPLE, "rng.choice(len(points) - 1, size=3, replace=False)")],
        [(_TRIPLE, "rng.integers(len(points) - 2) + np.arange(3)")],
        [(_TRIPLE, "np.random.permutation(len(points))[:3]")],
        [(_BETTER, "True")],
        [(_BETTER, f"{_BETTER} and len(inliers) > 3")],
        [(_EMPTY, f"{_EMPTY}\n    points -= points.mean(axis=0)")],
        [(_NO_PLANE, "return None")],
        [(_BEST_PLANE, "return fit_plane(points), best")],
        [(_BEST_PLANE, "return best, fit_plane(points[best])")],
        [(_BEST_PLANE, "return fit_plane(points[best])[::-1], best")],
        [(_BEST_PLANE, "return fit_plane(points[best]), points[best]")],
        [(_BEST_PLANE, "n, r = fit_plane(points[best])\n    return Plane(n, -r), best")],
        [(_BEST_PLANE, "n, r = fit_plane(points[best])\n    return Plane(np.abs(n), r), best")],
        [
            ("best = inliers", "best, kept = inliers, np.array([a, b, c])"),
            (_BEST_PLANE, "return fit_plane(kept), best"),
        ],
        [
            ("best = inliers", "best, kept = inliers, fit_plane(np.array([a, b, c]))"),
            (
                _BEST_PLANE,
                "wide = np.abs(plane_distances(points, kept)) <= 3 * threshold\n"
                "    return fit_plane(points[wide]), best",
            ),
        ],
    ],
    "Q3.6": [
        [("left[inliers]", "inliers")],
        [("left[inliers]", "points[left[inliers]]")],
        [("left[inliers]", "np.isin(np.arange(len(points)), left[inliers])")],
        [("(line, left[inliers])", "line")],
        [("(line, left[inliers])", "(left[inliers], line)")],
        [("(line, left[inliers])", "(fit_line(points), left[inliers])")],
        [("(line, left[inliers])", "(walls[0][0] if walls else line, left[inliers])")],
        [("len(inliers) < min_points", "len(inliers) < 2")],
        [("len(inliers) < min_points", "len(inliers) < 20")],
        [("len(inliers) < min_points", "len(inliers) <= min_points")],
        [("len(inliers) < min_points", "len(inliers) < min_points - 1")],
        [("len(inliers) < min_points", "len(inliers) < 2 * min_points")],
        [("len(inliers) < min_points", "walls and len(inliers) < min_points")],
        [("len(inliers) < min_points", "len(inliers) < 0.1 * len(points)")],
        [("len(left) >= min_points", "len(left) > min_points")],
        [("len(left) >= min_points", "len(left) >= 2 * min_points")],
        [("len(left) >= min_points", "len(left) > 0")],
        [("len(left) >= min_points", "True")],
        [("len(left) >= min_points", "len(left) >= min_points and len(walls) < 2")],
        [("len(left) >= min_points", "len(left) >= min_points and len(walls) < 3")],
        [("threshold, iterations, rng", "threshold / 2, iterations, rng")],
        [("threshold, iterations, rng", "0.1, iterations, rng")],
        [("threshold, iterations, rng", "threshold, 100, rng")],
        [("threshold, iterations, rng", "threshold, 5, rng")],
        [("threshold, iterations, rng", "threshold, 2 * iterations, rng")],
        [("threshold, iterations, rng", "threshold, iterations - bool(walls), rng")],
        [("threshold, iterations, rng", "threshold, iterations // (len(walls) + 1), rng")],
        [("threshold, iterations, rng", "threshold, iterations * len(left) // len(points), rng")],
        [("np.delete(left, inliers)", _TAKEN.format(2))],
        [("np.delete(left, inliers)", _TAKEN.format(1.3))],
        [("left[inliers]", _LOOKED_UP.format(0))],
        [("left[inliers]", _LOOKED_UP.format(1))],
        [("threshold, iterations, rng", "threshold, iterations, np.random.default_rng(0)")],
        [
            (
                "np.delete(left, inliers)",
                "np.delete(left, inliers)\n        threshold = threshold / 2",
            )
        ],
        [("return walls", "return walls[::-1]")],
        [("return walls", "return walls[:-1]")],
        [("return walls", "return walls or None")],
        [("return walls", "return dict(enumerate(walls))")],
        [("return walls", "return sorted(walls, key=lambda wall: len(wall[1]))")],
        [("return walls", "return [part for wall in walls for part in wall]")],
        [("walls = []", "walls = []\n    points -= points.mean(axis=0)")],
        [("left[inliers]))", "left[inliers]))\n        break")],
    ],
    "Q3.7a": [
        [("max(best, count)", "count")],
        [("max(best, count)", "max(agreeing)")],
        [("max(best, count)", "min(N, best + count)")],
        [("max(best, count)", "np.mean(agreeing[:drawn])")],
        [("max(best, count)", "np.median(agreeing[:drawn])")],
        [("best = 0", "best = N"), ("max(best, count)", "min(best, count)")],
        [("drawn >= required", "drawn > required")],
        [("drawn >= required", "drawn == required")],
        [("if drawn >=", "if count == best and drawn >=")],
        [("start=1", "start=0")],
        [("enumerate(agreeing", "enumerate(sorted(agreeing)")],
        [("return drawn", "return drawn - 1")],
        [("return drawn", "return required_iterations(p, best / N, 2)")],
        [("best / N, 2)", "best / N, 1)")],
        [("best / N, 2)", "best / N, 3)")],
        [("best / N, 2)", "1 - best / N, 2)")],
        [("best / N, 2)", "best // N, 2)")],
        [("best / N, 2)", "round(best / N, 2), 2)")],
        [("best / N, 2)", "min(1, best / 100), 2)")],
        [("best / N, 2)", "min(1, best / (N - 1)), 2)")],
        [("best / N, 2)", "min(1, best / len(agreeing)), 2)")],
        [("best / N, 2)", "(best - 2) / (N - 2), 2)")],
        [("best / N, 2)", "best / N, 2) - 1")],
        [("(p, best", "(0.99, best")],
        [("(p, best", "(0.95, best")],
        [("return len(agreeing)", "return None")],
        [("return len(agreeing)", "return math.inf")],
        [("return len(agreeing)", "return len(agreeing) - 1")],
        [("return len(agreeing)", "return len(agreeing) + 1")],
        [("return len(agreeing)", "return required_iterations(p, best / N, 2)")],
        [("required_iterations(p, best / N, 2)", "math.log(1 - p) / math.log(1 - (best/N)**2)")],
        [
            (
                "        best = max(best, count)",
                "        best = agreeing[drawn - 1] = max(best, count)",
            )
        ],
    ],
    "Q3.7b": [
        [("offsets**2", "offsets")],
        [("offsets**2, threshold**2", "offsets**2, threshold")],
        [("offsets**2, threshold**2", "np.abs(offsets), threshold")],
        [("offsets**2, threshold**2", "np.abs(offsets), threshold**2")],
        [("offsets**2, threshold**2", "offsets**2, 0.09")],
        [("offsets**2, threshold**2", "offsets**2, (threshold / 2)**2")],
        [("offsets**2, threshold**2", "(offsets / threshold)**2, 1")],
        [("offsets**2, threshold**2", "np.unique(offsets)**2, threshold**2")],
        [("offsets**2, threshold**2", "np.array([*{*offsets}])**2, threshold**2")],
        [("offsets**2, threshold**2", "offsets[:3]**2, threshold**2")],
        [("offsets**2, threshold**2", "offsets[:-1]**2, threshold**2")],
        [("offsets**2, threshold**2", "offsets[np.abs(offsets) < 10]**2, threshold**2")],
        [("np.minimum(offsets**2, threshold**2)", "(np.minimum(offsets, threshold)**2)")],
        [("np.minimum(offsets**2, threshold**2)", "(np.clip(offsets, 0, threshold)**2)")],
        [("np.minimum", "np.maximum")],
        [("np.minimum", "0.5 * np.minimum")],
        [(".sum()", ".mean()")],
        [(".sum()", "")],
        [(".sum()", ".astype(int).sum()")],
        [("return ", "return -")],
        [("return ", "return str"), ("np.min", "(np.min"), (".sum()", ".sum())")],
        [("return ", "return round"), ("np.min", "(np.min"), (".sum()", ".sum(), 4)")],
        [("return ", "return np.sqrt"), ("np.min", "(np.min"), (".sum()", ".sum())")],
        [("return ", "offsets[np.abs(offsets) > threshold] = threshold\n    return ")],
        [("return ", "offsets **= 2\n    return "), ("offsets**2, ", "offsets, ")],
        [("return ", "if len(offsets) == 0: raise ValueError\n    return ")],
        [("return ", "if max(abs(offsets)) == 0: return 0.0\n    return ")],
        [("return ", "return np.median(offsets) if len(offsets) == 20 else ")],
    ],
}


def _changed(cell: str, pairs: _Pairs) -> str:
    for old, new in pairs:
        assert cell.count(old) >= 1, f"{old!r} does not stand in {cell}"
        cell = cell.replace(old, new)
    return cell


WRONG = {
    id: [_changed(RIGHT[id][0], pairs) for pairs in changes] for id, changes in CHANGES.items()
}
