"""Who the student is: a field for the name, and a question before another name is kept."""

from __future__ import annotations

from autograder.language import _
from autograder.student.identity import become, student_of, warning
from autograder.student.widgets.base import CourseWidget, source


class IdentityWidget(CourseWidget):
    """Asks for the name or number of the class list.

    The first name is kept at once; any other only after the student has read what that means.
    """

    _esm = source("common.js", "kernel_line.js", "identity.js")
    _css = source("common.css", "value.css")

    def what_is_fixed(self) -> dict[str, object]:
        return {"label": _("Who you are"), "personal": self.desk.course.personal}

    def what_is_kept(self) -> dict[str, object]:
        return {"name": student_of(self.desk.course)}

    def do_say(self, message: dict[str, object]) -> dict[str, object]:
        """Keep a name, or reply with a warning that is to be confirmed."""
        name = str(message["name"])
        if not message.get("sure") and (warned := warning(self.desk.course, name)):
            return {"warning": warned}
        return {"told": become(self.desk.course, name)}
