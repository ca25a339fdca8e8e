"""Run all benchmarks in one process, or those that are named.

All of them write results.md and results.png beside this file; named ones only print.
"""

import argparse
import importlib
import importlib.metadata
import os
import platform
import sys
from pathlib import Path

for name in ("OMP", "OPENBLAS", "MKL", "NUMEXPR"):  # one thread for all; before NumPy loads
    os.environ[f"{name}_NUM_THREADS"] = "1"

import cv2  # noqa: E402

from benchmarks.plot import write_plot  # noqa: E402
from benchmarks.report import Section, markdown_section, write_report  # noqa: E402

MODULES = ("ransac", "line_extraction", "place_recognition")
PACKAGES = (
    "numpy",
    "scipy",
    "opencv-python-headless",
    "scikit-image",
    "scikit-learn",
    "open3d-cpu",
    "pyransac3d",
    "faiss-cpu",
)


def main() -> int:
    """Run the benchmarks and return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("module", nargs="*", metavar="MODULE", help=", ".join(MODULES))
    parser.add_argument("--out", type=Path, default=Path(__file__).parent, metavar="DIR")
    arguments = parser.parse_args()
    unknown = set(arguments.module) - set(MODULES)
    if unknown:
        parser.error(f"no benchmark is named {min(unknown)}; choose from {', '.join(MODULES)}")

    cv2.setNumThreads(1)
    sections = []
    for module in arguments.module or MODULES:
        print(f"running {module} ...", file=sys.stderr)
        section: Section = importlib.import_module(f"benchmarks.{module}").run()
        sections.append(section)
        print(markdown_section(section), end="\n\n")
    if not arguments.module:
        arguments.out.mkdir(parents=True, exist_ok=True)
        write_report(sections, introduction(), arguments.out / "results.md")
        write_plot(sections, arguments.out / "results.png")
    return 0


def introduction() -> str:
    """What the numbers are and where they were taken."""
    versions = []
    for package in PACKAGES:
        try:
            versions.append(f"{package} {importlib.metadata.version(package)}")
        except importlib.metadata.PackageNotFoundError:
            versions.append(f"{package} not installed")
    return f"""
One run of `uv run --group bench python -m benchmarks`: one process, one thread, contenders
on the same data (but where it says otherwise), taking turns; the median of the processor times
counts. A ratio of 10 × means that a contender takes ten times as long as this project. Ratios carry
over to other machines roughly, times do not.

{processor()}, Python {platform.python_version()}, {", ".join(versions)}.

![Ratios and growth](results.png)
"""


def processor() -> str:
    """The processor's name, as far as the system tells."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.split(":")[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


if __name__ == "__main__":
    sys.exit(main())
