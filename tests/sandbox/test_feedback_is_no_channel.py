"""Little that a response does with hidden inputs can be seen on the page of feedback."""

import json
import math
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.course import load_course
from autograder.language import use
from autograder.marking.draw import set_number
from autograder.marking.marker import Marker
from autograder.questions.registry import kind_of
from tests.classroom import hand_in, make_course
from tests.toy import Toy

# What a function could do to say something about a hidden input, on every kind of input alike.
SIGNALS = [
    *({"raised": name} for name in ("ValueError", "TypeError", "KeyError", "OSError", "EOFError")),
    *({"unusable": reason} for reason in ("text", "not finite", "too large", "not plain")),
    {"value": -1.0, "changed": True},
    {"value": -1.0},
    {"value": -2.0},
    {"value": [[]]},
    {"value": 10**300},
]


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory):
    return make_course(tmp_path_factory.mktemp("orchard") / "course")


def pages(course, choose) -> set[tuple[object, ...]]:
    """What pages say for some outcomes of each signal, beyond what was right and wrong."""
    marker = Marker(course, 3, tells=False)
    count = len(marker.drawn("Q4").probe["cases"])
    seen = set()
    for signal in SIGNALS:
        response = {"state": "given", "outcomes": [choose(i, signal) for i in range(count)]}
        mark = kind_of(course.question("Q4")).mark(
            course.question("Q4"), course.key["Q4"], marker.drawn("Q4"), response
        )
        assert not any(part.right for part in mark.parts)
        seen.add((mark.status, mark.feedback, mark.parts, mark.alternative, str(mark.shown)))
    return seen


def test_what_happens_on_one_hidden_input_is_worth_at_most_a_bit(course):
    wrong = {"value": -3.0}
    seen = pages(course, lambda i, signal: signal if i == 1 else wrong)
    assert math.log2(len(seen)) <= 1


def test_what_happens_on_every_input_names_no_exception(course):
    seen = pages(course, lambda i, signal: signal)
    assert math.log2(len(seen)) < 2
    assert not any(name in str(seen) for name in ("ValueError", "KeyError", "string"))


def test_the_page_tells_what_the_example_that_students_see_raises(tmp_path, course):
    hand_in(tmp_path / "work", "ada", Q4="def heaviest(w):\n    raise KeyError('my words')")
    hand_in(tmp_path / "work", "bob", Q4="def heaviest(w):\n    return object()")
    grade(tmp_path, course.root)
    assert "KeyError" in (tmp_path / "out/feedback/ada.html").read_text()
    assert "my words" in (tmp_path / "out/feedback/ada.html").read_text()
    assert "On the example that you can see" in (tmp_path / "out/feedback/bob.html").read_text()


def test_the_example_is_asked_whatever_language_the_course_speaks(tmp_path):
    root = make_course(tmp_path / "course").root
    Toy(root).set('language = "de"')
    hand_in(tmp_path / "work", "bob", Q4="def heaviest(w):\n    return object()")
    try:
        grade(tmp_path, root)
    finally:
        use("")
    page = (tmp_path / "out/feedback/bob.html").read_text(encoding="utf-8")
    assert "Bei dem Beispiel, das Sie sehen können: es wurde etwas zurückgegeben" in page


def grade(folder: Path, root: Path, *options: str) -> None:
    arguments = ["grade", str(folder / "work"), "--out", str(folder / "out"), *options]
    assert main(["--course", str(root), *arguments]) == 0


def seen_inputs(monkeypatch, folder: Path, root: Path, *options: str) -> dict[str, str]:
    """With what hidden inputs each student was marked in a run."""
    from autograder.grading import threads

    found: dict[str, str] = {}
    real = threads.grade_submission

    def spy(submission, contents, marker, *others):
        found[submission.student] = json.dumps(marker.drawn("Q4").probe["cases"])
        return real(submission, contents, marker, *others)

    monkeypatch.setattr(threads, "grade_submission", spy)
    grade(folder, root, *options)
    monkeypatch.setattr(threads, "grade_submission", real)
    return found


def marks(out: Path) -> list[tuple[str, str]]:
    with closing(sqlite3.connect(out / "gradebook.db")) as db:
        return sorted(db.execute("SELECT student, mark FROM mark"))


def test_other_work_meets_other_inputs_and_the_same_work_the_same(tmp_path, course, monkeypatch):
    hand_in(tmp_path / "work", "ada")
    hand_in(tmp_path / "work", "bob", Q2="trees = 7")
    first = seen_inputs(monkeypatch, tmp_path, course.root)
    assert first["ada"] == first["bob"]
    before = marks(tmp_path / "out")
    again = seen_inputs(monkeypatch, tmp_path, course.root, "--regrade")
    assert again == first
    assert marks(tmp_path / "out") == before

    hand_in(tmp_path / "work", "bob", Q2="trees = 8")
    second = seen_inputs(monkeypatch, tmp_path, course.root)
    assert set(second) == {"bob"}
    assert second["bob"] != first["bob"]
    assert seen_inputs(monkeypatch, tmp_path, course.root, "--regrade") == {
        "ada": first["ada"],
        "bob": second["bob"],
    }

    hand_in(tmp_path / "work", "bob", Q2="trees = 7")  # the first work comes back
    third = seen_inputs(monkeypatch, tmp_path, course.root)
    assert third["bob"] == first["bob"]
    assert seen_inputs(monkeypatch, tmp_path, course.root, "--regrade")["bob"] == first["bob"]
    assert marks(tmp_path / "out") == before


def test_no_set_of_inputs_comes_back_for_other_work_of_a_student():
    works: list[str] = []
    met = []
    for attempt in range(6):
        met.append(set_number("ada", f"work {attempt}", works))
        works.append(f"work {attempt}")
    assert met[0] == 0
    assert len(set(met)) == len(met)
    assert [set_number("ada", work, works) for work in works] == met


def test_another_set_asks_for_the_same_kinds_of_input(course):
    marker = Marker(load_course(course.root), 3)
    names = [
        [case["name"] for case in marker.with_set(number).drawn("Q4").expected.cases]
        for number in (0, 1, 5)
    ]
    assert names[0] == names[1] == names[2]
    assert marker.with_set(0) is marker
    assert marker.with_set(1) is marker.with_set(1)
