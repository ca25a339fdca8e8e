"""What the feedback for a student draws: a response beside the reference, on a public input."""

from __future__ import annotations

import math

import numpy as np

from solutions.cases.case import Case, Value


def fitted_line(case: Case, expected: Value, actual: Value) -> dict[str, object] | None:
    """Describe the points of a case, the line that fits best and the line that was returned.

    None if `actual` is no line, which is a pair of finite numbers (r, alpha).
    """
    points = np.asarray(case["args"][0], dtype=float)
    r, alpha = (float(value) for value in actual)
    if not (math.isfinite(r) and math.isfinite(alpha) and abs(r) < 1e3):
        return None
    offsets = np.abs(points @ [math.cos(alpha), math.sin(alpha)] - r)
    near = np.median(offsets)
    return {
        "title": f"Your line for {case['name']}",
        "alt": (
            f"{len(points)} points, the best line and the line that your function returned, "
            f"r = {r:.3g} m and alpha = {alpha:.3g} rad. "
            f"Half of the points are {near:.3g} m or less from your line."
        ),
        "x_label": "x in m",
        "y_label": "y in m",
        "layers": [
            {"kind": "line", "xy": _along(points, r, alpha), "label": "your line"},
            {"kind": "expected", "xy": _along(points, *expected), "label": "the best line"},
            {"kind": "points", "xy": points, "label": "the points"},
        ],
    }


def consensus(case: Case, expected: Value, actual: Value) -> Case | None:
    """Describe the line that RANSAC found, from the pairs (line, inliers)."""
    return fitted_line(case, expected[0], actual[0])


def _along(points: np.ndarray, r: float, alpha: float) -> np.ndarray:
    """Return the two ends, shape (2, 2), of the part of a line that lies beside the points."""
    normal = np.array([math.cos(alpha), math.sin(alpha)])
    along = np.array([-normal[1], normal[0]])
    center = points.mean(axis=0)
    foot = center + (r - center @ normal) * normal
    reach = 1.1 * float(np.linalg.norm(points - center, axis=1).max())
    return np.array([foot - reach * along, foot + reach * along])
