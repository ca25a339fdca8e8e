"""OpenCV's probabilistic Hough transform as a line extractor for scans."""

import itertools
from dataclasses import dataclass

import cv2
import numpy as np

from benchmarks.scenes import BEAMS, NO_ECHO, Scene
from benchmarks.true_and_false_walls import rates


@dataclass(frozen=True)
class Hough:
    """`cv2.HoughLinesP` on a raster in which every echo is one pixel.

    With `cropped` the raster is as large as the scan's echoes need, which is faster. Without
    it the raster always has the scanner's whole range, which is what one writes first.
    """

    pixel: float  # m
    threshold: int  # votes
    min_length: float  # m
    max_gap: float  # m
    cropped: bool = True

    def __call__(self, ranges: np.ndarray, angles: np.ndarray) -> np.ndarray:
        """(S, 2, 2) end points in metres."""
        echo = (ranges > 0) & (ranges < NO_ECHO - 1)
        points = ranges[echo, None] * np.column_stack([np.cos(angles), np.sin(angles)])[echo]
        if not len(points):
            return np.empty((0, 2, 2))
        if self.cropped:
            low, high = points.min(axis=0), points.max(axis=0)
        else:
            low, high = np.array([0.0, -NO_ECHO]), np.array([NO_ECHO, NO_ECHO])
        column, row = np.round((points - low) / self.pixel).astype(int).T
        width, height = np.round((high - low) / self.pixel).astype(int) + 1
        image = np.zeros((height, width), np.uint8)
        image[row, column] = 255
        found = cv2.HoughLinesP(
            image,
            1,
            np.pi / 180,
            self.threshold,
            minLineLength=self.min_length / self.pixel,
            maxLineGap=self.max_gap / self.pixel,
        )
        if found is None:
            return np.empty((0, 2, 2))
        return found.reshape(-1, 2, 2) * self.pixel + low


def tuned_hough(scenes: list[Scene]) -> Hough:
    """The setting with the largest true minus false positive rate on some scenes."""
    grid = itertools.product((0.02, 0.03, 0.05, 0.08), (6, 8, 10, 14), (0.5, 0.6), (0.25, 0.5))
    candidates = [Hough(*setting) for setting in grid]

    def gain(hough: Hough) -> float:
        true, false = rates(scenes, [hough(scene.ranges, BEAMS) for scene in scenes])
        return true - false

    return max(candidates, key=gain)
