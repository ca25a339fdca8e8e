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
#
# At the end of this chapter you will have built a search engine for photographs: the vocabulary tree of
# Nister and Stewenius, with its inverted file, its votes and its weights.

# %%
from functools import cache

import cv2
import numpy as np

import data
from notebooks import figures
from notebooks.explorers import explore_journey
from notebooks.two_views import two_views

# %% [markdown]
# These are the places that the robot knows, 20 photographs of a walk round a campus. Some of them show the same
# building. (The numbers are the camera's.)

# %% demo=true
walk = data.campus_photographs()
figures.photographs(walk)

# %% [markdown]
# And here are five photographs that it takes later. Where was it? **Decide for yourself first**, for each of
# the five: which photographs above show the same place?

# %% demo=true
queries = data.campus_queries()
figures.photographs(queries)

# %% [markdown]
# Two of them are hard even for us. Remember which ones.
#
# ## Features
#
# Comparing photographs pixel by pixel does not work: one step to the side, and every pixel has
# changed. Instead the program looks for **keypoints**, small spots that are easy to find again,
# such as the corner of a window. It describes the surroundings of each by a vector of numbers, the
# **descriptor**. A keypoint with its descriptor is a **feature**.

# %% demo=true
sift = cv2.SIFT_create(1000)
keypoints, descriptors = sift.detectAndCompute(walk["0503"], None)
print(f"{descriptors.shape[1]} numbers describe each keypoint")

# %% demo=true
figures.keypoints(walk["0503"], keypoints)

# %% [markdown]
# Each circle is a keypoint. Its size and direction come from the image as well, so that the descriptor
# does not change when the camera turns or comes closer.
#
# There are many kinds of feature.
#
# - *SIFT* and *SURF* describe how brightness changes around the keypoint, by 128 or 64 numbers.
# - *FAST* only compares a few pixels to find a corner; *BRIEF* describes it by a string of bits, each of which
#   compares two pixels. *ORB* combines the two.
#
# Which of them is the better choice? Predict before you see it. (A prediction is kept, and has no points: it is there for you, to
# compare with what comes true.)

# %% demo=true
predict("P1.1")

# %% [markdown]
# Both kinds of feature are tried on the 19 pairs of photographs below the picture on the right, each pair of one place. A
# **match** is a pair of keypoints, one in each photograph, whose descriptors are alike. Many matches are wrong, so only those
# count that fit together: two positions of the camera can be found from which all of them make sense. (How that is tested
# comes at the end of this chapter.)
#
# A few matches fit together by mere chance, even if the photographs show different places. The grey band goes up to the
# most that happened in 19 pairs of *different* places. A pair above the band is recognised; a pair inside it might as well be
# chance.

# %% demo=true
photographs = {**walk, **queries}
figures.compare_features(photographs, data.same_place_pairs(), predicted("P1.1"))

# %% [markdown]
# The bits of ORB are quick to compute and to compare: the distance of two descriptors is the number of bits in which they
# differ. Robots with small computers build their words from them (*bags of binary words*, as in ORB-SLAM):

# %% demo=true
figures.binary_descriptors(photographs["0502"], photographs["0503"])

# %% [markdown]
# The field has moved on since. Today a neural network often *learns* how to describe a photograph: it turns the whole
# photograph into one vector (NetVLAD, 2016, and its successors). Such a network can recognise at night a place that it saw by
# day. What you build in this chapter keeps its shape with learnt vectors too: compare vectors quickly, keep the best
# candidates, and let geometry have the last word.

# %% [markdown]
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
# each word occur? This is the **bag of words**. As in a real bag, the position of each thing is lost.
# Photographs with similar bags are good candidates for the same place.
#
# ### The tree
#
# Good vocabularies have up to a million words. To find the word of a descriptor, we do not want to
# compare it with a million centres. The **vocabulary tree** divides the space into a few
# groups only, each of these into a few again, and so on. Below, the space has two dimensions instead of 128, and
# the star is a new descriptor that looks for its word. It is compared with three centres, then with three more:

# %% demo=true
figures.descriptor_space()

# %% [markdown]
# With ten children at each node and six levels there are a million words at the bottom, and yet a descriptor is compared
# with only ten centres at each level: 60 comparisons instead of a million.
#
# ### The inverted file and the votes
#
# A book's index lists for each word the pages on which it occurs. The **inverted file** does the same
# for visual words: it lists for each word the images in which it occurs. To find out which images
# share words with a new photograph, we look up the words of that photograph only: this is the **lookup**.
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
# A new photograph has the words 0, 1 and 1. Word 0 gives a vote to A and to B, word 1 gives one to B, and the second word 1
# another one to B. The voting array is A 1, B 3, C 0, and B is the best candidate.

# %% exercise="Q1.1"

# %% [markdown]
# ### All steps in order
#
# The next question is about the whole system. Three sets of images play a part:
#
# - the **image collection**, any large set of photographs, from which the words are learnt;
# - the **model images**, the photographs of the places that shall be recognised;
# - the **test image**, the photograph that the robot has just taken.
#
# Words are learnt once. The inverted file is filled once for each model image. The lookup happens
# again and again, with every new photograph. When the inverted file is filled we call the tree ready.

# %% exercise="Q1.2"

# %% [markdown]
# ## Build it
#
# Now you build what you have put in order. First the features of all photographs:

# %% demo=true
features = {name: sift.detectAndCompute(image, None) for name, image in photographs.items()}
collection = np.vstack([features[name][1] for name in walk])
print(f"{len(walk)} photographs of the walk have about {len(collection) // 1000} thousand features")

# %% [markdown]
# ### The nearest word
#
# All of place recognition rests on one small step: which word is nearest to a descriptor? Near means that the
# **Euclidean distance** is small, the root of the sum of squared differences. (The root changes nothing about which is the
# smallest, so you may leave it out.)

# %% exercise="Q1.3"

# %% [markdown]
# The example that was worked by hand, with your function:

# %% demo=true
d = numbers("words").d
three, two = np.array([[1.0, 0], [d - 1, 1], [d + 1, d + 1]]), np.array([[0.0, 0], [d, 0]])
figures.nearest_words(three, two, assign_words)

# %% [markdown]
# ### The tree
#
# This is how the tree is trained: k-means on all descriptors, then k-means once more in each group, and so on. `levels` has
# the centres of each level, `levels[0]` those of the first $k$ groups. The children of row $i$ of one level are the
# rows $k i$ to $k i + k - 1$ of the next. Besides, the function keeps the `node` of each descriptor.


# %% demo=true
def k_means(points, k):
    """Return the (k, 128) centres of k groups of points, and the group of each point."""
    stop = (cv2.TERM_CRITERIA_MAX_ITER, 10, 0)
    _, groups, centers = cv2.kmeans(points, k, None, stop, 1, cv2.KMEANS_PP_CENTERS)
    return centers, groups.ravel()


def train_tree(descriptors, k, depth):
    """Return the centres of each level, and for each descriptor its row in the last one."""
    cv2.setRNGSeed(1)
    levels, node = [], np.zeros(len(descriptors), dtype=int)
    for _ in range(depth):
        centers, below = [], node * k
        for parent in range(node.max() + 1):
            found, group = k_means(descriptors[node == parent], k)
            centers.append(found)
            below[node == parent] += group
        levels, node = [*levels, np.vstack(centers)], below
    return levels, node


levels, words = train_tree(collection, k=8, depth=3)
[level.shape for level in levels]

# %% [markdown]
# Eight children, three levels: 512 words. What do they look like? Each row shows spots of different photographs that
# belong to the same word. Nobody has told the program what a window is, or a brick.

# %% demo=true
ends = np.cumsum([len(features[name][1]) for name in walk])
figures.word_patches(
    list(walk.values()), [features[name] for name in walk], np.split(words, ends[:-1])
)

# %% exercise="Q1.4"

# %% demo=true
far, high = numbers("tree")
children = [[-1.0, 0], [1, 0], [far - 2, 0], [far + 2, 0]]
small_tree = [np.array([[0.0, 0], [far, 0]]), np.array(children)]
figures.way_down(np.array([far - 1.0, high]), small_tree, descend_tree)

# %% [markdown]
# With your function every photograph becomes a list of words. (`@cache` keeps the result, so that each photograph is
# looked at only once. If you change `descend_tree`, run the next cell again: it forgets the old words.) To find a word takes 8 comparisons at each of 3 levels, not 512.


# %% demo=true
@cache
def words_of(name):
    """Return the words of a photograph, one for each of its features."""
    return np.array([descend_tree(descriptor, levels) for descriptor in features[name][1]])


# %% [markdown]
# ### The inverted file
#
# The list of words of each image is turned round: for each word, the images that have it.

# %% exercise="Q1.5"

# %% demo=true
figures.occurrences([np.array([0, 1, 1]), np.array([2, 0])], 4, build_inverted_file)

# %% [markdown]
# ### The votes
#
# The words of the test image are known now. Each of them is looked up, and votes.

# %% exercise="Q1.6"

# %% [markdown]
# Now ask it. For each of the five photographs the votes of all places are drawn, and the three best are shown beside
# them. (The bars do not start at zero, or you would see no difference.)


# %% demo=true
def votes_for(name, places=tuple(walk)):
    """Return the votes of a photograph for each place."""
    inverted_file = build_inverted_file([words_of(place) for place in places], len(levels[-1]))
    return count_votes(words_of(name), inverted_file, len(places))


# %% demo=true
same = data.same_place_pairs(by_eye=True)  # for the colours only; the search does not know it
figures.search_results(queries, walk, votes_for, same, "votes")

# %% [markdown]
# Not bad for a program that has never heard of buildings, and not good either. Look at the bars: *every* place gets a lot of
# votes. Some words, such as the edge between a leaf and the sky, occur on nearly all photographs. They vote for
# everybody.
#
# ### What a word is worth
#
# The word "the" tells nothing about what a text is about; the word "carburettor" tells a lot. The fewer images a word occurs
# in, the more it is worth. If $M$ is the number of images and $M_i$ the number of images with word $i$, its
# **weight** (*inverse document frequency*) is
#
# $$w_i = \ln \frac{M}{M_i}$$

# %% exercise="Q1.7"

# %% [markdown]
# Instead of counting votes, Nister and Stewenius compare the bags as a whole. Each histogram is multiplied by the
# weights and then divided by its sum, so that a photograph with many features has no advantage. For the results $\mathbf{q}$ of
# the query and $\mathbf{d}$ of an image the **score** is the sum of the absolute differences,
#
# $$s = \sum_i |q_i - d_i| .$$
#
# It is 0 for equal bags and 2 for bags without a common word: *small* is good.

# %% exercise="Q1.8"


# %% demo=true
def likeness_to(name, places=tuple(walk)):
    """Return how alike a photograph and each place are: 0 nothing in common, 2 equal."""
    bags = [np.bincount(words_of(other), minlength=len(levels[-1])) for other in (name, *places)]
    query, histograms = bags[0], np.array(bags[1:])
    return 2 - l1_scores(query, histograms, idf_weights(histograms))


# %% demo=true
figures.search_results(queries, walk, likeness_to, same, "likeness")

# %% [markdown]
# ## Palm trees
#
# Compare with the votes: the weights have repaired something. But look at the query 0513, the one with the
# palm trees in front of a white building. Its first place is a different part of the campus, and *nothing in its bars* warns you:
# the winner looks like any other winner. A robot that believed it would tear its map apart.
#
# Leaves of palms look like leaves of palms, wherever they grow. The bag of words knows *that* they are there, but has lost
# *where*. If two photographs show the same place, the matching spots must also fit together: there must be one position for
# each camera from which all of them make sense. This is **geometric verification**. It is too slow for a whole database,
# but quick enough for the five best candidates.
#
# First come the matches: pairs of spots that are each other's nearest, and clearly nearer than the second nearest. Then, which of
# them agree with one geometry? Two photographs of the same scene are tied together by a 3 × 3 matrix, the
# **fundamental matrix**: it turns a spot in one photograph into a line in the other, on which the matching spot must lie. Many
# of the matches are wrong, so OpenCV looks for the matrix that most of them agree with. It does so by guessing, with an
# algorithm that has a whole chapter of its own: RANSAC, chapter 3. (Both steps are in `notebooks/two_views.py`.)


# %% demo=true
@cache
def views(one, other):
    """Return the matched spots of two photographs, and which of them agree with one geometry."""
    return two_views(features[one], features[other])


# %% [markdown]
# The same place, seen from two sides:

# %% demo=true
figures.matches(photographs["0508"], walk["0510"], *views("0508", "0510")[:3], "0508, 0510")

# %% [markdown]
# And the palm trees, 0513, with 0506, which the plain votes liked best:

# %% demo=true
figures.matches(photographs["0513"], walk["0506"], *views("0513", "0506")[:3], "0513, 0506")

# %% [markdown]
# Now follow one keypoint on its whole journey, by your own functions. Click on a spot of the photograph 0508, go down the tree with it, and watch whom
# it votes for. Let the votes grow: who leads after 100 of them, who at the end, and who with the weights? Then move the pointer
# over the photograph, and look for the same spot on the thick line in the candidate. (Where the candidate is a wrong place, the line passes
# through nothing that you know: that is how it is found out. Then put `"0513"` in place of `"0508"`, and see where the palm leaves lead.)

# %% demo=true
functions = [train_tree, descend_tree, build_inverted_file, idf_weights]
explore_journey("0508", photographs, features, tuple(walk), functions)

# %% [markdown]
# ## How many are enough?
#
# Some matches always agree by chance: among all pairs of our photographs that show different places, nine or ten agree in most, and
# never more than 14. (The 19 pairs at the beginning of this chapter happened to stop at ten.) So we need a threshold above
# that, and it must not be chosen on the queries on which it is tried afterwards. Let each photograph of the *walk* search
# among the others, as often happens on a real drive, and verify its five best candidates:


# %% demo=true
def agreeing_with(name, places=tuple(walk)):
    """Return the number of agreeing matches of the five best candidates; 0 for all other places."""
    likeness, counts = likeness_to(name, places), np.zeros(len(places))
    for place in [place for place in np.argsort(-likeness) if places[place] != name][:5]:
        counts[place] = views(name, places[place]).agree.sum()
    return counts


# %% [markdown]
# **Precision** is the share of right ones among the loops that are closed, **recall** the share of loops that are closed among those that could be. A
# low threshold closes many, some of them wrong; a high one misses many. What does that cost? A missed loop is a chance lost, and the next one may come soon. A
# wrong loop bends the map, and everything that is added afterwards. Say that one wrong loop is as bad as twenty missed
# ones.

# %% demo=true
predict("P1.2")

# %% [markdown]
# In the picture, the walk is on the left and the five queries are on the right. The dotted line is the threshold that costs least on
# the walk; on the right the same threshold is tried. On the walk 22 loops could be closed: eleven pairs of photographs show the same
# place, and each of the two can find the other. For the queries there are eleven.

# %% demo=true
scores = {"likeness of the bags": likeness_to, "agreeing matches": agreeing_with}
unsure = data.undecided_pairs()  # three pairs of which nobody can tell: they are left out
figures.precision_recall(scores, tuple(walk), tuple(queries), same, 20, predicted("P1.2"), unsure)

# %% [markdown]
# For the bags alone (above) it is cheapest to close no loop at all and to miss all 22: the most alike of all pairs is a wrong one, so
# every threshold that closes a right loop has closed a wrong one before, which costs as much as 20 missed ones. Change the 20 to
# 1, for a robot that can afford mistakes. How far does each of the two thresholds fall, and how many loops are closed now?
#
# For the geometry (below), no wrong candidate of the walk reaches the threshold. Most of the loops that it misses were never looked
# at: the place was not among the five best candidates of the bags. For the others too few matches agree.
#
# The next building may have more windows that look alike, so we leave a margin and ask for 20. Here are the queries again, one
# by one; the grey band is what chance has reached on the walk.

# %% demo=true
figures.agreement(agreeing_with, tuple(queries), tuple(walk), same, 20, unsure)

# %% [markdown]
# No wrong place reaches 20. And not all right places do: 0511 and 0513 have no place above the threshold at all. (The right places of
# 0513 were not even among its five candidates, so there is no green dot.) For them the honest answer of the robot is "I do not know this place". It
# closes one loop less, and keeps its map.
#
# Nister and Stewenius take one more thing from the tree: not only its words, the *inner nodes* count as well. Two descriptors that end
# at different words may have come down the same branch for a while, and that is some likeness, too. Each node gets a weight in
# the same way; those near the root, through which all images go, weigh nothing by themselves. Your functions need no change, only longer
# histograms:


# %% demo=true
def nodes_of(name):
    """Return the words of a photograph, and the nodes above each of them, numbered on."""
    word = words_of(name)
    return np.concatenate([word, 512 + word // 8, 512 + 64 + word // 64])


def likeness_by_nodes(name, places=tuple(walk)):
    """Return how alike a photograph and each place are, by all nodes of the tree."""
    bags = np.array([np.bincount(nodes_of(other), minlength=584) for other in (name, *places)])
    return 2 - l1_scores(bags[0], bags[1:], idf_weights(bags[1:]))


# %% [markdown]
# Last, the search with verification: a place that is verified goes to the front. Five queries are too few to say which method is
# better. So let *each* of the 25 photographs search among all others, the walk and the queries together.

# %% demo=true
predict("P1.3")


# %% demo=true
def verified_likeness_to(name, places=tuple(walk)):
    """Return the likeness of each place, plus the number of agreeing matches if they are enough."""
    counts = agreeing_with(name, places)
    return likeness_to(name, places) + np.where(counts >= 20, counts, 0)


# %% demo=true
searches = {
    "votes": votes_for,
    "weighted": likeness_to,
    "all nodes": likeness_by_nodes,
    "verified": verified_likeness_to,
}
figures.first_places(searches, photographs, same, predicted("P1.3"))

# %%
progress()

# %% [markdown]
# ## What to remember
#
# - Words make it fast: a tree to find them, an inverted file to look them up.
# - Weights make it better: what occurs everywhere tells nothing.
# - Geometry makes it safe: it is slow, and comes last.
# - A threshold is chosen on other photographs than those on which it is tried.
#
# ## Further reading
#
# - D. Nister and H. Stewenius, *Scalable recognition with a vocabulary tree*, CVPR 2006: the tree, the
#   inverted file and the weights, with a million words and more.
# - H. Stewenius, S. H. Gunderson and J. Pilet, *Size matters: exhaustive geometric verification for
#   image retrieval*, ECCV 2012: what happens if the geometry of *all* candidates is checked.
# - D. Gálvez-López and J. D. Tardós, *Bags of binary words for fast place recognition in image sequences*,
#   IEEE Transactions on Robotics 28(5), 2012: the same with binary features, as many robots use it.
# - R. Arandjelović, P. Gronat, A. Torii, T. Pajdla and J. Sivic, *NetVLAD: CNN architecture for weakly supervised place
#   recognition*, CVPR 2016: one learnt vector for a whole photograph.
#
# Next: [line fitting](2_line_fitting.ipynb).
