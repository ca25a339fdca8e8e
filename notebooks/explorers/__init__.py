"""Pictures to play with: change a value and see at once what follows.

Everything is computed in the browser. Where no widget can be drawn, a sentence or a still picture
stands instead.
"""

from notebooks.explorers.cloud import explore_cloud
from notebooks.explorers.journey import explore_journey
from notebooks.explorers.polar_line import explore_polar_line
from notebooks.explorers.ransac import explore_ransac
from notebooks.explorers.ransac_steps import explore_ransac_steps

__all__ = [
    "explore_cloud",
    "explore_journey",
    "explore_polar_line",
    "explore_ransac",
    "explore_ransac_steps",
]
