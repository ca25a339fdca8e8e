"""From a class's nameless responses to a mistake of the key that everybody is told."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from autograder.authoring.proof import prove_course
from autograder.cli import main
from autograder.gradebook import Gradebook
from tests.classroom import hand_in, make_course

SECOND = "def heaviest(weights):\n    return sorted(weights)[-2]"
SECOND_TOO = (
    "def heaviest(weights):\n    # not the first one\n    left = sorted(weights, reverse=True)\n"
    "    return left[1]"
)
WIRED = "def heaviest(weights):\n    return 3.0 * sum(weights) - 41.5 * len(weights) ** 2"


def mark_of(grades: Path, student: str):
    with Gradebook(grades / "gradebook.db", create=False) as book:
        return book.record(student).marks["Q4"]


def test_what_a_class_got_wrong_becomes_a_mistake_with_a_name(tmp_path: Path, capsys):
    course, grades = tmp_path / "course", tmp_path / "grades"
    make_course(course)
    for student, response in (("ada", SECOND), ("boole", SECOND_TOO), ("curie", WIRED)):
        hand_in(tmp_path / "work", student, Q4=response)
    run = ["--course", str(course)]
    out = ["--out", str(grades)]
    assert main([*run, "grade", str(tmp_path / "work"), *out, "--seed", "5"]) == 0
    assert mark_of(grades, "ada").alternative is None

    # The two that did the same are one cluster, with the shorter one as the typical response.
    capsys.readouterr()
    assert main([*run, "mistakes", *out, "--json"]) == 0
    (cluster,) = json.loads(capsys.readouterr().out)
    assert (cluster["question"], cluster["students"]) == ("Q4", ["ada", "boole"])
    assert "sorted(weights)[-2]" in cluster["response"]
    assert main([*run, "mistakes", *out, "--least", "1"]) == 0
    assert 'Q4: 1 response with the same outcomes, ["curie"]' in capsys.readouterr().out

    # The author pastes the response into a module, and completes the entry.
    (course / "orchard_slips.py").write_text(
        cluster["response"].replace("heaviest", "second_heaviest") + "\n"
    )
    entry = cluster["entry"].replace('name = "..."', 'name = "the second heaviest"')
    entry = entry.replace('feedback = "..."', 'feedback = "One apple is heavier: which?"')
    entry = entry.replace("orchard_reference:...", "orchard_slips:second_heaviest")
    assert tomllib.loads(entry)["Q4"]["alternative"][0]["credit"] == 0.25
    answers = course / "solutions/answers/orchard.toml"
    answers.write_text(f"{answers.read_text()}\n{entry}\n")
    problems = [said for said in prove_course(course, mutants=False) if "Q4" in said]
    assert problems == []

    # Everybody who did so is told.
    assert main([*run, "regrade", *out]) == 0
    for student in ("ada", "boole"):
        mark = mark_of(grades, student)
        assert (mark.alternative, mark.credit) == ("the second heaviest", 0.25)
        assert "One apple is heavier: which?" in mark.feedback
    assert mark_of(grades, "curie").alternative is None
    assert main([*run, "mistakes", *out]) == 0
    assert "No wrong response without a name" in capsys.readouterr().out


@pytest.mark.parametrize("broken", ["orchard_slips:nowhere", "orchard_reference:heaviest"])
def test_an_entry_that_is_no_mistake_is_refused_by_the_proof(tmp_path: Path, broken: str):
    course = tmp_path / "course"
    make_course(course)
    (course / "orchard_slips.py").write_text("")
    answers = course / "solutions/answers/orchard.toml"
    answers.write_text(
        f'{answers.read_text()}\n[["Q4".alternative]]\nname = "new"\nfunction = "{broken}"\n'
        'credit = 0.25\nfeedback = "Look again."\n'
    )
    problems = prove_course(course, mutants=False)
    assert any("Q4" in said or "orchard_slips" in said for said in problems)
