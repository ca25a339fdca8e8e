"""Grade the same submissions with this project, nbgrader and otter-grader.

``uv run python -m benchmarks.grading`` makes an environment for each peer, lets the three take
turns, and writes ``grading.md`` beside this file. Times include the gradebook and the reports.
"""

from __future__ import annotations

import argparse
import os
import platform
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from benchmarks.grading_assignment import (
    fresh,
    write_course,
    write_nbgrader,
    write_otter,
)
from benchmarks.grading_profile import profile, profile_table

_ROOT = Path(__file__).parents[1]
LIBRARIES = ("ipykernel", "numpy", "sympy", "matplotlib", "opencv-python-headless")
PEERS = {"nbgrader": "nbgrader>=0.9.6,<0.10", "otter-grader": "otter-grader>=7,<8"}
OWN = "this project"


class Cost(NamedTuple):
    """What a run took, all its processes together."""

    cpu: float  # s
    wall: float  # s

    def __add__(self, other: object) -> Cost:
        assert isinstance(other, Cost)
        return Cost(self.cpu + other.cpu, self.wall + other.wall)


@dataclass
class Contender:
    """A grader: how its course is laid out and prepared, and the commands that are timed."""

    name: str
    write: Callable[[Path, int], None]
    prepare: list[list[str]]
    grade: list[list[str]]
    grades: str  # the table of grades that it must have written
    environment: Path | None = None
    costs: list[Cost] = field(default_factory=list)

    def run(self, command: list[str], folder: Path) -> Cost:
        """Run a command to its end.

        Raises:
            RuntimeError: if it fails.
        """
        environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
        environment |= {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS")}
        if self.environment is not None:
            environment["PATH"] = f"{self.environment / 'bin'}:{environment['PATH']}"
            environment["VIRTUAL_ENV"] = str(self.environment)
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        done = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, text=True, check=False
        )
        wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            raise RuntimeError(f"{self.name}: {command} failed:\n{done.stdout}{done.stderr}")
        return Cost(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall)

    def time(self, template: Path, copy: Path, students: int) -> Cost:
        """Grade a fresh copy of the course; every student must get full marks.

        Raises:
            RuntimeError: if a student does not.
        """
        fresh(template, copy)
        cost = sum((self.run(command, copy) for command in self.grade), Cost(0, 0))
        rows = (copy / self.grades).read_text().splitlines()[1:]
        if len(rows) != students or not all(",10" in row for row in rows):
            raise RuntimeError(f"{self.name} did not give everybody full marks:\n{rows[:3]}")
        return cost


def make_environment(folder: Path, package: str) -> Path:
    """An environment with a peer and the libraries."""
    if not (folder / "bin/python").exists():
        version = f"{sys.version_info.major}.{sys.version_info.minor}"
        subprocess.run(["uv", "venv", "--quiet", "--python", version, str(folder)], check=True)
        python = ["--python", str(folder / "bin/python")]
        command = ["uv", "pip", "install", "--quiet", "--compile-bytecode", *python]
        subprocess.run([*command, package, *LIBRARIES], check=True)
    return folder


def contenders(environments: Path) -> list[Contender]:
    """This project and its peers, ready to run."""
    nbgrader = make_environment(environments / "nbgrader", PEERS["nbgrader"])
    otter = make_environment(environments / "otter", PEERS["otter-grader"])
    return [own(), with_nbgrader(nbgrader), with_otter(otter)]


def own() -> Contender:
    """This project, as `autograder grade` runs it."""
    autograder = [sys.executable, "-m", "autograder", "--course", "."]
    return Contender(
        OWN, write_course, [], [[*autograder, "grade", "submitted"]], "grades/grades.csv"
    )


def with_nbgrader(environment: Path) -> Contender:
    """Run nbgrader: marks, feedback pages, and the table."""
    program = str(environment / "bin/nbgrader")
    return Contender(
        "nbgrader",
        write_nbgrader,
        [[program, "generate_assignment", "ten"]],
        [[program, "autograde", "ten"], [program, "generate_feedback", "ten"], [program, "export"]],
        "grades.csv",
        environment,
    )


def with_otter(environment: Path) -> Contender:
    """Run otter-grader without containers, all submissions in one process."""
    program = str(environment / "bin/otter")
    plain = ["--no-requirements", "--no-environment", "--no-config"]
    return Contender(
        "otter-grader",
        write_otter,
        [[program, "generate", "-t", "tests", "-o", "autograder.zip", *plain]],
        [[str(environment / "bin/python"), "grade_all.py"]],
        "grades.csv",
        environment,
    )


def otter_anew(otter: Contender, folder: Path, submissions: int = 3) -> str:
    """What `otter run` takes when it is started for each submission, as its documentation shows."""
    program = str(otter.environment / "bin/otter") if otter.environment else "otter"
    run = [program, "run", "--no-logo", "-a", "autograder.zip", "-o", "."]
    total = Cost(0, 0)
    for student in range(submissions):
        total += otter.run([*run, f"submitted/student{student:04}.ipynb"], folder)
    text = (
        "Started anew for each submission, as its documentation shows, `otter run` takes "
        f"{total.cpu / submissions:.2f} CPU-seconds and {total.wall / submissions:.2f} s "
        f"({submissions} submissions)."
    )
    print(text, file=sys.stderr)
    return text


def large_class(folder: Path, students: int) -> tuple[Cost, list[int]]:
    """Grade a large class; its cost, and the grader's memory (bytes) ten times on the way."""
    root = folder / "large"
    write_course(root, students)
    command = [sys.executable, "-m", "autograder", "--course", ".", "grade", "submitted"]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    process = subprocess.Popen(command, cwd=root, stdout=subprocess.DEVNULL)
    samples: list[int] = []

    def sample() -> None:
        while process.poll() is None:
            samples.append(_resident(process.pid))
            time.sleep(0.5)

    watcher = threading.Thread(target=sample)
    watcher.start()
    if process.wait() != 0:
        raise RuntimeError("grading the large class failed")
    watcher.join()
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    samples = [sample for sample in samples if sample]
    return Cost(cpu, wall), [samples[len(samples) * tenth // 10] for tenth in range(10)]


def large_class_text(folder: Path, students: int) -> str:
    """Grade a large class and say what it took."""
    cost, memory = large_class(folder, students)
    shown = ", ".join(f"{sample / 2**20:.0f}" for sample in memory)
    text = (
        f"## {students} submissions in one run\n\n"
        f"{cost.wall:.0f} s, {cost.cpu / students:.3f} CPU-seconds a submission. "
        f"The grader's memory at ten moments on the way: {shown} MB."
    )
    print(text, file=sys.stderr)
    return text


def _resident(process: int) -> int:
    try:
        return int(Path(f"/proc/{process}/statm").read_text(encoding="utf-8").split()[1]) * 4096
    except OSError:
        return 0


def median(costs: list[Cost]) -> Cost:
    """The median of each of both."""
    return Cost(*(statistics.median(column) for column in zip(*costs, strict=True)))


def whole_class_text(graders: list[Contender], folder: Path, students: int) -> str:
    """Let each grader grade a class of another size once, and say what it took."""
    rows = [
        f"## A class of {students}",
        "",
        "The same notebook, one round.",
        "",
        "| grader | CPU a submission [s] | wall a submission [s] | CPU, times ours | "
        "wall, times ours |",
        "|---|---|---|---|---|",
    ]
    costs: list[Cost] = []
    for grader in graders:
        root = folder / f"{grader.name} of {students}"
        grader.write(root, students)
        for command in grader.prepare:
            grader.run(command, root)
        costs.append(grader.time(root, folder / "copy", students))
        cost = costs[-1]
        rows.append(
            f"| {grader.name} | {cost.cpu / students:.3f} | {cost.wall / students:.3f} | "
            f"{cost.cpu / costs[0].cpu:.1f} | {cost.wall / costs[0].wall:.1f} |"
        )
        print(rows[-1], file=sys.stderr)
    return "\n".join(rows)


def profile_text(folder: Path, students: int) -> str:
    """Whose the processor time is, for these ten questions and for this course."""
    ten, course = folder / "profiled", folder / "solved"
    write_course(ten, students)
    for number in range(students):
        copy = course / "submitted" / f"student{number:04}"
        copy.mkdir(parents=True)
        for notebook in sorted((_ROOT / "solutions/notebooks").glob("*.ipynb")):
            shutil.copy(notebook, copy)
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    environment |= {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS")}
    grade = [sys.executable, "-m", "autograder", "--course"]
    own = [*grade, str(_ROOT), "grade", "submitted", "--out", str(course / "grades")]
    rows = profile_table(
        {
            "the ten questions": (
                profile([*grade, ".", "grade", "submitted"], ten, environment),
                students,
            ),
            "this course, all solved": (profile(own, course, environment), students),
        }
    )
    text = "\n".join(
        [
            f"Whose the time is, in classes of {students}: the students' own processes run their "
            "cells and the calls of their functions; a zygote imports the libraries once and "
            "clears up between submissions; the grader reads, marks, keeps the gradebook and "
            "writes the pages; the rest tries the isolation out.",
            "",
            *rows,
        ]
    )
    print(text, file=sys.stderr)
    return text


def report(
    students: int, rounds: int, graders: list[Contender], alone: Cost, texts: Sequence[str]
) -> str:
    """The page that says what came out."""
    own_cost = median(graders[0].costs)
    lines = [
        "# Grading: this project and its peers",
        "",
        f"`uv run python -m benchmarks.grading`: {students} copies of a notebook with ten "
        "questions (numpy, sympy, matplotlib, OpenCV, one function checked on five inputs), "
        f"everything right. The graders took turns, {rounds} rounds, the median counts. CPU is "
        "that of all processes; gradebook, table and feedback pages are included. otter-grader "
        "runs without its containers and with all submissions in one process, which is faster "
        "than `otter run` for each.",
        "",
        f"{os.cpu_count()} cores, Python {platform.python_version()}, {platform.machine()}.",
        "",
        "| grader | CPU a submission [s] | wall a submission [s] | CPU, times ours | "
        "wall, times ours | rounds, CPU [s] |",
        "|---|---|---|---|---|---|",
    ]
    for grader in graders:
        cost = median(grader.costs)
        each = ", ".join(f"{round.cpu / students:.3f}" for round in grader.costs)
        lines.append(
            f"| {grader.name} | {cost.cpu / students:.3f} | {cost.wall / students:.3f} | "
            f"{cost.cpu / own_cost.cpu:.1f} | {cost.wall / own_cost.wall:.1f} | {each} |"
        )
    anew, whose, *others = texts
    lines += ["", anew]
    more = (own_cost.cpu - alone.cpu) / (students - 1)
    lines += [
        "",
        "## Where the time goes",
        "",
        f"A class of one takes {alone.cpu:.2f} CPU-seconds: starting Python, importing numpy, "
        "sympy, matplotlib, OpenCV and IPython once in each worker's zygote, trying the sandbox "
        f"out, and writing the reports. Each further submission takes {more:.3f} CPU-seconds, so "
        f"the start is {100 * (1 - more * students / own_cost.cpu):.0f} % of the time above and "
        "matters less the larger the class is.",
        "",
        whose,
        "",
        "Only this project keeps the answers away from the student's code while it checks.",
        *(line for text in others if text for line in ("", text)),
    ]
    return "\n".join(lines).rstrip() + "\n"


def main() -> int:
    """Run the benchmark and write the page."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.grading", description=__doc__)
    parser.add_argument("--students", type=int, default=20)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--whole", type=int, default=200, help="one more class; 0 leaves it out")
    parser.add_argument("--large", type=int, default=1000, help="0 leaves the large class out")
    parser.add_argument("--own", action="store_true", help="this project only; writes nothing")
    parser.add_argument("--environments", type=Path, help="keep the peers' environments here")
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "grading.md")
    arguments = parser.parse_args()
    students = arguments.students
    with tempfile.TemporaryDirectory(prefix="grading-benchmark-") as name:
        folder = Path(name)
        graders = [own()] if arguments.own else contenders(arguments.environments or folder / "env")
        for grader in graders:
            grader.write(folder / grader.name, students)
            for command in grader.prepare:
                grader.run(command, folder / grader.name)
        write_course(folder / "one", 1)
        one = own()  # takes turns as well: the machine may be slower at one time than at another
        large = large_class_text(folder, arguments.large) if arguments.large else ""
        anew = "" if arguments.own else otter_anew(graders[-1], folder / graders[-1].name)
        whole = whole_class_text(graders, folder, arguments.whole) if arguments.whole else ""
        texts = (anew, profile_text(folder, students), whole, large)
        for round in range(1, arguments.rounds + 1):
            one.costs.append(one.time(folder / "one", folder / "copy", 1))
            alone = median(one.costs)
            print(f"a class of one: {alone.cpu:.2f} CPU-s, {alone.wall:.2f} s", file=sys.stderr)
            for grader in graders:
                cost = grader.time(folder / grader.name, folder / "copy", students)
                grader.costs.append(cost)
                print(
                    f"round {round}, {grader.name}: {cost.cpu / students:.3f} CPU-s and "
                    f"{cost.wall / students:.3f} s a submission",
                    file=sys.stderr,
                )
            if not arguments.own:  # after each round, so that a run cut short leaves a page too
                arguments.out.write_text(report(students, round, graders, alone, texts))
        shutil.rmtree(folder / "copy", ignore_errors=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
