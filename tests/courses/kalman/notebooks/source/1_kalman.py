# %% [markdown]
# # The Kalman filter
#
# A scale trembles. How sure can you be of a weight after one reading, after two, after twenty?

# %%
import matplotlib.pyplot as plt
import numpy as np
import sympy as sp

import data

# %%
readings = data.weighings()
print(len(readings), "readings of the scale; these data are", data.WHOSE)

# %% demo=true
plt.plot(readings, "o")
plt.xlabel("reading")
plt.ylabel("weight in kg")
plt.show()

# %% exercise="Q1.1"

# %% exercise="Q1.2"

# %% [markdown]
# A guess has the variance `P`, a reading the variance `R`, both in kg².

# %% exercise="Q1.3"

# %%
P, R = sp.symbols("P R", positive=True)

# %% exercise="Q1.4"

# %% exercise="Q1.5"

# %%
progress()

# %%
submit()
