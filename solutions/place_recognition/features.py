"""Keypoints and descriptors of a photograph, with OpenCV."""

from typing import Literal, NamedTuple

import cv2
import numpy as np

_SIFT = 128  # numbers in a descriptor


class Features(NamedTuple):
    """The N features of an image."""

    positions: np.ndarray  # (N, 2) float32, x to the right and y down, in pixels
    descriptors: np.ndarray  # (N, 128) float32 for SIFT, (N, 32) uint8 for ORB


def extract_features(
    image: np.ndarray, kind: Literal["sift", "orb"] = "sift", most: int = 0
) -> Features:
    """Return the features of a grey (H, W) or red, green, blue (H, W, 3) image of bytes.

    `most` limits their number to the strongest; 0 is no limit for SIFT, and 1000 for ORB.

    Raises:
        ValueError: for any other kind.
    """
    if kind not in ("sift", "orb"):
        raise ValueError(f"There are features of the kinds 'sift' and 'orb', not {kind!r}.")
    detector = cv2.SIFT.create(most) if kind == "sift" else cv2.ORB.create(most or 1000)
    gray = image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_RGB2GRAY)
    keypoints, descriptors = detector.detectAndCompute(gray, None)
    if descriptors is None:  # nothing to be seen
        descriptors = np.zeros((0, _SIFT), "f4") if kind == "sift" else np.zeros((0, 32), "u1")
    positions = np.array([keypoint.pt for keypoint in keypoints], np.float32).reshape(-1, 2)
    return Features(positions, descriptors)


def are_bits(descriptors: np.ndarray) -> bool:
    """Tell whether (N, d) descriptors are rows of bits, compared by how many differ.

    Bytes are bits, as ORB, BRISK, FREAK and AKAZE give them, in 32 to 64 bytes a feature. The
    exception is 128 bytes: they are SIFT's 128 numbers, kept small.
    """
    return descriptors.dtype == np.uint8 and descriptors.shape[-1] != _SIFT
