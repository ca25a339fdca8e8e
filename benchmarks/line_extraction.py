"""Line extraction on Killian Court and on hard simulated scans."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

import data
from benchmarks.hough import Hough, tuned_hough
from benchmarks.report import OURS, Curve, Row, Section
from benchmarks.scenes import BEAMS, hard_scenes
from benchmarks.timing import measure
from benchmarks.true_and_false_walls import rates
from solutions.lines.line_extraction import (
    Segment,
    Settings,
    sequential_ransac,
    split_and_merge,
    split_and_merge_all,
)

ONE_BY_ONE = "split-and-merge, one scan after the other"
RANSAC = "sequential RANSAC"
HOUGH = "OpenCV HoughLinesP"
HOUGH_CROPPED = "OpenCV HoughLinesP, cropped raster"
EVERY = 20  # of the scans of Killian Court is given to those who take one scan after the other
# Takes (M, B) ranges and (B,) angles; returns (S, 2, 2) end points for each scan.
Extractor = Callable[[np.ndarray, np.ndarray], list[np.ndarray]]


def run() -> Section:
    """Compare line extractors."""
    hough = tuned_hough(hard_scenes(300, np.random.default_rng(0)))
    extractors = _extractors(hough)
    rows = _killian_court(extractors) + _simulation(extractors)
    return Section("Line extraction", _setup(hough), rows, _growth(extractors))


def _setup(hough: Hough) -> str:
    return f"""
Times are for one scan of 180 beams. This project splits and merges all scans at once; the same
algorithm one scan after the other, and its sequential RANSAC (200 samples a line), are given for
comparison. All use the default `Settings`.

On Killian Court the time of this project is from all scans, that of everybody else from every
{EVERY}th, as all would take them too long. The segments a scan are counted on every {EVERY}th for
everybody. They are no measure of quality: nobody knows the true walls of Killian Court, so there
are no rates of true and false positives.

HoughLinesP gets a raster with one pixel an echo, 1 pixel and 1 degree of resolution. The rest was
tuned on 300 simulated scenes for the largest true minus false positive rate, over pixels of 2 to
8 cm, 6 to 14 votes, two minimum lengths and two gaps. The best was {100 * hough.pixel:g} cm,
{hough.threshold} votes, {hough.min_length:g} m and {hough.max_gap:g} m. The defaults of this
project were chosen on scenes of the same kind. HoughLinesP runs twice: on a raster of the
scanner's whole range, and on one that is cropped to the echoes of each scan, which is faster.

The hard simulation has curved walls, pillars, people's legs, bushes, mixed pixels, lost echoes and
15 mm of noise; 1000 scenes that no setting was tuned on. True positives: visible straight walls
that were found, to 5 cm and 6 degrees. False positives: segments that lie on no straight wall, or
on a stretch that a longer segment covers already.
"""


def _extractors(hough: Hough) -> dict[str, Extractor]:
    settings = Settings()

    def all_at_once(ranges: np.ndarray, angles: np.ndarray) -> list[np.ndarray]:
        found = split_and_merge_all(ranges, angles, settings)
        ends = np.stack([found.start, found.end], axis=1)
        return np.split(ends, np.searchsorted(found.scan, np.arange(1, len(ranges))))

    def one_by_one(ranges: np.ndarray, angles: np.ndarray) -> list[np.ndarray]:
        return [_ends(split_and_merge(scan, angles, settings)) for scan in ranges]

    def by_ransac(ranges: np.ndarray, angles: np.ndarray) -> list[np.ndarray]:
        rng = np.random.default_rng(0)
        return [_ends(sequential_ransac(scan, angles, rng, settings)) for scan in ranges]

    def by_hough(hough: Hough) -> Extractor:
        return lambda ranges, angles: [hough(scan, angles) for scan in ranges]

    return {
        OURS: all_at_once,
        ONE_BY_ONE: one_by_one,
        RANSAC: by_ransac,
        HOUGH: by_hough(replace(hough, cropped=False)),
        HOUGH_CROPPED: by_hough(hough),
    }


def _ends(segments: list[Segment]) -> np.ndarray:
    return np.array([[segment.start, segment.end] for segment in segments]).reshape(-1, 2, 2)


def _killian_court(extractors: dict[str, Extractor]) -> list[Row]:
    scans = data.killian_court()
    # All scans at once against every 20th scan one by one: the time for one scan is compared.
    some = scans.ranges[::EVERY]
    chosen = {name: scans.ranges if name == OURS else some for name in extractors}
    calls = {
        name: _call(extract, chosen[name], scans.angles) for name, extract in extractors.items()
    }
    extra: dict[str, dict[str, float | str]] = {
        name: {"segments a scan": float(np.mean([len(ends) for ends in found]))}
        for name, found in ((name, f(some, scans.angles)) for name, f in extractors.items())
    }
    task = f"Killian Court, {len(scans.ranges)} scans"
    items = {name: len(ranges) for name, ranges in chosen.items()}
    return measure("Line extraction", task, calls, 5, extra, items)


def _simulation(extractors: dict[str, Extractor]) -> list[Row]:
    scenes = hard_scenes(1000, np.random.default_rng(1))
    ranges = np.stack([scene.ranges for scene in scenes])
    calls = {name: _call(extract, ranges, BEAMS) for name, extract in extractors.items()}
    extra: dict[str, dict[str, float | str]] = {}
    for name, call in calls.items():
        true, false = rates(scenes, call())
        extra[name] = {"true positives": f"{true:.1%}", "false positives": f"{false:.1%}"}
    items = dict.fromkeys(calls, len(ranges))
    return measure("Line extraction", "hard simulation", calls, 3, extra, items)


def _growth(extractors: dict[str, Extractor], slowest: float = 1.0) -> list[Curve]:
    scans = data.killian_court()
    sizes = (1, 10, 100, 1000, len(scans.ranges))
    times: dict[str, list[float]] = {name: [] for name in extractors}
    for size in sizes:
        calls = {
            name: _call(extract, scans.ranges[:size], scans.angles)
            for name, extract in extractors.items()
            if not times[name] or times[name][-1] < slowest
        }
        for row in measure("growth", str(size), calls, 3):
            times[row.contender].append(row.seconds or 0.0)
    return [
        Curve(
            "Line extraction, Killian Court",
            name,
            "scans",
            "seconds",
            tuple(float(size) for size in sizes[: len(seconds)]),
            tuple(seconds),
        )
        for name, seconds in times.items()
    ]


def _call(
    extract: Extractor, ranges: np.ndarray, angles: np.ndarray
) -> Callable[[], list[np.ndarray]]:
    return lambda: extract(ranges, angles)
