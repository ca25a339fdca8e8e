# %% [markdown]
# # 1 Place recognition
#
# A robot has driven for an hour. Its estimate of where it is has drifted by several metres. Now it
# comes round a corner, and its camera sees a place that it passed half an hour ago. If it
# *recognises* that place, it can correct an hour of drift at one stroke. This is called **closing a
# loop**. The same skill helps a robot that was carried away and put down somewhere: the
# **kidnapped robot**.
#
# A wrong recognition is worse than none. It ties two places together that are far apart, and may
# ruin the whole map. So the robot must be fast, since it has thousands of photographs to compare
# with, and careful.

# %%
from autograder import ask, check, progress, submit

# %% [markdown]
# ## Features
#
# Comparing photographs pixel by pixel does not work: one step to the side, and every pixel has
# changed. Instead the program looks for **keypoints**, small spots that are easy to find again,
# such as the corner of a window. It describes the surroundings of each by a vector of numbers, the
# **descriptor**. A keypoint with its descriptor is a **feature**.
#
# - *SIFT* and *SURF* describe how brightness changes around the keypoint by 128 (or 64) real numbers.
#   They cope with changes of scale, rotation and light, and they take their time.
# - *FAST* only compares a few pixels to find a corner; *BRIEF* and *ORB* describe it by a string of
#   bits. That is many times faster, and less robust.
#
# ## From descriptors to words
#
# A photograph has about a thousand features, so a database of a thousand photographs has a
# million. Comparing each new feature with all of them is too slow. The idea that saves us comes from
# text search: use **words**.
#
# Take the descriptors of many photographs. Each is a point in a space of 128 dimensions, the
# **descriptor space**. Spots that look alike lie close together there. **k-means clustering** divides
# the points into groups: it guesses $k$ centres, gives every point to the nearest centre, moves each
# centre to the mean of its points, and repeats. Each group is a **visual word**.
#
# A photograph can now be written as a list of words, and the list as a **histogram**: how often does
# each word occur? This is the **bag of words**. As in a real bag, it is lost where each thing was.
# Photographs with similar bags are good candidates for the same place.
#
# ### The tree
#
# Good vocabularies have up to a million words. To find the word of a descriptor, we do not want to
# compare it with a million centres. The **vocabulary tree** divides the space into only ten
# groups, each of these into ten, and so on. With six levels there are a million words at the bottom,
# but a descriptor is compared with ten centres at each level: 60 comparisons instead of a million.
#
# ### The inverted file
#
# A book's index lists for each word the pages on which it occurs. The **inverted file** does the same
# for visual words: it lists for each word the images in which it occurs. To find out which images
# share words with a new photograph, we open the index at the words of that photograph only.
#
# Every image that is listed there gets a vote. The votes are counted in a **voting array** with one
# entry for each image. The image with the most votes is the best candidate.
#
# Here is a tiny example, by hand. The inverted file is
#
# | word | images |
# |---|---|
# | 0 (window corner) | A, B |
# | 1 (brick) | B |
# | 2 (leaf) | A, C |
#
# A new photograph has the words 0, 1 and 2. Word 0 gives a vote to A and B, word 1 to B, word 2 to A
# and C. The voting array is A 2, B 2, C 1: A and B tie, and C is less likely.

# %% exercise="Q1.1"

# %% [markdown]
# ## All steps in order
#
# The next question is about the whole system. Three sets of images play a part:
#
# - the **image collection**, any large set of photographs, from which the words are learnt;
# - the **model images**, the photographs of the places that shall be recognised;
# - the **test image**, the photograph that the robot has just taken.
#
# Words are learnt once. The inverted file is filled once for each model image. The look-up happens
# again and again, with every new photograph. When the inverted file is filled we call the tree ready.

# %% exercise="Q1.2"

# %%
progress()

# %% [markdown]
# ## Further reading
#
# - D. Nister and H. Stewenius, *Scalable recognition with a vocabulary tree*, CVPR 2006: the tree, the
#   inverted file and the weights.
# - H. Stewenius, S. H. Gunderson and J. Pilet, *Size matters: exhaustive geometric verification for
#   image retrieval*, ECCV 2012: what checking the geometry of the candidates adds.
#
# Next: [line fitting](2_line_fitting.ipynb).
