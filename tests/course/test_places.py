"""Everybody's place in the class list, kept without names."""

from __future__ import annotations

import re
from itertools import pairwise

import pytest

from autograder.cli import main
from autograder.course.places import FILE, MOST, make_places, read_places
from autograder.errors import CourseError, UsageError
from autograder.questions.variables import Variables
from tests.toy import Toy, make_toy

CLASS = """Student,ID,SIS User ID,SIS Login ID,Section
"Lovelace, Ada",101,s1,ada,A
"Boole, George",102,s2,boole,A
"Kepler, Johannes",103,s3,kepler,A
"Kepler, Johannes",104,s4,jkepler,A
"Noether, Emmy",105,s5,emmy,A
"""


@pytest.fixture
def alone(market: Toy, tmp_path) -> Toy:
    """A course with numbers of everybody's own, and a class list beside it."""
    cells = "".join(f'\n\n# %% exercise="{id}"\n' for id in ("Q7", "Q7.1", "Q7.2"))
    market.append("notebooks/source/1_kitchen.py", "\n\n# %%\nme()\n" + cells)
    (tmp_path / "canvas.csv").write_text(CLASS)
    return market


@pytest.mark.parametrize("count", [1, 2, 3, 17, 300, 5000])
def test_every_name_has_its_place_and_the_file_keeps_it(count, tmp_path):
    wanted = {f"Student {n}": n for n in range(count)}
    places = make_places(wanted)
    assert {name: places.of(name) for name in wanted} == wanted
    assert places.of("  STUDENT   0 ") == 0
    (tmp_path / FILE).write_text(places.text())
    assert read_places(tmp_path) == places


def test_nothing_tells_whether_a_name_is_in_the_list():
    places = make_places({f"student {n}": n for n in range(100)})
    assert max(places.slots) < 100
    assert 0 not in {places.slots.count(n) for n in range(0, 100, 25)}
    others = [places.of(f"somebody {n}") for n in range(10_000)]
    assert set(others) == set(range(100))
    assert max(others.count(n) for n in range(100)) < 1_000  # no place stands out
    assert make_places({"ada": 3}).of("ada") == 3
    with pytest.raises(UsageError, match="0 names"):
        make_places({})
    with pytest.raises(UsageError, match="names; give 1 to"):
        make_places({str(n): n for n in range(MOST + 1)})


@pytest.mark.parametrize("sizes", [(2,), (3,), (2, 3), (4, 3, 2), (10, 10, 10), (1,)])
def test_neighbors_have_other_variants_and_all_are_used_alike(sizes):
    values = {f"v{n}": tuple(range(size)) for n, size in enumerate(sizes)}
    for name in "abcdefgh":
        variables = Variables(name, values)
        variants = [variables.variant_of("chapter", "whoever", place) for place in range(300)]
        counts = [variants.count(n) for n in range(variables.count)]
        assert max(counts) - min(counts) <= 1
        if variables.count > 1:
            assert all(a != b for a, b in pairwise(variants))


def test_a_dealt_class(alone, tmp_path, capsys):
    deal = ["--course", str(alone.root), "deal", str(tmp_path / "canvas.csv")]
    assert main(deal) == 0
    said = capsys.readouterr()
    assert "5 people have places" in said.out
    assert "johannes kepler is the name of more than one" in said.err
    text = (alone.root / FILE).read_text()
    assert not re.search("lovelace|boole|kepler|noether", text, re.IGNORECASE)
    course = alone.load()
    rows = [("Ada Lovelace", "ada", "s1"), ("George Boole", "boole", "102"), ("kepler", "103"),
            ("jkepler", "104"), ("Emmy Noether", "Noether, Emmy", "emmy")]  # fmt: skip
    numbers = []
    for names in rows:
        (own,) = {course.for_student(name).numbers("Q7.2")["m"] for name in names}
        numbers.append(own)
    assert all(a != b for a, b in pairwise(numbers))

    assert main(deal) == 2
    assert "--again deals anew" in capsys.readouterr().err
    assert main([*deal, "--again"]) == 0
    assert main(["--course", str(alone.root), "release", str(tmp_path / "bundle")]) == 0
    assert (tmp_path / "bundle" / FILE).read_text() == text


def test_other_places_are_another_course_to_the_gradebook(alone, tmp_path):
    before = alone.load().version
    assert main(["--course", str(alone.root), "deal", str(tmp_path / "canvas.csv")]) == 0
    assert alone.load().version != before


def test_a_course_with_the_sheets_numbers_deals_nothing(tmp_path, capsys):
    course = make_toy(tmp_path / "course")
    (tmp_path / "canvas.csv").write_text(CLASS)
    assert main(["--course", str(course.root), "deal", str(tmp_path / "canvas.csv")]) == 2
    assert 'write variants = "student"' in capsys.readouterr().err
    assert not (course.root / FILE).exists()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("salt = 1", "people"),
        ("people = 3\nsalt = 1", "slots"),
        ('people = 3\nsalt = 1\nslots = "AA=="', "run it again"),
        ('people = 3\nsalt = 1\nslots = "?"', "run it again"),
        ('people = 3\nsalt = 1\nslots = ""', "run it again"),
        ('people = 3\nsalt = "x"\nslots = "AAAAAAAA"', "salt"),
        ("salt = ", "cannot be read"),
    ],
)
def test_a_broken_file_is_refused_with_one_sentence(alone, text, said):
    (alone.root / FILE).write_text(text)
    with pytest.raises(CourseError, match=said):
        alone.load()
