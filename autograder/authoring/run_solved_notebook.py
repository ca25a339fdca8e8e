"""Running a solved notebook, which keeps its outputs but for pictures."""

from __future__ import annotations

import os
import subprocess
import tempfile
from typing import Any

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

from autograder.authoring.assemble_notebook import KERNEL
from autograder.authoring.master import Master
from autograder.authoring.raising_cells import raised
from autograder.course import Course
from autograder.course.folders import SOLVED, cell_id
from autograder.errors import CourseError
from autograder.exchange.building import BUILDING


def run_solved_notebook(notebook: Any, course: Course, master: Master) -> None:
    """Run every cell, and write the outputs into the notebook.

    Raises:
        CourseError: if a cell raises; the sentence says where in the master, and what.
    """
    folder = course.root / SOLVED
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as responses:
        # Some ipykernels bring a debugger along, which warns of how newer Pythons are built.
        os.environ.setdefault("PYDEVD_DISABLE_FILE_VALIDATION", "1")
        # Responses of the author's own must neither be read nor overwritten.
        environment = {
            **os.environ,
            "AUTOGRADER_RESPONSES": responses,
            "AUTOGRADER_WIDGETS": "0",  # even if this runs inside of a notebook
            BUILDING: "1",
        }
        client = NotebookClient(
            notebook,
            timeout=600,
            kernel_name="python3",
            resources={"metadata": {"path": folder}},
        )
        try:
            # The kernel's own warnings concern its ports, not the author.
            client.execute(env=environment, stderr=subprocess.DEVNULL)
        except CellExecutionError:
            cell = next(c for c in notebook.cells if _raised(c))
            of_exercises = {
                cell_id(id, part): id for id in course.questions for part in ("response", "check")
            }
            raise CourseError(raised(master, cell, of_exercises.get(cell.id))) from None
    notebook.metadata = nbformat.from_dict(KERNEL)  # without this machine's Python version
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
        if cell.cell_type == "code":
            cell.outputs = [kept for output in cell.outputs if (kept := _without_images(output))]


def _raised(cell: Any) -> bool:
    return any(output.output_type == "error" for output in cell.get("outputs", ()))


def _without_images(output: Any) -> object:
    """The output without pictures, which change with every version of Matplotlib.

    What stands beside a picture as text stays: nbval compares that.
    """
    if output.output_type not in ("display_data", "execute_result"):
        return output
    kept = {kind: data for kind, data in output.data.items() if not kind.startswith("image/")}
    if not kept:
        return None
    output.data = nbformat.from_dict(kept)
    return output
