# %% [markdown]
# # The cellar

# %%
from autograder import ask, check, progress, submit

# %% exercise="Q2.1"
