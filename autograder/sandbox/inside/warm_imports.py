"""Imports and warms everything once, so that a fork starts with it.

Run as a program it does the same outside of any sandbox, but without the course, which makes Python
keep the compiled modules where the sandbox, which writes nothing, finds them. Which modules these
are goes into the file that its argument names.
"""

from __future__ import annotations

import importlib
import os
import pkgutil
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from types import ModuleType

from autograder.sandbox.inside.evaluate import load_kinds
from autograder.sandbox.inside.notebook import Notebook

_LIBRARIES = (
    "asyncio",
    "cv2",
    "IPython.display",
    "matplotlib.pyplot",
    "mpl_toolkits.mplot3d",
    "numpy.fft",
    "numpy.linalg",
    "numpy.ma",
    "numpy.random",
    "sympy",
)
# No `await`: an event loop of this process would be of no use in a fork.
# Small things of the kind that notebooks do; what they load and cache is then there.
_CELLS = (
    """
import numpy as np, sympy as sp
x, y = sp.symbols("x y", real=True)
f = sp.sin(x * y)**2 + sp.sqrt(x**2 + 1) / y
sp.diff(f, x); sp.simplify((x**2 - 1) / (x - 1)); sp.solve(x**2 - y, x); str(f)
sp.Sum(x, (y, 1, 3)).doit(); sp.expand((x + y)**2)
sp.atan2(x, y).subs({x: 1, y: 2}).evalf(); sp.Matrix([[x, 1], [1, y]]).det()
np.linalg.svd(np.eye(2)); np.linalg.lstsq(np.eye(2), np.ones(2), rcond=None); np.cov(np.eye(2))
np.random.default_rng(0).normal(size=3); np.random.rand(2)
""",
    # OpenCV and Matplotlib may be missing: such a cell fails, and nobody minds.
    """
import matplotlib.pyplot as plt
figure, axes = plt.subplots(1, 2)
axes[0].plot([0, 1], [0, 1], label="a"); axes[1].scatter([0, 1], [0, 1], c=[0, 1])
axes[0].set_title("t"); axes[0].legend(); axes[0].set_aspect("equal"); plt.show()
""",
    """
import cv2
picture = np.zeros((64, 64), np.uint8); picture[20:40, 20:40] = 255
cv2.ORB_create().detectAndCompute(picture, None); cv2.SIFT_create().detectAndCompute(picture, None)
cv2.GaussianBlur(picture, (3, 3), 1); cv2.cvtColor(picture, cv2.COLOR_GRAY2BGR)
""",
    "%timeit -n1 -r1 -q 1",
    "1 / 0",
)
# For a course whose notebooks ask questions themselves.
_ASKING = "from autograder import ask, check, progress, submit\nprogress();"


def warm(with_course: bool) -> Notebook:
    """An empty notebook in a process where everything is imported.

    Only in a sandbox ``with_course``, which imports what a folder of that name holds.
    """
    for name in (*_LIBRARIES, *os.environ.get("AUTOGRADER_PACKAGES", "").split()):
        with suppress(Exception):
            importlib.import_module(name)
    for name in _course_modules() if with_course else ():
        with suppress(Exception):
            importlib.import_module(name)
    if "cv2" in sys.modules:
        sys.modules["cv2"].setNumThreads(1)  # its threads would not be there after a fork
    load_kinds()
    notebook = Notebook()
    notebook.run(list(_CELLS), ["f", "x", "figure"])
    if with_course and _asks_in_its_notebooks():
        notebook.run([_ASKING], [])
    notebook.forget()
    return notebook


def _course_modules() -> Iterator[str]:
    """The modules of the course that notebooks import: those of ``data`` and ``notebooks``."""
    for package in ("data", "notebooks"):
        with suppress(Exception):
            module: ModuleType = importlib.import_module(package)
            yield from (
                f"{package}.{entry.name}"
                for entry in pkgutil.iter_modules(module.__path__)
                if not entry.name[0].isdigit()
            )


def _asks_in_its_notebooks() -> bool:
    """Whether notebooks begin with importing `ask`.

    Those that are built from masters do, though it is not written in a master itself.
    """
    return any(Path(os.environ.get("AUTOGRADER_COURSE", "."), "notebooks/source").glob("*.py"))


if __name__ == "__main__":
    sys.dont_write_bytecode = False
    warm(with_course=False)
    files = (getattr(module, "__file__", None) for module in list(sys.modules.values()))
    imported = sorted({file for file in files if file and file.endswith(".py")})
    with open(sys.argv[1], "w", encoding="utf-8", errors="surrogateescape", newline="\n") as kept:
        kept.writelines(f"{file}\n" for file in imported)
