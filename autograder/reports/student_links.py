"""Students as links from ``class.html`` to their pages of feedback."""

from __future__ import annotations

from collections.abc import Sequence
from urllib.parse import quote

from autograder.gradebook.student_names import Names
from autograder.language import n_
from autograder.reports.class_summary import MOST_NAMED
from autograder.reports.markdown import isolated, text
from autograder.reports.whole_files import file_name


class Links:
    """Students as links to their pages, under the names that tell them apart."""

    def __init__(self, names: Names) -> None:
        self._names = names

    def to(self, student: str, anchor: str = "", said: str = "") -> str:
        """A link to a student's page, or to a question there."""
        address = f"feedback/{quote(file_name(student))}.html"
        place = f"#{quote(anchor.replace('.', '-'))}" if anchor else ""
        shown = text(said) if said else isolated(self._names[student])
        return f'<a href="{address}{place}">{shown}</a>'

    def all(
        self, students: Sequence[str], anchor: str = "", most: int = 5, count: int | None = None
    ) -> str:
        """Several links; those beyond ``most`` are folded away.

        ``count`` says how many there are if not all are given; of many the last are left out.
        """
        count = len(students) if count is None else count
        made = [self.to(student, anchor) for student in students[:MOST_NAMED]]
        if count <= most:
            return ", ".join(made)
        shown, rest = ", ".join(made[:most]), ", ".join(made[most:])
        left = count - len(made)
        if left:
            others = n_("and {count} other", "and {count} others", left)
            rest += f" {others.format(count=left)}"
        more = n_("{count} more", "{count} more", count - most).format(count=count - most)
        return f"{shown}<details><summary>{more}</summary>{rest}</details>"
