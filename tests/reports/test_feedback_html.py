"""What a student reads: the verdicts, and nothing that is not for students."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from autograder.course import Course, load_course
from autograder.gradebook import Override, Record
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.reports.feedback_html import Feedback, feedback_html
from autograder.reports.pictures import Pictures, draw
from tests.classroom import all_marks, graded, hostile_mark, mark

REPOSITORY = Path(__file__).parents[2]


def page_of(course: Course, *marks: Mark, explanations: bool = False, **fields: object) -> str:
    record = Record(graded("ada", *marks), run=1, seed=1, **fields)  # type: ignore[arg-type]
    return feedback_html(Feedback(course, Pictures(course), explanations), record)


def words(page: str) -> str:
    return " ".join(re.sub(r"<[^>]+>", " ", page).split())


def test_the_total_and_every_question_are_there(course: Course):
    said = words(page_of(course, *all_marks((1, 0.25, 0.5, 0))))
    assert "3.5 of 10 points" in said
    for line in ("Q1 · Trees 2 of 2", "Q2 · The rows 0.5 of 2", "Q3 · The hedge 1 of 2"):
        assert line in said


def test_what_was_understood_is_shown_as_it_is(course: Course):
    page = page_of(course, mark("Q2", 0, understood="7 * <b>"))
    assert "7 * &lt;b&gt;" in page


def test_explanations_are_shown_only_where_they_are_allowed(course: Course):
    marked = mark("Q2", 0, explanation="Rows multiply.")
    assert "Rows multiply" not in page_of(course, marked)
    assert "Rows multiply" in page_of(course, marked, explanations=True)


def test_an_override_says_what_and_why(course: Course):
    override = Override("ada", "Q2", 1.5, "drew <it>", "2026-11-20T10:00:00+00:00")
    said = words(page_of(course, mark("Q2", 0), overrides={"Q2": override}))
    assert "Marked by hand: 1.5 points. drew &lt;it&gt; The grader gave 0." in said
    assert "1.5 of 10 points" in said


def test_lateness_is_explained(course: Course):
    said = words(page_of(course, *all_marks(), late_days=2, late_percent=20.0))
    assert "2 days late: 20 % of the 10 points earned, that is 2, are taken off" in said
    assert "8 of 10 points" in said


def test_a_question_that_was_never_marked_is_said(course: Course):
    assert "This question was not marked" in page_of(course, mark("Q1", 1))


@pytest.mark.parametrize(
    "hostile",
    [
        "<script>alert(1)</script>",
        '"><img src=x onerror=alert(1)>',
        "[click](javascript:alert(1))",
        "![x](https://example.org/spy.png)",
        "</style><script>alert(1)</script>",
        "<svg/onload=alert(1)>",
        "\x1b[31m\x00\x07 \ud800 \u202e",
        "$\\href{javascript:alert(1)}{x}$ $\\unknown{$",
    ],
)
def test_hostile_text_anywhere_is_shown_and_does_nothing(course: Course, hostile: str):
    record = Record(
        graded(hostile, *(hostile_mark(f"Q{n}", hostile) for n in range(1, 5)), notes=(hostile,)),
        run=1,
        seed=1,
        overrides={"Q2": Override(hostile, "Q2", 1, hostile, hostile)},
    )
    page = feedback_html(Feedback(course, Pictures(course), True), record)
    tags = Tags()
    tags.feed(page)
    assert tags.names.isdisjoint({"script", "img", "iframe", "object", "embed", "link", "base"})
    assert not [name for name, _ in tags.attributes if name.startswith("on") or name == "style"]
    assert all(
        value.startswith(("#", "https://"))
        for name, value in tags.attributes
        if name in ("href", "src", "action")
    )
    assert page.count("<style>") == page.count("</style>") == 1
    assert not any(c in page for c in "\x1b\x00\x07\u202e\ud800")


class Tags(HTMLParser):
    """Collects what a browser would act on."""

    def __init__(self) -> None:
        super().__init__()
        self.names: set[str] = set()
        self.attributes: list[tuple[str, str]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names.add(tag)
        self.attributes += [(name, value or "") for name, value in attrs]


def test_the_policy_allows_this_style_and_nothing_else(course: Course):
    page = page_of(course)
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', page)
    assert policy
    assert "default-src 'none'" in policy[1]
    assert "unsafe" not in policy[1]
    assert "script-src" not in policy[1]
    assert " style=" not in page


def test_the_fitted_line_is_drawn_for_the_public_points_and_no_others():
    course = load_course(REPOSITORY)
    marker = Marker(course, 3)
    cases = marker.drawn("Q2.3").expected.cases
    assert cases[0]["public"]
    outcomes = [{"value": np.array([2.5, 0.9])} for _ in cases]
    marked = marker.mark("Q2.3", {"state": "given", "outcomes": outcomes})
    assert marked.shown == [2.5, 0.9]
    drawn = Pictures(course).html("Q2.3", Mark.from_dict(marked.to_dict()), 3)
    assert drawn.count("<circle") == len(cases[0]["args"][0]) == 3
    assert drawn.count("<polyline") >= 2
    assert "r = 2.5 m and alpha = 0.9 rad" in drawn


def test_every_picture_of_the_key_draws_the_reference():
    course = load_course(REPOSITORY)
    marker = Marker(course, 3)
    named = [id for id, answer in course.key.items() if getattr(answer, "picture", None)]
    assert {"Q2.3", "Q3.4"} <= set(named)
    for id in named:
        outcomes = marker.drawn(id).expected.outcomes
        marked = marker.mark(id, {"state": "given", "outcomes": list(outcomes)})
        drawn = Pictures(course).html(id, Mark.from_dict(marked.to_dict()), 3)
        assert "your line" in drawn


@pytest.mark.parametrize("value", [None, "text", [1.0], [float("nan"), 1], [1e300, 0], {"a": 1}])
def test_what_is_no_line_is_not_drawn(value: object):
    course = load_course(REPOSITORY)
    marked = mark("Q2.3", 0, 4, shown=value)
    assert Pictures(course).html("Q2.3", marked, 3) == ""


def test_only_a_value_for_the_very_first_case_can_be_shown(course: Course):
    """A function that has met hidden inputs could carry them out in a later value."""
    from autograder.kinds.function.drawn_outcomes import shown_outcome

    hidden_first = [{"name": "a", "args": []}, {"name": "b", "args": [], "public": True}]
    assert shown_outcome(hidden_first, [{"value": 1.0}, {"value": 2.0}]) is None
    assert shown_outcome(hidden_first[::-1], [{"value": 2.0}, {"value": 1.0}]) == 2.0
    assert shown_outcome(hidden_first[::-1], [{"value": "carried out"}, {}]) is None
    assert shown_outcome(hidden_first[::-1], [{"value": np.zeros(5000)}, {}]) is None
    assert shown_outcome(hidden_first[::-1], [{"raised": "ValueError"}, {}]) is None


def test_a_picture_has_words_for_those_who_cannot_see_it():
    xy = [[0, 0], [1, 1]]
    drawn = draw(
        {
            "title": "A <line>",
            "alt": "It rises.",
            "x_label": "x",
            "y_label": "y",
            "layers": [{"kind": "line", "xy": xy, "label": "your line"}],
        }
    )
    assert "<desc" in drawn
    assert "It rises." in drawn
    assert "A &lt;line&gt;" in drawn
