# %% [markdown]
# # Start here
#
# A robot drives round a campus and down a long corridor. It has two senses.
#
# - Its **camera** takes photographs. Has it been here before? (Chapter 1, place recognition)
# - Its **laser** measures distances in a plane. Where are the walls? (Chapter 2, line fitting)
# - Half of what both report is wrong: a tree that looks like another tree, a person in front of
#   the wall. Which half? (Chapter 3, RANSAC)
#
# At the end you will be able to
#
# - build a search engine for photographs that tells a robot where it is,
# - derive the line that is closest to a set of points, and say how certain it is,
# - find lines and planes among mostly wrong measurements, and compute how long that takes,
# - draw a map of a building from what a laser saw.
#
# You need linear algebra, a little calculus, a little probability, and Python with NumPy. You need no
# robotics.
#
# The questions follow an exercise sheet of a robotics lecture. You do not need it. Short remarks that begin with *For
# readers of the sheet* say where the course corrects it; without the sheet, pass over them.

# %% [markdown]
# ## Is everything installed?
#
# Click on the next cell and press Shift and Enter. It should answer with one line that says so.

# %%
import cv2
import numpy as np
import sympy as sp

import data
from notebooks import figures

photographs, scans = data.campus_photographs(), data.killian_court()
print(
    f"Everything is installed, {len(photographs)} photographs and {len(scans.ranges)} scans are here."
)

# %% [markdown]
# And pictures? This is what the robot sees, and what you will make of it. (In the middle the robot is the orange triangle,
# and each blue dot is a spot that its laser has hit.)

# %% demo=true
beams = np.stack([np.cos(scans.angles), np.sin(scans.angles)], axis=1)
figures.three_senses(photographs["0503"], scans.ranges[161, :, np.newaxis] * beams, scans)

# %% [markdown]
# ## Who are you?
#
# Write your name or number as the class list has it. It is kept with your answers and handed in with them. In a class
# where everybody has numbers of their own, yours follow from it, on every computer.

# %%
me()

# %% [markdown]
# ## How to answer
#
# There are five kinds of question. Each has its own number, and you can answer it again as often
# as you like.
#
# | kind | what you do |
# |---|---|
# | true or false | click a choice for each statement |
# | order | drag the cards until their order is right |
# | number | replace `...` by a number, or by Python that computes one |
# | expression | replace `...` by a formula of symbols |
# | function | replace `raise NotImplementedError` by your code |
#
# A cell `ask(...)` shows a question to click on. Run it, click, and press **Check**. Below a number, an
# expression or a function stands a cell `check(...)`. Run it: it tells you what it made of your answer. While
# `...` stands, it also shows a field, into which you may type a number or a formula instead; what a cell assigns
# wins. Hints come one at a time, when you ask for them: by a button, or where there is none, by `hint("Q2.2a")`.
#
# Your copy of the course may not hold the answers to all questions. Then there is no button **Check**, or the result of
# `check(...)` is *recorded*: your answer is stored, and marked after you have handed it in.
#
# Here is how a formula is written. First come the symbols, then an expression of them:

# %%
width, height = sp.symbols("width height", positive=True)
area = width * height
area

# %% [markdown]
# `sp.sin(width)`, `sp.cos(width)`, `sp.sqrt(width)` and `width**2` work as you would expect. It does
# not matter in which form you write a formula: `height * width` is the same answer. Formulas and numbers are
# written without quotes, and of an equation only the side that is asked for: `width * height`, not
# `sp.Eq(area, width * height)`.
#
# A function leaves the arrays and lists that it is given as they are. To change one, make a copy first.
#
# Your answers are stored as you give them. You may close the notebook, restart its kernel or clear
# its outputs, and they are still there.

# %% [markdown]
# ## How far you are, and how to hand in
#
# At any time:

# %%
progress()

# %% [markdown]
# When you are done, or when time is up, open a new cell and run `submit()`. It writes the file
# `submission.zip` and lists what you have not answered yet. Hand in that file. You may hand in
# unfinished work: what is not answered counts as not attempted, nothing worse.
#
# ## Where to go
#
# 1. [Place recognition](1_place_recognition.ipynb)
# 2. [Line fitting](2_line_fitting.ipynb)
# 3. [RANSAC](3_ransac.ipynb)
#
# The chapters belong together but do not need each other: begin where you like. [Practice](4_practice.ipynb) asks
# more of the same, with other numbers and without points.
