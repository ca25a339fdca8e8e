"""Every picture shows itself once, says what it shows, and copes with functions not yet written."""

import math
import subprocess
import sys
from typing import Any

import cv2
import numpy as np
import pytest
import sympy as sp

import data
from notebooks import figures
from notebooks.explorers.journey import Functions, Journey
from notebooks.explorers.still import ransac_run
from notebooks.figures import chances, style


@pytest.fixture
def shown(monkeypatch) -> list[dict[str, Any]]:
    """What the pictures handed to the notebook: bundle and metadata."""
    pictures: list[dict[str, Any]] = []

    def display(bundle, *, raw, metadata):
        assert raw
        pictures.append({"bundle": bundle, "metadata": metadata["image/png"]})

    monkeypatch.setattr(style, "display", display)
    return pictures


def stub(*args: Any) -> Any:
    raise NotImplementedError


def broken(*args: Any) -> Any:
    raise ZeroDivisionError


POINTS = np.column_stack([np.linspace(0, 3, 20), 1 + 0.1 * np.sin(np.arange(20))])
SCANS = data.killian_court()
WALK = dict(list(data.campus_photographs().items())[:3])
SPACE = data.brick_walls()
PAIRS = data.same_place_pairs()


def rng() -> np.random.Generator:
    return np.random.default_rng(0)


def small_journey(*functions: Any) -> Journey:
    """The journey of 0491 through two places with 60 features each."""
    sift = cv2.SIFT.create(60)
    features = {name: sift.detectAndCompute(image, None) for name, image in WALK.items()}
    return Journey("0491", WALK, features, list(WALK), Functions(halves, *functions))


def halves(descriptors: np.ndarray, k: int, depth: int) -> tuple[list[np.ndarray], np.ndarray]:
    """A tree without meaning: descriptor number i belongs to leaf i modulo their number."""
    levels = [np.zeros((k ** (level + 1), 128)) for level in range(depth)]
    return levels, np.arange(len(descriptors)) % k**depth


PLAIN = {
    "cloud_views": lambda: figures.cloud_views(POINTS),
    "ransac_steps": lambda: figures.ransac_steps(POINTS, ransac_run(POINTS, 0.05, 10, 1), 0.05),
    "steep_walls": lambda: figures.steep_walls(POINTS - POINTS.mean(axis=0)),
    "polar_line": lambda: figures.polar_line(2.0, -2.0),
    "polar_lines": lambda: figures.polar_lines([(1.0, 0.0), (0.0, 3.0), (2.0, -3.0), (1.0, 1.0)]),
    "squared_distances": lambda: figures.squared_distances(POINTS, (1.0, 1.5)),
    "scan": lambda: figures.scan(POINTS, POINTS[:5]),
    "hypothesis": lambda: figures.hypothesis(POINTS, (1.0, math.pi / 2), 0.1),
    "guesses": lambda: figures.guesses(POINTS, 0.1, rng()),
    "cloud": lambda: figures.cloud(SPACE.points, SPACE.colors),
    "corridor": lambda: figures.corridor(POINTS[:, 0], POINTS[:, 1], POINTS),
    "three_senses": lambda: figures.three_senses(WALK["0491"], POINTS, SCANS),
    "photographs": lambda: figures.photographs(WALK),
    "descriptor_space": lambda: figures.descriptor_space(),
    "matches": lambda: figures.matches(
        WALK["0491"], WALK["0493"], POINTS, POINTS + 1, np.arange(20) < 5
    ),
    "journey": lambda: figures.journey(small_journey(stub, stub, stub)),
    "binary_descriptors": lambda: figures.binary_descriptors(WALK["0491"], WALK["0493"]),
}
# With `...` for a response and a stub for a function: the untouched notebook.
UNTOUCHED = {
    "cost_over_angle": lambda: figures.cost_over_angle({"a": POINTS}, ...),
    "fitted_line": lambda: figures.fitted_line(POINTS, stub),
    "uncertain_line": lambda: figures.uncertain_line(POINTS, stub, stub, 0.1),
    "scattered_fits": lambda: figures.scattered_fits(POINTS, stub, stub, 0.1, rng()),
    "one_outlier": lambda: figures.one_outlier(POINTS, stub),
    "found_line": lambda: figures.found_line(POINTS, stub, 0.1, 5),
    "waiting_times": lambda: figures.waiting_times(100, 0.5, 2, ..., rng(), runs=1000),
    "runs_that_failed": lambda: figures.runs_that_failed(100, 0.5, 3, ..., rng(), runs=100),
    "noisy_inliers": lambda: figures.noisy_inliers(100, 0.5, ..., rng()),
    "laser_errors": lambda: figures.laser_errors(POINTS, stub, stub, 0.02, 0.05, rng()),
    "stopping": lambda: figures.stopping(POINTS, stub, 0.1, 0.95, rng()),
    "pushed_line": lambda: figures.pushed_line(POINTS, (1.0, math.pi / 2), stub, 0.1),
    "growth": lambda: figures.growth(stub, {"a line": 2}),
    "walls_of_scan": lambda: figures.walls_of_scan(POINTS, stub, 0.1, 5, 5),
    "corridor_walls": lambda: figures.corridor_walls(SCANS, stub, 500, 0.1, 5, 5),
    "largest_planes": lambda: figures.largest_planes(SPACE.points, stub, 0.02, 5),
    "nearest_words": lambda: figures.nearest_words(POINTS, POINTS[:2], stub),
    "way_down": lambda: figures.way_down(POINTS[0], [POINTS[:2], POINTS[:4]], stub),
    "occurrences": lambda: figures.occurrences([np.array([0, 1])], 2, stub),
    "search_results": lambda: figures.search_results(WALK, WALK, stub, PAIRS, "votes"),
    "agreement": lambda: figures.agreement(stub, tuple(WALK), tuple(WALK), PAIRS, 15),
    "precision_recall": lambda: figures.precision_recall(
        {"votes": stub}, tuple(WALK), tuple(WALK), PAIRS, 20
    ),
    "first_places": lambda: figures.first_places({"votes": stub}, WALK, PAIRS),
}


@pytest.mark.parametrize("name", [*PLAIN, *UNTOUCHED])
def test_a_picture_is_shown_once_with_a_text_and_returns_nothing(name, shown):
    assert {**PLAIN, **UNTOUCHED}[name]() is None
    (picture,) = shown
    assert list(picture["bundle"]) == ["image/png"]
    assert len(picture["metadata"]["alt"]) > 20


def test_every_picture_of_the_course_is_among_those_tested():
    elsewhere = {"few_points", "keypoints", "compare_features", "word_patches"}  # need features
    assert set(figures.__all__) - elsewhere == {*PLAIN, *UNTOUCHED}


def test_every_picture_is_found_under_its_name_and_offered_by_the_tab_key():
    assert [getattr(figures, name).__name__ for name in figures.__all__] == figures.__all__
    assert dir(figures) == figures.__all__
    with pytest.raises(AttributeError, match="no picture 'hypotheis'"):
        _ = figures.hypotheis


def test_matplotlib_is_loaded_for_the_first_picture_and_not_before():
    script = (
        "import sys, data, autograder.student.api\n"
        "from notebooks import explorers, figures\n"
        "assert 'matplotlib' not in sys.modules\n"
        "figures.hypothesis\n"
        "assert 'matplotlib' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True)


def test_a_guess_beyond_the_picture_is_answered_in_its_title(shown):
    """By hand: with half of the points inliers, 1 - 0.75^20 = 99.7 % are done by 20 samples."""
    figures.waiting_times(1000, 0.5, 2, 10_000, rng(), runs=1000)
    alt = shown[0]["metadata"]["alt"]
    assert "Your 10000 lies beyond the picture: 99.6% of the runs were done by 20." in alt


def test_an_error_in_a_student_s_function_is_not_hidden(shown):
    with pytest.raises(ZeroDivisionError):
        figures.fitted_line(POINTS, broken)


def test_figure_3_has_16_inliers_and_10_outliers(shown):
    points = figures.few_points()
    distances = points @ [math.cos(math.radians(115)), math.sin(math.radians(115))] - 2.0
    assert np.count_nonzero(np.abs(distances) <= 0.3) == 16
    assert np.count_nonzero(np.abs(distances) > 0.45) == 10  # none of them near the edge


def test_valley_and_hill_of_the_cost_are_where_the_singular_vectors_point(shown):
    generator = rng()
    points = generator.normal(size=(30, 2)) @ [[2.0, 0.7], [0.0, 0.5]] + [2.0, 1.0]
    figures.cost_over_angle({"cloud": points})
    _, _, directions = np.linalg.svd(points - points.mean(axis=0))
    degrees = [math.degrees(math.atan2(y, x)) for x, y in directions]
    hill, valley = ((value + 90) % 180 - 90 for value in degrees)
    alt = shown[0]["metadata"]["alt"]
    assert f"valley at {valley:.0f}°, hill at {hill:.0f}°" in alt


def test_a_student_s_angle_is_marked_only_when_it_is_an_expression(shown):
    S_xx, S_yy = sp.symbols("S_xx S_yy")
    for angle in (..., None, 0.3, S_xx / S_yy, sp.Symbol("something_else")):
        figures.cost_over_angle({"a": POINTS}, angle)
    assert len(shown) == 5


@pytest.mark.parametrize("size", [1, 2, 3])
def test_simulated_samples_are_clean_as_often_as_combinatorics_says(size):
    clean = chances._clean(2000, 50, 40, 12, size, rng())
    expected = math.comb(12, size) / math.comb(40, size)
    deviation = math.sqrt(expected * (1 - expected) / clean.size)
    assert abs(clean.mean() - expected) < 4 * deviation


def test_on_a_screen_a_picture_carries_its_text(monkeypatch):
    """JupyterLab gives an `alt` only to pictures in HTML."""
    bundles = []
    monkeypatch.setattr(style, "display", lambda bundle, **_: bundles.append(bundle))
    monkeypatch.setenv("AUTOGRADER_WIDGETS", "1")
    style.show(style.figure(2, 1), 'Points "on" a line, r < 2')
    (bundle,) = bundles
    assert 'alt="Points &quot;on&quot; a line, r &lt; 2"' in bundle["text/html"]
    assert 'src="data:image/png;base64,' in bundle["text/html"]
    assert bundle["text/plain"] == 'Points "on" a line, r < 2'


def test_a_threshold_is_chosen_on_the_walk_and_counted_on_the_queries(shown):
    """By hand: on the walk the wrong pairs score 3, the right one 8; the query's right one 5."""
    walk, queries = ("0491", "0492", "0499"), ("0493",)
    pairs = [frozenset(("0491", "0492")), frozenset(("0493", "0491"))]

    def score(name, places):
        right = {"0493": 5.0}.get(name, 8.0)
        return [right if frozenset((name, place)) in pairs else 3.0 for place in places]

    figures.precision_recall({"s": score}, walk, queries, pairs, wrong_costs=20)
    alt = shown[0]["metadata"]["alt"]
    assert "s, walk, threshold 8: 2 right, 0 wrong, 0 missed loops" in alt
    assert "s, five queries, threshold 8: 0 right, 0 wrong, 1 missed loops" in alt


def test_where_it_is_cheapest_to_close_no_loop_the_picture_says_so(shown):
    """By hand: the wrong pairs score more than the right ones, and one costs as much as twenty."""
    walk, pairs = ("0491", "0492", "0499"), [frozenset(("0491", "0492"))]

    def score(name, places):
        return [1.0 if frozenset((name, place)) in pairs else 2.0 for place in places]

    figures.precision_recall({"s": score}, walk, ("0493",), pairs, wrong_costs=20)
    alt = shown[0]["metadata"]["alt"]
    assert "s, walk, no loop closed: 0 right, 0 wrong, 2 missed loops" in alt


def test_the_still_cloud_has_the_line_that_most_points_agree_with(shown):
    """By hand: ten points lie on y = 0, whose normal is upright; the outlier is 2 m above them."""
    points = np.vstack([np.column_stack([np.arange(10.0), np.zeros(10)]), (9, 2)])
    figures.cloud_views(points)
    alt = shown[0]["metadata"]["alt"]
    assert "10 points agree on the dashed line, whose normal is at 90°" in alt
    assert "The cost is least at" in alt
    assert "α = 90°" not in alt  # least squares follows the outlier
