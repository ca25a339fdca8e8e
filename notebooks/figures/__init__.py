"""Every picture of the course. Each function takes data, shows one picture and returns nothing."""

from notebooks.figures.chances import growth, noisy_inliers, runs_that_failed, waiting_times
from notebooks.figures.consensus import few_points, found_line, guesses, hypothesis
from notebooks.figures.cost import cost_over_angle, squared_distances
from notebooks.figures.examples import nearest_words, occurrences, way_down
from notebooks.figures.features import compare_features, keypoints, photographs
from notebooks.figures.fits import fitted_line, one_outlier, scan, scattered_fits, uncertain_line
from notebooks.figures.mapping import corridor, corridor_walls, three_senses, walls_of_scan
from notebooks.figures.polar import polar_line, polar_lines, steep_walls
from notebooks.figures.retrieval import agreement, first_places, matches, search_results
from notebooks.figures.space import cloud, largest_planes
from notebooks.figures.words import descriptor_space, word_patches

__all__ = [
    "agreement",
    "cloud",
    "compare_features",
    "corridor",
    "corridor_walls",
    "cost_over_angle",
    "descriptor_space",
    "few_points",
    "first_places",
    "fitted_line",
    "found_line",
    "growth",
    "guesses",
    "hypothesis",
    "keypoints",
    "largest_planes",
    "matches",
    "nearest_words",
    "noisy_inliers",
    "occurrences",
    "one_outlier",
    "photographs",
    "polar_line",
    "polar_lines",
    "runs_that_failed",
    "scan",
    "scattered_fits",
    "search_results",
    "squared_distances",
    "steep_walls",
    "three_senses",
    "uncertain_line",
    "waiting_times",
    "walls_of_scan",
    "way_down",
    "word_patches",
]
