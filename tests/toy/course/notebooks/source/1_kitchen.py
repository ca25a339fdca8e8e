# %% [markdown]
# # The kitchen
#
# Everything that follows happens at sea level.

# %%
import numpy as np
import sympy as sp

from autograder import ask, check, progress, submit

# %% exercise="Q1.1"

# %% exercise="Q1.2"

# %% [markdown]
# Now some numbers.

# %% exercise="Q1.3"

# %%
a, b, half = sp.symbols("a b half")

# %% exercise="Q1.4"

# %% exercise="Q1.5"
