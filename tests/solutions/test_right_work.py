"""Right work in other clothes: every question has enough of it.

That it earns everything under 25 seeds is part of the course's proof, in `test_the_course.py`."""

from autograder.course.right_work import right_work_of, unexpected_right_work
from autograder.questions.registry import kind_of


def test_every_function_has_four_variants_and_every_expression_six(real_course):
    few = {
        id: len(right_work_of(real_course, question))
        for id, question in real_course.questions.items()
        if len(right_work_of(real_course, question)) < kind_of(question).fewest_variants
    }
    assert few == {}


def test_every_file_of_variants_belongs_to_a_question(real_course):
    assert unexpected_right_work(real_course) == []
