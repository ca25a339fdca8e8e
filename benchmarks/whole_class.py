"""An instructor's evening: a class graded, regraded after a key change, exported, released.

Not a comparison, so `benchmarks/__main__.py` does not run it::

    uv run python -m benchmarks.whole_class [--students 200] [--keep DIR]

Every submission starts from the solved notebooks; each question is then, at random, left right,
left open, or answered with one of its known mistakes. A few students hand in something broken.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import TypeVar

import numpy as np

from autograder.course import Course, load_course
from autograder.kinds.expression.answer import ExpressionAnswer
from autograder.kinds.number.answer import NumberAnswer
from autograder.kinds.order.answer import OrderAnswer
from autograder.kinds.true_false.answer import TrueFalseAnswer
from autograder.questions.answer import Alternative
from solutions.make_sample_class import Work

A = TypeVar("A", bound=Alternative)

ROOT = Path(__file__).parents[1]
# Work that no class is without: name, and what is in the file.
BROKEN = {"no_zip.zip": b"no zip at all", "empty.ipynb": b"", "essay.docx": b"Dear instructor"}


def make_class(folder: Path, course: Course, count: int, rng: np.random.Generator) -> None:
    """Write `count` submissions to `folder`."""
    folder.mkdir(parents=True)
    solved = Work()
    for number in range(count - len(BROKEN)):
        work = Work()
        skill = rng.beta(4, 2)
        for id in solved.ids:
            if id not in course.questions:
                continue
            chance = rng.uniform()
            if chance > skill + 0.7 * (1 - skill):
                work.blank(id)
            elif chance > skill:
                _mistake(work, course, id, rng)
        path = folder / f"student_{number:03}.zip"
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in work.files().items():
                archive.writestr(name, content)
    for name, content in BROKEN.items():
        (folder / name).write_bytes(content)


def _popular(alternatives: Sequence[A], rng: np.random.Generator) -> A:
    """A mistake; some are more popular than others."""
    mistakes = [entry for entry in alternatives if entry.is_mistake]
    return mistakes[min(len(mistakes) - 1, int(rng.exponential(1.0)))]


def _mistake(work: Work, course: Course, id: str, rng: np.random.Generator) -> None:
    answer, question = course.key[id], course.question(id)
    if isinstance(answer, TrueFalseAnswer):
        said = [bool(s.truth) != bool(rng.uniform() < 0.4) for s in answer.statements]
        work.click(id, said)
    elif isinstance(answer, OrderAnswer):
        order = list(answer.order)
        order.insert(int(rng.integers(len(order))), order.pop(int(rng.integers(len(order)))))
        work.click(id, order)
    elif isinstance(answer, NumberAnswer):
        work.type(id, f"{question.name} = {_popular(answer.alternatives, rng).value!r}")
    elif isinstance(answer, ExpressionAnswer):
        formula = _in_sympy(_popular(answer.alternatives, rng).expression)
        work.type(id, f"{question.name} = {formula}")
    else:
        work.type(id, f"def {question.name}(*arguments, **options):\n    return 0.0")


def _in_sympy(formula: str) -> str:
    names = ("atan2", "atan", "sin", "cos", "sqrt", "log", "exp", "pi")
    text = formula
    for name in names:
        text = text.replace(f"{name}(", f"sp.{name}(").replace("sp.sp.", "sp.")
    return "..." if "where" in text else text


def change_key(root: Path) -> None:
    """The instructor has second thoughts about one mistake's credit."""
    path = root / "solutions/answers/ransac.toml"
    text = path.read_text(encoding="utf-8")
    before, mark, after = text.partition('name = "rounded down"')
    assert mark
    path.write_text(before + mark + after.replace("credit = 0.75", "credit = 0.9", 1), "utf-8")


def copy_course(root: Path) -> None:
    """A copy of the course whose key may be changed."""
    skip = shutil.ignore_patterns("__pycache__", "sample_class", "responses")
    for name in ("autograder", "data", "notebooks", "solutions"):
        shutil.copytree(ROOT / name, root / name, ignore=skip)
    for name in ("pyproject.toml", "README.md"):
        shutil.copy(ROOT / name, root)


def _cpu_seconds() -> float:
    """What the commands so far have used, which other work on the machine does not change."""
    used = os.times()
    return used.children_user + used.children_system


def main() -> None:
    """Make the class, run each command in a process of its own, and print the times."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--students", type=int, default=200)
    parser.add_argument("--keep", type=Path, help="a new folder for everything that is written")
    parsed = parser.parse_args()
    folder = parsed.keep or Path(tempfile.mkdtemp(prefix="whole-class-"))
    course_root, grades = folder / "course", folder / "grades"
    copy_course(course_root)
    course = load_course(course_root)
    make_class(folder / "work", course, parsed.students, np.random.default_rng(1))
    students = "\n".join(
        f'[[student]]\nname = "Student {n:03}"\nid = "{1000 + n}"\nlogin = "student_{n:03}"\n'
        f'email = "s{n}@example.org"\n'
        for n in range(parsed.students - len(BROKEN))
    )
    grades.mkdir()
    (grades / "class.toml").write_text(f'[assignment]\ntitle = "Course"\n\n{students}')
    out = ["--out", str(grades)]

    def step(said: str, *command: str) -> str:
        began, spent = time.perf_counter(), _cpu_seconds()
        done = subprocess.run(
            [sys.executable, "-m", "autograder", "--course", str(course_root), *command],
            env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
            capture_output=True,
            text=True,
        )
        seconds, spent = time.perf_counter() - began, _cpu_seconds() - spent
        print(f"{seconds:8.1f} s by the clock {spent:8.1f} s of processors  {said}", flush=True)
        if done.returncode:
            sys.exit(done.stderr)
        return done.stdout

    step("grade", "grade", str(folder / "work"), *out, "--explanations")
    step("grade again, nothing changed", "grade", str(folder / "work"), *out)
    step("override", "override", "student_000", "Q3.2.1", "1", "--reason", "oral exam", *out)
    change_key(course_root)
    told = step(
        "regrade one question, dry run",
        "regrade",
        "--question",
        "Q3.2.1",
        "--dry-run",
        "--json",
        *out,
    )
    print(f"            {len(json.loads(told)['changed'])} marks would change")
    step("regrade one question", "regrade", "--question", "Q3.2.1", *out)
    step("regrade everything", "regrade", *out)
    for name in ("csv", "canvas", "moodle", "gradescope"):
        step(f"export {name}", "export", "--format", name, *out)
    pairs = step("similar", "similar", "--json", *out)
    print(f"            {len(json.loads(pairs))} pairs")
    step("release", "release", str(folder / "bundle"))
    if not parsed.keep:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
