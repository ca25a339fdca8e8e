"""The layouts of downloads, each recognised by its own marks: one module a layout.

`plain`, which has no marks, is what is left; it is not in the list.
"""

from autograder.intake.layouts.blackboard import Blackboard
from autograder.intake.layouts.canvas import Canvas
from autograder.intake.layouts.github import GitHub
from autograder.intake.layouts.gradescope import Gradescope
from autograder.intake.layouts.layout import Context, Entry, Found, Layout, PassedOver
from autograder.intake.layouts.moodle import Moodle
from autograder.intake.layouts.nbgrader import NbGrader

# Those with a side file come first: its word goes before a name's.
LAYOUTS: tuple[Layout, ...] = (
    Gradescope(),
    GitHub(),
    Moodle(),
    Blackboard(),
    Canvas(),
    NbGrader(),
)

__all__ = ["LAYOUTS", "Context", "Entry", "Found", "Layout", "PassedOver"]
