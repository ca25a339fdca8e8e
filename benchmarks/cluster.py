"""What the coordinator of a large class needs: memory, and how many submissions it stores a second.

Not a comparison, so `benchmarks/__main__.py` does not run it::

    uv run python -m benchmarks.cluster [--sizes 1000 10000 100000] [--zip]
    uv run --extra cluster python -m benchmarks.cluster --sizes 20000 --zip --cluster local:2

The submissions are empty notebooks, and instead of grading them each is given the marks of what
was not attempted: everything else (taking in, reading, storing, every report) is what `autograder
grade` does. With ``--cluster`` they are really graded, and the memory of this process, which holds
the scheduler too, is printed after each thousand. Each size runs in a process of its own.
"""

from __future__ import annotations

import argparse
import io
import json
import resource
import subprocess
import sys
import tempfile
import time
import zipfile
from collections.abc import Collection
from pathlib import Path
from typing import Any

import autograder.cli.grading_run as grading_run
from autograder.cli import main as autograder
from autograder.cli.run_tally import Tally
from autograder.grading.graded_submission import Graded, same_mark_for_all
from autograder.grading.spread import Task
from autograder.grading.whole_class import grade_class
from autograder.marking.marker import Marker
from tests.classroom import make_course, notebook


class NothingAttempted:
    """Stands in for the sandboxes: gives every task back at once."""

    has_room, isolation = True, "nothing was run"

    def __init__(self, marker: Marker, jobs: int, questions: Collection[str] | None, *more: object):
        self._course, self._graded = marker.course, list[Graded]()

    def __enter__(self) -> NothingAttempted:
        return self

    def __exit__(self, *exception: object) -> None:
        pass

    @property
    def under_way(self) -> int:
        return len(self._graded)

    def begin(self, task: Task, more: int) -> None:
        marks = same_mark_for_all(self._course, "not attempted", "Nothing was run.", None)
        fingerprint = task.contents.fingerprint
        self._graded.append(Graded(task.submission, "graded", fingerprint, marks))

    def finished(self, wait: bool) -> list[Graded]:
        graded, self._graded = self._graded, []
        return graded

    def describe(self) -> str:
        return ""


def hand_in(folder: Path, count: int, is_zip: bool) -> Path:
    """A folder of empty notebooks, or a zip of zips of them."""
    text = notebook([])
    if not is_zip:
        work = folder / "work"
        work.mkdir()
        for number in range(count):
            (work / f"student{number:06}.ipynb").write_text(text)
        return work
    one = io.BytesIO()
    with zipfile.ZipFile(one, "w") as archive:
        archive.writestr("3_orchard.ipynb", text)
    with zipfile.ZipFile(folder / "class.zip", "w") as archive:
        for number in range(count):
            archive.writestr(f"student{number:06}.zip", one.getvalue())
    return folder / "class.zip"


def memory_now() -> float:
    """What this process has of the machine's memory, in MB; on Linux."""
    pages = int(Path("/proc/self/statm").read_text(encoding="utf-8").split()[1])
    return pages * resource.getpagesize() / 2**20


class Told(Tally):
    """Counts as ever, and says how much memory there is in use after each thousand."""

    def add(self, entry: Graded) -> None:
        super().add(entry)
        if self.count == 1 or self.count % 1000 == 0:
            now = time.strftime("%H:%M:%S")
            print(f"{now} {self.count:7,} {memory_now():7.1f} MB", file=sys.stderr, flush=True)


def measure(count: int, is_zip: bool, cluster: str | None) -> dict[str, float]:
    """Grade in this process: the peak of its memory in MB, and submissions stored a second.

    ``worked`` is a second of processor time, which other work on the machine does not change much.
    """
    spent: dict[str, float] = {}

    def timed(*arguments: Any) -> None:
        began, worked = time.perf_counter(), time.process_time()
        grade_class(*arguments)
        spent["seconds"] = time.perf_counter() - began
        spent["processor"] = time.process_time() - worked

    vars(grading_run).update(grade_class=timed)
    vars(grading_run).update({"Tally": Told} if cluster else {"Threads": NothingAttempted})
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        make_course(root / "course")
        work = hand_in(root, count, is_zip)
        began = time.perf_counter()
        command = ["--course", str(root / "course"), "grade", str(work)]
        command += ["--cluster", cluster] if cluster else []
        if autograder([*command, "--out", str(root / "grades")]) != 0:
            sys.exit("It was not graded.")
        whole = time.perf_counter() - began
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return {
        "peak": peak,
        "stored": count / spent["seconds"],
        "worked": count / spent["processor"],
        "whole": whole,
    }


def main() -> None:
    """Measure each size in a process of its own, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[1_000, 10_000, 100_000])
    parser.add_argument("--zip", action="store_true", help="a zip of zips instead of a folder")
    parser.add_argument("--cluster", help="grade them really, on workers such as local:2")
    parser.add_argument("--one", type=int, help=argparse.SUPPRESS)
    parsed = parser.parse_args()
    if parsed.one:
        print(json.dumps(measure(parsed.one, parsed.zip, parsed.cluster)))
        return
    print("| submissions | peak memory | stored a second | of processor | with all reports |")
    print("|---|---|---|---|---|")
    for size in parsed.sizes:
        command = [sys.executable, "-m", "benchmarks.cluster", "--one", str(size)]
        command += ["--zip"] if parsed.zip else []
        command += ["--cluster", parsed.cluster] if parsed.cluster else []
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
        if done.returncode:
            sys.exit(done.returncode)
        found = json.loads(done.stdout.splitlines()[-1])
        print(
            f"| {size:,} | {found['peak']:.0f} MB | {found['stored']:.0f} | "
            f"{found['worked']:.0f} | {found['whole']:.0f} s |",
            flush=True,
        )


if __name__ == "__main__":
    main()
