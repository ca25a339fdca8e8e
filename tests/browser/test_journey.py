"""A student works through two chapters in a browser and hands in; that very file is graded."""

from __future__ import annotations

import csv
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from lab import ROOT, Notebook, Server
from playwright.sync_api import BrowserContext, Page, expect

from autograder.course import Course, load_course


@pytest.fixture(scope="module")
def course() -> Course:
    return load_course(ROOT)


@pytest.fixture
def page(window: BrowserContext) -> Iterator[Page]:
    tab = window.new_page()
    yield tab
    tab.close()


def test_a_student_answers_saves_comes_back_hands_in_and_is_graded(
    page: Page, server: Server, course: Course, window: BrowserContext, tmp_path: Path
):
    key: Any = course.key

    # Chapter 1: click every statement, put the cards in order by mouse, buttons and keys.
    chapter = Notebook(page, server, "1_place_recognition.ipynb").open()
    # Only its two questions: the rest of the chapter computes for a while.
    for source in ("from autograder", 'ask("Q1.1")', 'ask("Q1.2")'):
        chapter.run_cell(chapter.index_of(source))
    chapter.wait_for_widgets()
    truths = [statement.truth for statement in key["Q1.1"].statements]
    answer_statements(chapter, "Q1.1", truths)
    put_in_order(chapter, "Q1.2", list(key["Q1.2"].order), course)
    check(chapter, "Q1.1", "right")
    check(chapter, "Q1.2", "right")
    chapter.save()

    # Close the tab, open it again: the answers are there, and can be changed.
    page.close()
    chapter = Notebook(window.new_page(), server, chapter.path).open()
    for at, truth in enumerate(truths):
        chosen = chapter.question("Q1.1").get_by_role("radio").nth(2 * at + (not truth))
        expect(chosen).to_be_checked()
        expect(chosen).to_be_enabled()
    chapter.page.close()

    # Chapter 3: two statements right and two open, a typed number and formula, code in a cell.
    page = window.new_page()
    chapter = Notebook(page, server, "3_ransac.ipynb").open()
    chapter.run_all()
    chapter.wait_for_widgets()
    truths = [statement.truth for statement in key["Q3.1"].statements]
    answer_statements(chapter, "Q3.1", truths[:2])
    value = next(entry.value for entry in key["Q3.2.1"].alternatives if entry.credit == 1)
    type_answer(chapter, "Q3.2.1", str(value))
    formula = next(entry.expression for entry in key["Q3.2.3a"].alternatives if entry.credit == 1)
    type_answer(chapter, "Q3.2.3a", formula)
    value = next(entry.value for entry in key["Q3.2.2"].alternatives if entry.credit == 1)
    chapter.write(chapter.index_of("candidate_lines = ..."), f"candidate_lines = {value}")
    chapter.run_cell(chapter.index_of("candidate_lines ="))
    chapter.run_cell(chapter.index_of('check("Q3.2.2"'))
    expect(chapter.question("Q3.2.2").locator(".ag-verdict")).to_contain_text("right")

    # Hand in: the panel notices that the cell was not saved.
    chapter.run_cell(chapter.append("submit()"))
    panel = page.get_by_role("group", name="Submission")
    expect(panel).to_contain_text("differs from what you ran last")
    chapter.save()
    panel.get_by_role("button", name="Pack again").click()
    expect(panel).not_to_contain_text("Not ready")
    expect(panel).to_contain_text(f"6 of {len(course.questions)} questions are answered")
    page.close()

    handed_in = server.course / "notebooks/submission.zip"
    marks = grade(handed_in, server.course, tmp_path)
    expected = dict.fromkeys(course.questions, 0.0) | {
        id: course.question(id).points for id in ("Q1.1", "Q1.2", "Q3.2.1", "Q3.2.2", "Q3.2.3a")
    }
    expected["Q3.1"] = 2.0
    assert {id: float(marks[id]) for id in expected} == expected
    assert float(marks["total"]) == sum(expected.values())


def answer_statements(chapter: Notebook, id: str, truths: list[bool]) -> None:
    for at, truth in enumerate(truths):
        chapter.question(id).get_by_role("radio").nth(2 * at + (not truth)).click()
        expect(chapter.question(id).locator(".ag-status")).to_have_text("Kept.")


def put_in_order(chapter: Notebook, id: str, order: list[str], course: Course) -> None:
    """The first card by mouse, the second by its buttons, the others by keys."""
    texts = {card.id: card.text for card in course.question(id).cards}  # type: ignore[attr-defined]
    question = chapter.question(id)
    for to, card in enumerate(order):
        now = question.locator(".ag-card .ag-text").all_inner_texts()
        at = now.index(texts[card], to)
        if at == to:
            continue
        moving = question.locator(".ag-card").nth(at)
        if to == 0:
            grip = moving.locator(".ag-grip")
            grip.scroll_into_view_if_needed()
            start = grip.bounding_box()
            end = question.locator(".ag-card").nth(to).bounding_box()
            assert start is not None
            assert end is not None
            chapter.page.mouse.move(start["x"] + 8, start["y"] + 8)
            chapter.page.mouse.down()
            chapter.page.mouse.move(start["x"] + 8, end["y"] + 4, steps=8)
            chapter.page.mouse.up()
        elif to == 1:
            for _ in range(at - to):
                question.get_by_role("button", name=f"Move up: {texts[card]}", exact=True).click()
        else:
            moving.locator(".ag-grip").focus()
            chapter.page.keyboard.press("Space")
            for _ in range(at - to):
                chapter.page.keyboard.press("ArrowUp")
            chapter.page.keyboard.press("Space")
        expect(question.locator(".ag-card .ag-text").nth(to)).to_have_text(texts[card])
    expect(question.locator(".ag-status")).to_have_text("Kept.")


def type_answer(chapter: Notebook, id: str, text: str) -> None:
    chapter.question(id).get_by_role("textbox").fill(text)
    chapter.question(id).get_by_role("textbox").press("Enter")
    expect(chapter.question(id).locator(".ag-verdict")).to_contain_text("right")


def check(chapter: Notebook, id: str, status: str) -> None:
    chapter.question(id).get_by_role("button", name="Check").click()
    expect(chapter.question(id).locator(".ag-verdict")).to_contain_text(status)


def grade(submission: Path, course: Path, folder: Path) -> dict[str, str]:
    """The row that `autograder grade` writes for the submission."""
    environment = {
        name: value for name, value in os.environ.items() if not name.startswith("AUTOGRADER_")
    }
    command = "from autograder.cli import main; raise SystemExit(main())"
    done = subprocess.run(
        [sys.executable, "-c", command, "grade", str(submission), "--out", str(folder)],
        cwd=course,
        env=environment,
        capture_output=True,
        text=True,
        timeout=400,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    with (folder / "grades.csv").open(encoding="utf-8-sig") as file:
        return next(csv.DictReader(file))


def test_notebook_7_shows_and_keeps_the_same_answers(page: Page, server: Server):
    chapter = Notebook(page, server, "2_line_fitting.ipynb", app="notebooks").open()
    chapter.run_cell(chapter.index_of("from autograder"))
    chapter.run_cell(chapter.index_of('ask("Q2.1")'))
    answer_statements(chapter, "Q2.1", [True])
    assert chapter.kept()["Q2.1"]["response"] == [True, None, None]
    chapter.question("Q2.1").get_by_role("button", name="Check").click()
    expect(chapter.question("Q2.1").locator(".ag-attempts")).to_have_text("1 attempt")
    before = chapter.sources()
    page.keyboard.press("b")
    assert chapter.sources() == before


def test_without_a_key_answers_are_recorded_and_nothing_looks_marked(page: Page, server: Server):
    bundle = server.course / "bundle"
    ignored = shutil.ignore_patterns("responses", "submission.zip")
    shutil.copytree(ROOT / "notebooks", bundle / "notebooks", ignore=ignored)
    (bundle / "data").symlink_to(server.course / "data")
    shutil.copy(server.course / "pyproject.toml", bundle)
    chapter = Notebook(page, server, "3_ransac.ipynb", folder="bundle/notebooks").open()
    for source in ("from autograder", 'ask("Q3.1")', "iterations = ...", 'check("Q3.2.1"'):
        chapter.run_cell(chapter.index_of(source))
    chapter.wait_for_widgets()
    statements, number = chapter.question("Q3.1"), chapter.question("Q3.2.1")
    expect(statements).to_contain_text("marked later")
    expect(statements.get_by_role("button", name="Check")).to_have_count(0)
    answer_statements(chapter, "Q3.1", [True, False])
    number.get_by_role("textbox").fill("1 / 3")
    number.get_by_role("textbox").press("Enter")
    expect(number.locator(".ag-verdict")).to_have_text("● recorded")
    expect(statements.locator(".ag-verdict")).to_have_count(0)
    expect(statements.locator(".ag-part:visible")).to_have_count(0)
    assert chapter.kept()["Q3.1"]["response"][:2] == [True, False]
    assert chapter.kept()["Q3.2.1"]["points"] == 0
