"""A database of a million synthetic images, in a process of its own to see its memory.

`python -m benchmarks.million_images` prints one line of JSON for each size.
"""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from solutions.place_recognition import InvertedIndex

WORD_COUNT = 10**6  # a tree of six levels with ten children
SIZES = (100_000, 300_000, 1_000_000)
PORTION = 10_000  # images added at a time


def synthetic_images(rng: np.random.Generator, count: int) -> list[np.ndarray]:
    """The words of images with 300 to 1000 features each.

    The i-th most frequent word has a probability in proportion to 1 / sqrt(i) (Zipf's law with
    the exponent 0.5), so the share of the i most frequent ones is sqrt(i / WORD_COUNT).
    """
    sizes = rng.integers(300, 1001, count)
    words = (rng.random(sizes.sum()) ** 2 * WORD_COUNT).astype(np.int32)
    return np.split(words, np.cumsum(sizes)[:-1])


def main() -> None:
    """Let the database grow, and ask it at every size."""
    rng = np.random.default_rng(0)
    queries = synthetic_images(rng, 25)
    index, building = InvertedIndex(WORD_COUNT), 0.0
    for size in SIZES:
        while index.image_count < size:
            images = synthetic_images(rng, min(PORTION, size - index.image_count))
            start = time.process_time()
            index.extend(images)
            building += time.process_time() - start
        start = time.process_time()
        index.scores(queries[0])
        weighting = time.process_time() - start
        times = {"tf-idf": index.scores, "votes": index.votes}
        result = {"images": size, "building": building, "weighting": weighting}
        for name, ask in times.items():
            seconds = []
            for query in queries:
                start = time.process_time()
                ask(query)
                seconds.append(time.process_time() - start)
            result |= {name: float(np.median(seconds)), f"slowest {name}": max(seconds)}
        peak = peak_memory()
        if peak is not None:
            result["peak"] = peak
        print(json.dumps(result), flush=True)


def peak_memory() -> int | None:
    """The most memory in bytes that this process had, None where Linux does not tell.

    `resource.getrusage` would count the process that started this one, as the two are one until
    Python is loaded.
    """
    try:
        status = Path("/proc/self/status").read_text(encoding="utf-8").splitlines()
    except OSError:
        return None
    peaks = [line.split()[1] for line in status if line.startswith("VmHWM:")]
    return 1024 * int(peaks[0]) if peaks else None


def measured() -> list[dict[str, float]]:
    """Run this module in a new process and return what it printed."""
    command = [sys.executable, "-m", "benchmarks.million_images"]
    root = Path(__file__).parents[1]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


if __name__ == "__main__":
    main()
