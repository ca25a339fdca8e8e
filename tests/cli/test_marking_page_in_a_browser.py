"""The page for marking by hand, as a browser and its rules about origins treat it."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser

from autograder.cli.mark_page import MarkServer, make_server
from autograder.gradebook import Gradebook, view_class
from autograder.gradebook.by_hand import Item, open_items
from autograder.intake.class_list import ClassList
from tests.classroom import all_marks, fill, graded, mark
from tests.cli.test_marking_by_hand import with_text

BOOK = "gradebook.db"


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    """Where two answers wait to be marked."""
    course = with_text(tmp_path / "course")
    servers: list[MarkServer] = []
    ready = threading.Event()

    def work() -> None:  # a connection to the gradebook belongs to one thread
        with Gradebook(tmp_path / BOOK) as book:
            text = mark("Q5", 0, 3, status="recorded", understood="It *rests*: $x^2$.")
            fill(book, *(graded(name, *all_marks(), text) for name in ("ada", "boole")))

            def look() -> list[Item]:
                return open_items(view_class(course, book, ClassList()))

            servers.append(make_server(0, False, "tutor", book, look, set()))
            ready.set()
            servers[0].serve_forever()
            servers[0].server_close()

    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    assert ready.wait(30)
    yield servers[0].address
    servers[0].shutdown()
    thread.join(30)


def test_a_verdict_is_sent_and_the_next_answer_comes(
    browser: Browser, address: str, tmp_path: Path
):
    context = browser.new_context(bypass_csp=True)  # axe is a script, which the page refuses
    page = context.new_page()
    page.goto(address)
    violations = Axe().run(page).response["violations"]
    assert [(v["id"], v["nodes"][0]["html"]) for v in violations] == []
    context.close()
    page = browser.new_page()
    said: list[str] = []
    page.on("console", lambda message: said.append(message.text))
    page.goto(address)
    seen = set()
    for _ in range(2):  # in an order that follows no names
        (student,) = (name for name in ("ada", "boole") if name in page.inner_text("header"))
        seen.add(student)
        page.locator("input[name=c0]").first.check()
        page.locator("input[name=c1]").last.check()
        page.fill("textarea", f"Well said, {student}.")
        page.click("button:not(.quiet)")
    page.wait_for_selector("text=Everything is marked")
    assert said == []
    assert seen == {"ada", "boole"}
    page.close()
    with Gradebook(tmp_path / BOOK) as book:
        for student in ("ada", "boole"):
            override = book.record(student).overrides["Q5"]
            assert (override.points, override.author) == (2, "tutor")
            assert override.reason == f"Well said, {student}."
