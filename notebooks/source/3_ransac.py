# %% [markdown]
# # 3 RANSAC
#
# Chapter 2 found the best line through *all* the points. But when the robot looks down the corridor,
# most beams do not hit the wall it looks for: they hit another wall, a door, a person, a chair.
# Points that belong to the line are its **inliers**, all others its **outliers**. Least squares
# listens to the outliers most of all.
#
# If we knew the inliers, fitting would be easy. If we knew the line, finding the inliers would be easy.
# We know neither. RANSAC, *random sample consensus*, gets out of the circle by guessing.

# %%
import math

import numpy as np
import sympy as sp

from autograder import ask, check, progress, submit

# %% [markdown]
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
# A model made from a sample with an outlier, an **outlier model**, lies somewhere across the points, and
# few of them happen to agree with it. A model from inliers only gets the votes of all the others. Lies
# differ, the truth agrees with itself.
#
# RANSAC needs to know two things about the model: how to make one from a few points, and how far
# a point is from it.

# %% exercise="Q3.1"

# %% [markdown]
# ## How long does it take?
#
# Guessing sounds hopeless. It is not, and you can compute why. The numbers for all the questions:

# %%
N = 1000  # points in the cloud
w = 0.2  # the share of inliers among them
p = 0.95  # the probability of success that we want

# %% [markdown]
# When a point is drawn, it is an inlier with probability $w$. Strictly speaking, that changes a little once
# a point was taken out: of the 999 that remain, 199 are inliers. The cloud is large, so we neglect that.
#
# Make a guess before you compute: with four outliers for every inlier, how many lines must be tried to
# be 95 % sure that one was made from inliers only? A dozen? A hundred? Ten thousand?

# %% exercise="Q3.2.1"

# %% exercise="Q3.2.2"

# %% [markdown]
# Compare your last two results. That is the strength of the random sample.
#
# Now a general formula. For the next question `w` becomes a symbol, and then a number again.

# %%
w = sp.Symbol("w", positive=True)

# %% exercise="Q3.2.3a"

# %%
w = 0.2

# %% exercise="Q3.2.3b"

# %% exercise="Q3.2.4"

# %% [markdown]
# ## From lines to planes
#
# RANSAC does not care what it fits. A camera pair, or a laser that also turns up and down, measures points
# in space; floors and walls are planes there.

# %% exercise="Q3.2.5"

# %% [markdown]
# You have now used the same formula several times. Write it as a function, and it is of use for every model
# there is.

# %% exercise="Q3.3"

# %%
progress()

# %% [markdown]
# ## Further reading
#
# - R. Raguram, J.-M. Frahm and M. Pollefeys, *A comparative analysis of RANSAC techniques leading to
#   adaptive real-time random sample consensus*, ECCV 2008: what to do when time is short.
