"""What students predict: kept at the first click, never marked, carried along, counted."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from autograder import predict, predicted, submit
from autograder.authoring.masters import read_masters
from autograder.course import load_course
from autograder.course.predictions import Prediction
from autograder.errors import CourseError, UsageError
from autograder.gradebook import Gradebook, Record
from autograder.grading.graded_submission import Graded
from autograder.grading.submission import predictions_of
from autograder.intake.notebook_reader import Notebook
from autograder.intake.submissions import Contents, Submission, read_submission
from autograder.marking import Mark
from autograder.reports.class_html import class_html
from autograder.reports.class_summary import gather
from autograder.reports.predictions import Predicted, predictions_html
from autograder.student.desk import Desk
from autograder.student.receipts import RECEIPT
from autograder.student.widgets.base import CourseWidget
from autograder.student.widgets.prediction import PredictionWidget

PREDICTIONS = """
[[prediction]]
id = "P1.1"
prompt = "Which grows faster?"
choices = ["a bean", "an oak"]

[[prediction]]
id = "P1.2"
prompt = "How many acorns does an oak drop in a year?"
between = [0, 1_000_000]
integer = true
unit = "acorns"
"""

MARK = Mark("Q2", "right", 1.0, 2.0, "")


@pytest.fixture
def patch(own_orchard: Path) -> Path:
    """The orchard with something to predict; the working folder is that of its notebooks."""
    path = own_orchard / "notebooks/questions/orchard.toml"
    path.write_text(path.read_text() + PREDICTIONS)
    return own_orchard


def kept(root: Path) -> dict[str, Any]:
    entries = json.loads((root / "notebooks/responses/orchard.json").read_text())["responses"]
    return {id: entry["response"] for id, entry in entries.items()}


def test_nothing_waits_for_a_prediction(patch: Path):
    view = predict("P1.2")
    assert "Not predicted" in repr(view)
    assert 'predict("P1.2", NUMBER)' in repr(view)
    assert predicted("P1.2") is None
    assert predicted("P1.1") is None
    assert not (patch / "notebooks/responses").exists()


@pytest.mark.parametrize(
    ("id", "given", "value"),
    [
        ("P1.1", "an oak", "an oak"),
        ("P1.1", 1, "a bean"),
        ("P1.2", 12, 12),
        ("P1.2", 12.0, 12),
        ("P1.2", np.int64(7), 7),
        ("P1.2", 0, 0),
    ],
)
def test_a_prediction_that_is_written_is_kept(patch: Path, id: str, given: object, value: object):
    assert "You predicted" in repr(predict(id, given))
    assert predicted(id) == value
    assert type(predicted(id)) is type(value)
    assert kept(patch) == {id: value}


@pytest.mark.parametrize(
    ("id", "given"),
    [
        ("P1.1", 0),
        ("P1.1", 3),
        ("P1.1", True),
        ("P1.1", "a fern"),
        ("P1.1", ["an oak"]),
        ("P1.2", -1),
        ("P1.2", 1.5),
        ("P1.2", 10**400),
        ("P1.2", math.nan),
        ("P1.2", math.inf),
        ("P1.2", True),
        ("P1.2", "12"),
        ("P1.2", np.zeros(3)),
        ("P1.2", None),
    ],
)
def test_what_cannot_be_predicted_is_refused_in_a_sentence(
    patch: Path, capsys, id: str, given: object
):
    assert predict(id, given) is None
    assert capsys.readouterr().out.startswith(("Choose one of 1 (a bean)", "Give a whole number"))
    assert predicted(id) is None
    with pytest.raises(UsageError):
        load_course().prediction(id).read(given)


def test_the_first_prediction_stands(patch: Path, capsys):
    predict("P1.2", 12)
    predict("P1.2", 12)
    assert capsys.readouterr().out == ""
    predict("P1.2", 5000)
    assert "You predicted 12 acorns before; that stands." in capsys.readouterr().out
    assert predicted("P1.2") == 12


def test_an_id_that_does_not_exist_is_named_with_those_that_do(patch: Path, capsys):
    assert predict("P9") is None
    assert predicted("P9") is None
    assert capsys.readouterr().out.count("There is no prediction 'P9'; this course has P1.1") == 2


def test_a_click_or_a_typed_number_is_kept(patch: Path, monkeypatch: pytest.MonkeyPatch):
    replies: list[dict[str, Any]] = []
    monkeypatch.setattr(CourseWidget, "send", lambda self, reply: replies.append(reply))
    desk = Desk(load_course())
    choice, number = (PredictionWidget(desk, desk.course.prediction(id)) for id in ("P1.1", "P1.2"))
    assert choice.state == {"said": ""}
    choice._receive(choice, {"seq": 1, "do": "choose", "choice": 1}, [])
    number._receive(number, {"seq": 2, "do": "type", "text": "3*4"}, [])
    assert [reply["ok"] for reply in replies] == [True, True]
    assert choice.state == {"said": "an oak"}
    assert number.state == {"said": "12 acorns"}
    assert kept(patch) == {"P1.1": "an oak", "P1.2": 12}
    assert choice.receipt()[RECEIPT] == {"question": "P1.1", "response": "an oak"}  # type: ignore[index]


@pytest.mark.parametrize(
    "message",
    [
        {"do": "choose", "choice": 2},
        {"do": "choose", "choice": "x"},
        {"do": "type", "text": "twelve"},
        {"do": "type", "text": "1/0"},
        {"do": "type", "text": "-1"},
        {"do": "type", "text": "().__class__"},
        {"do": "type"},
    ],
)
def test_a_message_that_makes_no_sense_keeps_nothing(
    patch: Path, monkeypatch: pytest.MonkeyPatch, message: dict[str, Any]
):
    replies: list[dict[str, Any]] = []
    monkeypatch.setattr(CourseWidget, "send", lambda self, reply: replies.append(reply))
    desk = Desk(load_course())
    id = "P1.1" if message["do"] == "choose" else "P1.2"
    widget = PredictionWidget(desk, desk.course.prediction(id))
    widget._receive(widget, {"seq": 1, **message}, [])
    assert replies[-1]["ok"] is False
    assert widget.state == {"said": ""}


def test_a_file_that_was_edited_counts_as_not_predicted(patch: Path):
    predict("P1.2", 12)
    path = patch / "notebooks/responses/orchard.json"
    path.write_text(path.read_text().replace('"response": 12', '"response": {"a": "b"}'))
    assert predicted("P1.2") is None
    predict("P1.2", 13)
    assert predicted("P1.2") == 13


def test_a_lost_file_comes_back_from_the_receipts_of_the_notebook(patch: Path):
    bundle = predict("P1.2", 12)._repr_mimebundle_()
    notebook = patch / "notebooks/3_orchard.ipynb"
    document = json.loads(notebook.read_text())
    document["cells"][0]["outputs"] = [
        {"output_type": "display_data", "data": bundle, "metadata": {}}
    ]
    notebook.write_text(json.dumps(document))
    (patch / "notebooks/responses/orchard.json").unlink()
    desk = Desk(load_course())  # as after a restart of the kernel
    assert "was missing; 1 answer came back" in desk.mend()[0]
    assert desk.prediction(desk.course.prediction("P1.2")) == 12


def test_what_is_handed_in_carries_the_predictions(patch: Path):
    predict("P1.1", 2)
    path = submit().packed.path
    course = load_course()
    contents = read_submission(Submission("ada", path), course.settings)
    assert predictions_of(contents, course) == {"P1.1": "an oak"}


def test_only_what_the_course_asks_for_and_allows_is_taken_from_a_submission(patch: Path):
    entries = {
        "P1.1": {"response": "<script>"},
        "P1.2": {"response": 12},
        "P1.3": {"response": 1},
        "Q2": {"response": 12},
    }
    receipts = {"P1.1": "a bean", "P1.2": 99}
    contents = Contents({"orchard": Notebook([], receipts)}, {"orchard": entries})
    assert predictions_of(contents, load_course()) == {"P1.2": 12}


def test_the_gradebook_keeps_them_and_the_class_page_counts_them(patch: Path, tmp_path: Path):
    course = load_course()
    guesses = [1, 2, 3, 50, 60, 70, 3000, 3100, 999_999, 0]
    with Gradebook(tmp_path / "gradebook.sqlite") as book:
        run = book.begin_run("v", 1)
        for n, guess in enumerate(guesses):
            work = Submission(f"s{n}", Path(f"/s{n}.zip"))
            made: dict[str, Any] = {"P1.2": guess, "P1.1": "an oak" if n else "a fern"}
            book.store(Graded(work, "graded", "f", (MARK,), predictions=made), run)
        found = book.find("s3", "f", run)
        assert found is not None
        assert found.predictions == {"P1.2": 50, "P1.1": "an oak"}
        records = book.records()
    choices, numbers = gather(course, records).predicted
    assert choices.rows() == [("a bean", 0), ("an oak", 9)]  # a fern was never a choice
    assert sum(count for _, count in numbers.rows()) == len(guesses)
    page = class_html(course, records, None)
    assert "What was predicted" in page
    assert "9 of 10 predicted." in page
    for choice, count in choices.rows():
        assert f'<th scope="row">{choice}</th><td class="number">{count}</td>' in page
    assert "9 of 9" in page  # what the bar says to whom it cannot be shown


def test_formulas_in_choices_are_set_and_nothing_is_cut():
    choices = (
        "when $S_{xx} = S_{yy}$",
        "nowhere: it is as wide as that at each place of a wall",
    )
    asked = Prediction(id="P1.9", prompt="When?", choices=choices)
    found = Predicted(asked)
    found.choices.update({choices[0]: 2, choices[1]: 1})
    page = predictions_html([found], 3)
    assert "<math" in page
    assert "$" not in page
    assert choices[1] in page


def test_numbers_far_apart_are_drawn_by_their_magnitude():
    found = Predicted(Prediction(id="P1.9", prompt="How many?", between=(1, 10**6), integer=True))
    found.numbers.extend([12, 50, 100, 100, 400, 10_000])
    names = [name for name, count in found.rows() if count]
    assert names == ["10 to 19", "50 to 99", "100 to 199", "200 to 499", "10,000 to 19,999"]


@pytest.mark.parametrize(
    ("numbers", "rows"),
    [
        ([7], [("7", 1)]),
        ([1, 2, 2, 9], [("1", 1), ("2", 2)] + [(str(n), 0) for n in range(3, 9)] + [("9", 1)]),
        ([1, 5, 999, 1000], {"1": 1, "5 to 9": 1, "500 to 999": 1, "1,000 to 1,999": 1}),
        ([0, 3, 20_000], {"0 to 1": 1, "2 to 4": 1, "20,000 to 49,999": 1}),
    ],
)
def test_numbers_are_counted_in_round_ranges(patch: Path, numbers: list[int], rows: Any):
    course = load_course()
    records = [
        Record(Graded(Submission(str(n), Path()), "graded", "", (), predictions={"P1.2": n}), 1, 1)
        for n in numbers
    ]
    found = [
        (name.removesuffix(" acorns"), n) for name, n in gather(course, records).predicted[1].rows()
    ]
    if isinstance(rows, dict):
        assert {name: n for name, n in found if n} == rows
    else:
        assert found == rows


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ('id = "P1.3"\nprompt = "x"', "say either choices = [...] or between"),
        ('id = "P1.3"\nprompt = "x"\nchoices = ["a"]', "two different choices"),
        ('id = "P1.3"\nprompt = "x"\nchoices = ["a", "a"]', "two different choices"),
        ('id = "P1.3"\nprompt = "x"\nbetween = [2, 1]', "must be below the second"),
        ('id = "P1.3"\nprompt = "x"\nbetween = [2]', "a list of 2"),
        ('id = "P1.1"\nprompt = "x"\nbetween = [1, 2]', "two predictions have this id"),
        ('id = "X1"\nprompt = "x"\nbetween = [1, 2]', "id is 'X1'"),
        ('id = "P1.3"\nprompt = "x"\nbetween = [1, 2]\nanswer = 1', "unknown field 'answer'"),
    ],
)
def test_a_table_that_cannot_be_asked_is_refused(patch: Path, table: str, said: str):
    path = patch / "notebooks/questions/orchard.toml"
    path.write_text(path.read_text() + f"\n[[prediction]]\n{table}\n")
    with pytest.raises(CourseError, match=said.replace("[", r"\[").replace(".", r"\.")):
        load_course()


def test_each_prediction_is_asked_for_in_one_cell_of_its_chapter(patch: Path):
    asked = [f'# %% exercise="Q{n}"' for n in range(1, 6)]
    cells = [*asked, '# %%\npredict("P1.1")', '# %%\npredict("P1.2")']
    master = patch / "notebooks/source/3_orchard.py"
    master.write_text("\n\n".join(cells))
    assert [one.predictions for one in read_masters(load_course())] == [["P1.1", "P1.2"]]
    for text, said in (
        ("\n\n".join(cells[:-1]), "P1.2 is asked for 0 times"),
        ("\n\n".join([*cells, cells[-1]]), "P1.2 is asked for 2 times"),
        ("\n\n".join([*cells, '# %%\npredict("P7")']), "asks for the prediction 'P7'"),
    ):
        master.write_text(text)
        with pytest.raises(CourseError, match=said):
            read_masters(load_course())
