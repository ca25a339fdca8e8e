"""Pictures to play with: change a value and see at once what follows.

Everything is computed in the browser. Where no widget can be drawn, one sentence stands instead.
"""

from notebooks.explorers.polar_line import explore_polar_line
from notebooks.explorers.ransac import explore_ransac

__all__ = ["explore_polar_line", "explore_ransac"]
