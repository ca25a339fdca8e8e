"""Of ``class.html``: the most common mistakes, and who made them."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.language import _, n_
from autograder.reports.common_mistakes import Mistake
from autograder.reports.html_page import table
from autograder.reports.markdown import text
from autograder.reports.student_links import Links

_MOST_MISTAKES = 20


def mistakes_html(mistakes: Sequence[Mistake], links: Links) -> str:
    """A table of known mistakes, and one of where responses fail that match none."""
    named = [mistake for mistake in mistakes if mistake.named]
    others = [mistake for mistake in mistakes if not mistake.named]
    if not mistakes:
        return f"<p>{_('Nobody made a mistake that has a name.')}</p>"
    body = ""
    if named:
        known = _("Known mistakes, by how many students made them")
        body += _mistake_table(known, named, links)
    if others:
        unknown = _("Where responses fail that match no known mistake")
        body += _mistake_table(unknown, others, links)
    return body


def _mistake_table(caption: str, mistakes: Sequence[Mistake], links: Links) -> str:
    rows = [
        [text(m.question), text(m.name), str(len(m.students)), links.all(m.students, m.question)]
        for m in mistakes[:_MOST_MISTAKES]
    ]
    left = len(mistakes) - _MOST_MISTAKES
    more = n_(
        "{count} more is in class_mistakes.csv.", "{count} more are in class_mistakes.csv.", left
    ).format(count=left)
    header = [_("question"), _("mistake"), _("students"), _("who")]
    return table(caption, header, rows, {2}) + (f"<p>{more}</p>" if left > 0 else "")
