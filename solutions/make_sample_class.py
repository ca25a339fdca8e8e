"""Makes ``solutions/sample_class``: twelve submissions such as a class hands in.

Each is made from the solved notebooks by changing some responses. Run it again after the notebooks
have changed::

    uv run python -m solutions.make_sample_class           # write
    uv run python -m solutions.make_sample_class --check   # exit 1 if what is there differs
"""

from __future__ import annotations

import ast
import copy
import io
import json
import random
import re
import shutil
import sys
import textwrap
import tomllib
import zipfile
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent
TARGET = ROOT / "sample_class"
BLANK = ROOT.parent / "notebooks"
SOLVED = ROOT / "notebooks"
_RESPOND = re.compile(r'^ask\("(?P<id>[^"]+)"\)\.respond\((?P<response>.*)\)$', re.DOTALL)

# What students of the sample class predict: numbers, or places in the list of choices.
GUESSES: dict[str, dict[str, tuple[int | float, ...]]] = {
    "place_recognition": {
        "P1.1": (1, 1, 1, 0, 2, 3),
        "P1.2": (0, 1, 1, 2),
        "P1.3": (9, 12, 14, 15, 17, 18, 20),
    },
    "line_fitting": {
        "P2.1": (0, 0, 1, 1, 2, 3),
        "P2.2": (0, 1, 1, 2, 3),
        "P2.3": (0, 1, 1, 2, 3),
        "P2.4": (0, 1, 2),
        "P2.5": (0.5, 1.0, 2.0, 3.0, 5.0, 10.0),
    },
    "ransac": {
        "P3.1": (12, 50, 80, 100, 100, 400, 10_000),
        "P3.2": (60.0, 80.0, 90.0, 95.0, 95.0, 99.0),
        "P3.3": (0, 1, 2, 2),
        "P3.4": (20, 45, 50, 100, 373, 1000),
    },
}

Cell = dict[str, Any]  # as nbformat reads it, like a whole notebook
Notebook = dict[str, Any]


class Work:
    """The notebooks and clicked responses of one student; starts out all right, or blank."""

    def __init__(self, blank: bool = False) -> None:
        folder = BLANK if blank else SOLVED
        self.notebooks: dict[str, Notebook] = {
            path.name: _without_outputs(json.loads(path.read_text(encoding="utf-8")))
            for path in sorted(folder.glob("[1-9]_*.ipynb"))
        }
        self.responses: dict[str, dict[str, Cell]] = {}
        if not blank:
            for name, notebook in self.notebooks.items():
                self._click(name, notebook)

    def _click(self, name: str, notebook: Notebook) -> None:
        """Turn ``ask(...).respond(...)`` into what a click leaves: a cell and a saved response."""
        for cell in notebook["cells"]:
            match = _RESPOND.match("".join(cell["source"]))
            if match:
                cell["source"] = f'ask("{match["id"]}")'
                self.click(match["id"], ast.literal_eval(match["response"]), name)

    def click(self, id: str, response: Sequence[object], notebook: str | None = None) -> None:
        """Answer a true/false or an order question."""
        if notebook is None:
            notebook = self._place(id)[0]
        self.responses.setdefault(_chapter(notebook), {})[id] = {"response": response}

    def predict(self, student: str) -> None:
        """What this student expects of the pictures of the chapters, right or wrong by chance."""
        for chapter in map(_chapter, self.notebooks):
            for id, guesses in GUESSES.get(chapter, {}).items():
                guess = random.Random(f"{student} {id}").choice(guesses)
                choices = _choices(chapter, id)
                self.responses.setdefault(chapter, {})[id] = {
                    "kind": "prediction",
                    "response": choices[int(guess)] if choices else guess,
                    "status": "recorded",
                }

    def type(self, id: str, source: str) -> None:
        """Put code into the cell of a question."""
        self._place(id)[1]["source"] = textwrap.dedent(source).strip()

    def blank(self, id: str) -> None:
        """Take a response back."""
        for entries in self.responses.values():
            entries.pop(id, None)
        name, cell = self._place(id)
        untouched = json.loads((BLANK / name).read_text(encoding="utf-8"))["cells"]
        cell["source"] = next(other["source"] for other in untouched if other["id"] == cell["id"])

    def cells(self, name: str) -> list[Cell]:
        """The cells of one notebook, to be rearranged."""
        cells: list[Cell] = self.notebooks[name]["cells"]
        return cells

    @property
    def ids(self) -> list[str]:
        """Every question of the notebooks, in order."""
        return [
            _question(cell["id"])
            for notebook in self.notebooks.values()
            for cell in notebook["cells"]
            if cell["id"].endswith("-response")
        ]

    def files(self) -> dict[str, bytes]:
        """What is handed in, by name."""
        notebooks = {
            name: json.dumps(notebook, indent=1, ensure_ascii=False).encode()
            for name, notebook in self.notebooks.items()
        }
        responses = {
            f"responses/{chapter}.json": json.dumps(
                {"chapter": chapter, "responses": entries}, indent=1
            ).encode()
            for chapter, entries in self.responses.items()
        }
        return notebooks | responses

    def _place(self, id: str) -> tuple[str, Cell]:
        for name, notebook in self.notebooks.items():
            for cell in notebook["cells"]:
                if cell["id"].endswith("-response") and _question(cell["id"]) == id:
                    return name, cell
        raise LookupError(f"no notebook asks {id}")


def half_done() -> Work:
    """Every second question is left open."""
    work = Work()
    for id in work.ids[1::2]:
        work.blank(id)
    return work


def mistaken_choices() -> Work:
    """Wrong calls, an order with the query before the vocabulary, one statement left open."""
    work = Work()
    work.click("Q1.1", [True, True, True, None])
    work.click("Q2.1", [False, True, True])
    work.click("Q3.1", [True, True, True, True])
    order = list(work.responses["place_recognition"]["Q1.2"]["response"])
    order.insert(0, order.pop(7))
    work.click("Q1.2", order)
    return work


def mistaken_numbers() -> Work:
    """The typical slips: w for its square, ordered pairs, rounding down, the complement."""
    work = Work()
    work.type("Q3.2.1", "iterations = math.ceil(math.log(1 - p) / math.log(1 - w))")
    work.type("Q3.2.2", "candidate_lines = N * (N - 1)")
    work.type("Q3.2.3b", "outlier_after_42 = 1 - (1 - w**2) ** 42")
    work.type("Q3.2.4", "success_after_100 = (1 - w**2) ** 100")
    work.type("Q3.2.5", "plane_iterations = math.floor(math.log(1 - p) / math.log(1 - w**3))")
    return work


def mistaken_expressions() -> Work:
    """Lost factors, a plain arctan where the minimum is asked for, a result that is text."""
    work = Work()
    work.type("Q2.2a", "dS_dr = N * r - sum_x * sp.cos(alpha) - sum_y * sp.sin(alpha)")
    work.type("Q2.2b", "r_opt = sum_x * sp.cos(alpha) + sum_y * sp.sin(alpha)")
    work.type("Q2.2c", "S_alpha = S_xx * sp.cos(alpha) ** 2 + S_yy * sp.sin(alpha) ** 2")
    work.type("Q2.2d", 'dS_dalpha = "(S_yy - S_xx) * sin(2 * alpha)"')
    work.type("Q2.2e", "alpha_opt = sp.atan(-2 * S_xy / (S_yy - S_xx)) / 2")
    work.type("Q2.2f2", "alpha_min = alpha_opt")
    work.type("Q3.2.3a", "outlier_model = (1 - w) ** 2")
    return work


def mistaken_functions() -> Work:
    """A line with a negative radius, and iterations rounded down."""
    work = Work()
    work.type(
        "Q2.3",
        """
        def fit_line(points, weights=None):
            weights = np.ones(len(points)) if weights is None else weights
            centre = np.average(points, axis=0, weights=weights)
            x, y = (points - centre).T
            alpha = np.arctan2(-2 * weights @ (x * y), weights @ (y**2 - x**2)) / 2
            return centre @ [np.cos(alpha), np.sin(alpha)], alpha
        """,
    )
    work.type(
        "Q3.3",
        """
        def required_iterations(p, w, s):
            return math.floor(math.log(1 - p) / math.log1p(-(w**s)))
        """,
    )
    return work


def raises_in_the_middle() -> Work:
    """A cell of chapter 3 that raises, and a function that raises on every input."""
    work = Work()
    work.type("Q3.2.4", "success_after_100 = 1 - outlier_modell ** 100")
    work.type("Q2.3", "def fit_line(points, weights=None):\n    return points.fit()")
    return work


def cells_deleted_and_duplicated() -> Work:
    """One response's cell is gone, another is there three times: the last one counts."""
    work = Work()
    cells = work.cells("3_ransac.ipynb")
    cells[:] = [cell for cell in cells if not cell["id"].startswith("Q3-2-2-")]
    at = next(i for i, cell in enumerate(cells) if cell["id"] == "Q3-2-1-response")
    wrong = copy.deepcopy(cells[at])
    wrong["source"] = "iterations = 12"
    duplicate = copy.deepcopy(cells[at])
    wrong["id"], duplicate["id"] = "first-try", "third-try"
    cells[at:at] = [wrong]
    cells.insert(at + 2, duplicate)
    for cell in cells:
        cell["metadata"] = {"tags": ["mine"]}
    return work


def make(target: Path) -> None:
    """Write the twelve submissions into an empty folder."""
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    zipped: dict[str, Callable[[], Work]] = {
        "ada": Work,
        "boole": lambda: Work(blank=True),
        "curie": half_done,
        "dijkstra": mistaken_choices,
        "euler": mistaken_numbers,
        "fourier": mistaken_expressions,
        "gauss": mistaken_functions,
        "hopper": raises_in_the_middle,
        "ito": cells_deleted_and_duplicated,
    }
    for student, make_work in zipped.items():
        work = make_work()
        if student not in ("boole", "hopper"):  # who hands in without a prediction is there too
            work.predict(student)
        (target / f"{student}.zip").write_bytes(_zip(work.files()))
    # One notebook alone, as solved and executed: its outputs carry the receipts.
    shutil.copy(SOLVED / "3_ransac.ipynb", target / "jacobi.ipynb")
    for name, data in Work().files().items():
        path = target / "kepler" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    (target / "lovelace.docx").write_bytes(
        b"Dear instructor, my notebooks are on my other laptop.\n"
    )


def main() -> int:
    """Write the sample class, or compare it with what would be written."""
    if "--check" not in sys.argv[1:]:
        make(TARGET)
        return 0
    fresh = ROOT / ".sample_class_fresh"
    try:
        make(fresh)
        same = _all_files(fresh) == _all_files(TARGET)
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
    if not same:
        print("solutions/sample_class is out of date; run python -m solutions.make_sample_class.")
    return 0 if same else 1


@cache
def _choices(chapter: str, id: str) -> list[str]:
    """The choices of a prediction; none where a number is asked for."""
    text = (BLANK / "questions" / f"{chapter}.toml").read_text(encoding="utf-8")
    asked = next(p for p in tomllib.loads(text)["prediction"] if p["id"] == id)
    return list(asked.get("choices", []))


def _chapter(notebook: str) -> str:
    return Path(notebook).stem.partition("_")[2]


def _question(cell_id: str) -> str:
    return cell_id.removesuffix("-response").replace("-", ".")


def _without_outputs(notebook: Notebook) -> Notebook:
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell["outputs"], cell["execution_count"] = [], None
    return notebook


def _zip(files: dict[str, bytes]) -> bytes:
    """A zip whose bytes depend on nothing but the files."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, date_time=(2024, 1, 1, 0, 0, 0))
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    return buffer.getvalue()


def _all_files(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


if __name__ == "__main__":
    sys.exit(main())
