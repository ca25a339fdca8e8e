"""What the class page says, on classes small enough to reckon by hand."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from autograder.course import Course
from autograder.gradebook import Record
from autograder.marking import Part
from autograder.reports.class_csv import write_class_csv
from autograder.reports.class_html import class_html
from autograder.reports.statistics import (
    FEWEST,
    Together,
    common_mistakes,
    question_statistics,
    who_needs_help,
)
from autograder.reports.svg_charts import ticks
from autograder.reports.whole_files import cell, file_name
from tests.classroom import all_marks, graded, make_course, mark


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Course:
    return make_course(tmp_path_factory.mktemp("orchard") / "course")


def class_of(*credits: tuple[float, float, float, float]) -> list[Record]:
    return [
        Record(graded(f"student {number:02}", *all_marks(row)), 1, 1)
        for number, row in enumerate(credits)
    ]


def test_difficulty_is_the_mean_share_among_those_who_tried(course: Course):
    untouched = mark("Q2", 0, status="not attempted")
    records = [
        Record(graded("a", mark("Q2", 1)), 1, 1),
        Record(graded("b", mark("Q2", 0.5)), 1, 1),
        Record(graded("c", untouched), 1, 1),
    ]
    statistics = {s.question.id: s for s in question_statistics(course, records)}
    assert statistics["Q2"].attempted == 2
    assert statistics["Q2"].difficulty == pytest.approx(0.75)
    assert statistics["Q3"].difficulty is None


def test_a_question_that_the_best_get_wrong_looks_broken(course: Course):
    strong, weak = (1, 1, 0, 1), (0, 0, 1, 0)
    statistics = {
        s.question.id: s for s in question_statistics(course, class_of(*[strong, weak] * 6))
    }
    assert statistics["Q3"].discrimination == pytest.approx(-1)
    assert "check the key" in statistics["Q3"].troubles[0]
    assert statistics["Q1"].discrimination > 0
    assert not statistics["Q1"].troubles


def test_a_question_without_a_single_point_looks_broken(course: Course):
    rows = [(1, 0, 1, 1), (0, 0, 1, 0)] * 6
    statistics = {s.question.id: s for s in question_statistics(course, class_of(*rows))}
    assert "Nobody earned a point" in statistics["Q2"].troubles[0]


def test_wrong_responses_that_no_mistake_names_are_counted(course: Course):
    records = [Record(graded(str(n), mark("Q2", 0)), 1, 1) for n in range(12)]
    statistics = {s.question.id: s for s in question_statistics(course, records)}
    assert statistics["Q2"].unnamed == 12
    assert any("no mistake in the key" in said for said in statistics["Q2"].troubles)


def test_a_few_submissions_are_no_evidence(course: Course):
    records = class_of(*[(1, 1, 0, 1), (0, 0, 1, 0)] * 2)
    assert all(not s.troubles for s in question_statistics(course, records))
    together = Together(2)
    for n in range(FEWEST - 1):
        together.add(np.array([n, 1.0]), np.array([n, n]))
    assert together.correlations() == [None, None]  # too few
    together.add(np.array([0.0, 1.0]), np.array([5.0, 5.0]))
    first, second = together.correlations()
    assert first is not None
    assert second is None  # what never varies


def test_correlations_that_are_gathered_are_those_of_the_whole():
    rng = np.random.default_rng(3)
    rows = rng.normal(1e6, 1.0, (200, 2, 5))
    together = Together(5)
    for row in rows:
        together.add(*row)
    wanted = [np.corrcoef(rows[:, 0, n], rows[:, 1, n])[0, 1] for n in range(5)]
    assert together.correlations() == pytest.approx(wanted, abs=1e-9)


def test_mistakes_are_counted_by_name_and_the_most_common_is_first(course: Course):
    records = [
        Record(graded("a", mark("Q2", 0.25, alternative="added")), 1, 1),
        Record(graded("b", mark("Q2", 0.25, alternative="added")), 1, 1),
        Record(graded("c", mark("Q2", 1, alternative="right")), 1, 1),
        Record(
            graded(
                "d",
                mark(
                    "Q1",
                    0.5,
                    understood="true, true",
                    parts=(Part("Statement 1", False, "no"), Part("Statement 2", True, "")),
                ),
                mark("Q4", 0.5, 4, parts=(Part("a basket", False, ""), Part("three", True, ""))),
            ),
            1,
            1,
        ),
    ]
    found = [
        (m.question, m.name, m.named, len(m.students)) for m in common_mistakes(course, records)
    ]
    assert found == [
        ("Q2", "added", True, 2),
        ("Q1", "statement 1 called true", True, 1),
        ("Q4", "wrong on: a basket", False, 1),
    ]


def test_a_function_that_is_wrong_everywhere_is_one_mistake_not_many(course: Course):
    parts = (Part("a basket", False, ""), Part("three", False, ""))
    (mistake,) = common_mistakes(course, [Record(graded("a", mark("Q4", 0, parts=parts)), 1, 1)])
    assert mistake.name == "wrong on all kinds of input"


def test_who_needs_help_are_the_lowest_and_those_whose_work_does_not_run(course: Course):
    stopped = [mark(f"Q{n}", 0, status="timeout") for n in (1, 2)]
    records = [
        *class_of((1, 1, 1, 1), (0, 0, 0, 0.5)),
        Record(graded("z", status="unreadable"), 1, 1),
        Record(graded("slow", *stopped, mark("Q3", 1), mark("Q4", 1, 4)), 1, 1),
    ]
    needy = {entry.student: " ".join(entry.reasons) for entry in who_needs_help(course, records)}
    assert list(needy) == ["z", "student 01", "slow"]
    assert "could not be opened" in needy["z"]
    assert "less than half" in needy["student 01"]
    assert needy["slow"] == "2 questions ended at the time limit"


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


def test_ticks_are_round_and_few():
    assert ticks(0, 50) == [0, 10, 20, 30, 40, 50]
    assert ticks(0, 1.08) == [0, 0.2, 0.4, 0.6, 0.8, 1.0]
    assert all(len(ticks(0, high)) <= 8 for high in (0.001, 3, 7, 11, 19, 1e6))
