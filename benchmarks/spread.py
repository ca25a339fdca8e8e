"""Threads and Dask side by side: what a submission costs, and the time to go on after a kill.

Not a comparison with others, so `benchmarks/__main__.py` does not run it::

    uv run --extra cluster python -m benchmarks.spread [--few 12] [--many 60] [--rounds 3] [--whole]

The submissions are real notebooks of a course of four questions, graded in sandboxes; with
``--whole``, of this course with all its chapters. Each
contender grades a small and a large class; a submission costs the difference of the two over the
difference of their sizes, so that starting (imports, workers, reports) does not count. The
contenders take turns, and the median of the rounds counts. ``processor`` is the time of all
processes together, ended workers and sandboxes included.
"""

from __future__ import annotations

import argparse
import os
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

from solutions.make_sample_class import Work
from tests.classroom import hand_in, make_course, stored

CONTENDERS = {
    "threads, --jobs 1": ("--jobs", "1"),
    "--cluster local:1": ("--cluster", "local:1"),
    "threads, --jobs 2": ("--jobs", "2"),
    "--cluster local:2": ("--cluster", "local:2"),
}
REPOSITORY = Path(__file__).parents[1]


def hand_in_whole(folder: Path, student: str) -> None:
    """Hand in the solved notebooks of this course."""
    with zipfile.ZipFile(folder / f"{student}.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in Work().files().items():
            archive.writestr(name, content)


def start(course: Path, work: Path, out: Path, more: tuple[str, ...]) -> subprocess.Popen[bytes]:
    """Begin to grade a class in a process of its own."""
    command = [sys.executable, "-m", "autograder", "--course", str(course), "grade", str(work)]
    return subprocess.Popen(
        [*command, "--out", str(out), "--seed", "7", *more],
        env={**os.environ, "PYTHONPATH": str(REPOSITORY)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )


def grade(course: Path, work: Path, out: Path, more: tuple[str, ...]) -> tuple[float, float]:
    """Grade a class; the seconds on the clock and of processors.

    Raises:
        SystemExit: if it could not be graded.
    """
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    process = start(course, work, out, more)
    _, said = process.communicate()
    if process.returncode:
        sys.exit(said.decode(errors="replace"))
    seconds = time.perf_counter() - began
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def go_on(course: Path, work: Path, out: Path, many: int, more: tuple[str, ...]) -> float:
    """Kill the coordinator half-way; the seconds from the next start to the next one stored."""
    process = start(course, work, out, more)
    book = out / "gradebook.db"
    while stored(book) < many // 2 and process.poll() is None:
        time.sleep(0.02)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    before, began = stored(book), time.perf_counter()
    process = start(course, work, out, more)
    while stored(book) <= before and process.poll() is None:
        time.sleep(0.01)
    seconds = time.perf_counter() - began
    _, said = process.communicate()
    if process.returncode or stored(book) != many:
        sys.exit(f"It did not go on: {said.decode(errors='replace')}")
    return seconds


def main() -> None:
    """Let all contenders take turns, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--few", type=int, default=12)
    parser.add_argument("--many", type=int, default=60)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--whole", action="store_true", help="submissions of this course")
    parsed = parser.parse_args()
    found: dict[str, list[tuple[float, float]]] = {name: [] for name in CONTENDERS}
    resumed: dict[str, list[float]] = {name: [] for name in CONTENDERS}
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        course = REPOSITORY
        if not parsed.whole:
            course = make_course(root / "course").root
        for size in (parsed.few, parsed.many):
            (root / f"work{size}").mkdir()
            for number in range(size):
                hand = hand_in_whole if parsed.whole else hand_in
                hand(root / f"work{size}", f"student{number:04}")
        for turn in range(parsed.rounds):
            for name, more in CONTENDERS.items():
                small, large = (
                    grade(course, root / f"work{size}", root / f"{turn}{size}{name}", more)
                    for size in (parsed.few, parsed.many)
                )
                count = parsed.many - parsed.few
                found[name].append(((large[0] - small[0]) / count, (large[1] - small[1]) / count))
                work, out = root / f"work{parsed.many}", root / f"{turn}again{name}"
                resumed[name].append(go_on(course, work, out, parsed.many, more))
    print("| | a second | processor a submission | of threads | goes on after a kill |")
    print("|---|---|---|---|---|")
    costs = {name: statistics.median(cost for _, cost in turns) for name, turns in found.items()}
    names = list(CONTENDERS)
    for at, name in enumerate(names):
        clock = statistics.median(seconds for seconds, _ in found[name])
        ratio = costs[name] / costs[names[at - at % 2]]
        print(
            f"| {name} | {1 / clock:.1f} | {costs[name]:.3f} s | {ratio:.2f} | "
            f"{statistics.median(resumed[name]):.1f} s |"
        )


if __name__ == "__main__":
    main()
