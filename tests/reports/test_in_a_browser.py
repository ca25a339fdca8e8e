"""The HTML reports in a real browser: nothing on the console, no failing accessibility rule."""

from __future__ import annotations

from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser

from autograder.course import Course, load_course
from autograder.gradebook import Override, Record, Run
from autograder.reports.class_html import class_html
from autograder.reports.feedback_html import Feedback, feedback_html
from autograder.reports.pictures import Pictures
from autograder.reports.whole_files import write_text
from tests.classroom import graded, hostile_mark, mark

REPOSITORY = Path(__file__).parents[2]
HOSTILE = '"><script>document.title="owned"</script><img src=x onerror=alert(1)>'


def records(course: Course) -> list[Record]:
    statuses = ("wrong", "error", "timeout", "killed", "unreadable", "not attempted", "recorded")
    made = []
    for number in range(24):
        marks = [
            mark(
                question.id,
                [1, 0.5, 0][(number + place) % 3],
                question.points,
                explanation="Because $\\frac{1}{2} \\alpha$:\n\n1. first\n2. second",
                understood="true, false" if question.kind == "true_false" else "x**2 + 1",
                shown=[2.0, 0.9] if question.kind == "function" else None,
            )
            if number % 4 or place % 3
            else mark(question.id, 0, question.points, status=statuses[(number + place) % 7])
            for place, question in enumerate(course.questions.values())
        ]
        override = Override(f"s{number}", "Q3.1", 2, "oral", "2026-11-20T10:00:00+00:00")
        made.append(
            Record(
                graded(f"student {number}", *marks, seconds=number / 7, notes=("A note.",)),
                1,
                1,
                {"Q3.1": override},
                late_days=1,
                late_percent=10,
            )
        )
    hostile = [hostile_mark(id, HOSTILE, q.points) for id, q in course.questions.items()]
    return [*made, Record(graded(HOSTILE, *hostile, notes=(HOSTILE,)), 1, 1)]


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    course = load_course(REPOSITORY)
    everybody = records(course)
    run = Run(1, "version", 1, "a separate process", "", 12.0)
    shared = Feedback(course, Pictures(course), explanations=True)
    texts = {
        "class": class_html(course, everybody, run),
        "student": feedback_html(shared, everybody[4]),
        "hostile": feedback_html(shared, everybody[-1]),
    }
    folder = tmp_path_factory.mktemp("pages")
    for name, text in texts.items():
        write_text(folder / f"{name}.html", text)
    return {name: folder / f"{name}.html" for name in texts}


@pytest.mark.parametrize("name", ["class", "student", "hostile"])
@pytest.mark.parametrize("width", [390, 1200])
def test_a_page_says_nothing_on_the_console_and_fits_its_screen(
    browser: Browser, pages: dict[str, Path], name: str, width: int
):
    page = browser.new_page(viewport={"width": width, "height": 800})
    said: list[str] = []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("dialog", lambda dialog: said.append("a dialog"))
    page.on("request", lambda request: said.append(request.url))
    page.goto(pages[name].as_uri())
    assert [line for line in said if line != pages[name].as_uri()] == []
    assert page.title() != "owned"
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    page.close()


@pytest.mark.parametrize("name", ["class", "student", "hostile"])
@pytest.mark.parametrize("width", [390, 1200])
def test_no_accessibility_rule_fails(
    browser: Browser, pages: dict[str, Path], name: str, width: int
):
    context = browser.new_context(
        viewport={"width": width, "height": 800},
        bypass_csp=True,  # axe is a script, which the page's own policy refuses
    )
    page = context.new_page()
    page.goto(pages[name].as_uri())
    violations = Axe().run(page).response["violations"]
    assert [(v["id"], v["nodes"][0]["html"]) for v in violations] == []
    context.close()


def test_the_style_is_applied_under_the_policy(browser: Browser, pages: dict[str, Path]):
    page = browser.new_page()
    page.goto(pages["student"].as_uri())
    border = page.evaluate("getComputedStyle(document.querySelector('article')).borderLeftWidth")
    assert float(border.removesuffix("px")) > 3
    page.close()


def test_paper_shows_everything_but_the_links(browser: Browser, pages: dict[str, Path]):
    page = browser.new_page()
    page.emulate_media(media="print")
    page.goto(pages["student"].as_uri())
    assert not page.locator(".index").is_visible()
    assert page.locator("article").first.is_visible()
    assert page.locator(".explained").first.is_visible()
    page.close()
