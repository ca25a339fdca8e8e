"""Every picture of the course. Each function takes data, shows one picture and returns nothing."""

from notebooks.figures.cost import cost_over_angle, squared_distances
from notebooks.figures.polar import polar_line, polar_lines, steep_walls

__all__ = ["cost_over_angle", "polar_line", "polar_lines", "squared_distances", "steep_walls"]
