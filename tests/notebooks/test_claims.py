"""What the prose, the explanations and the feedback say in numbers is computed here.

One line a claim: where it stands, the words, and what must fill their braces. A number that no
longer holds, or words that were changed, fail alike.
"""

import math
import re
from collections.abc import Iterator
from functools import cache
from itertools import permutations
from pathlib import Path
from typing import Any

import cv2
import msgspec
import numpy as np
import pytest

import data
from autograder.course import load_course
from notebooks.figures.consensus import few_points
from notebooks.two_views import two_views
from solutions.lines.line_fitting import distances, fit_line, line_covariance
from solutions.ransac import exact_probabilities as exact
from solutions.ransac.fast.consensus import ransac_plane
from solutions.ransac.line import ransac_line
from solutions.ransac.probabilities import (
    candidate_count,
    outlier_model_probability,
    required_iterations,
    success_probability,
)

MASTERS = {path.stem: path for path in Path("notebooks/source").glob("*.py")}
COURSE = load_course()  # formulas in its texts are filled in


@cache
def words_of(place: str) -> str:
    """The text of a master, of a chapter's key or, as "asked CHAPTER", of its questions."""
    if place in MASTERS:
        text = re.sub(r"^# ?", "", MASTERS[place].read_text(encoding="utf-8"), flags=re.M)
    else:
        asked, chapter = place.startswith("asked "), place.removeprefix("asked ")
        ids = [id for id, question in COURSE.questions.items() if question.chapter == chapter]
        found = [COURSE.question(id) if asked else COURSE.key[id] for id in ids]
        more = COURSE.chapter(chapter).predictions if asked else ()
        text = " ".join(_texts(msgspec.to_builtins([*found, *more])))
    return " ".join(text.split())


def _texts(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict | list | tuple):
        for entry in value.values() if isinstance(value, dict) else value:
            yield from _texts(entry)


def wall() -> np.ndarray:
    """The wall of chapter 2: points 77 to 130 of scan 161."""
    scans = data.killian_court()
    ranges = scans.ranges[161]
    return np.column_stack([ranges * np.cos(scans.angles), ranges * np.sin(scans.angles)])[77:131]


def seen_points() -> int:
    """How many beams of all scans met something nearer than 30 m."""
    return int((data.killian_court().ranges < 30).sum())


def size_of_the_building() -> float:
    """The longer side of a box round all poses, in metres."""
    return float(np.ptp(data.killian_court().poses[:, :2], axis=0).max())


def share_of_the_largest_plane() -> float:
    points = data.brick_walls().points
    found = ransac_plane(points, 0.02, 300, np.random.default_rng(0))
    assert found is not None
    return len(found.inliers) / len(points)


def centered_sums(x: list[list[float]]) -> np.ndarray:
    """Centred sums S_xx, S_yy and S_xy of a few points."""
    dx, dy = (np.mean(x, axis=0) - x).T
    return np.array([dx @ dx, dy @ dy, dx @ dy])


THREE = np.array([[0.0, 0], [1, 1], [2, 5]])  # chapter 2's example


def cost_at(degrees: float) -> float:
    """The cost of the three points for an angle, with the best r, from its definition."""
    offsets = THREE @ [math.cos(math.radians(degrees)), math.sin(math.radians(degrees))]
    return float(((offsets - offsets.mean()) ** 2).sum())


def slope_at(degrees: float) -> float:
    """The slope of that cost in the angle, by a small difference."""
    step = 1e-4
    rise = cost_at(degrees + math.degrees(step)) - cost_at(degrees - math.degrees(step))
    return float(rise / (2 * step))


@cache
def shares_that_keep_nine_of_ten() -> tuple[float, float]:
    """Of runs with a clean sample: which keep 90 % of the inliers, before and after the refit.

    An independent simulation of the chapter's: 200 points of a wall of one metre, 5 mm off.
    """
    rng = np.random.default_rng(1)
    kept = []
    for _ in range(1500):
        points = np.column_stack([rng.random(200), rng.normal(0, 0.005, 200)])
        best = np.zeros(200, dtype=bool)
        for _ in range(rng.binomial(74, 0.04)):
            a, b = points[rng.choice(200, 2, replace=False)]
            normal = np.array([a[1] - b[1], b[0] - a[0]]) / math.dist(a, b)
            agree = np.abs((points - a) @ normal) <= 0.0125
            best = agree if agree.sum() > best.sum() else best
        if best.any():
            again = np.abs(distances(points, fit_line(points[best]))) <= 0.0125
            kept.append((best.mean() >= 0.9, again.mean() >= 0.9))
    before, after = np.mean(kept, axis=0)
    return float(before), float(after)


def repaired() -> float:
    """The share of runs with a clean sample, but too few inliers, that the refit repairs."""
    before, after = shares_that_keep_nine_of_ten()
    return (after - before) / (1 - before)


def fits_of_noisy_walls() -> np.ndarray:
    """How far lines refitted to new errors are from the true one, in deviations of the formula.

    At (runs, positions) along the wall.
    """
    points, rng = wall(), np.random.default_rng(0)
    line = fit_line(points)
    normal = np.array([math.cos(line.alpha), math.sin(line.alpha)])
    along = points @ [-normal[1], normal[0]]
    true = np.outer(np.full(len(points), line.r), normal) + np.outer(along, [-normal[1], normal[0]])
    C = line_covariance(points, 0.02)
    positions = np.linspace(along.min(), along.max(), 41)
    off = []
    for _ in range(1500):
        r, alpha = fit_line(true + rng.normal(0, 0.02, true.shape))
        off.append((r - line.r) - positions * math.remainder(alpha - line.alpha, 2 * math.pi))
    variance = C[0, 0] - 2 * positions * C[0, 1] + positions**2 * C[1, 1]
    return np.abs(off) / np.sqrt(variance)


N, W, P = 1000, 0.2, 0.95
PLANES = required_iterations(P, W, 3)

# Where, the words with braces for what is computed, and what is computed.
CLAIMS = [
    ("1_place_recognition", "{} photographs of a walk", len(data.campus_photographs())),
    ("1_place_recognition", "{} comparisons instead of a million", 10 * round(math.log10(10**6))),
    ("1_place_recognition", "Eight children, three levels: {} words", 8**3),
    ("1_place_recognition", "8 comparisons at each of 3 levels, not {}", 8**3),
    ("1_place_recognition", "*each* of the {} photographs", 20 + len(data.campus_queries())),
    ("1_place_recognition", "The voting array is A {}, B {}, C {}", (1, 1 + 1 + 1, 0)),
    ("2_line_fitting", "a beam in each of {} directions", len(data.killian_court().angles)),
    ("2_line_fitting", "distance $5 \\cdot 1 + 1 \\cdot 0 - 2 = {}$", 5 * 1 + 1 * 0 - 2),
    (
        "2_line_fitting",
        "gives $S_{{xx}} = {:.0f}$, $S_{{yy}} = {:.0f}$ and $S_{{xy}} = {:.0f}$",
        tuple(centered_sums([[0, 0], [1, 1], [2, 5]])),
    ),
    ("2_line_fitting", "*one* of the {} points", len(wall())),
    (
        "2_line_fitting",
        "for this scanner by about {:.0f} cm",
        100 * np.std(distances(wall(), fit_line(wall()))),
    ),
    ("3_ransac", "among {} points", len(few_points())),
    ("3_ransac", "\\log 0.01 / \\log 0.5 = {:.2f}$", math.log(0.01) / math.log(0.5)),
    ("3_ransac", "a heap of {:,} points", seen_points()),
    ("3_ransac", "made {} scans", len(data.killian_court().ranges)),
    ("3_ransac", "more than {} metres", 100 * int(size_of_the_building() // 100)),
    ("ransac", "log(0.05) / log(0.96) = {:.2f}", math.log(1 - P) / math.log(1 - W**2)),
    ("ransac", "the first whole number that is enough is {}", required_iterations(P, W, 2)),
    ("ransac", "N(N-1)/2 = {}", candidate_count(N, 2)),
    ("ransac", "about one in {:.0f} of them", candidate_count(N, 2) / 74),
    ("ransac", "= 0.96^42 = {:.2f}", outlier_model_probability(W, 2, 42)),
    ("ransac", "0.96^100 = {:.3f}", outlier_model_probability(W, 2, 100)),
    ("ransac", "1 - 0.017 = {:.3f}", success_probability(W, 2, 100)),
    ("ransac", "log(0.05) / log(0.992) = {:.2f}", math.log(1 - P) / math.log(1 - W**3)),
    ("ransac", "372.97: {} iterations", PLANES),
    (
        "ransac",
        "with 373 iterations the true probability is {:.3f}",
        exact.success_probability(N, 200, 3, PLANES),
    ),
    ("ransac", "{:.2f} belongs to samples of three points", success_probability(W, 3, 100)),
    ("ransac", "{:.2f} belongs to samples of three points", outlier_model_probability(W, 3, 42)),
    ("ransac", "1/w² = {:.0f} is how long it takes on average", 1 / W**2),
    ("ransac", "with a threshold of 0.01 m that lets points pass that are {} m away", 0.01**0.5),
    ("asked ransac", "0.75^{{16}} \\approx {:.5f}$", 0.75**16),
    ("asked ransac", "0.75^{{17}} \\approx {:.4f}$", 0.75**17),
    ("asked ransac", "the answer is {}.", required_iterations(0.99, 0.5, 2)),
    (
        "asked line_fitting",
        "points along $(2, 1)$, at ${:.1f}°$, or ${:.3f}$ in radians",
        (math.degrees(math.atan2(1, 2)), math.atan2(1, 2)),
    ),
    (
        "asked line_fitting",
        "points along $(1, 2)$, at ${:.1f}°$",
        math.degrees(math.atan2(2, 1)),
    ),
    ("asked line_fitting", "the cost is $(3^2 + 1^2 + (-4)^2) / 2 = {:.0f}$", cost_at(45)),
    (
        "asked line_fitting",
        "the cost is ${:.2f}$ at $44°$ and ${:.2f}$ at $46°$",
        (cost_at(44), cost_at(46)),
    ),
    ("asked line_fitting", "is about $0.42 / 0.0349 \\approx {:.0f}$", slope_at(45)),
    (
        "asked line_fitting",
        "the slope is ${:.2f}$ at $44°$ and ${:.2f}$ at $46°$",
        (slope_at(44), slope_at(46)),
    ),
    (
        "asked line_fitting",
        "is about $-0.70 / 0.0349 \\approx {:.0f}$",
        (slope_at(45.5) - slope_at(44.5)) / math.radians(1),
    ),
    ("asked line_fitting", "S_{{yy}} = 4 + 1 + 9 = {}$", 4 + 1 + 9),
    ("asked place_recognition", "$\\ln(4/2) \\approx {:.3f}$", math.log(4 / 2)),
    ("asked place_recognition", "$\\ln(4/1) \\approx {:.3f}$", math.log(4 / 1)),
]


@pytest.mark.parametrize(("place", "words", "computed"), CLAIMS)
def test_what_is_said_in_numbers_is_so(place, words, computed):
    said = words.format(*(computed if isinstance(computed, tuple) else (computed,)))
    assert said in words_of(place)


def says(place: str, words: str) -> None:
    assert words in words_of(place), f"{place} no longer says {words!r}: is it still true?"


def test_the_count_without_replacement_is_74_for_lines_and_378_for_planes():
    says("3_ransac", "For lines it makes no difference in the end, for planes it costs a few")
    assert exact.required_iterations(P, N, 200, 2) == required_iterations(P, W, 2) == 74
    assert exact.required_iterations(P, N, 200, 3) == 378
    assert PLANES == 373
    assert 378 in [entry.value for entry in COURSE.key["Q3.2.5"].alternatives if entry.credit == 1]


def test_the_refit_repairs_about_four_of_five_runs():
    says("3_ransac", "those that kept less than 90 % before. The refit repairs about four of five")
    assert 0.7 <= repaired() <= 0.9


def test_the_band_holds_at_each_position_and_less_often_for_the_whole_line():
    says("2_line_fitting", "At each position along the wall, the line lies in the band")
    says("2_line_fitting", "(The whole line stays inside less often")
    inside = fits_of_noisy_walls() <= 1.96
    assert np.all(np.abs(inside.mean(axis=0) - 0.95) < 0.025)
    assert inside.all(axis=1).mean() < 0.91


def test_the_largest_plane_of_the_cloud_holds_two_fifths_of_its_points():
    says("asked ransac", "The largest plane of the cloud holds about two fifths of the points")
    assert 0.35 <= share_of_the_largest_plane() <= 0.45


def test_after_25_iterations_a_third_of_the_runs_has_no_clean_sample():
    says("ransac", "After 25 iterations about a third of the runs still have none")
    assert 0.3 < outlier_model_probability(W, 2, 25) < 0.4


def test_the_slips_of_the_sheet_are_named_where_they_are_met():
    for chapter, words in (
        ("2_line_fitting", "it derives the equation from Pythagoras"),
        ("2_line_fitting", "it calls outliers *measurement noise*"),
        ("2_line_fitting", "where it begins with"),
        ("2_line_fitting", "it writes this slope as a *product of two sums*"),
        ("2_line_fitting", "it ends with the plain"),
        ("3_ransac", "it calls $w$ the *inlier count* and $p$ the *probability of all inliers*"),
    ):
        says(chapter, f"> *For readers of the sheet:* {words}")


def test_who_has_no_sheet_can_pass_over_every_remark_on_it():
    """Apart from the first page, the sheet stands only in asides that begin alike."""
    for path in MASTERS.values():
        blocks = re.split(r"\n# *\n|\n\n", path.read_text(encoding="utf-8"))
        named = [block for block in blocks if re.search(r"\b(the|exercise) sheet\b", block, re.I)]
        for block in named if path.stem != "0_start_here" else []:
            assert "> *For readers of the sheet:*" in block
            assert len(block.split()) < 60
    for chapter in ("place_recognition", "line_fitting", "ransac"):
        assert "exercise sheet" not in words_of(chapter)
        assert "exercise sheet" not in words_of(f"asked {chapter}")


def agreeing(one: str, other: str) -> int:
    """How many matches of two photographs agree with one geometry."""
    images = {**data.campus_photographs(), **data.campus_queries()}
    sift = cv2.SIFT.create(1000)
    found = [sift.detectAndCompute(images[name], None) for name in (one, other)]
    return int(two_views(found[0], found[1]).agree.sum())


def test_matches_of_different_places_agree_by_chance_up_to_14_times():
    says("1_place_recognition", "nine or ten agree in most, and never more than 14")
    assert agreeing("0508", "0513") <= 14
    assert 7 <= agreeing("0513", "0506") <= 14


@pytest.mark.long
def test_no_pair_of_different_places_has_more_than_14_agreeing_matches():
    images = {**data.campus_photographs(), **data.campus_queries()}
    sift = cv2.SIFT.create(1000)
    found = {name: sift.detectAndCompute(image, None) for name, image in images.items()}
    known = data.same_place_pairs(by_eye=True) | data.undecided_pairs()
    counts = [
        two_views(found[one], found[other]).agree.sum()
        for one, other in permutations(images, 2)
        if frozenset((one, other)) not in known
    ]
    assert max(counts) == 14
    assert np.mean(np.isin(counts, (9, 10))) > 0.5


def test_one_loop_is_found_from_both_of_its_ends():
    says("1_place_recognition", "On the walk 22 loops could be closed: eleven pairs")
    says("1_place_recognition", "For the queries there are eleven")
    walk, queries = set(data.campus_photographs()), set(data.campus_queries())
    pairs = data.same_place_pairs(by_eye=True)
    assert sum(pair <= walk for pair in pairs) == 11
    assert sum(len(pair & walk) == 1 and len(pair & queries) == 1 for pair in pairs) == 11


def test_a_second_refit_hardly_moves_the_line_of_the_scan():
    says("3_ransac", "a second refit moves the line by less than two millimetres in most runs")
    scans = data.killian_court()
    ranges = scans.ranges[161]
    points = np.column_stack([ranges * np.cos(scans.angles), ranges * np.sin(scans.angles)])
    moved = []
    for seed in range(9):
        line, inliers = ransac_line(points, 0.06, 100, np.random.default_rng(seed))
        moved.append(abs(fit_line(points[inliers]).r - line.r))
    assert np.mean(np.array(moved) < 0.002) > 0.6


def test_the_two_slopes_differ_by_about_a_quarter():
    says("2_line_fitting", "two slopes, the second about a quarter larger than the first")
    x, y = wall().T
    ratio = 1 / (np.polyfit(x, y, 1)[0] * np.polyfit(y, x, 1)[0])
    assert 1.2 < ratio < 1.3
    (prediction,) = [p for p in COURSE.chapter("line_fitting").predictions if p.id == "P2.1"]
    assert "they differ by a quarter or so" in prediction.choices
