"""What is decided after the exam, with points that were added up by hand."""

from __future__ import annotations

from dataclasses import replace

import pytest

from autograder.course import Course
from autograder.errors import CourseError
from autograder.gradebook import Attempt, Override, Record
from autograder.gradebook.read_grading_toml import read_scheme
from tests.classroom import all_marks, graded
from tests.toy import make_toy


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Course:
    # The kitchen: Q1.1 3, Q1.2 5, Q1.3 2, Q1.4 4, Q1.5 4 points; the cellar: Q2.1 1 point.
    return make_toy(tmp_path_factory.mktemp("toy")).load()


def record(course: Course, student: str = "ada", **credits: float) -> Record:
    from tests.classroom import mark

    marks = [
        mark(q.id, credits.get(q.id.replace(".", "_"), 0.0), q.points)
        for q in course.questions.values()
    ]
    return Record(graded(student, *marks), 1, 1)


def under(course: Course, text: str, entry: Record) -> Record:
    return replace(entry, scheme=read_scheme(text, course, [entry], "grading.toml"))


HALF = {"Q1_1": 1.0, "Q1_2": 0.5, "Q1_3": 1.0, "Q1_4": 0.0, "Q1_5": 0.25, "Q2_1": 1.0}
# 3 + 2.5 + 2 + 0 + 1 + 1 = 9.5 of 19


@pytest.mark.parametrize(
    ("text", "earned", "most"),
    [
        ("", 9.5, 19),
        ('dropped = ["Q1.4"]', 9.5, 15),
        ('dropped = ["Q1.1"]', 6.5, 16),
        ('given = ["Q1.4"]', 13.5, 19),
        ('given = ["Q1.1"]', 9.5, 19),
        ('bonus = ["Q1.1"]', 9.5, 16),
        ('bonus = ["Q1.4"]\ngiven = ["Q1.2"]', 12, 15),
        # kitchen 8.5 of 18, cellar 1 of 1
        ("[weights]\nkitchen = 36\ncellar = 10", 36 * 8.5 / 18 + 10, 46),
        ("[weights]\nkitchen = 90\ncellar = 0", 42.5, 90),
        # excused from Q1.2: 7 of 14, on the scale of 19
        ('[[excused]]\nstudent = "ada"\nquestions = ["Q1.2"]', 9.5, 19),
        ('[[excused]]\nstudent = "ada"\nquestions = ["Q1.4"]', 9.5 * 19 / 15, 19),
        # the whole kitchen: 1 of 1
        ('[[excused]]\nstudent = "ADA"\nchapters = ["kitchen"]', 19, 19),
        ("[curve]\nadd = 2", 11.5, 19),
        ("[curve]\nfactor = 1.5\nadd = 1", 15.25, 19),
        ("[curve]\nfactor = 3", 19, 19),
        ("[curve]\ntable = [[0, 0], [9, 12], [10, 13], [19, 19]]", 12.5, 19),
        ("[curve]\ntable = [[10, 5], [19, 19]]", 5, 19),
    ],
)
def test_points_and_the_most_are_as_added_up_by_hand(course, text, earned, most):
    entry = under(course, text, record(course, **HALF))
    assert entry.scheme is not None
    assert entry.scheme.most == pytest.approx(most)
    assert entry.earned == pytest.approx(earned, abs=0.006)


def test_a_perfect_submission_has_the_most_and_an_empty_one_nothing(course: Course):
    text = 'dropped = ["Q1.1"]\n[weights]\nkitchen = 30\ncellar = 7\n[curve]\nfactor = 1.2'
    perfect = record(course, **dict.fromkeys(HALF, 1.0))
    assert under(course, text, perfect).earned == 37
    assert under(course, text, record(course)).earned == 0


def test_extra_points_of_a_bonus_question_survive_the_curve(course: Course):
    perfect = record(course, **dict.fromkeys(HALF, 1.0))
    assert under(course, 'bonus = ["Q2.1"]\n[curve]\nadd = 5', perfect).earned == 19


def test_nobody_gets_given_points_for_work_that_could_not_be_opened(course: Course):
    marks = [replace(m, status="unreadable") for m in record(course).graded.marks]
    entry = Record(graded("ada", *marks, status="unreadable"), 1, 1)
    assert under(course, 'given = ["Q1.1"]\n[curve]\nadd = 2', entry).earned == 0


def test_points_by_hand_count_unless_the_question_is_dropped(course: Course):
    given = {"Q1.4": Override("ada", "Q1.4", 3.0, "oral", "2026-11-20T10:00:00+00:00")}
    entry = replace(record(course, **HALF), overrides=given)
    assert under(course, 'bonus = ["Q1.1"]', entry).earned == 12.5
    assert under(course, 'dropped = ["Q1.4"]', entry).earned == 9.5


def test_lateness_is_taken_off_after_the_curve(course: Course):
    entry = replace(record(course, **HALF), late_percent=50.0)
    assert under(course, "[curve]\nadd = 0.5", entry).total == 5


@pytest.mark.parametrize(("rule", "total"), [("newest", 9.5), ("best", 14), ("mean", 9.5)])
def test_several_attempts_count_as_the_rule_says(course: Course, rule: str, total: float):
    first = record(course, **(HALF | {"Q1_4": 1.0, "Q1_2": 0.6}))  # 14, then a tenth off below
    second = record(course, Q1_2=1.0)  # 5
    entry = replace(
        record(course, **HALF),
        attempts=(
            Attempt(first.graded.marks, None, 0.0, "2026-01-01T00:00:00+00:00"),
            Attempt(second.graded.marks, None, 0.0, "2026-01-02T00:00:00+00:00"),
        ),
    )
    assert first.earned == 14
    counted = under(course, f'[resubmission]\npoints = "{rule}"', entry)
    assert counted.total == pytest.approx((14 + 5 + 9.5) / 3 if rule == "mean" else total, abs=0.01)


def test_a_late_attempt_loses_by_itself(course: Course):
    perfect = record(course, **dict.fromkeys(HALF, 1.0))
    early = Attempt(record(course, **HALF).graded.marks, None, 0.0, "2026-01-01T00:00:00+00:00")
    entry = replace(perfect, late_percent=90.0, attempts=(early,))
    assert under(course, '[resubmission]\npoints = "best"', entry).total == 9.5


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("dropped = [", "cannot be read"),
        ('dropped = ["Q9"]', "no such question"),
        ('droped = ["Q1.1"]', "unknown field 'droped'; perhaps 'dropped'"),
        ('dropped = ["Q1.1"]\ngiven = ["Q1.1"]', "both dropped and given"),
        ('[[excused]]\nstudent = "eve"\nquestions = ["Q1.1"]', "no student 'eve'"),
        ('[[excused]]\nstudent = "ada"', "write questions or chapters"),
        ("[weights]\nkitchen = 3", "nothing for cellar"),
        ("[weights]\nkitchen = -3\ncellar = 1", "at least 0"),
        ('dropped = ["Q2.1"]\n[weights]\nkitchen = 3\ncellar = 1', "nothing of it counts"),
        ("[curve]\nfactor = 0", "line 2: factor of curve is 0; give a number of more than 0"),
        ("[curve]\ntable = [[0, 5], [10, 2]]", "must rise"),
        ("[curve]\nadd = 1\ntable = [[0, 0]]", "stands alone"),
        ('[resubmission]\npoints = "first"', "write 'best' or 'mean' or 'newest'"),
        ("[curve]\nadd = nan", "finite"),
    ],
)
def test_a_scheme_that_is_unclear_is_refused_in_one_sentence(course: Course, text, said):
    with pytest.raises(CourseError, match=said):
        read_scheme(text, course, [record(course)], "grading.toml")


def test_the_orchard_still_adds_up_without_any_scheme():
    assert Record(graded("ada", *all_marks((1, 1, 0, 0.5))), 1, 1).total == 6
