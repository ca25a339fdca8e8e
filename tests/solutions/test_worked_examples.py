"""The examples that prompts work by hand, in every variant, against the references.

The inputs are made of the variables, and every number that the prompt gives as a result is
recomputed here, not by the prompt's own formulas.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from autograder.course import load_course
from solutions.lines.line_fitting import distances, fit_line, line_covariance
from solutions.lines.plane_fitting import fit_plane, plane_distances
from solutions.place_recognition.inverted_file import build_inverted_file, count_votes
from solutions.place_recognition.scoring import idf_weights, l1_scores
from solutions.place_recognition.words import assign_words, descend_tree
from solutions.ransac.adaptive import adaptive_stop, msac_cost
from solutions.ransac.probabilities import required_iterations

COURSE = load_course(Path(__file__).parents[2])
NUMBER = r"-?\d+(?:\.\d+)?"
VARIANTS = [
    (id, variant)
    for id, written in COURSE.varied.items()
    if (written.table["kind"] == "function" or id.startswith("Q2.2")) and written.variables
    for variant in range(written.variables.count)
]


def points_in(text: str) -> Iterator[tuple[float, ...]]:
    """All coordinates in round brackets, in the order of the text."""
    for found in re.finditer(rf"\(({NUMBER}(?:, ?{NUMBER})+)\)", text):
        yield tuple(float(number) for number in found[1].split(","))


def the_number(text: str, before: str) -> float:
    """The number after some words, which must be there."""
    found = re.search(re.escape(before) + rf"\s*({NUMBER})", text)
    assert found, before
    return float(found[1])


def words(text: str) -> None:
    *two, one, other, third = list(points_in(text))[:5]
    assert assign_words(np.array([one, other, third]), np.array(two)).tolist() == [0, 1, 1]
    squared = ((np.array([one, other, third])[:, None] - np.array(two)) ** 2).sum(axis=2)
    told = re.findall(rf"\$({NUMBER})\$ and \$({NUMBER})\$", text)
    assert [tuple(map(float, pair)) for pair in told] == [tuple(row) for row in squared]


def tree(text: str) -> None:
    found = list(points_in(text))
    levels = [np.array(found[:2]), np.array(found[2:6])]
    assert descend_tree(np.array(found[6]), levels) == 2
    assert found[7] == found[1]  # the nearer node of the first level, and of the second
    assert found[9] == found[4]


def inverted_file(text: str) -> None:
    first = int(the_number(text, "four words: image"))
    images = [[2, 0], [2, 0]]
    images[first] = [0, 1, 1]
    assert repr(build_inverted_file(images, 4)) in text
    assert f"word 1 in image {first} only" in text
    assert f"word 2 in image {1 - first}," in text


def votes(text: str) -> None:
    found = re.search(r"`(\[\[.*?\]\])`", text)
    assert found
    listed = [
        [int(n) for n in row.split(",") if n.strip()]
        for row in re.findall(r"\[([^\[\]]*)\]", found[1])
    ]
    assert len(listed) == 4
    told = count_votes([0, 1, 2], listed, 3)
    assert f"`{np.asarray(told).tolist()}`" in text
    one, two = listed[1][0], listed[2][1]
    assert f"images 0 and {one}, word 1 to image {one}, word 2 to the images 0 and {two}." in text


def weights(text: str) -> None:
    told = idf_weights(np.array(list(points_in(text))[:4]))
    assert np.allclose(told, [0, 0.693, 1.386, 0], atol=5e-4)


def scores(text: str) -> None:
    query, shares, far, far_shares, near, near_shares = list(points_in(text))
    for bag, divided in ((query, shares), (far, far_shares), (near, near_shares)):
        assert np.allclose(np.array(bag) / sum(bag), divided)
    told = re.findall(rf"\$((?:{NUMBER} \+ )+{NUMBER}) = ({NUMBER})\$", text)
    right = l1_scores(np.array(query), np.array([far, near]), np.ones(3))
    assert np.allclose([float(sum_) for _, sum_ in told], right)
    for bag, (terms, _) in zip((far_shares, near_shares), told, strict=True):
        apart = np.abs(np.array(shares) - bag)
        assert np.allclose([float(term) for term in terms.split("+")], apart)
    assert right[1] < right[0]


def line(text: str) -> None:
    *three, center = list(points_in(text))[:4]
    points = np.array(three)
    assert np.allclose(points.mean(axis=0), center)
    fitted = fit_line(points)
    assert math.isclose(fitted.r, the_number(text, r"\alpha = 0$ and $r ="))
    assert fitted.alpha == 0
    terms, total = re.findall(rf"S_\{{yy\}} = ((?:{NUMBER} \+ )+{NUMBER}) = ({NUMBER})", text)[0]
    squares = (points[:, 1] - center[1]) ** 2
    assert np.allclose([float(term) for term in terms.split("+")], squares)
    assert math.isclose(float(total), squares.sum())


def covariance(text: str) -> None:
    *three, center = [point for point in points_in(text) if len(point) == 2][:4]
    assert np.allclose(np.mean(three, axis=0), center)
    sigma = the_number(text, r"\sigma =")
    told = line_covariance(np.array(three), sigma)
    variance, of_angle, both = (
        float(re.findall(rf"= ({NUMBER})\$", text[text.index(words) :])[0])
        for words in ("the variance of $r$", r"that of $\alpha$", "the covariance is")
    )
    assert np.allclose(told, [[variance, both], [both, of_angle]], rtol=3e-3)
    assert math.isclose(fit_line(np.array(three)).r, the_number(text, r"\alpha = 0$, $r ="))


def iterations(text: str) -> None:
    p, w, good = (the_number(text, words) for words in ("$p =", "$w =", "with probability $"))
    answer = the_number(text, "the answer is")
    assert required_iterations(p, w, 2) == answer
    assert math.isclose(good, w**2)
    powers = re.findall(rf"\$({NUMBER})\^\{{(\d+)\}} \\approx ({NUMBER})\$", text)
    assert [int(k) for _, k, _ in powers] == [answer - 1, answer]
    for base, k, value in powers:
        assert math.isclose(float(base) ** int(k), float(value), rel_tol=6e-3)
    assert float(powers[0][2]) > 1 - p > float(powers[1][2])


def consensus(text: str) -> None:
    points = np.array(list(points_in(text))[:5])
    band = the_number(text, "a threshold of $")
    for pair, agreeing in (([0, 1], [0, 1, 2, 3]), ([3, 4], [3, 4])):
        near = np.abs(distances(points, fit_line(points[pair]))) <= band
        assert np.flatnonzero(near).tolist() == agreeing
    assert points[0, 1] == the_number(text, "the line $y =")


def plane(text: str) -> None:
    a, b, c, cross, normal, point = (np.array(p) for p in list(points_in(text))[:6])
    assert np.allclose(np.cross(b - a, c - a), cross)
    assert np.allclose(cross / np.linalg.norm(cross), normal)
    assert np.allclose((point - a) @ normal, the_number(text, r"\cdot (0,0,1) ="))
    far = plane_distances(point[None], fit_plane(np.array([a, b, c])))
    assert np.allclose(np.abs(far), 0.4)
    assert a[2] == the_number(text, "the plane $z =")


def walls(text: str) -> None:
    left = np.delete(np.arange(6), [0, 2, 3])
    found = [int(n) for n in re.findall(r"indices (\d) and (\d):", text)[0]]
    told = [int(n) for n in re.findall(r"these are the points (\d) and (\d)", text)[0]]
    assert left[found].tolist() == told


def stopping(text: str) -> None:
    agreeing = [
        int(the_number(text, "points,")),
        int(the_number(text, "with the first line,")),
        int(the_number(text, "with the second,")),
    ]
    p, stops = the_number(text, "$p ="), int(the_number(text, "stops after"))
    asked = [required_iterations(p, count / 100, 2) for count in agreeing[:2]]
    told = [int(n) for n in re.findall(r"asks for (\d+)", text)]
    assert asked == told
    assert stops == told[1]
    assert max(agreeing) == agreeing[1]
    assert adaptive_stop([*agreeing, *[30] * 200], 100, p) == stops


def cost(text: str) -> None:
    threshold = the_number(text, "a threshold of")
    total = float(re.findall(rf"= ({NUMBER})\$ m²", text)[0])
    assert math.isclose(msac_cost(np.array([0.1, -0.2, 5]), threshold), total)


# -- the derivation ------------------------------------------------------------------------------


def cost_of(points: np.ndarray, r: float, degrees: float) -> float:
    normal = np.array([math.cos(math.radians(degrees)), math.sin(math.radians(degrees))])
    return float(((r - points @ normal) ** 2).sum())


def least_cost(points: np.ndarray, degrees: float) -> float:
    alpha = math.radians(degrees)
    best = points.mean(axis=0) @ np.array([math.cos(alpha), math.sin(alpha)])
    return cost_of(points, best, degrees)


def sums(points: np.ndarray) -> list[float]:
    dx, dy = (points.mean(axis=0) - points).T
    return [dx @ dx, dy @ dy, dx @ dy]


def told_sums(text: str) -> list[float]:
    return [the_number(text, f"S_{{{which}}} =") for which in ("xx", "yy", "xy")]


def slope_in_r(text: str) -> None:
    (x, y), at = next(points_in(text)), the_number(text, "At $r =")
    point = np.array([[x, y]])
    slope = (cost_of(point, at + 0.5, 0) - cost_of(point, at - 0.5, 0)) / 1.0
    assert float(re.findall(rf"= ({NUMBER})\$\. Your", text)[0]) == slope != 0
    assert the_number(text, r"\sum_i x_i =") == x


def best_distance(text: str) -> None:
    one, other, center = list(points_in(text))
    middle = (np.array(one) + other) / 2
    assert middle.tolist() == list(center)
    assert [float(r) for r in re.findall(rf"at \$r = ({NUMBER})\$", text)] == list(center)


def least_costs(text: str) -> None:
    points = np.array(list(points_in(text))[:3])
    assert np.allclose(told_sums(text), sums(points))
    deviations = re.findall(rf"\$((?:{NUMBER}, ){{2}}{NUMBER})\$", text)
    for column, told in zip((points.mean(axis=0) - points).T, deviations, strict=True):
        assert [float(number) for number in told.split(",")] == column.tolist()
    at_0, at_45 = (
        the_number(text, "the cost is $"),
        float(re.findall(rf"= ({NUMBER})\$\.$", text)[0]),
    )
    assert math.isclose(at_0, least_cost(points, 0))
    assert math.isclose(at_45, least_cost(points, 45))
    squares = re.findall(rf"\(?({NUMBER})\)?\^2", text)
    assert np.allclose([float(n) for n in squares], (points.mean(axis=0) - points).sum(axis=1))


def with_sums(told: list[float]) -> np.ndarray:
    """Points with these sums, to compute costs of."""
    factor = np.linalg.cholesky([[told[0], told[2]], [told[2], told[1]]]).T
    return np.vstack([factor, -factor]) / math.sqrt(2)


def slope_in_alpha(text: str) -> None:
    points = with_sums(told_sums(text))
    below, above = (float(n) for n in re.findall(rf"\$({NUMBER})\$ at", text)[:2])
    assert np.allclose([below, above], [least_cost(points, 44), least_cost(points, 46)], atol=5e-3)
    change, slope = re.findall(rf"\$({NUMBER}) / 0\.0349 \\approx ({NUMBER})\$", text)[0]
    assert math.isclose(float(change), above - below, abs_tol=0.011)
    assert round(float(change) / math.radians(2)) == float(slope)


def second_slope(text: str) -> None:
    points, h = with_sums(told_sums(text)), 0.1
    slopes = [
        (least_cost(points, at + h) - least_cost(points, at - h)) / math.radians(2 * h)
        for at in (44, 46)
    ]
    told = [float(n) for n in re.findall(rf"\$({NUMBER})\$ at", text)[:2]]
    assert np.allclose(told, slopes, atol=6e-3)
    change, second = re.findall(rf"\$({NUMBER}) / 0\.0349 \\approx ({NUMBER})\$", text)[0]
    assert math.isclose(float(change), told[1] - told[0], abs_tol=0.011)
    assert round(float(change) / math.radians(2)) == float(second)


def angle(text: str) -> None:
    one, other, along = list(points_in(text))[:3]
    points = np.array([one, other])
    assert np.allclose(told_sums(text), sums(points))
    fitted = fit_line(points)
    assert math.isclose(fitted.alpha, math.atan2(along[1], along[0]))
    assert math.isclose(the_number(text, "at $"), math.degrees(fitted.alpha), abs_tol=0.05)
    assert math.isclose(the_number(text, "or $"), fitted.alpha, abs_tol=5e-4)


def both_angles(text: str) -> None:
    upright, turned = text.split("With $x$ and $y$ exchanged")
    for half in (upright, turned):
        one, other, along = list(points_in(half))
        points = np.array([one, other])
        assert np.allclose(told_sums(half), sums(points))
        fitted = fit_line(points).alpha
        assert math.isclose(fitted, math.atan2(along[1], along[0]))
        assert math.isclose(the_number(half, "at $"), math.degrees(fitted), abs_tol=0.05)


EXAMPLES: dict[str, Callable[[str], None]] = {
    "Q1.3": words, "Q1.4": tree, "Q1.5": inverted_file, "Q1.6": votes, "Q1.7": weights,
    "Q1.8": scores, "Q2.2a": slope_in_r, "Q2.2b": best_distance, "Q2.2c": least_costs,
    "Q2.2d": slope_in_alpha, "Q2.2e": angle, "Q2.2f1": second_slope, "Q2.2f2": both_angles,
    "Q2.3": line, "Q2.4": covariance, "Q3.3": iterations, "Q3.4": consensus,
    "Q3.5": plane, "Q3.6": walls, "Q3.7a": stopping, "Q3.7b": cost,
}  # fmt: skip


@pytest.mark.parametrize(("id", "variant"), VARIANTS)
def test_the_reference_says_what_the_prompt_works_out_by_hand(id, variant):
    prompt = COURSE.varied[id].question(variant).prompt
    (example,) = (part for part in prompt.split("\n\n") if part.startswith("By hand"))
    EXAMPLES[id](example)


def test_every_function_and_step_of_the_derivation_has_an_example_in_several_variants():
    written = {
        id
        for id, question in COURSE.questions.items()
        if question.kind == "function" or id.startswith("Q2.2")
    }
    assert written == EXAMPLES.keys() == {id for id, _ in VARIANTS}
    assert all(sum(id == other for other, _ in VARIANTS) > 1 for id in written)
