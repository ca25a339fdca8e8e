# %% [markdown]
# # The orchard

# %%
from sympy.abc import l, w

from autograder import ask, check, progress, submit

# %% exercise="Q1"

# %% exercise="Q2"

# %% exercise="Q3"

# %% exercise="Q4"
