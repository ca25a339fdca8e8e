"""The widgets' Python side: messages as a browser sends them, answers as it gets them."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
import sympy as sp

from autograder import check, language
from autograder.course import load_course
from autograder.questions.registry import kind_of
from autograder.student.desk import Desk
from autograder.student.receipts import RECEIPT
from autograder.student.responses import Responses
from autograder.student.widgets.progress import ProgressWidget
from autograder.student.widgets.submission import SubmissionWidget


@pytest.fixture
def desk(orchard: Path) -> Desk:
    return Desk(load_course())


def show(desk: Desk, id: str) -> Any:
    question = desk.course.question(id)
    return kind_of(question).widget(desk, question)


def say(widget: Any, do: str, **message: Any) -> None:
    """A message as the browser sends it."""
    widget._receive(widget, {"seq": 1, "do": do, **message}, [])


def test_a_choice_is_kept_before_the_browser_hears_that_it_is(desk: Desk, orchard: Path, sent):
    widget = show(desk, "Q1")
    say(widget, "choose", statement=1, said=True)
    assert Responses(orchard, "orchard").get("Q1")["response"] == [None, True]
    assert widget.state["response"] == [None, True]
    assert sent == [{"seq": 1, "ok": True, "said": ""}]


def test_a_choice_does_not_undo_what_another_kernel_kept(desk: Desk, orchard: Path, sent):
    first, second = show(desk, "Q1"), show(Desk(load_course()), "Q1")
    say(first, "choose", statement=0, said=False)
    say(second, "choose", statement=1, said=True)
    assert Responses(orchard, "orchard").get("Q1")["response"] == [False, True]


def test_an_answer_that_cannot_be_saved_is_taken_back_and_said(desk: Desk, orchard: Path, sent):
    widget = show(desk, "Q1")
    say(widget, "choose", statement=0, said=False)
    (orchard / "orchard.json").rename(orchard.parent / "aside.json")
    for left in orchard.iterdir():
        left.unlink()
    orchard.rmdir()
    orchard.write_text("in the way", encoding="utf-8")
    say(widget, "choose", statement=0, said=True)
    assert sent[-1]["ok"] is False
    assert "NOT saved" in sent[-1]["said"]
    assert widget.state["response"] is None
    assert "NOT saved" in show(desk, "Q1").state["refusal"]


@pytest.mark.parametrize(
    "message",
    [
        {"do": "choose"},
        {"do": "choose", "statement": 7, "said": True},
        {"do": "choose", "statement": -1, "said": True},
        {"do": "choose", "statement": 0, "said": "yes"},
        {"do": "nonsense"},
        {"do": "order", "cards": ["sow"]},
        {},
    ],
)
def test_a_message_that_makes_no_sense_changes_nothing(
    desk: Desk, orchard: Path, sent, message: dict[str, Any]
):
    widget = show(desk, "Q1")
    widget._receive(widget, {"seq": 4, **message}, [])
    assert (sent[-1]["seq"], sent[-1]["ok"]) == (4, False)
    assert not (orchard / "orchard.json").exists()


def test_a_mark_stands_as_long_as_the_response_it_judges(desk: Desk, sent):
    widget = show(desk, "Q1")
    say(widget, "choose", statement=0, said=True)
    say(widget, "choose", statement=1, said=True)
    say(widget, "check")
    mark = widget.state["mark"]
    assert (mark["status"], mark["points"]) == ("partial", "1 of 2 points")
    assert [part["right"] for part in mark["parts"]] == [False, True]
    assert "look for needles" in mark["parts"][0]["feedback"]
    assert widget.state["attempts"] == "1 attempt"
    say(widget, "choose", statement=0, said=False)
    assert widget.state["mark"] is None


def test_a_kernel_that_is_started_again_shows_the_mark_without_counting_it(desk: Desk, sent):
    widget = show(desk, "Q1")
    say(widget, "choose", statement=0, said=False)
    say(widget, "check")
    again = show(Desk(load_course()), "Q1")
    assert again.state["mark"] == widget.state["mark"]
    assert again.state["attempts"] == "1 attempt"


def test_a_changed_answer_is_no_longer_marked_in_the_file(desk: Desk, orchard: Path, sent):
    widget = show(desk, "Q5")
    say(widget, "order", cards=["sow", "water", "eat"])
    say(widget, "check")
    assert Responses(orchard, "orchard").get("Q5")["points"] == 3
    say(widget, "order", cards=["water", "sow", "eat"])
    entry = Responses(orchard, "orchard").get("Q5")
    assert (entry["status"], entry["points"], entry["attempts"]) == ("recorded", 0, 1)
    say(widget, "order", cards=["eat", "sow", "water"])  # as they were dealt
    assert Responses(orchard, "orchard").get("Q5")["status"] == "not attempted"


def test_the_card_to_move_is_named(desk: Desk, sent):
    widget = show(desk, "Q5")
    say(widget, "order", cards=["water", "eat", "sow"])
    say(widget, "check")
    assert [part["right"] for part in widget.state["mark"]["parts"]] == [True, True, False]


def test_the_browser_gets_the_sentences_of_the_language_that_is_spoken(desk: Desk):
    assert show(desk, "Q5").get_state()["translated"] == {}
    language.use("de")
    try:
        translated = show(desk, "Q5").get_state()["translated"]
    finally:
        language.use("")
    assert translated["Check"] == "Prüfen"
    assert translated["out of place"] == "am falschen Platz"
    assert "Predict" not in translated  # it is no sentence of this widget


def test_hints_are_opened_one_by_one_and_are_no_answer(desk: Desk, orchard: Path, sent):
    widget = show(desk, "Q1")
    for count in (1, 2, 2):
        say(widget, "hint")
        assert widget.state["hints"] == count
    assert show(Desk(load_course()), "Q1").state["hints"] == 2
    progress = ProgressWidget(desk)
    assert progress.state["chapters"][0]["answered"] == 0


def test_progress_and_other_widgets_of_the_question_follow(desk: Desk, sent):
    progress = ProgressWidget(desk)
    first, second = show(desk, "Q1"), show(desk, "Q1")
    say(first, "choose", statement=0, said=False)
    say(first, "check")
    assert second.state["response"] == [False, None]
    chapter = progress.state["chapters"][0]
    assert (chapter["answered"], chapter["questions"], chapter["points"]) == (1, 5, "1")
    second.close()
    say(first, "choose", statement=0, said=True)
    assert second.state["response"] == [False, None]


def test_the_receipt_is_readable_and_can_be_taken_in_again(desk: Desk, sent):
    widget = show(desk, "Q1")
    assert RECEIPT not in widget.receipt()
    say(widget, "choose", statement=0, said=False)
    receipt = widget.receipt()
    assert json.loads(json.dumps(receipt[RECEIPT])) == {
        "question": "Q1",
        "response": [False, None],
    }
    assert receipt["text/plain"].startswith("Kept for Q1: 1 false · 2 open")


def test_a_typed_number_is_understood_kept_and_marked(desk: Desk, orchard: Path, sent):
    widget = show(desk, "Q2")
    say(widget, "type", text="3 * 4")
    assert "12" in widget.state["understood"]
    assert widget.state["understood"].endswith(" trees")
    assert Responses(orchard, "orchard").get("Q2")["response"] == 12
    say(widget, "check", text="3 * 4")
    assert widget.state["mark"]["status"] == "right"


def test_what_is_not_understood_leaves_the_answer_as_it_was(desk: Desk, orchard: Path, sent):
    widget = show(desk, "Q2")
    say(widget, "type", text="12")
    say(widget, "type", text="12 +")
    assert sent[-1]["ok"] is False
    assert Responses(orchard, "orchard").get("Q2")["response"] == 12


def test_a_typed_formula_is_typeset(desk: Desk, sent):
    widget = show(desk, "Q3")
    say(widget, "check", text="2*w + 2*l")
    assert "<math" in widget.state["understood"]
    assert widget.state["mark"]["status"] == "right"
    again = show(Desk(load_course()), "Q3")
    assert again.state["mark"]["status"] == "right"
    assert again.state["response"] == "2*w + 2*l"


def test_a_value_of_the_notebook_is_shown_without_a_field(desk: Desk, sent):
    question = desk.course.question("Q3")
    w, length = sp.symbols("w l")
    mark = desk.mark_value(question, w + length)
    widget = kind_of(question).widget(desk, question, w + length, mark)
    assert widget.fixed["field"] is False
    assert "<math" in widget.state["understood"]
    assert widget.state["mark"]["status"] == "partial"


def test_a_value_of_the_notebook_takes_the_place_of_a_typed_one(desk: Desk, orchard: Path, sent):
    say(show(desk, "Q2"), "check", text="7")
    desk.mark_value(desk.course.question("Q2"), 12)
    entry = Responses(orchard, "orchard").get("Q2")
    assert (entry["response"], entry["points"]) == (None, 2)


def test_a_function_has_no_field(desk: Desk, sent):
    question = desk.course.question("Q4")
    widget = kind_of(question).widget(desk, question, max, desk.mark_value(question, max))
    assert widget.fixed["field"] is False
    assert widget.state["mark"]["status"] == "right"


def test_a_broken_key_does_not_lose_the_answer(own_orchard: Path, sent):
    (own_orchard / "solutions/answers/orchard.toml").write_text("[")
    desk = Desk(load_course())
    widget = show(desk, "Q1")
    say(widget, "choose", statement=0, said=False)
    assert sent[-1]["ok"] is True
    say(widget, "check")
    assert sent[-1]["ok"] is False
    entry = Responses(own_orchard / "notebooks/responses", "orchard").get("Q1")
    assert entry["response"] == [False, None]


def test_without_a_key_there_is_nothing_to_check_and_answers_are_kept(bundle: Path, sent):
    widget = show(Desk(load_course()), "Q1")
    assert widget.fixed["marks"] is False
    say(widget, "choose", statement=0, said=False)
    assert sent[-1]["ok"] is True
    entry = Responses(bundle / "notebooks/responses", "orchard").get("Q1")
    assert (entry["status"], entry["response"]) == ("recorded", [False, None])


def test_the_panel_lists_what_is_open_and_packs_again(own_orchard: Path, sent):
    from autograder.student.submit import pack_and_say

    desk = Desk(load_course())
    panel = SubmissionWidget(desk, pack_and_say(desk, None), lambda: pack_and_say(desk, None))
    questions = panel.state["chapters"][0]["questions"]
    assert [entry["answered"] for entry in questions] == [False] * 5
    assert panel.state["path"] == str(own_orchard / "notebooks/submission.zip")
    say(show(desk, "Q1"), "choose", statement=0, said=False)
    assert panel.state["stale"] is True
    assert panel.state["chapters"][0]["questions"][0]["answered"] is True
    say(panel, "pack")
    assert panel.state["stale"] is False
    assert "responses/orchard.json" in panel.state["names"]


def test_prompts_with_formulas_become_mathml_and_html_in_them_stays_text(desk: Desk):
    from autograder.reports.markdown import formula, markdown

    assert "<math" in show(desk, "Q1").fixed["prompt"]
    assert "<script>" not in markdown("<script>alert(1)</script>")
    assert formula(r"\nonsense{") == r"<code>\nonsense{</code>"


def test_widgets_and_pages_of_feedback_read_markdown_in_the_same_way(desk: Desk):
    """Prices are no formulas, pictures are not loaded, and a formula is no link."""
    from msgspec.structs import replace

    from autograder.reports.markdown import markdown

    picture, link = "![x](http://a.example/p.png)", r"$\href{http://a.example}{x}$"
    prompt = f"Is $5 more than $6?\n\n{picture}\n\n{link}\n\n$x^2$"
    question = replace(desk.course.question("Q1"), prompt=prompt)
    shown = kind_of(question).widget(desk, question).fixed["prompt"]
    assert shown == markdown(prompt)
    assert "Is $5 more than $6?" in shown
    assert "<img" not in shown
    assert r"\href" in shown  # as it is written
    assert shown.count("<math") == 1


@pytest.mark.parametrize(("id", "text"), [("Q2", "3 * 4"), ("Q3", "2*w + 2*l")])
def test_checking_the_variable_that_a_field_has_filled_keeps_what_was_typed(
    desk: Desk, orchard: Path, id: str, text: str
):
    question: Any = desk.course.question(id)
    desk.keep_typed(question, text)
    kept = Responses(orchard, "orchard").get(id)["response"]
    check(id, desk.typed(question))  # as when the cell is run again
    assert Responses(orchard, "orchard").get(id)["response"] == kept
    check(id, 13)  # the notebook's own value counts from now on
    assert Responses(orchard, "orchard").get(id)["response"] is None


def test_a_check_button_stands_where_something_can_be_marked(bundle: Path):
    desk = Desk(load_course())
    assert not show(desk, "Q1").fixed["marks"]
    assert not ProgressWidget(desk).state["chapters"][0]["marks"]
    (bundle / "notebooks/snapshots").mkdir()
    snapshot = {"Q3": {"points": {"w": [1.0]}, "accepted": [], "checked": True}}
    (bundle / "notebooks/snapshots/orchard.json").write_text(json.dumps(snapshot))
    desk = Desk(load_course())
    assert show(desk, "Q3").fixed["marks"]
    assert not show(desk, "Q2").fixed["marks"]
    assert not ProgressWidget(desk).state["chapters"][0]["marks"]


def test_a_chapter_for_practice_has_check_buttons(bundle: Path, orchard_template: Path):
    shutil.copytree(orchard_template, bundle / "practice")
    (bundle / "notebooks/snapshots").mkdir()
    desk = Desk(load_course())
    assert all(show(desk, id).fixed["marks"] for id in desk.course.questions)
    assert ProgressWidget(desk).state["chapters"][0]["marks"]
