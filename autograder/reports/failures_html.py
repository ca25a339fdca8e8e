"""Of ``class.html``: how long submissions took, and which responses failed to run."""

from __future__ import annotations

import numpy as np

from autograder.gradebook import Run
from autograder.language import _, n_
from autograder.reports.class_summary import ClassFindings
from autograder.reports.html_page import table
from autograder.reports.markdown import text
from autograder.reports.student_links import Links
from autograder.reports.svg_charts import (
    histogram,
)


def time_and_failures_html(found: ClassFindings, run: Run | None, links: Links) -> str:
    """The times as a chart, and a table of the reasons why responses stopped."""
    seconds = np.array(found.seconds)
    spent = _("{seconds} s of running and marking.").format(seconds=f"{seconds.sum():.0f}")
    if run is not None and run.seconds:
        spent = _(
            "{seconds} s of running and marking, the last run took {clock} s by the clock."
        ).format(seconds=f"{seconds.sum():.0f}", clock=f"{run.seconds:.0f}")
    named = ", ".join(f"{links.to(student)} ({s:.1f} s)" for s, student in found.slowest)
    usual = _("Median {seconds} s a submission; slowest: {students}.").format(
        seconds=f"{np.median(seconds):.2g}", students=named
    )
    lines = [f"<p>{spent} {usual}</p>"]
    high = max(1.0, float(seconds.max()) * 1.02)
    title = _("Time for each submission")
    chart = histogram(seconds.tolist(), 0, high, 20, _("seconds"), title)
    lines.append(f"<figure>{chart}</figure>")
    rows = [
        [
            *(text(_(question)), _(status), text(sentence), str(students.count)),
            links.all(students.first, count=students.count),
        ]
        for (question, status, sentence), students in sorted(
            found.failures.items(), key=lambda item: (-item[1].count, item[0])
        )
    ]
    if rows:
        header = [_("question"), _("status"), _("reason"), _("students"), _("who")]
        caption = n_("{count} failure", "{count} failures", found.failure_count)
        lines.append(table(caption.format(count=found.failure_count), header, rows, {3}))
        listed = sum(students.count for students in found.failures.values())
        if listed < found.failure_count:
            left = found.failure_count - listed
            sentence = n_(
                "{count} more has another reason.", "{count} more have other reasons.", left
            )
            lines.append(f"<p>{sentence.format(count=left)}</p>")
    else:
        lines.append(f"<p>{_('No response failed to run.')}</p>")
    return "\n".join(lines)
