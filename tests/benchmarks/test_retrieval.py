"""How retrieval is scored, and what the synthetic images look like."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from benchmarks import retrieval
from benchmarks.million_images import WORD_COUNT, synthetic_images


def test_average_precision_by_hand():
    # Relevant at ranks 1, 3 and 4: (1/1 + 2/3 + 3/4) / 3.
    ranked = np.array([True, False, True, True, False])
    assert retrieval.average_precision(ranked) == pytest.approx((1 + 2 / 3 + 3 / 4) / 3)


def test_words_that_name_the_place_are_perfect_and_words_at_random_are_not(monkeypatch):
    pairs = frozenset(frozenset(pair) for pair in ("ab", "cd"))
    monkeypatch.setattr(retrieval.data, "same_place_pairs", lambda: pairs)
    places = {"a": 0, "b": 0, "c": 1, "d": 1, "alone": 2}
    descriptors = {name: np.full((5, 1), place) for name, place in places.items()}
    assert retrieval.quality(descriptors, lambda own: own[:, 0], 3) == (1.0, 1.0)
    backwards = {"a": 0, "b": 1, "c": 0, "d": 1, "alone": 2}
    descriptors = {name: np.full((5, 1), word) for name, word in backwards.items()}
    precision, recall = retrieval.quality(descriptors, lambda own: own[:, 0], 3, votes=True)
    assert recall == 0.0
    assert precision < 0.6


def test_synthetic_words_follow_the_law_of_zipf():
    images = synthetic_images(np.random.default_rng(0), 200)
    sizes = [len(words) for words in images]
    assert min(sizes) >= 300
    assert max(sizes) <= 1000
    words = np.concatenate(images)
    assert words.max() < WORD_COUNT
    for share in (0.01, 0.25):  # of the words, the most frequent ones: the root of the features
        assert np.mean(words < share * WORD_COUNT) == pytest.approx(share**0.5, abs=0.01)


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="only Linux tells the peak")
def test_the_peak_of_memory_is_not_that_of_the_process_that_started_this_one():
    child = "from benchmarks.million_images import peak_memory; print(peak_memory())"
    parent = f"""
import subprocess, sys
large = bytearray(600_000_000)
subprocess.run([sys.executable, "-c", {child!r}], check=True)
"""
    done = subprocess.run(
        [sys.executable, "-c", parent],
        cwd=Path(retrieval.__file__).parents[1],
        capture_output=True,
        text=True,
        check=True,
    )
    assert 1e7 < int(done.stdout) < 4e8
