"""What ``submit()`` does and says: the packed file, what is unanswered, and how to hand it in."""

from __future__ import annotations

from pathlib import Path

from autograder.language import N_, _
from autograder.student import unsaved
from autograder.student.desk import Desk
from autograder.student.frontend import colab_notebook, in_colab
from autograder.student.put_into_drop_folder import drop
from autograder.student.responses import answered, responses_folder
from autograder.student.submission import asks_for_a_name, pack_submission
from autograder.student.views import (
    SubmissionView,
)

COLAB = N_(
    "Download it from the panel of files (the folder on the left) before you close the page: "
    "Colab forgets its files."
)
NO_COPY = N_(
    "Colab did not hand over your notebook, so the file lacks it. Run `submit()` again; if that "
    "does not help, hand in the notebook as well (File, Download, Download .ipynb)."
)


def pack_and_say(desk: Desk, to: Path | None) -> SubmissionView:
    """Pack notebooks and responses, hand them in where ``to`` says, and tell what is missing."""
    on_screen = colab_notebook()
    packed = pack_submission(desk.course, responses_folder(desk.course.root), on_screen)
    entries = desk.entries()
    unanswered = [
        question
        for question in desk.course.questions.values()
        if not answered(entries[question.chapter].get(question.id))
    ]
    warning = ""
    if on_screen is None:
        warning = _(NO_COPY) if in_colab() else unsaved.unsaved_work(packed.folder)
    advice, taken = _(COLAB) if in_colab() else "", False
    if to is not None and warning:
        advice = _("Nothing was put into {folder}.").format(folder=to)
    elif to is not None:
        put = drop(packed.path, to)
        advice = _("Handed in as {path}; the newest counts.").format(path=put)
        taken = True
    nameless = ""
    if not desk.student and asks_for_a_name(packed.folder):
        call = '`me("Ada Lovelace")`'
        sentence = _(
            "You have not said who you are. Run {call} with your own name, then submit() again."
        )
        nameless = sentence.format(call=call)
    count = len(desk.course.questions)
    return SubmissionView(packed, unanswered, count, warning, advice, taken, nameless)
