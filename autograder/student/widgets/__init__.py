"""The questions as widgets: one Python class, one ES module and one style sheet for each.

Nothing here is imported before a widget is really shown.
"""

from autograder.student.widgets.order import OrderWidget
from autograder.student.widgets.progress import ProgressWidget
from autograder.student.widgets.submission import SubmissionWidget
from autograder.student.widgets.true_false import TrueFalseWidget
from autograder.student.widgets.value import ValueWidget, question_widget

progress_widget = ProgressWidget
submission_widget = SubmissionWidget
value_widget = ValueWidget

__all__ = [
    "OrderWidget",
    "ProgressWidget",
    "SubmissionWidget",
    "TrueFalseWidget",
    "ValueWidget",
    "progress_widget",
    "question_widget",
    "submission_widget",
    "value_widget",
]
