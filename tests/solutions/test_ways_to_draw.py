"""However a function draws its samples, by any method of the generator, right work is right."""

import numpy as np
import pytest
from given import what_a_chapter_gives
from msgspec import structs

from autograder.marking.draw import draw
from autograder.questions.registry import kind_of
from autograder.sandbox.inside.evaluate import evaluate
from solutions.lines.line_fitting import distances, fit_line

LINE = """
def ransac_line(points, threshold, iterations, rng):
    n, s, best = len(points), 2, []
    for _ in range(iterations):
        {draw}
        two = points[list(pick)]
        if np.array_equal(two[0], two[1]):
            continue
        agree = np.flatnonzero(np.abs(distances(points, fit_line(two))) <= threshold)
        if len(agree) > len(best):
            best = agree
    if len(best) == 0:
        raise ValueError("no line")
    return fit_line(points[best]), best
"""
PLANE = """
def ransac_plane(points, threshold, iterations, rng):
    n, s, best = len(points), 3, []
    for _ in range(iterations):
        {draw}
        a, b, c = points[list(pick)]
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        if length <= 1e-12 * np.linalg.norm(b - a) * np.linalg.norm(c - a):
            continue
        agree = np.flatnonzero(np.abs((points - a) @ (normal / length)) <= threshold)
        if len(agree) > len(best):
            best = agree
    if len(best) == 0:
        raise ValueError("no plane")
    return fit_plane(points[best]), best
"""
# How the indices of a sample of s out of n points are drawn: what stands in the loop.
WAYS = """
pick = rng.choice(a=n, size=s, replace=False)

pick = rng.choice(n, s, False)

pick = rng.choice(range(n), s, replace=False)

pick = rng.choice(list(range(n)), s, replace=False)

pick = rng.choice(np.arange(n), size=(s,), replace=False)

pick = rng.choice(n, s, replace=False, p=None, axis=0, shuffle=False)

pick = rng.choice(n, s, False, np.ones(n) / n)

rows = rng.choice(points, s, replace=False)
pick = [int(np.flatnonzero((points == row).all(axis=1))[0]) for row in rows]

pick = []
while len(pick) < s:
    k = rng.choice(n)
    if k not in pick:
        pick.append(k)

pick = []
for _k in range(s):
    pick.append(rng.choice([k for k in range(n) if k not in pick]))

pick = rng.choice(n, s)
while len(set(pick)) < s:
    pick = rng.choice(n, s)

pick = rng.permutation(n)[:s]

pick = rng.permutation(np.arange(n))[-s:]

pick = rng.permutation(x=n)[:s]

pick = rng.permutation(list(range(n)))[:s]

pick = np.arange(n)
rng.shuffle(pick)
pick = pick[:s]

pick = np.arange(n)
rng.shuffle(x=pick)
pick = pick[:s]

pick = list(range(n))
rng.shuffle(pick)
pick = pick[:s]

pick = rng.permuted(np.arange(n))[:s]

pick = np.arange(n)
rng.permuted(pick, out=pick)
pick = pick[:s]

pick = np.argsort(rng.random(n))[:s]

pick = np.argsort(rng.random(size=n))[:s]

pick = np.argpartition(rng.random(n), s - 1)[:s]

pick = np.argsort(rng.normal(size=n))[:s]

pick = np.argsort(rng.standard_normal(n))[:s]

pick = np.argsort(rng.uniform(size=n))[:s]

pick = np.argsort(rng.uniform(0, 1, n))[:s]

pick = np.argsort(rng.exponential(size=n))[:s]

pick = sorted(range(n), key=lambda k: rng.random())[:s]

pick = rng.integers(n, size=s)
while len(set(pick.tolist())) < s:
    pick = rng.integers(n, size=s)

pick = rng.integers(low=0, high=n, size=s)
while len(np.unique(pick)) < s:
    pick = rng.integers(low=0, high=n, size=s)

pick = rng.integers(0, n - 1, endpoint=True, size=s)
while len(np.unique(pick)) < s:
    pick = rng.integers(0, n - 1, endpoint=True, size=s)

pick = set()
while len(pick) < s:
    pick.add(int(rng.integers(n)))
pick = list(pick)

pick = []
while len(pick) < s:
    k = int(rng.random() * n)
    if k not in pick:
        pick.append(k)

pick = []
while len(pick) < s:
    k = math.floor(rng.uniform(0, n))
    if k not in pick:
        pick.append(k)

pick = list(range(n))
for k in range(s):
    m = int(rng.integers(k, n))
    pick[k], pick[m] = pick[m], pick[k]
pick = pick[:s]

pick = rng.multivariate_hypergeometric([1] * n, s).nonzero()[0]

left = list(range(n))
pick = [left.pop(rng.integers(len(left))) for _k in range(s)]

pick = rng.choice(np.arange(n, dtype=np.int32), np.int64(s), replace=False)

pick = np.sort(rng.choice(n, s, replace=False))
""".strip().split("\n\n")
NAMES = {
    "np": np,
    "distances": distances,
    "fit_line": fit_line,
    **what_a_chapter_gives("3_ransac", "Plane", "fit_plane"),
}


@pytest.fixture(scope="module")
def drawn(real_course):
    """The two questions that draw samples, made ready without their mistakes, which take time."""
    made = {}
    for id in ("Q3.4", "Q3.5"):
        question = real_course.questions[id]
        answer = structs.replace(real_course.key[id], alternatives=())
        made[id] = question, answer, draw(question, answer, 1, real_course.root)
    return made


def earns(drawn, id, name, loop, way):
    question, answer, probe = drawn[id]
    names = dict(NAMES)
    exec(loop.format(draw=way.replace("\n", "\n        ")), names)
    reply = evaluate(names[name], probe.probe)
    return kind_of(question).mark(question, answer, probe, reply).credit


@pytest.mark.parametrize("way", WAYS)
def test_any_way_to_draw_a_sample_earns_everything(drawn, way):
    assert earns(drawn, "Q3.4", "ransac_line", LINE, way) == 1


@pytest.mark.parametrize("way", WAYS[::3])
def test_a_sample_of_three_may_be_drawn_in_any_way_too(drawn, way):
    assert earns(drawn, "Q3.5", "ransac_plane", PLANE, way) == 1
