"""Two photographs of one scene: the spots that match, and the geometry that ties them together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import cv2
import numpy as np

RATIO = 0.8  # a match is nearer than this share of the distance to the second nearest
PIXELS = 1.5  # how far a spot may lie from its epipolar line
_FEWEST = 8  # matches; any seven agree with some geometry


class TwoViews(NamedTuple):
    """The matches of two photographs, and what most of them agree with."""

    here: np.ndarray  # (N, 2) pixels in the first photograph
    there: np.ndarray  # (N, 2) pixels of the matching spots in the second
    agree: np.ndarray  # (N,) bool: the match agrees with the fundamental matrix
    fundamental: np.ndarray | None  # (3, 3): turns (x, y, 1) here into a line there


def two_views(
    one: tuple[Sequence[Any], np.ndarray],
    other: tuple[Sequence[Any], np.ndarray],
    norm: int = cv2.NORM_L2,
) -> TwoViews:
    """Match the features of two photographs and look for the geometry that most matches share.

    Matches are each other's nearest and clearly nearer than the second nearest; of several between
    the same two spots one counts. With fewer than eight there is no geometry, and none agrees.

    Args:
        one: OpenCV's keypoints in the first, with their (n, d) descriptors.
        other: those in the second.
        norm: how far descriptors are apart: NORM_L2 for SIFT, NORM_HAMMING for ORB.
    """
    (spots, descriptors), (other_spots, other_descriptors) = one, other
    pairs = cv2.BFMatcher(norm).knnMatch(descriptors, other_descriptors, k=2)
    back = cv2.BFMatcher(norm).match(other_descriptors, descriptors)
    kept = [m for m, second in pairs if m.distance < RATIO * second.distance]
    kept = [m for m in kept if back[m.trainIdx].trainIdx == m.queryIdx]
    ends = [(*spots[m.queryIdx].pt, *other_spots[m.trainIdx].pt) for m in kept]
    found = np.array(ends).reshape(-1, 4)
    found = found[np.sort(np.unique(np.rint(found), axis=0, return_index=True)[1])]
    here, there = found[:, :2], found[:, 2:]
    nothing = TwoViews(here, there, np.zeros(len(found), dtype=bool), None)
    if len(found) < _FEWEST:
        return nothing
    cv2.setRNGSeed(0)
    matrix, inliers = cv2.findFundamentalMat(here, there, cv2.FM_RANSAC, PIXELS, 0.999)
    if matrix is None or matrix.shape != (3, 3):
        return nothing
    return TwoViews(here, there, inliers.ravel() > 0, matrix)
