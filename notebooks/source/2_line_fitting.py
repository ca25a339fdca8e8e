# %% [markdown]
# # 2 Line fitting
#
# The robot has turned from the campus into a building. A laser scanner on it sends out a beam in 180
# directions, parallel to the floor, and measures how far each gets. Along a wall, the end points of
# the beams lie on a line. If the robot can find these lines, it knows how it stands in the corridor.
#
# But no measurement is exact, so no line goes through all the points. Which line is the best?

# %%
import math
from typing import NamedTuple

import numpy as np
import sympy as sp

from autograder import ask, check, progress, submit

# %% [markdown]
# ## A line without a slope
#
# At school a line is $y = mx + b$. A wall straight ahead, at right angles to the $x$-axis, breaks this
# form: its slope $m$ would have to be infinite.
#
# A robot needs a form that treats all directions alike. Draw the shortest connection from the origin
# to the line. It has a length, $r$, and it makes an angle with the $x$-axis, $\alpha$. These two numbers
# are the line's **polar parameters**, and
#
# $$x \cos\alpha + y \sin\alpha = r, \qquad r \ge 0, \quad -\pi < \alpha \le \pi$$
#
# holds for every point $(x, y)$ on it. Read it as a dot product: $(\cos\alpha, \sin\alpha)$ is the
# **normal**, the unit vector at right angles to the line, and all points of the line reach equally
# far in its direction.
#
# For a point that is *not* on the line, $x \cos\alpha + y \sin\alpha - r$ is its distance from the line,
# with a sign that tells the side. The wall $x = 2$ has $\alpha = 0$ and $r = 2$; the point $(5, 1)$ has the
# distance $5 \cdot 1 + 1 \cdot 0 - 2 = 3$ from it.


# %%
class Line(NamedTuple):
    """A line x cos(alpha) + y sin(alpha) = r."""

    r: float  # m, distance from the origin, never negative
    alpha: float  # rad, direction of the normal, in (-pi, pi]


# %% [markdown]
# ## Least squares
#
# The method of **least squares** says: the best line is the one for which the sum of the squared
# distances of *all* points is least. The sum is called the **cost**:
#
# $$S(r, \alpha) = \sum_{i=1}^{N} (r - x_i \cos\alpha - y_i \sin\alpha)^2$$
#
# Squares make the mathematics easy, as you will see, and they have a dark side. A point that is ten
# times as far from the line as another adds a hundred times as much to the cost.

# %% exercise="Q2.1"

# %% [markdown]
# ## The derivation
#
# Now find the $r$ and $\alpha$ that make $S$ least, in steps. At a minimum both slopes are zero,
# $\partial S / \partial r = 0$ and $\partial S / \partial \alpha = 0$. (The exercise sheet writes the
# first condition twice; the second is meant.) Start with $r$, which is easier.
#
# You type formulas, and these are their symbols:

# %%
r, alpha, N = sp.symbols("r alpha N", real=True)
x_c, y_c, sum_x, sum_y = sp.symbols("x_c y_c sum_x sum_y", real=True)
S_xx, S_yy, S_xy = sp.symbols("S_xx S_yy S_xy", real=True)

# %% [markdown]
# A sum over points needs no index here: `sum_x` is $\sum_i x_i$, and `x_c` is the mean of the $x_i$, so
# that `sum_x` and `N * x_c` are the same. The mean point $(x_c, y_c)$ is the **centre** of the points.

# %% exercise="Q2.2a"

# %% exercise="Q2.2b"

# %% [markdown]
# Half of the problem is solved: whatever $\alpha$ is, we know the best $r$. Now put it back into the
# cost. Then only $\alpha$ is unknown.
#
# The formulas become short when we measure coordinates from the centre, $\tilde x_i = x_c - x_i$ and
# $\tilde y_i = y_c - y_i$. By hand, for the three points $(0, 0)$, $(1, 1)$ and $(2, 5)$: the centre is
# $(1, 2)$, so $\tilde x = (1, 0, -1)$ and $\tilde y = (2, 1, -3)$, which gives $S_{xx} = 2$,
# $S_{yy} = 14$ and $S_{xy} = 5$.

# %% exercise="Q2.2c"

# %% exercise="Q2.2d"

# %% exercise="Q2.2e"

# %% [markdown]
# ## Valley or hill?
#
# A slope of zero is found at the bottom of a valley and at the top of a hill. The best line is a
# valley of the cost. The *worst* line through the centre, the one at right angles to the wall, is a
# hill, and it solves the same equation. Within half a turn there is one of each, a quarter turn apart.
#
# The tangent of $2\alpha$ does not tell them apart: $\tan$ repeats itself after $\pi$, so $\alpha$ is known
# only up to a quarter turn. The second derivative decides. It is positive in a valley.

# %% exercise="Q2.2f1"

# %% exercise="Q2.2f2"

# %% [markdown]
# ## The function
#
# Now all of it together, as a program. From here on the names `r` and `alpha` may stand for numbers.

# %% exercise="Q2.3"

# %%
progress()

# %% [markdown]
# ## Further reading
#
# What you have derived is known as *total least squares* or *orthogonal regression*. The same line comes
# from the singular value decomposition of the centred points: its normal is the right singular vector of
# the smallest singular value.
#
# Next: [RANSAC](3_ransac.ipynb), for the case that half of the points are not on the wall at all.
