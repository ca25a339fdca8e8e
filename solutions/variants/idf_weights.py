"""Other right ways to weigh words."""

import math

import numpy as np


def loops(histograms):
    weights = []
    for word in range(histograms.shape[1]):
        having = sum(1 for image in histograms if image[word] > 0)
        weights.append(math.log(len(histograms) / having) if having else 0.0)
    return weights


def where_divided(histograms):
    counts = np.count_nonzero(histograms, axis=0)
    ratio = np.divide(len(histograms), counts, where=counts > 0, out=np.ones(len(counts)))
    return np.log(ratio)


def infinities_replaced(histograms):
    with np.errstate(divide="ignore"):
        weights = np.log(len(histograms) / (histograms != 0).sum(axis=0))
    weights[np.isinf(weights)] = 0
    return weights


def differences_of_logarithms(histograms):
    M, K = histograms.shape
    counts = np.array([len(np.flatnonzero(histograms[:, k])) for k in range(K)])
    return (counts > 0) * (np.log(M) - np.log(np.where(counts, counts, 1)))


def single_precision(histograms):
    counts = (histograms > 0).mean(axis=0)
    return np.where(counts > 0, -np.log(np.maximum(counts, 1e-9)), 0).astype(np.float32)
