"""Names of files that every system takes, and cells that no spreadsheet runs."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder.reports.whole_files import cell, file_name


@pytest.mark.parametrize(
    "text",
    [
        '=HYPERLINK("http://example.org")',
        "+1",
        "-1+1",
        "@SUM(A1)",
        "\t=1",
        "\r=1",
        "\n=1",
        "  =1",
        "＝1",
        "|calc",
        "%0a=1",
    ],
)
def test_no_cell_of_text_is_a_formula(text: str, tmp_path: Path):
    assert cell(text).startswith("'")


def test_numbers_stay_numbers_and_text_stays_readable():
    assert [cell(v) for v in (-1.5, 3, 0.1 + 0.2, None, "Ada", "a=b")] == [
        "-1.5",
        "3",
        "0.3",
        "",
        "Ada",
        "a=b",
    ]


@pytest.mark.parametrize(
    "name", ["ada", "a/b", "CON", "x" * 300, "é" * 100, "..", "", "a:b?", "名" * 90]
)
def test_every_name_becomes_a_file_name_that_every_system_takes(name: str):
    made = file_name(name)
    assert 0 < len(f"{made}.html.tmp".encode()) <= 255
    assert not set(made) & set('<>:"/\\|?*')
    assert made.casefold() not in {"con", ".", "..", ""}


def test_different_names_become_different_files():
    names = ["a/b", "a:b", "a_b", "x" * 300, "x" * 299]
    assert len({file_name(name) for name in names}) == len(names)
