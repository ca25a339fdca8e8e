"""A notebook finds its own course, its own `data`, and true advice where there is neither."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.toy import make_toy

ROOT = Path(__file__).parents[2]
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))


def in_a_kernel(code: str, folder: Path, **environment: str) -> str:
    """What code prints in a process that runs in a notebook's folder."""
    clean = {name: value for name, value in os.environ.items() if not name.startswith("AUTOGRADER")}
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=folder,
        env=clean | environment,
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout + done.stderr


def make_course(root: Path) -> Path:
    make_toy(root, "cellar")
    (root / "data").mkdir()
    (root / "data/__init__.py").write_text("WHOSE = 'its own'\n")
    return root / "notebooks"


def test_another_course_s_data_are_its_own(tmp_path: Path):
    folder = make_course(tmp_path / "course")
    code = "from autograder import ask\nimport data\nprint(data.WHOSE)"
    assert in_a_kernel(code, folder) == "its own\n"


def test_data_that_were_taken_from_another_course_first_are_forgotten(tmp_path: Path):
    folder = make_course(tmp_path / "course")
    code = "import data\nfrom autograder import ask\nimport data\nprint(data.WHOSE)"
    assert in_a_kernel(code, folder, PYTHONPATH=str(ROOT)) == "its own\n"


def test_a_notebook_that_was_copied_alone_is_told_where_to_move(tmp_path: Path):
    said = in_a_kernel("from autograder import ask\nask('Q1')", tmp_path)
    assert "outside of its course" in said
    assert "--course" not in said
    assert "%env AUTOGRADER_COURSE=" in said


def test_that_advice_is_true(tmp_path: Path):
    folder = make_course(tmp_path / "course")
    code = "from autograder import progress\nimport data\nprint(data.WHOSE, progress())"
    said = in_a_kernel(code, tmp_path, AUTOGRADER_COURSE=str(folder.parent))
    assert said.startswith("its own")
    assert "outside" not in said


def test_a_mistyped_course_is_named(tmp_path: Path):
    code = "from autograder import ask\nask('Q1')"
    said = in_a_kernel(code, tmp_path, AUTOGRADER_COURSE=str(tmp_path / "nowhere"))
    assert f"AUTOGRADER_COURSE names {tmp_path / 'nowhere'}, which does not exist" in said


@pytest.mark.parametrize("other", ["nothing", "another project of that name"])
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_first_cell_says_how_to_install_the_course(path: Path, other: str, tmp_path: Path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    first = next(cell for cell in cells if cell["cell_type"] == "code")
    if other != "nothing":
        (tmp_path / "autograder.py").write_text("def grade(): ...\n")
    code = "import sys\nsys.path[:] = [*sys.argv[1:], *(p for p in sys.path if 'python3' in p)]\n"
    code += "sys.meta_path.insert(0, type('No', (), {'find_spec': staticmethod(lambda n, *_: "
    code += "(_ for _ in ()).throw(ImportError(n)) if n == 'autograder' and len(sys.argv) < 2 "
    code += "else None)}))\n"
    where = [str(tmp_path)] if other != "nothing" else []
    done = subprocess.run(
        [sys.executable, "-c", code + "".join(first["source"]), *where],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    last = done.stderr.strip().splitlines()[-1]
    assert last.startswith("ImportError: The course is not installed for this kernel")
    assert "uv run --extra lab jupyter lab" in last
