"""Weights for words and scores for images, as the course explains them.

Source: Nister and Stewenius, Scalable recognition with a vocabulary tree, CVPR 2006,
section 4: w_i = ln(N / N_i) and the L1 norm of the difference of the normalised vectors.
"""

import numpy as np


def idf_weights(histograms: np.ndarray) -> np.ndarray:
    """Return the weight ln(M / M_i) of each word i: a (K,) array.

    `histograms` is (M, K) with M at least 1: how often each of M images has each of K words.
    M_i is the number of images that have word i at all. A word of all images weighs 0, and so
    does, by convention, a word of no image.
    """
    images_with_word = (histograms > 0).sum(axis=0)
    share = np.maximum(images_with_word, 1) / len(histograms)
    return np.where(images_with_word > 0, -np.log(share), 0.0)


def l1_scores(query: np.ndarray, histograms: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Return how different each image is from the query: (M,) numbers, 0 equal, 2 nothing shared.

    `query` is (K,), the histogram of the test image; `histograms` is (M, K), those of the
    model images; `weights` is (K,), none negative. Each histogram is multiplied by the weights
    and then divided by its sum, so that its entries add up to 1. The score of an image is the
    sum of the absolute differences to the query (the L1 norm). Where a sum is 0, because the
    image or the query has no word of weight, nothing is shared: the score is 2.
    """
    q = query * weights
    d = histograms * weights
    q = q / (q.sum() or 1.0)
    sums = d.sum(axis=1, keepdims=True)
    d = d / np.where(sums > 0, sums, 1.0)
    # |q - d| = q + d - 2 min(q, d), and q and d add up to 1 each.
    return 2.0 - 2.0 * np.minimum(q, d).sum(axis=1)
