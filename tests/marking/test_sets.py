"""Which set of hidden inputs some work meets: the first set first, then one it has not met."""

from autograder.marking.draw import SETS, seed_of_set, set_number, set_of_variant


def test_the_first_work_of_everyone_meets_set_0_also_when_it_comes_again():
    assert all(set_number(f"student {n}", "a", []) == 0 for n in range(20))
    assert set_number("ada", "a", ["a", "b"]) == 0
    assert set_number("bo", "z", ["z"]) == 0


def test_each_later_work_meets_a_set_of_its_own_time():
    for position in range(1, 6):
        works = [f"work {n}" for n in range(position)]
        met = {set_number(f"student {n}", "new", works) for n in range(40)}
        assert met == {1 + (position - 1) * SETS + chance for chance in range(SETS)}


def test_the_same_work_meets_the_same_set_whatever_came_after_it():
    works = ["a", "b", "c", "d"]
    for n, work in enumerate(works):
        number = set_number("ada", work, works[:n])
        assert set_number("ada", work, works) == number
        assert set_number("ada", work, works[: n + 1]) == number


def test_a_name_or_work_that_is_no_text_for_a_file_has_a_set_all_the_same():
    assert set_number("\ud800", "\udfff", ["a"]) in range(1, 1 + SETS)


def test_variants_count_down_from_set_0():
    assert [set_of_variant(variant) for variant in range(4)] == [0, -1, 0, -1]


def test_set_0_has_the_seed_of_the_run_and_the_others_seeds_of_their_own():
    assert seed_of_set(7, 0) == 7
    seeds = {seed_of_set(seed, number) for seed in (7, 8) for number in range(-1, 6)}
    assert len(seeds) == 14
    assert seed_of_set(7, 1) not in (7, 8)
    # Marks that were given must not change: the CRC-32 of "7:1".
    assert seed_of_set(7, 1) == 2853368900
