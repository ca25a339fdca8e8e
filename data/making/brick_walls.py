"""The brick walls: a stereo pair of the package mvtb-data, matched and triangulated.

SIFT features of both photographs are matched, matches that no camera motion explains are dropped,
and the others are triangulated. The camera's constants are those of the book that the pair comes
from: P. Corke, *Robotics, Vision and Control*, 3rd ed., Springer 2023, section 14.3.
"""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

from data.making.archive import write_arrays

FOCAL_LENGTH = 4.15e-3  # m, the iPhone 5s (EXIF)
PIXEL = 2 * 1.5e-6  # m, its pixels after halving the photographs
BASELINE = 0.3  # m, how far the phone was moved sideways; sets the scale, and is a rough figure
NEAREST_RATIO = 0.8  # Lowe's ratio of the best to the second best match
EPIPOLAR_TOLERANCE = 1.0  # px
FARTHEST = 10.0  # m, beyond it triangulation over 0.3 m says little


def make_brick_walls(source: Path, target: Path) -> None:
    """Write points (N, 3) in m and their colours (N, 3)."""
    cv2.setRNGSeed(0)
    cv2.setNumThreads(1)
    left, right = (_half_size(source / "images" / f"walls-{side}.png") for side in "lr")
    pixels_left, pixels_right = _match(left, right)

    focal = FOCAL_LENGTH / PIXEL
    height, width = left.shape[:2]
    camera = np.array([[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1]])
    essential, agrees = cv2.findEssentialMat(
        pixels_left,
        pixels_right,
        camera,
        method=cv2.USAC_MAGSAC,
        prob=0.9999,
        threshold=EPIPOLAR_TOLERANCE,
    )
    _, rotation, translation, _ = cv2.recoverPose(
        essential, pixels_left, pixels_right, camera, mask=agrees.copy()
    )
    translation *= BASELINE / abs(translation[0])

    kept = agrees.ravel() > 0
    pixels_left, pixels_right = pixels_left[kept], pixels_right[kept]
    homogeneous = cv2.triangulatePoints(
        camera @ np.eye(3, 4),
        camera @ np.hstack([rotation, translation]),
        pixels_left.T,
        pixels_right.T,
    )
    points = (homogeneous[:3] / homogeneous[3]).T
    columns, rows = np.rint(pixels_left).astype(int).T
    colors = left[np.clip(rows, 0, height - 1), np.clip(columns, 0, width - 1), ::-1]

    seen = (points[:, 2] > 0) & (points[:, 2] < FARTHEST)
    write_arrays(
        target / "brick_walls.npz", points=points[seen].astype(np.float32), colors=colors[seen]
    )


def _half_size(path: Path) -> np.ndarray:
    return cv2.resize(cv2.imread(str(path)), None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)


def _match(left: np.ndarray, right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pixels (N, 2) of the features that both photographs show."""
    sift = cv2.SIFT.create(contrastThreshold=0.02)
    (found_left, words_left), (found_right, words_right) = (
        sift.detectAndCompute(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY), None)
        for image in (left, right)
    )
    pairs = cv2.BFMatcher().knnMatch(words_left, words_right, k=2)
    best = [a for a, b in pairs if a.distance < NEAREST_RATIO * b.distance]
    return (
        np.array([found_left[match.queryIdx].pt for match in best]),
        np.array([found_right[match.trainIdx].pt for match in best]),
    )
