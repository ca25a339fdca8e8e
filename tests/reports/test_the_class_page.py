"""What the class page says, on classes small enough to reckon by hand."""

from __future__ import annotations

import csv
from pathlib import Path

from autograder.course import Course
from autograder.gradebook import Record
from autograder.reports.class_csv import write_class_csv
from autograder.reports.class_html import class_html
from autograder.reports.svg_charts import ticks
from tests.classroom import class_of, graded, mark


def test_the_class_page_can_be_written_for_any_class(course: Course):
    for records in ([], class_of((1, 1, 1, 1)), class_of(*[(0, 0, 0, 0)] * 30)):
        page = class_html(course, records, None)
        assert "nan" not in page.replace("tenant", "")
        assert page.endswith("</html>\n")


def test_a_hostile_class_changes_nothing_about_the_page(course: Course, tmp_path: Path):
    name = '<img src=x onerror="alert(1)">'
    records = [
        Record(
            graded(f"{name}{n}", mark("Q2", 0.25, alternative=name, feedback=name), notes=(name,)),
            1,
            1,
        )
        for n in range(12)
    ]
    page = class_html(course, records, None)
    assert "<img" not in page
    write_class_csv(tmp_path, course, records)
    assert "Q2" in (tmp_path / "class_mistakes.csv").read_text()


def test_the_csv_tables_hold_one_row_a_question(course: Course, tmp_path: Path):
    write_class_csv(tmp_path, course, class_of((1, 0, 0.5, 1), (1, 1, 1, 1)))
    with (tmp_path / "class_questions.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["question"] for row in rows] == ["Q1", "Q2", "Q3", "Q4"]
    assert [(row["right"], row["wrong"], row["earned_share"]) for row in rows] == [
        ("2", "0", "1"),
        ("1", "1", "0.5"),
        ("1", "0", "0.75"),
        ("2", "0", "1"),
    ]


def test_ticks_are_round_and_few():
    assert ticks(0, 50) == [0, 10, 20, 30, 40, 50]
    assert ticks(0, 1.08) == [0, 0.2, 0.4, 0.6, 0.8, 1.0]
    assert all(len(ticks(0, high)) <= 8 for high in (0.001, 3, 7, 11, 19, 1e6))
