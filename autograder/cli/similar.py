"""``autograder similar``: pairs of submissions that somebody should read side by side."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from rich.console import Console

from autograder.cli.common import Commands, add_json, add_out, gradebook_path, load, print_json
from autograder.cli.status import DONE


def add(commands: Commands) -> None:
    """Describe the command."""
    similar = commands.add_parser(
        "similar", help="find submissions whose code is suspiciously alike"
    )
    similar.add_argument(
        "paths",
        nargs="*",
        type=Path,
        metavar="PATH",
        help="submissions (default: those in the gradebook)",
    )
    similar.add_argument(
        "--least",
        type=_share,
        default=0.5,
        metavar="SHARE",
        help="the share of the shorter one's own code that both must have (default: 0.5)",
    )
    add_out(similar)
    add_json(similar)
    similar.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Compare everybody with everybody, print the pairs and write similar.csv."""
    from autograder.gradebook import Gradebook
    from autograder.intake.submissions import Unreadable, find_submissions, read_submission
    from autograder.reports.files import write_csv
    from autograder.reports.similarity import fingerprints, handout_cells, similar_pairs
    from autograder.reports.terminal import printable, progress_bar

    course = load(parsed)
    if parsed.paths:
        submissions = find_submissions(parsed.paths, course.settings)
    else:
        with Gradebook(gradebook_path(parsed), create=False) as book:
            submissions = [record.graded.submission for record in book.records()]
    untouched = [
        json.loads(path.read_text(encoding="utf-8"))
        for path in sorted((course.root / "notebooks").glob("*.ipynb"))
    ]
    handout = fingerprints(handout_cells(untouched))
    chapters = [chapter.name for chapter in course.chapters]
    students = {}
    with progress_bar("comparing") as progress:
        task = progress.add_task("", total=2 * len(submissions))
        for submission in submissions:
            progress.advance(task)
            try:
                contents = read_submission(submission, course.settings, chapters)
            except Unreadable:
                continue
            cells = [cell for book in contents.notebooks.values() for cell in book.cells]
            students[submission.student] = fingerprints(cells)
        pairs = similar_pairs(students, handout, parsed.least, lambda: progress.advance(task))
    if parsed.json:
        print_json([vars(pair) for pair in pairs])
        return DONE
    rows: list[list[object]] = [["first", "second", "share", "fingerprints", "line", "other_line"]]
    rows += [
        [p.first, p.second, round(p.share, 3), p.fingerprints, *map(printable, p.lines)]
        for p in pairs
    ]
    path = parsed.out / "similar.csv"
    write_csv(path, rows)
    for pair in pairs:
        console.print(
            printable(
                f"{pair.share:4.0%}  {pair.first} and {pair.second}, at “{pair.lines[0][:60]}” and "
                f"“{pair.lines[1][:60]}”"
            ),
            markup=False,
            soft_wrap=True,
        )
    console.print(
        f"{len(pairs)} pairs of {len(students)} submissions are alike; {path} is written. "
        "Likeness is a reason to read both, not a proof.",
        markup=False,
        soft_wrap=True,
    )
    return DONE


def _share(text: str) -> float:
    share = float(text)
    if not 0 < share <= 1:
        raise argparse.ArgumentTypeError("give a share above 0 and up to 1")
    return share
