# %% [markdown]
# # 2 Line fitting
#
# The robot has turned from the campus into a building. Its laser scanner sends a beam in each of 180
# directions, parallel to the floor, and measures how far it gets. Along a wall, the end points of
# the beams lie on a line. If the robot finds these lines, it knows how it stands in the corridor.
#
# At the end of this chapter you will have derived the line that is closest to a set of points, written
# the function that finds it, and worked out how far it can be trusted.

# %%
import math
from typing import NamedTuple

import numpy as np
import sympy as sp

import data
from notebooks import figures
from notebooks.explorers import explore_cloud, explore_polar_line

# %% [markdown]
# Here is one scan from a real robot, in the corridors of MIT's Killian Court. Beam number $i$ has the
# angle `angles[i]` in radians and the length `ranges[i]` in metres; the robot stands at the origin and looks
# along the $x$-axis. Sine and cosine turn the beams into points:

# %% demo=true
scans = data.killian_court()
ranges, angles = scans.ranges[161], scans.angles
points = np.column_stack([ranges * np.cos(angles), ranges * np.sin(angles)])
wall = points[77:131]
figures.scan(points, wall)

# %% [markdown]
# The robot comes to the end of a corridor and sees the wall of the next one straight ahead. The points scatter
# around the wall by a few centimetres: no measurement is exact. So no line goes through all of
# them. Which one is the best?
#
# ## A line without a slope
#
# At school a line is $y = mx + b$, and NumPy finds $m$ and $b$ by `polyfit`. It measures the errors of the points along $y$.
# With the axes exchanged it measures them along $x$ and finds $x = m'y + b'$, which is a line with the slope $1/m'$.

# %% demo=true
predict("P2.1")

# %% demo=true
x, y = wall.T
m, b = np.polyfit(x, y, 1)
m_exchanged, b_exchanged = np.polyfit(y, x, 1)
print(f"errors along y: m = {m:.1f}; errors along x: m = {1 / m_exchanged:.1f}")
print("Your prediction:", predicted("P2.1") or "none")

# %% [markdown]
# One wall, and two slopes, the second about a quarter larger than the first. For an upright wall a tiny error in $x$ is a huge one in $y$, and if the
# wall stands exactly upright, no $m$ is right. Below, an artificial wall of four metres is turned step by step, and
# $y = mx + b$ is fitted each time. Watch the slope on the way:

# %% demo=true
rng = np.random.default_rng(0)
straight = np.column_stack([np.linspace(-2, 2, 40), rng.normal(0, 0.12, 40)])
figures.steep_walls(straight)

# %% [markdown]
# A robot needs a form that treats all directions alike. Draw the shortest connection from the origin
# to the line. It has a length, $r$, and it makes an angle with the $x$-axis, $\alpha$. These two numbers
# are the line's **polar parameters**, and
#
# $$x \cos\alpha + y \sin\alpha = r, \qquad r \ge 0, \quad -\pi < \alpha \le \pi$$
#
# holds for every point $(x, y)$ on it.

# %% demo=true
figures.polar_line(r=1.8, alpha=math.radians(35))

# %% [markdown]
# Read the equation as a dot product: $(\cos\alpha, \sin\alpha)$ is the **normal**, the unit vector at right
# angles to the line, and all points of the line reach equally far in its direction.
#
# For a point that is *not* on the line, $x \cos\alpha + y \sin\alpha - r$ is its distance from the line,
# with a sign that tells the side. The wall $x = 2$ has $\alpha = 0$ and $r = 2$; the point $(5, 1)$ has the
# distance $5 \cdot 1 + 1 \cdot 0 - 2 = 3$ from it.
#
# > *For readers of the sheet:* it derives the equation from Pythagoras, $x^2 + y^2 = r^2$, which holds only at the foot of the normal.
#
# What do $r$ and $\alpha$ do? Each picture shows one pair of them. Change the numbers and run it again:

# %% demo=true
figures.polar_lines([(2, math.pi / 4), (1, math.pi / 4), (2, -math.pi / 2)])

# %% [markdown]
# A line is a pair of numbers for us, and gets a name of its own:


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
# In the picture each squared distance is the area of a square. Change $r$ and $\alpha$ by hand and try to get
# the cost below 0.3 m². Which of the two numbers is easier to adjust?

# %% demo=true
five = np.array([[1, 2.6], [2, 2.1], [3, 1.9], [4, 0.9], [5, 0.8]])
figures.squared_distances(five, Line(r=2.0, alpha=math.radians(80)))

# %% [markdown]
# Or take the line into your hand: drag its round handle, or use the sliders, and watch the cost on the right.

# %% demo=true
explore_polar_line(five)

# %% [markdown]
# Squares make the mathematics easy, as you will see, and they have a dark side. A point that is ten
# times as far from the line as another adds a hundred times as much to the cost. Mind the two words: **noise** is the small
# scatter of every point; an **outlier** does not belong to the line at all.
#
# > *For readers of the sheet:* it calls outliers *measurement noise*.

# %% exercise="Q2.1"

# %% [markdown]
# ## The derivation
#
# Now find the $r$ and $\alpha$ that make $S$ least, in steps. At a minimum both slopes are zero,
# $\partial S / \partial r = 0$ and $\partial S / \partial \alpha = 0$. Start with $r$, which is easier.
#
# > *For readers of the sheet:* where it begins with $\alpha$ it writes $\partial S / \partial r = 0$ again;
# > $\partial S / \partial \alpha = 0$ is meant.
#
# You type formulas, and these are their symbols:

# %%
r, alpha, N = sp.symbols("r alpha N", real=True)
x_c, y_c, sum_x, sum_y = sp.symbols("x_c y_c sum_x sum_y", real=True)
S_xx, S_yy, S_xy = sp.symbols("S_xx S_yy S_xy", real=True)

# %% [markdown]
# A sum over points needs no index here: `sum_x` is $\sum_i x_i$, and `x_c` is the mean of the $x_i$, so
# that `sum_x` and `N * x_c` are the same. The mean point $(x_c, y_c)$ is the **centre** of the points.
#
# An example of how a slope of a sum is written: for $\sum_i (r - x_i)^2$ each term has the slope
# $2 (r - x_i)$, and all together have $2 (N r - \sum_i x_i)$, in Python:

# %% demo=true
2 * (N * r - sum_x)

# %% exercise="Q2.2a"

# %% exercise="Q2.2b"

# %% [markdown]
# Half of the problem is solved: whatever $\alpha$ is, we know the best $r$. Now put it back into the
# cost. Then only $\alpha$ is unknown.
#
# The formulas become short when we measure coordinates from the centre, $\tilde x_i = x_c - x_i$ and
# $\tilde y_i = y_c - y_i$. By hand, for the three points $(0, 0)$, $(1, 1)$ and $(2, 5)$: the centre is
# $(1, 2)$, so $\tilde x = (1, 0, -1)$ and $\tilde y = (2, 1, -3)$, which gives $S_{xx} = 2$,
# $S_{yy} = 14$ and $S_{xy} = 5$. The same for the wall of the scan:

# %% demo=true
dx, dy = (wall.mean(axis=0) - wall).T
print(f"S_xx = {dx @ dx:.2f}, S_yy = {dy @ dy:.2f}, S_xy = {dx @ dy:.2f} m²")

# %% exercise="Q2.2c"

# %% exercise="Q2.2d"

# %% [markdown]
# > *For readers of the sheet:* it writes this slope as a *product of two sums*. The product stands inside one sum,
# > $2 \sum_i (\dots)(\dots)$, since the square of each point is differentiated on its own.

# %% exercise="Q2.2e"

# %% [markdown]
# ## Valley or hill?
#
# A slope of zero is found at the bottom of a valley and at the top of a hill. Here is the cost over the angle
# for two clouds of points, with the best $r$ for each angle. Your angle is marked, once you have one:

# %% demo=true
along = np.linspace(-1.8, 1.8, 30)
flat = np.column_stack([2.5 + along, 1.2 + 0.3 * along + rng.normal(0, 0.15, 30)])
steep = np.column_stack([2 + 0.3 * along + rng.normal(0, 0.15, 30), 1.8 + 0.9 * along])
figures.cost_over_angle({"a flat wall": flat, "a steep wall": steep}, alpha_opt)

# %% [markdown]
# Within half a turn there is one valley and one hill, a quarter turn apart. The valley is the best
# line. The hill is the *worst* line through the centre, the one at right angles to the wall, and it solves
# the same equation.
#
# A tangent does not tell them apart: $\tan$ repeats itself after $\pi$, so from $\tan 2\alpha$ the angle
# $\alpha$ is known only up to a quarter turn. A plain $\arctan$ takes whichever of the two lies between -45° and 45°.
# For which of the two clouds is that the hill? The second derivative decides: it is positive in a valley.
#
# > *For readers of the sheet:* it ends with the plain $\arctan$.

# %% exercise="Q2.2f1"

# %% exercise="Q2.2f2"

# %% [markdown]
# The same picture again, now with your angle of the minimum. It should stand in both valleys:

# %% demo=true
figures.cost_over_angle({"a flat wall": flat, "a steep wall": steep}, alpha_min)

# %% [markdown]
# The next picture shows one cloud in three views, and all of them move together. On the left are the points. In the middle is
# the cost of *every* line: a point of this map is a line, dark where the cost is low, and each white curve holds the
# lines through one of the points. Where the curves nearly meet, the points nearly agree. On the right is what you have just seen,
# the cost over the angle.
#
# Predict, then turn the cloud slowly and watch the sentence above the pictures. After that, drag
# the outlier (the square). The solid line is least squares. The dashed line is the one that most points agree with; it takes no
# notice of the outlier. How it is found is what chapter 3 is about.

# %% demo=true
predict("P2.2")

# %% demo=true
explore_cloud(five, outlier=(4, 3.5), predicted=predicted("P2.2"))

# %% [markdown]
# What if the cost has neither valley nor hill? That happens when $S_{xx} = S_{yy}$ and $S_{xy} = 0$, for
# instance at the four corners of a square. Then every line through the centre is as good as any other, and an honest
# program says so instead of returning some angle.
#
# ## The function
#
# Now write all of it as a program. (Variables inside a function are its own: if you call them `r` and `alpha`, the symbols of the
# same names above stay what they are.) The function also takes weights, for points of which some are more certain than
# others: each squared distance is multiplied by the weight of its point before the cost is added up.

# %% exercise="Q2.3"

# %% [markdown]
# Your line on the wall for which `polyfit` had two answers:

# %% demo=true
figures.fitted_line(wall, fit_line)

# %% [markdown]
# ## How certain is it?
#
# Each laser point is a little off, for this scanner by about 2 cm, as a picture further down shows. Call that $\sigma$, the
# standard deviation of a point's coordinates. Since the points are off, the fitted line is off too. By how much? Nobody knows the
# errors themselves, but how far $r$ and $\alpha$ scatter because of them can be computed. The result is the **covariance** of
# $(r, \alpha)$, a 2 × 2 matrix: on its diagonal stand the variances of $r$ and of $\alpha$, beside it how they go together.
#
# Walk along the wall with a tape measure. All positions along it count as positive to the left of the normal, that is, in the
# direction $(-\sin\alpha, \cos\alpha)$. Three quantities are needed:
#
# - $b_i$ is the position of point $i$, *measured from the centre* of the points;
# - $B = \sum_i b_i^2$ says how far the points spread along the wall;
# - $t$ is the position of the centre, *measured from the foot of the normal*, the point of the line nearest to the origin.
#
# Now think of small errors across the wall:
#
# - An error at one end of the wall turns the line. It turns less if the points are spread farther:
#   the variance of $\alpha$ is $\sigma^2 / B$.
# - The line passes through the centre, the mean of $N$ points. Across the wall the centre has the variance
#   $\sigma^2 / N$.
# - When the line turns about the centre, its distance $r$ from the origin changes as well, by $t$ for each radian. So the
#   variance of $\alpha$ comes into that of $r$ with the factor $t^2$, and the two errors go together, with the covariance $t\,\sigma^2 / B$.
#
# All together (as long as $\sigma$ is small compared with the wall):
#
# $$C = \sigma^2 \begin{pmatrix} \dfrac1N + \dfrac{t^2}{B} & \dfrac{t}{B} \\ \dfrac{t}{B} & \dfrac1B \end{pmatrix}$$

# %% exercise="Q2.4"

# %% [markdown]
# At each position along the wall, the line lies in the band with a probability of 95 %. (The whole line stays inside
# less often: a line that is right in the middle may leave the band at an end.) Mind the axes: across the wall the
# scale is in centimetres, along it in metres.

# %% demo=true
predict("P2.3")

# %% demo=true
figures.uncertain_line(wall, fit_line, line_covariance, 0.02, predicted("P2.3"))

# %% [markdown]
# Look at the points again. They do not scatter quite at random: where the wall is closest, some neighbours in a row
# all lie about 2 cm below the line. The formula believes that all errors are independent. It cannot know better, but
# you can.
#
# Can you trust a formula that you were given? Test it: give the wall new random errors, fit it again, a
# thousand times, and look at how the results spread. The ellipse is your covariance, the dots are the fits:

# %% demo=true
figures.scattered_fits(wall, fit_line, line_covariance, sigma=0.02, rng=np.random.default_rng(1))

# %% [markdown]
# That agreed because we made the errors as the formula wants them: equal in all directions, and from a bell curve. A laser errs *along its
# beam*, and this one reports steps of 5 cm.

# %% demo=true
predict("P2.4")

# %% [markdown]
# The same wall once more, with three kinds of error of the same size:

# %% demo=true
rng = np.random.default_rng(1)
figures.laser_errors(wall, fit_line, line_covariance, 0.02, 0.05, rng, predicted("P2.4"))

# %% [markdown]
# For this wall the direction hardly matters: most beams meet it nearly head-on. (At a slant, only a part of the error lies across the wall, and
# the formula is too careful.) The steps do matter. They add an error of their own, $5\,\mathrm{cm} / \sqrt{12} = 1.4$ cm, the same for
# neighbouring beams that are rounded the same way, and the distance of the line is off by about a quarter more than the
# formula says, its angle by a little more.
#
# ## One bad point
#
# So the line is known to a fraction of a degree, if all points belong to the wall. Now somebody steps in front of it, and
# *one* of the 54 points is wrong, the last one.

# %% demo=true
predict("P2.5")

# %% demo=true
figures.one_outlier(wall, fit_line, predicted("P2.5"))

# %% [markdown]
# Compare with the standard deviation of $\alpha$ above: one point turns the line by many times that. The covariance
# notices nothing, since it knows the sizes of errors only from the $\sigma$ that we told it. In a real scan, half of the points do not belong to the wall you
# look for. The next chapter is about that.

# %%
progress()

# %% [markdown]
# ## Further reading
#
# - What you have derived is known as *total least squares* or *orthogonal regression*. The same line comes
#   from the singular value decomposition of the centred points: its normal is the right singular vector of
#   the smallest singular value. That way it works in any dimension, for planes as well.
# - The uncertainty of lines from laser points, and what a robot does with it: R. Siegwart, I. Nourbakhsh and D.
#   Scaramuzza, *Introduction to Autonomous Mobile Robots*, chapter 4.
#
# Next: [RANSAC](3_ransac.ipynb), for the case that half of the points are not on the wall at all.
