"""The explorers on a page of their own: by hand, by keyboard, beside the same sums in Python."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect

import data
from notebooks import explorers
from notebooks.explorers import still

FOLDER = Path(explorers.__file__).parent


def scan_points() -> np.ndarray:
    scans = data.killian_court()
    ranges = scans.ranges[161]
    points = np.column_stack([ranges * np.cos(scans.angles), ranges * np.sin(scans.angles)])
    return points.round(6)


def open_page(browser: Browser, module: str, values: dict, width: int = 1280) -> Page:
    """Show one explorer as anywidget would, with values as they come from the kernel."""
    page = browser.new_page(viewport={"width": width, "height": 1000})
    source = "\n".join((FOLDER / name).read_text("utf-8") for name in ("plot.js", module))
    style = (FOLDER / "explorer.css").read_text("utf-8")
    page.set_content(
        f"<!doctype html><html lang=en><title>Explorer</title><style>{style}</style>"
        "<main id=here></main></html>"
    )
    page.evaluate(
        """async ([source, values]) => {
            const url = URL.createObjectURL(new Blob([source], { type: 'text/javascript' }));
            const { default: widget } = await import(url);
            const model = { get: () => values };
            widget.render({ model, el: document.getElementById('here') });
        }""",
        [source, json.loads(json.dumps(values))],
    )
    return page


@pytest.fixture
def steps(browser: Browser) -> Iterator[Page]:
    values = {"points": scan_points().tolist(), "iterations": 74, "threshold": 0.06}
    page = open_page(browser, "ransac_steps.js", values)
    page.emulate_media(reduced_motion="reduce")  # a run is shown at once, not step by step
    yield page
    page.close()


def test_a_run_finds_what_the_still_picture_shows(steps: Page):
    # The first run has begun when the page opens, "Run" begins the second.
    steps.get_by_role("button", name="Run: 74 samples").click()
    run = still.ransac_run(scan_points(), 0.06, 74, seed=2)
    result = steps.locator(".ex-result")
    expect(result).to_contain_text(f"Best so far: {len(run.inliers)} (")
    expect(result).to_contain_text(f"asks for {run.asked[-1]} samples")


def test_samples_are_drawn_one_by_one_from_the_keyboard(steps: Page):
    draw = steps.get_by_role("button", name="Draw a sample")
    draw.focus()
    for _ in range(3):
        steps.keyboard.press("Enter")
    run = still.ransac_run(scan_points(), 0.06, 3, seed=1)
    expect(steps.locator(".ex-result")).to_contain_text("Sample 3:")
    expect(steps.locator(".ex-result")).to_contain_text(f"Best so far: {len(run.inliers)} (")
    assert steps.locator(".ex-marker").count() == 3  # two points, and the mark on the curve


def test_a_hundred_runs_succeed_and_fail_in_numbers_that_add_up(steps: Page):
    steps.get_by_label("outliers added").fill("2")
    steps.get_by_role("button", name="100 runs").click()
    text = steps.locator("p[role=status]").last.inner_text()
    found, poor, spoilt = (
        int(re.search(pattern, text).group(1))
        for pattern in (r"enough in (\d+) of", r"In (\d+) runs", r"in (\d+) \(×\)")
    )
    assert found + poor + spoilt == 100
    assert steps.locator(".ex-run").count() == 100
    assert steps.locator(".ex-found").count() == found
    # 12 % of the points are the wall's: all 74 samples are spoilt in about a third of the runs.
    wall, points = int(re.search(r"wall's (\d+) points", text).group(1)), 3 * len(scan_points())
    chance = (1 - (wall / points) ** 2) ** 74
    assert abs(spoilt / 100 - chance) < 4 * (chance * (1 - chance) / 100) ** 0.5
    steps.get_by_role("button", name="Why did a run fail?").click()
    expect(steps.locator(".ex-result")).to_contain_text("None of its 74 samples")


def complaints(page: Page) -> list[str]:
    """What axe finds, but the heading that the page around an explorer has."""
    found = Axe().run(page, options={"rules": {"page-has-heading-one": {"enabled": False}}})
    return [violation["id"] for violation in found.response["violations"]]


def test_every_setting_can_be_reached_and_is_named(steps: Page):
    assert complaints(steps) == []
    steps.get_by_role("button", name="100 runs").click()
    assert complaints(steps) == []
    names = [steps.get_by_role("slider").nth(n).get_attribute("aria-label") for n in range(3)]
    assert names == ["threshold", "outliers added", "noise added, σ"]


@pytest.mark.parametrize("width", [390, 1280])
def test_the_steps_fit_into_the_window(steps: Page, width: int):
    steps.set_viewport_size({"width": width, "height": 900})
    steps.get_by_role("button", name="Run: 74 samples").click()
    assert steps.evaluate("document.documentElement.scrollWidth") <= width


CROSS = [[0.0, 1.0], [2.0, 1.0], [4.0, 1.0], [6.0, 1.0], [3.0, 4.0]]


@pytest.fixture
def cloud(browser: Browser) -> Iterator[Page]:
    """Four points of the wall y = 1, and an outlier 3 m above their middle."""
    page = open_page(browser, "cloud.js", {"points": CROSS})
    yield page
    page.close()


def drag(page: Page, mark: str, across: float, up: float) -> None:
    box = page.locator(mark).first.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + across, y - up, steps=5)
    page.mouse.up()


def test_the_first_line_is_the_one_that_a_hand_calculation_gives(cloud: Page):
    # The mean of y is 1.6: S = 4 * 0.36 + 5.76, and S_xx = 9 + 1 + 1 + 9.
    result = cloud.locator(".ex-result")
    expect(result).to_contain_text("r = 1.60 m, α = 90°, S = 7.20 m²")
    expect(result).to_contain_text("S_xx = 20.00, S_yy = 7.20 m²")
    expect(result).to_contain_text("the plain arctan finds the hill")
    expect(result).to_contain_text("Consensus: α = 90°, by 4 of 5 points")


def test_least_squares_follows_the_outlier_and_the_consensus_does_not(cloud: Page):
    drag(cloud, ".ex-outlier", 60, 40)
    result = cloud.locator(".ex-result")
    expect(result).not_to_contain_text("S = 7.20 m²")
    expect(result).not_to_contain_text("m, α = 90°")
    expect(result).to_contain_text("Consensus: α = 90°, by 4 of 5 points")


def test_the_plain_arctan_jumps_when_the_cloud_is_turned_by_keys(cloud: Page):
    cloud.get_by_label("its y").fill("1")  # the outlier lies down among the others
    turn = cloud.get_by_label("turn the cloud by")
    turn.fill("44")
    expect(cloud.locator(".ex-result")).to_contain_text("the plain arctan finds the hill")
    turn.focus()
    for _ in range(26):
        cloud.keyboard.press("ArrowRight")
    expect(cloud.locator(".ex-result")).to_contain_text("the plain arctan finds the valley too")


def test_the_cloud_has_names_for_everything_and_fits_into_narrow_windows(cloud: Page):
    assert complaints(cloud) == []
    assert cloud.get_by_role("img").count() == 4
    cloud.set_viewport_size({"width": 390, "height": 900})
    assert cloud.evaluate("document.documentElement.scrollWidth") <= 390


def a_journey() -> dict:
    """Three places and four keypoints; the third place has every word, the first one word."""
    dot = "data:image/gif;base64,R0lGODlhAQABAIAAAAAAAP///yH5BAEAAAAALAAAAAABAAEAAAIBRAA7"
    level = {
        "count": 2,
        "words": [0, 1, 1, 0],
        "rows": [[2], [0, 2]],
        "weights": [0.5, 2.0],
        "sizes": [3, 4],
        "examples": {"0": [0], "1": [0, 1]},
    }
    sideways = [[0, 0, 0], [0, 0, -1], [0, 1, 0]]  # the same height in both photographs
    matches = {"pairs": [[5, 5, 9, 5], [8, 30, 9, 2]], "agree": [1, 0], "fundamental": sideways}
    return {
        "query": "Q",
        "places": ["A1", "B2", "C3"],
        "photographs": dict.fromkeys(("Q", "A1", "B2", "C3"), dot),
        "size": [200, 100],
        "spots": [[20, 20, 6, 0], [100, 50, 6, 90], [150, 80, 6, 10], [180, 20, 6, 0]],
        "first": 1,
        "trees": [{"children": 2, "levels": [level]}],
        "patches": [[0, 10, 10, 6, 0], [2, 30, 30, 6, 0]],
        "matches": [matches, {"pairs": [], "agree": [], "fundamental": None}, matches],
    }


@pytest.fixture
def trip(browser: Browser) -> Iterator[Page]:
    page = open_page(browser, "journey.js", a_journey())
    page.emulate_media(reduced_motion="reduce")
    yield page
    page.close()


def test_the_votes_are_those_of_a_hand_calculation(trip: Page):
    result = trip.locator(".ex-result")
    expect(result).to_contain_text("Keypoint 2 is word 1. 2 of 3 places have this word.")
    expect(result).to_contain_text("Best candidate of 4 votes: C3, with 4.")
    trip.get_by_label("a vote counts").select_option(label="the weight of its word")
    expect(result).to_contain_text("C3, with 5.0.")  # 0.5 + 2 + 2 + 0.5
    trip.get_by_label("keypoints that have voted").fill("1")
    expect(result).to_contain_text("Best candidate of 1 votes: C3, with 0.5.")
    trip.get_by_role("button", name="Let the votes grow").click()
    expect(result).to_contain_text("C3, with 5.0.")


def test_a_click_and_the_arrow_keys_choose_a_keypoint(trip: Page):
    box = trip.locator(".ex-photo").first.bounding_box()
    trip.mouse.click(box["x"] + 0.1 * box["width"], box["y"] + 0.2 * box["height"])
    expect(trip.locator(".ex-result")).to_contain_text("Keypoint 1 is word 0. 1 of 3 places")
    trip.get_by_label("keypoint", exact=True).focus()
    trip.keyboard.press("ArrowRight")
    expect(trip.locator(".ex-result")).to_contain_text("Keypoint 2 is word 1.")


def test_the_line_of_the_spot_under_the_pointer_is_drawn_in_the_candidate(trip: Page):
    """With cameras side by side, a spot lies at the same height in the other photograph."""
    box = trip.locator(".ex-photo").last.bounding_box()
    trip.mouse.move(box["x"] + 0.2 * box["width"], box["y"] + 0.3 * box["height"])
    line = trip.locator("line.ex-thick").last
    heights = [float(line.get_attribute(name)) for name in ("y1", "y2")]
    assert heights == pytest.approx([30, 30], abs=1.5)
    trip.get_by_label("compare with").select_option(label="B2")
    expect(trip.locator(".ex-result")).to_contain_text("0 of 0 matches with B2 agree")
    assert trip.locator("line.ex-thick").count() == 0


def test_the_journey_has_names_for_everything_and_fits_into_narrow_windows(trip: Page):
    assert complaints(trip) == []
    trip.set_viewport_size({"width": 390, "height": 900})
    assert trip.evaluate("document.documentElement.scrollWidth") <= 390
    tall = trip.locator(".ex-photo").last
    expect(tall).to_have_attribute("viewBox", "0 0 200 214")  # one above the other


def test_a_journey_says_which_function_is_missing(browser: Browser):
    values = a_journey()
    values["trees"][0]["levels"][0] |= {"rows": None, "weights": None}
    page = open_page(browser, "journey.js", values)
    expect(page.locator(".ex-result")).to_contain_text("write build_inverted_file")
    page.close()
