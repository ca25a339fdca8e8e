"""What comes back when the file of responses is lost, and where widgets are shown."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from autograder import ask, progress
from autograder.student import frontend, live_view
from autograder.student.receipts import RECEIPT


def save_receipts(course: Path, receipts: dict[str, object]) -> None:
    """Save them in the notebook's outputs, as JupyterLab does."""
    path = course / "notebooks/3_orchard.ipynb"
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
    own_orchard: Path, capsys: pytest.CaptureFixture[str], lost: str
):
    save_receipts(
        own_orchard,
        {"Q1": [False, True], "Q5": ["sow", "sow", "eat"], "Q2": 12, "Q9": [True]},
    )
    if lost == "damaged":
        (own_orchard / "notebooks/responses").mkdir()
        (own_orchard / "notebooks/responses/orchard.json").write_text("{")
    assert "An apple tree has cones. → false" in repr(ask("Q1"))
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert f"was {lost}" in said
    assert "2 answers came back" in said  # what fits no question does not
    assert "2 of 5" in repr(progress())
    assert capsys.readouterr().out == ""


def test_a_file_that_is_lost_while_the_kernel_runs_loses_no_other_answer(own_orchard: Path):
    ask("Q1").respond([False, True])
    save_receipts(own_orchard, {"Q1": [False, True]})
    (own_orchard / "notebooks/responses/orchard.json").unlink()
    ask("Q5").respond(["sow", "water", "eat"])
    assert "An apple tree has cones. → false" in repr(ask("Q1"))


def test_whoever_names_a_folder_of_responses_starts_empty(
    own_orchard: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    save_receipts(own_orchard, {"Q1": [False, True]})
    monkeypatch.setenv("AUTOGRADER_RESPONSES", str(tmp_path / "empty"))
    assert "→" not in repr(ask("Q1"))


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
    orchard: Path, monkeypatch: pytest.MonkeyPatch
):
    shown: list[dict[str, object]] = []
    monkeypatch.setattr("IPython.display.display", lambda bundle, **options: shown.append(bundle))
    monkeypatch.setenv("AUTOGRADER_WIDGETS", "1")
    asked = ask("Q1")
    asked._ipython_display_()
    widget, receipt = shown
    assert {live_view.WIDGET_VIEW, "text/plain", "text/markdown"} <= widget.keys()
    assert "An apple tree has cones." in str(widget["text/markdown"])
    assert "Kept for Q1: nothing yet" in str(receipt["text/plain"])
    assert asked.respond([False, True]).mark.status == "right"
