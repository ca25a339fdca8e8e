import numpy as np

from benchmarks.scenes import BEAMS, Scene, hard_scenes
from benchmarks.true_and_false_walls import matches, rates

# Two walls: along x at y = 1, and along y at x = 5, both seen.
WALLS = np.array([[[0.0, 1.0], [4.0, 1.0]], [[5.0, 0.0], [5.0, 4.0]]])
SCENE = Scene(np.ones(180), WALLS, np.array([True, True]))


def test_a_segment_matches_the_wall_it_lies_on_in_either_direction():
    ends = np.array([[[1.0, 1.02], [3.0, 0.97]], [[5.0, 3.0], [5.03, 1.0]]])
    assert matches(ends, WALLS).tolist() == [[True, False], [False, True]]


def test_segments_beside_across_or_beyond_a_wall_do_not_match():
    beside = [[1.0, 1.2], [3.0, 1.2]]
    across = [[1.0, 0.96], [1.2, 1.04]]
    beyond = [[3.0, 1.0], [4.5, 1.0]]
    assert not matches(np.array([beside, across, beyond]), WALLS).any()


def test_rates_count_walls_found_and_segments_that_are_wrong_or_said_twice():
    one_wall = [[0.0, 1.0], [2.0, 1.0]]
    its_other_half = [[2.2, 1.0], [4.0, 1.0]]
    again = [[0.5, 1.0], [1.9, 1.01]]
    nowhere = [[0.0, 3.0], [2.0, 3.0]]
    ends = np.array([one_wall, its_other_half, again, nowhere])
    assert rates([SCENE], [ends]) == (0.5, 0.5)


def test_no_segments_find_nothing_and_are_never_wrong():
    assert rates([SCENE], [np.empty((0, 2, 2))]) == (0.0, 0.0)


def test_simulated_beams_end_on_the_walls_that_are_visible():
    for scene in hard_scenes(20, np.random.default_rng(0)):
        points = scene.ranges[:, None] * np.column_stack([np.cos(BEAMS), np.sin(BEAMS)])
        for start, end in scene.walls[scene.visible]:
            along = (end - start) / np.hypot(*(end - start))
            across = np.abs((points - start) @ [-along[1], along[0]])
            assert np.count_nonzero(across < 0.06) >= 12
