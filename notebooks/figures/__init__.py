"""Every picture of the course. Each function takes data, shows one picture and returns nothing.

A picture's module is loaded when the first of its pictures is asked for: Matplotlib takes longer to
load than everything else that a notebook starts with.
"""

from importlib import import_module
from typing import Any

_PICTURES = {
    "chances": ["growth", "noisy_inliers", "runs_that_failed", "waiting_times"],
    "consensus": ["few_points", "found_line", "guesses", "hypothesis"],
    "cost": ["cost_over_angle", "squared_distances"],
    "examples": ["nearest_words", "occurrences", "way_down"],
    "features": ["binary_descriptors", "compare_features", "keypoints", "photographs"],
    "fits": ["fitted_line", "one_outlier", "scan", "scattered_fits", "uncertain_line"],
    "way_of_a_keypoint": ["journey"],
    "mapping": ["corridor", "corridor_walls", "three_senses", "walls_of_scan"],
    "polar": ["polar_line", "polar_lines", "steep_walls"],
    "retrieval": ["agreement", "first_places", "matches", "precision_recall", "search_results"],
    "exploring": ["cloud_views", "ransac_steps"],
    "lasers": ["laser_errors"],
    "stopping_early": ["pushed_line", "stopping"],
    "space": ["cloud", "largest_planes"],
    "words": ["descriptor_space", "word_patches"],
}
_MODULE_OF = {name: module for module, names in _PICTURES.items() for name in names}

__all__ = sorted(_MODULE_OF)


def __getattr__(name: str) -> Any:
    if name in _MODULE_OF:
        return getattr(import_module(f"notebooks.figures.{_MODULE_OF[name]}"), name)
    raise AttributeError(f"module 'notebooks.figures' has no picture {name!r}")


def __dir__() -> list[str]:
    return __all__
