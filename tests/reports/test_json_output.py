"""What ``--json`` says of one student."""

from pathlib import Path

from autograder.gradebook import Record
from autograder.reports.json_output import record_fields
from tests.classroom import all_marks, graded, make_course


def test_each_student_has_the_isolation_in_which_the_work_was_graded(tmp_path: Path):
    course = make_course(tmp_path)
    for isolation in ("bubblewrap", "none, as asked for"):
        record = Record(graded("ada", *all_marks()), 1, 1, isolation=isolation)
        assert record_fields(course, record)["isolation"] == isolation
