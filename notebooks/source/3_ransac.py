# %% [markdown]
# # 3 RANSAC
#
# Chapter 2 found the best line through *all* the points it was given, and somebody had picked out the points of one
# wall beforehand. A robot has to do that itself. Most of its beams do not hit the wall it looks for: they hit
# another wall, a door, a person, a chair. Points that belong to the line are its **inliers**, all others its
# **outliers**.
#
# At the end of this chapter your program will find the walls and planes among mostly wrong measurements, you will
# have computed how long that takes, and a map of a whole building will have come out of it.

# %%
import math
from statistics import NormalDist
from typing import NamedTuple

import cv2
import numpy as np
import sympy as sp

import data
from notebooks import figures
from notebooks.explorers import explore_ransac, explore_ransac_steps

# %% [markdown]
# From chapter 2 we need a line, its fit and the distances from it. The fit here is OpenCV's, so that this chapter does
# not depend on the last one; it finds the same line as yours.


# %%
class Line(NamedTuple):
    """A line x cos(alpha) + y sin(alpha) = r."""

    r: float  # m, distance from the origin, never negative
    alpha: float  # rad, direction of the normal, in (-pi, pi]


def fit_line(points):
    """Return the line of least squares through (N, 2) points; two points are enough."""
    dx, dy, x, y = cv2.fitLine(np.float32(points), cv2.DIST_L2, 0, 0.01, 0.01).ravel().tolist()
    r = y * dx - x * dy
    return Line(r, math.atan2(dx, -dy)) if r >= 0 else Line(-r, math.atan2(-dx, dy))


def distances(points, line):
    """Return the N signed distances of (N, 2) points from a line, in metres."""
    return points @ [math.cos(line.alpha), math.sin(line.alpha)] - line.r


# %% [markdown]
# Here is the scan of chapter 2 again, with *all* its points, and the line of least squares through them. The band around
# it is 10 cm wide on both sides.

# %% demo=true
scans = data.killian_court()
ranges, angles = scans.ranges[161], scans.angles
points = np.column_stack([ranges * np.cos(angles), ranges * np.sin(angles)])
figures.hypothesis(points, fit_line(points), threshold=0.1)

# %% [markdown]
# The line is a compromise between three walls and belongs to none of them. If we knew the inliers of one wall, fitting
# would be easy. If we knew its line, finding the inliers would be easy. We know neither. RANSAC, *random sample
# consensus*, gets out of this circle by guessing.
#
# ## Guess, count, repeat
#
# 1. **Sample**: draw at random the fewest points that define the model. The smaller the sample, the
#    better the chance that no outlier is in it.
# 2. **Model**: make the model from the sample, exactly through its points.
# 3. **Count**: find all points that are closer to the model than a threshold. They are the
#    **consensus set** of this model.
# 4. Repeat, and keep the model with the largest consensus set.
# 5. **Refit**: at the end, fit the model again by least squares, to its consensus set only.
#
# The picture shows one model and its consensus set, among 26 points. The title says what counts:

# %% demo=true
few = figures.few_points()
figures.hypothesis(few, Line(r=2.0, alpha=math.radians(115)), threshold=0.3)

# %% [markdown]
# And here are six guesses on the same points. The two points of each sample are large and orange. **Before you look at
# the numbers**: which pictures hold a sample without any outlier?

# %% demo=true
figures.guesses(few, threshold=0.3, rng=np.random.default_rng(5))

# %% [markdown]
# A model made from a sample with an outlier, an **outlier model**, lies somewhere across the points, and
# few of them happen to agree with it. A model from inliers only gets the votes of most of the others. Errors
# disagree with each other; the truth agrees with itself. (Look at the first and the last picture of
# the second row for what can go wrong even so. We will come back to that.)
#
# RANSAC needs to know two things about the model: how to make one from a few points, and how far
# a point is from it.

# %% exercise="Q3.1"

# %% [markdown]
# ## How long does it take?
#
# Guessing sounds hopeless. It is not, and you can compute why. The numbers for all the questions: how many
# points $N$ the cloud has, which share $w$ of them are inliers, and the probability $p$ of success that we want.

# %%
N, w, p = numbers("cloud")
print(f"{N} points, a share w = {w} of them inliers; wanted is success with p = {p}")

# %% [markdown]
# > *For readers of the sheet:* it calls $w$ the *inlier count* and $p$ the *probability of all inliers*, and computes with both as we do.
#
# When a point is drawn, it is an inlier with probability $w$. Strictly speaking, that changes a little once
# a point has been taken out: of the $N - 1$ that remain, $wN - 1$ are inliers. The cloud is large, so we neglect that.
#
# Make a guess before you compute:

# %% demo=true
predict("P3.1")

# %% [markdown]
# The simulation draws samples in 10,000 runs and counts how many each run needed.

# %% demo=true
figures.waiting_times(N, w, 2, predicted("P3.1"), np.random.default_rng(0), p=p)

# %% [markdown]
# You could put other numbers in place of `predicted("P3.1")` until the share of the blue part is $p$. It is faster to compute it. A coin as an example: it falls on heads with
# probability 0.5, so $k$ tosses are all tails with probability $0.5^k$. To see heads at least once with probability
# 0.99 we need $0.5^k \le 0.01$, so $k \ge \log 0.01 / \log 0.5 = 6.64$: seven tosses.

# %% exercise="Q3.2.1"

# %% [markdown]
# The simulation with your number. It should come out close to $p$:

# %% demo=true
figures.waiting_times(N, w, 2, iterations, np.random.default_rng(0), p=p)

# %% exercise="Q3.2.2"

# %% [markdown]
# Compare your last two results: so few tries, among so many candidates. And the number of iterations does not
# depend on $N$ at all. A cloud of a million points needs just as many, as long as the share of inliers is the same.
#
# Now a general formula. For the next question `w` becomes a symbol, and then a number again.

# %%
w = sp.Symbol("w", positive=True)

# %% exercise="Q3.2.3a"

# %% [markdown]
# Back to numbers. `outlier_model` still holds the symbol; for the next question write the formula once more with the
# number `w`.

# %%
w = numbers("cloud").w

# %% exercise="Q3.2.3b"

# %% [markdown]
# Each square below is one run of 42 iterations. It is dark if *all* samples of the run held an outlier. Does the share of
# dark squares fit your number? (It will not be equal: a thousand runs are a sample, too.)

# %% demo=true
figures.runs_that_failed(N, w, 42, outlier_after_42, np.random.default_rng(0))

# %% exercise="Q3.2.4"

# %% demo=true
figures.runs_that_failed(N, w, 100, success_after_100, np.random.default_rng(0))

# %% [markdown]
# ## From lines to planes
#
# RANSAC does not care what it fits. A pair of cameras, or a laser that also turns up and down, measures points
# in space; floors and walls are planes there. Everything stays the same but the sample.

# %% exercise="Q3.2.5"

# %% [markdown]
# A real program draws three *different* points, so the
# probability of a clean sample is $\frac{wN}{N} \cdot \frac{wN-1}{N-1} \cdot \frac{wN-2}{N-2}$, slightly less than
# $w^3$. The question told you to neglect that. For lines it makes no difference in the end,
# for planes it costs a few iterations. Both numbers are accepted.
#
# You have now used the same formula several times. Write it as a function, and it is of use for every model
# there is.

# %% exercise="Q3.3"

# %% [markdown]
# How the number grows, by your function. The vertical axis is logarithmic: each line of the grid is ten times the one
# below. (Two photographs take seven points, or eight with the simplest method, as drawn here.)

# %% demo=true
figures.growth(required_iterations, {"a line": 2, "a plane": 3, "two photographs": 8})

# %% [markdown]
# Play with it. How many more iterations does one more point in the sample cost, when half of the points are inliers, and
# when three of four are outliers?

# %% demo=true
explore_ransac()

# %% [markdown]
# Now watch RANSAC at work on the scan. **Draw** takes one sample; **Run** draws as many as you computed for a line. On
# the right is the number of samples that the formula asks for *with the best share of inliers so far*. Nobody knows $w$
# before the first sample, but every better line is a better guess of it. When could a program stop by itself?
#
# Then add outliers until the share of the points on the wall is your $w$, and look at a hundred runs at once. Is your number of
# iterations enough in $100\,p$ of them?

# %% demo=true
explore_ransac_steps(points, iterations)

# %% [markdown]
# ## What the formula does not promise
#
# The formula promises *one sample without an outlier*. Not more. The inliers of such a sample are noisy themselves, and
# a line through two noisy points that are close together may point anywhere.
#
# In the next simulation every run draws as many samples as you computed for a line, 200 points of a wall of one metre
# are inliers, and each is 5 mm off or so. The threshold is 2.5 times that. How many of the true inliers does the best line
# of each run keep?

# %% demo=true
predict("P3.2")

# %% demo=true
figures.noisy_inliers(N, w, iterations, np.random.default_rng(0), predicted("P3.2"))

# %% [markdown]
# Each bar counts runs: the farther to the right, the more of the true inliers the best line of these runs keeps. In the left picture
# the line still goes through the two points of its sample. In the right picture it has been fitted once more, by least squares,
# to its consensus set: step 5 of RANSAC.
#
# The runs in the bar at 0 never drew a sample without an outlier, and the refit cannot help them. Look at the others: those that kept less
# than 90 % before. The refit repairs about four of five of them. That is why step 5 is not a luxury.
#
# ## Your RANSAC
#
# Your function ends with *one* refit. After it a few more points may lie within the threshold, or a few fewer, so one could fit again to
# these, and again, until the set no longer changes. Some programs do. Here it is not asked for: the first refit averages over
# many points instead of two, and after that there is little left to gain. (On our scan, a second refit moves the line by less than
# two millimetres in most runs.)

# %% exercise="Q3.4"

# %% [markdown]
# Your function on the 26 points from above:

# %% demo=true
figures.found_line(few, ransac_line, threshold=0.3, iterations=50)

# %% [markdown]
# And on the scan, the same points as in the first picture of this chapter. Then change the threshold to 0.5 m and
# to 0.005 m. What goes wrong in each case?

# %% demo=true
figures.found_line(points, ransac_line, threshold=0.06, iterations=100)

# %% [markdown]
# ## When to stop, and what to count
#
# The number of iterations needs $w$, which nobody knows beforehand. You saw the way out above: every line found so far is a
# guess of it.

# %% exercise="Q3.7a"

# %% demo=true
predict("P3.3")

# %% demo=true
rng = np.random.default_rng(0)
figures.stopping(points, adaptive_stop, 0.06, p, rng, predicted("P3.3"))

# %% [markdown]
# The threshold need not be tried out either, if the noise is known. When points are off by $\sigma$, the squared distance of an inlier from its line,
# $d^2 / \sigma^2$, follows the **chi-square** distribution with one degree of freedom: 95 % of them lie below 3.84, the square of 1.96. So a
# threshold of $1.96\,\sigma$ keeps 95 % of the inliers. For the laser with its 2 cm that is 4 cm; the 6 cm that we use leave room for the
# line, which is off as well:

# %% demo=true
sigma = 0.02
for share in (0.9, 0.95, 0.99):
    print(
        f"{share:.0%} of the inliers within {NormalDist(0, sigma).inv_cdf((1 + share) / 2):.3f} m"
    )

# %% [markdown]
# And why should a point at the edge of the band count as much as one in its middle?

# %% exercise="Q3.7b"

# %% [markdown]
# Here is the difference. Take the line that fits the wall, push it sideways by a few centimetres, to and fro, and ask for each position what it costs.
# For the grey curve each point outside the band costs the squared threshold, and a point inside costs nothing: that is
# counting. It goes in steps, and all positions on its lowest step are equally good to it. The blue curve is your cost. It has a
# single lowest point:

# %% demo=true
figures.pushed_line(points[77:131], fit_line(points[77:131]), msac_cost, threshold=0.06)

# %% [markdown]
# ## Planes in space
#
# Two photographs of two brick walls and the ground between them were taken from positions 30 cm apart. Points that were
# found in both can be located in space. The result is a cloud of points, and nothing says which of them belong to which
# wall:

# %% demo=true
bricks = data.brick_walls()
figures.cloud(bricks.points, bricks.colors)

# %% [markdown]
# For planes we need the counterparts of the functions for lines. A plane has a unit normal $\mathbf{n}$ and a distance $r$
# from the origin, and holds the points with $\mathbf{n} \cdot \mathbf{p} = r$:


# %%
class Plane(NamedTuple):
    """A plane normal . p = r."""

    normal: tuple[float, float, float]  # unit vector from the origin towards the plane
    r: float  # m, distance from the origin, never negative


def fit_plane(points):
    """Return the plane of least squares through (N, 3) points; three points are enough."""
    center = points.mean(axis=0)
    normal = np.linalg.svd(points - center, full_matrices=False)[2][-1]
    normal = normal if normal @ center >= 0 else -normal
    return Plane(tuple(normal.tolist()), float(normal @ center))


def plane_distances(points, plane):
    """Return the N signed distances of (N, 3) points from a plane, in metres."""
    return points @ plane.normal - plane.r


# %% exercise="Q3.5"

# %% [markdown]
# The three largest planes of the cloud, by your function, one after the other: the points of each are taken away before it
# looks for the next.

# %% demo=true
predict("P3.4")

# %% demo=true
figures.largest_planes(bricks.points, ransac_plane, 0.02, 300, predicted("P3.4"))

# %% [markdown]
# The formula promises one clean sample in 95 % of the runs, and not that its plane is a good one: three points that are close together and
# noisy give a tilted plane, as two such points give a tilted line. Real data asks for some more iterations than the formula.

# %% [markdown]
# ## All the walls of a scan
#
# Back to the corridor, and to the last missing piece.

# %% exercise="Q3.6"

# %% demo=true
figures.walls_of_scan(points, find_walls, threshold=0.06, iterations=200, min_points=12)

# %% [markdown]
# Look closely at the first wall: a few points beyond the gap lie on its line by chance, and RANSAC took them. It looks
# at points as a heap, without any order. A program that uses the order of the beams would have cut the wall at the gap.
#
# ## The map
#
# The robot went through the whole building and made 3873 scans. Each is stored with the robot's **pose**: its position
# and its heading. (The poses come from a program that had recognised places and closed loops, as in chapter 1.)
# A beam with the angle $\theta$ seen from a robot with the heading $\varphi$ points in the direction $\theta + \varphi$:

# %% demo=true
x, y, heading = scans.poses.T[:, :, np.newaxis]
seen = np.where(scans.ranges < 30, scans.ranges, np.nan)
world_x = x + seen * np.cos(heading + scans.angles)
world_y = y + seen * np.sin(heading + scans.angles)

# %% demo=true
figures.corridor(world_x, world_y, scans.poses[:, :2])

# %% [markdown]
# That is a heap of 684,628 points. Your `find_walls` turns it into a drawing: here it looks for walls in every
# thirtieth scan, and what it finds is drawn as segments. It takes a few seconds.

# %% demo=true
figures.corridor_walls(scans, find_walls, every=30, threshold=0.06, iterations=100, min_points=15)

# %% [markdown]
# A building of more than 200 metres, from random guesses. Where the map has gaps, which scans would you add? Where it has too many
# walls, what would you ask of a wall before you believe in it?

# %%
progress()

# %% [markdown]
# When you have done all three chapters, open a new cell and run `submit()`.
#
# ## Further reading
#
# - R. Raguram, J.-M. Frahm and M. Pollefeys, *A comparative analysis of RANSAC techniques leading to
#   adaptive real-time random sample consensus*, ECCV 2008: what to do when $w$ is not known and time is short.
# - M. A. Fischler and R. C. Bolles, *Random sample consensus*, Communications of the ACM 24(6), 1981: where it began, with a
#   camera that wanted to know where it was.
# - D. Nister and H. Stewenius (CVPR 2006) and H. Stewenius, S. H. Gunderson and J. Pilet (ECCV 2012), from chapter 1:
#   RANSAC is how such candidates are usually verified.
