"""What every chapter promises its readers, read off the masters."""

import re
import statistics
from pathlib import Path

import jupytext
import pytest

MASTERS = sorted(Path("notebooks/source").glob("*.py"))


def cells(path: Path, kind: str) -> list[str]:
    notebook = jupytext.read(path, fmt="py:percent")
    return [cell.source for cell in notebook.cells if cell.cell_type == kind and cell.source]


@pytest.mark.parametrize("path", MASTERS, ids=lambda path: path.stem)
def test_code_cells_are_short(path):
    lengths = [len(source.strip().splitlines()) for source in cells(path, "code")]
    assert statistics.median(lengths) <= 5


@pytest.mark.parametrize("path", MASTERS, ids=lambda path: path.stem)
def test_no_cell_draws_by_itself(path):
    assert "matplotlib" not in path.read_text()
    assert not re.search(r"\b(plt|axes?)\.", "\n".join(cells(path, "code")))


@pytest.mark.parametrize("path", MASTERS[1:4], ids=lambda path: path.stem)
def test_a_chapter_ends_with_further_reading(path):
    assert "## Further reading" in cells(path, "markdown")[-1]


def test_the_three_references_of_the_sheet_are_named():
    text = " ".join("".join(path.read_text() for path in MASTERS).replace("#", " ").split())
    for title in (
        "Scalable recognition with a vocabulary tree",
        "A comparative analysis of RANSAC techniques leading to adaptive real-time random sample",
        "Size matters: exhaustive geometric verification for image retrieval",
    ):
        assert title in text


@pytest.mark.parametrize("path", MASTERS, ids=lambda path: path.stem)
def test_nothing_random_is_left_to_chance(path):
    code = "\n".join(cells(path, "code"))
    assert "default_rng()" not in code
    assert "np.random.seed" not in code
