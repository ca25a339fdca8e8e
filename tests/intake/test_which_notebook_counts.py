"""Of copies, renamed notebooks and backups, the one that counts is found."""

import time

import pytest

from autograder.course import Settings
from autograder.intake.handout import Handout
from autograder.intake.submissions import Submission, read_submission
from tests.intake.handed_in import notebook, read_zip, zipped

LIMITS = Settings()


@pytest.mark.parametrize(
    "name",
    [
        "3_ransac.ipynb",
        "3_ransac (1).ipynb",
        "3_ransac-Copy1.ipynb",
        "3_ransac - Copy.ipynb",
        "3_ransac copy 2.ipynb",
        "Copy of 3_ransac.ipynb",
        "deep/inside/3_ransac.ipynb",
    ],
)
def test_a_copy_belongs_to_its_chapter(tmp_path, name):
    assert list(read_zip(tmp_path, {name: notebook("k = 1")}).notebooks) == ["ransac"]


@pytest.mark.parametrize(
    "suffix",
    ["-copy1" * 40, "-copy1" * 10_000, " (1)" * 10_000, "-copy" * 10_000, "- _" * 10_000,
     "-" * 60_000 + "copy", "(1" * 30_000, "copy " + "1" * 60_000],
    ids=lambda suffix: f"{suffix[:6]} {len(suffix)}",
)  # fmt: skip
def test_a_name_made_to_look_like_a_copy_in_many_ways_is_read_at_once(tmp_path, suffix):
    began = time.process_time()
    books = {"3_ransac.ipynb": notebook("k = 1"), f"3_ransac{suffix}x.ipynb": notebook("k = 2")}
    contents = read_zip(tmp_path, books)
    assert time.process_time() - began < 1  # of this process alone
    assert contents.notebooks["ransac"].cells == ["k = 1"]


def test_a_copy_of_a_copy_belongs_to_its_chapter(tmp_path):
    names = [
        "3_ransac-Copy1 (2).ipynb",
        "3_ransac (1) - Copy (3).ipynb",
        "3_ransac(4)_copy_2.ipynb",
    ]
    for name in names:
        assert list(read_zip(tmp_path, {name: notebook("k = 1")}).notebooks) == ["ransac"]


def test_with_the_chapters_known_a_renamed_notebook_is_found(tmp_path):
    path = tmp_path / "lovelace_4711_3_RANSAC final.ipynb"
    path.write_bytes(notebook("k = 1"))
    found = read_submission(Submission("ada", path), LIMITS, ["line_fitting", "ransac"])
    assert list(found.notebooks) == ["ransac"]


def test_of_two_notebooks_for_one_chapter_the_original_is_marked_and_the_other_named(tmp_path):
    copies = {"3_ransac (1).ipynb": notebook("copy"), "3_ransac.ipynb": notebook("original")}
    contents = read_zip(tmp_path, copies)
    assert contents.notebooks["ransac"].cells == ["original"]
    assert contents.notes == [
        "There are two notebooks for one chapter: 3_ransac.ipynb was marked, "
        "3_ransac (1).ipynb was not."
    ]


def test_a_backup_of_an_earlier_handout_is_not_taken_for_the_work(tmp_path):
    handout = Handout(
        {"ransac": ("Q3.1",)},
        {"ransac": ("k = ...", 'def fit():\n    """New words."""\n    raise NotImplementedError')},
    )
    stub = 'def fit():\n    """Old words."""\n    raise NotImplementedError'
    entries = {
        "backup/3_ransac.ipynb": notebook("k = ...", stub, "old_figure()"),
        "final/3_ransac.ipynb": notebook("k = 74", stub[:-25] + "    return 1", "old_figure()"),
    }
    path = tmp_path / "ada.zip"
    path.write_bytes(zipped(entries))
    contents = read_submission(Submission("ada", path), LIMITS, handout)
    assert contents.notebooks["ransac"].cells[0] == "k = 74"
    assert contents.notes == [
        "There are two notebooks for one chapter: final/3_ransac.ipynb was marked, "
        "backup/3_ransac.ipynb was not (it is as handed out)."
    ]
