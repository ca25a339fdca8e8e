"""``autograder similar``: pairs of submissions that somebody should read side by side."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.console import Console

from autograder.cli.exit_status import DONE
from autograder.cli.shared_arguments import (
    Commands,
    add_class_list,
    add_json,
    add_out,
    find_class_list,
    gradebook_path,
    load,
    print_json,
)
from autograder.course.folders import SOLUTIONS, SOLVED, readable_notebooks, student_notebooks
from autograder.language import _, n_

if TYPE_CHECKING:
    from autograder.reports.code_fingerprints import Code
    from autograder.reports.similarity import Pair


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
    add_class_list(similar)
    add_json(similar)
    similar.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Compare everybody with everybody and with what is public; print it, write similar.csv."""
    from autograder.gradebook import Gradebook
    from autograder.gradebook.student_names import names_of
    from autograder.gradebook.view import with_people
    from autograder.intake.find_submissions import find_submissions
    from autograder.intake.submissions import Unreadable, read_submission
    from autograder.reports.code_fingerprints import fingerprints
    from autograder.reports.similarity import handout_cells, shared_by_many, similar_pairs
    from autograder.reports.terminal import printable, progress_bar, warn
    from autograder.reports.whole_files import write_csv

    course = load(parsed)
    names: dict[str, str] = {}
    if parsed.paths:
        submissions = find_submissions(parsed.paths, course.settings)
    else:
        with Gradebook(gradebook_path(parsed), create=False) as book:
            records, _matches = with_people(book.records(), find_class_list(parsed, book))
            submissions = [record.graded.submission for record in records]
            names = names_of(records)
    untouched = list(_read(student_notebooks(course.root)))
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
        pairs = similar_pairs(
            *(students, handout, parsed.least),
            progress=lambda: progress.advance(task),
            public=_public(course.root),
        )
    if shared := shared_by_many(students, handout):
        warn(_shared_sentence([names.get(name, name) for name in sorted(shared)]))
    if parsed.json:
        print_json([vars(pair) for pair in pairs])
        return DONE
    header = ["first", "second", "share", "fingerprints", "line", "other_line"]
    rows: list[list[object]] = [
        [*header, "share_of_first", "share_of_second", "name", "other_name"]
    ]
    for p in pairs:
        row: list[object] = [p.first, p.second, round(p.share, 3), p.fingerprints]
        row += [*map(printable, p.lines), round(p.first_share, 3)]
        row += ["" if p.second_share is None else round(p.second_share, 3)]
        rows.append([*row, names.get(p.first, p.first), names.get(p.second, p.second)])
    path = parsed.out / "similar.csv"
    write_csv(path, rows)
    for pair in pairs:
        console.print(
            printable(_sentence(pair, names)),
            markup=False,
            soft_wrap=True,
        )
    console.print(
        n_(
            "{count} pair among {all} submissions and what is public is alike; {path} is written.",
            "{count} pairs among {all} submissions and what is public are alike; {path} is "
            "written.",
            len(pairs),
        ).format(count=len(pairs), all=len(students), path=path)
        + f" {_('Likeness is a reason to read both, not a proof.')}",
        markup=False,
        soft_wrap=True,
    )
    return DONE


def _shared_sentence(shared: Sequence[str]) -> str:
    return n_(
        "{count} submission was not compared ({names}): nearly all its code stands in more than a "
        "fifth of the class, as where there is one way to write it, or where a solution has gone "
        "round. Read it.",
        "{count} submissions were not compared ({names}): nearly all their code stands in more "
        "than a fifth of the class, as where there is one way to write it, or where a solution "
        "has gone round. Read one of them.",
        len(shared),
    ).format(count=len(shared), names=", ".join(shared))


def _sentence(pair: Pair, names: Mapping[str, str]) -> str:
    first, second = (names.get(name, name) for name in (pair.first, pair.second))
    alike = _("{share} of {name}'s own work").format(share=f"{pair.first_share:.0%}", name=first)
    if pair.second_share is not None:
        both = _("{alike} and {share} of {name}'s")
        alike = both.format(alike=alike, share=f"{pair.second_share:.0%}", name=second)
    sentence = _("{first} and {second}: {alike} is alike, as at “{one}” and “{other}”").format(
        first=first,
        second=second,
        alike=alike,
        one=pair.lines[0][:60],
        other=pair.lines[1][:60],
    )
    return f"{pair.share:4.0%}  {sentence}"


def _read(paths: Sequence[Path]) -> Iterator[dict[str, Any]]:
    """The course's own notebooks; one that cannot be read is named, since it is missed here."""
    from autograder.reports.terminal import warn

    for path in paths:
        found = list(readable_notebooks([path]))
        if not found:
            sentence = _("{file} cannot be read as a notebook; it is left out of the comparison.")
            warn(sentence.format(file=path))
        yield from found


def _public(root: Path) -> dict[str, Code]:
    """What anybody can read who finds the repository: the solved notebooks and the references."""
    from autograder.reports.code_fingerprints import fingerprints
    from autograder.reports.similarity import handout_cells

    solved = list(_read(sorted((root / SOLVED).glob("*.ipynb"))))
    references = [
        path.read_text(encoding="utf-8") for path in sorted((root / SOLUTIONS).rglob("*.py"))
    ]
    return {
        "the solved notebooks": fingerprints(handout_cells(solved)),
        "the references": fingerprints(references),
    }


def _share(text: str) -> float:
    share = float(text)
    if not 0 < share <= 1:
        raise argparse.ArgumentTypeError("give a share above 0 and up to 1")
    return share
