"""Another course, made with `autograder new`: handed out, taken in a browser, handed in, graded."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

from lab import ROOT, Notebook, Server
from playwright.sync_api import BrowserContext, expect
from test_journey import answer_statements, grade, put_in_order

from autograder.course import load_course

KALMAN = ROOT / "tests/courses/kalman"


def test_a_course_on_another_subject_is_taken_and_graded(
    window: BrowserContext, server: Server, tmp_path: Path
):
    course = load_course(KALMAN)
    key = course.key
    # In a process of its own: each course has a package `solutions`.
    command = [sys.executable, "-m", "autograder", "--course", KALMAN, "release"]
    subprocess.run([*command, tmp_path / "bundle"], check=True)
    shutil.move(tmp_path / "bundle", server.course / "kalman")
    page = window.new_page()
    chapter = Notebook(page, server, "1_kalman.ipynb", folder="kalman/notebooks").open()
    chapter.run_all()
    chapter.wait_for_widgets()

    # Its `data` are its own, although this repository has a package of that name too.
    expect(page.get_by_text("20 readings of the scale")).to_contain_text("the Kalman filter's")

    answer_statements(chapter, "Q1.1", [entry.truth for entry in key["Q1.1"].statements])
    put_in_order(chapter, "Q1.2", list(key["Q1.2"].order), course)
    chapter.question("Q1.3").get_by_role("textbox").fill("0.2")  # a known mistake: half the points
    chapter.question("Q1.3").get_by_role("textbox").press("Enter")
    expect(chapter.question("Q1.3").locator(".ag-verdict")).to_contain_text("recorded")
    chapter.question("Q1.4").get_by_role("textbox").fill("1/(1/P + 1/R)")
    chapter.question("Q1.4").get_by_role("textbox").press("Enter")
    expect(chapter.question("Q1.4").locator(".ag-verdict")).to_contain_text("right")
    stub = chapter.index_of("def correct")
    chapter.write(
        stub,
        "def correct(mean, variance, reading, noise):\n"
        "    total = variance + noise\n"
        "    return (noise * mean + variance * reading) / total, variance * noise / total",
    )
    chapter.run_cell(stub)
    chapter.run_cell(chapter.index_of('check("Q1.5"'))
    expect(chapter.question("Q1.5").locator(".ag-verdict")).to_contain_text("right")
    chapter.save()
    chapter.run_cell(chapter.index_of("submit()"))
    expect(page.get_by_role("group", name="Submission")).to_contain_text("5 questions are answered")
    page.close()

    handed_in = server.course / "kalman/notebooks/submission.zip"
    marks = grade(handed_in, KALMAN, tmp_path / "grades")
    expected = {"Q1.1": 2.0, "Q1.2": 3.0, "Q1.3": 1.0, "Q1.4": 2.0, "Q1.5": 4.0}
    assert {id: float(marks[id]) for id in expected} == expected
