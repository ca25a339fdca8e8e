"""What comes back when the file of responses is lost, and where widgets are shown."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from autograder import ask, progress
from autograder.student import frontend, live
from autograder.student.receipts import RECEIPT


def save_receipts(course: Path, receipts: dict[str, object]) -> None:
    """Save them in the notebook's outputs, as JupyterLab does."""
    path = course / "notebooks/1_garden.ipynb"
    notebook = json.loads(path.read_text())
    notebook["cells"][0]["outputs"] = [
        {
            "output_type": "display_data",
            "metadata": {},
            "data": {RECEIPT: {"question": id, "response": response}},
        }
        for id, response in receipts.items()
    ]
    path.write_text(json.dumps(notebook))


@pytest.mark.parametrize("lost", ["damaged", "missing"])
def test_answers_come_back_from_the_notebook(
    own_garden: Path, capsys: pytest.CaptureFixture[str], lost: str
):
    save_receipts(
        own_garden,
        {"Q1.1": [False, True], "Q1.2": ["sow", "sow", "eat"], "Q1.3": 12, "Q9": [True]},
    )
    if lost == "damaged":
        (own_garden / "notebooks/responses").mkdir()
        (own_garden / "notebooks/responses/garden.json").write_text("{")
    assert "A fern has flowers. → false" in repr(ask("Q1.1"))
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert f"was {lost}" in said
    assert "2 answers came back" in said  # what fits no question does not
    assert "2 of 5" in repr(progress())
    assert capsys.readouterr().out == ""


def test_a_file_that_is_lost_while_the_kernel_runs_loses_no_other_answer(own_garden: Path):
    ask("Q1.1").respond([False, True])
    save_receipts(own_garden, {"Q1.1": [False, True]})
    (own_garden / "notebooks/responses/garden.json").unlink()
    ask("Q1.2").respond(["sow", "water", "eat"])
    assert "A fern has flowers. → false" in repr(ask("Q1.1"))


def test_whoever_names_a_folder_of_responses_starts_empty(
    own_garden: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    save_receipts(own_garden, {"Q1.1": [False, True]})
    monkeypatch.setenv("AUTOGRADER_RESPONSES", str(tmp_path / "empty"))
    assert "→" not in repr(ask("Q1.1"))


@pytest.mark.parametrize(
    ("environment", "wanted"),
    [
        ({}, False),
        ({"JPY_SESSION_NAME": "3_ransac.ipynb"}, True),
        ({"JPY_SESSION_NAME": "3_ransac.ipynb", "AUTOGRADER_WIDGETS": "0"}, False),
        ({"AUTOGRADER_WIDGETS": "1"}, True),
    ],
)
def test_widgets_are_shown_only_where_somebody_can_click(
    monkeypatch: pytest.MonkeyPatch, environment: dict[str, str], wanted: bool
):
    class Shell:
        kernel = object()
        user_ns = ()

    monkeypatch.setattr(frontend, "running_shell", Shell)
    for name in ("JPY_SESSION_NAME", "AUTOGRADER_WIDGETS"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    assert frontend.widgets_wanted() is wanted


def test_a_widget_has_its_plain_form_beside_it_and_a_receipt_below(
    garden: Path, monkeypatch: pytest.MonkeyPatch
):
    shown: list[dict[str, object]] = []
    monkeypatch.setattr("IPython.display.display", lambda bundle, **options: shown.append(bundle))
    monkeypatch.setenv("AUTOGRADER_WIDGETS", "1")
    asked = ask("Q1.1")
    asked._ipython_display_()
    widget, receipt = shown
    assert {live.WIDGET_VIEW, "text/plain", "text/markdown"} <= widget.keys()
    assert "A fern has flowers." in str(widget["text/markdown"])
    assert "Kept for Q1.1: nothing yet" in str(receipt["text/plain"])
    assert asked.respond([False, True]).mark.status == "right"
