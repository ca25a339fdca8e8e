"""The data: shapes, units and facts that can be checked independently of how they were made."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import data
from data import build

HERE = Path(data.__file__).parent


def test_all_files_together_stay_under_six_megabytes():
    size = sum(path.stat().st_size for pattern in build.DATA for path in HERE.glob(pattern))
    assert size < 6e6


def test_every_file_is_as_its_checksum_says():
    assert build.checksums(HERE) == build.stored_checksums()


def test_there_are_25_photographs_of_640_by_426_pixels():
    photographs = data.campus_photographs() | data.campus_queries()
    assert len(photographs) == 25
    assert {image.shape for image in photographs.values()} == {(426, 640, 3)}
    assert {image.dtype for image in photographs.values()} == {np.dtype(np.uint8)}


def test_photographs_are_red_green_blue_the_sky_being_blue():
    sky = data.campus_photographs()["0491"][:20].reshape(-1, 3).mean(axis=0)
    assert sky[2] > sky[0]


def test_undecided_pairs_exist_and_are_in_no_other_list():
    photographs = {*data.campus_photographs(), *data.campus_queries()}
    undecided = data.undecided_pairs()
    assert len(undecided) == 3
    assert all(pair <= photographs for pair in undecided)
    assert not undecided & data.same_place_pairs(by_eye=True)


def test_same_place_pairs_name_photographs_that_exist():
    known = (data.campus_photographs() | data.campus_queries()).keys()
    pairs = data.same_place_pairs(by_eye=True)
    assert len(data.same_place_pairs()) == 19
    assert len(pairs) == 22
    assert all(len(pair) == 2 and pair <= known for pair in pairs)


def test_killian_court_has_3873_scans_of_180_beams_in_centimetre_steps():
    scans = data.killian_court()
    assert scans.ranges.shape == (3873, 180)
    assert scans.poses.shape == (3873, 3)
    np.testing.assert_allclose(scans.ranges * 100, np.rint(scans.ranges * 100), atol=1e-9)
    assert (scans.ranges >= 49).mean() == pytest.approx(0.014, abs=5e-4)


def test_killian_ranges_beyond_four_metres_come_in_steps_of_five_centimetres():
    centimetres = np.rint(data.killian_court().ranges * 100).astype(int)
    far = centimetres[(centimetres >= 400) & (centimetres < 4900)]
    assert np.isin(far % 5, [0, 1, 2]).mean() > 0.98
    assert (far % 5 == 1).mean() > 0.85


def test_killian_beams_run_from_right_to_left():
    angles = data.killian_court().angles
    assert angles[0] == pytest.approx(-np.pi / 2)
    np.testing.assert_allclose(np.diff(angles), 0.017453)


def test_neighboring_killian_scans_see_the_same_walls():
    # A wrong sign of an angle or a swapped axis would tear neighbouring scans apart.
    scans = data.killian_court()

    def points(k: int) -> np.ndarray:
        near = scans.ranges[k] < 8
        x, y, heading = scans.poses[k]
        direction = heading + scans.angles[near]
        return np.column_stack(
            [
                x + scans.ranges[k, near] * np.cos(direction),
                y + scans.ranges[k, near] * np.sin(direction),
            ]
        )

    gaps = []
    for k in range(0, 3800, 200):
        apart = np.linalg.norm(points(k)[:, None] - points(k + 1)[None], axis=2)
        gaps.append(np.median(apart.min(axis=1)))
    assert np.median(gaps) < 0.05


def test_corridor_beams_end_on_the_wall_they_are_said_to_hit():
    corridor = data.corridor()
    scans = corridor.scans
    k, beam = np.nonzero(corridor.wall_of_beam >= 0)
    direction = scans.poses[k, 2] + scans.angles[beam]
    ends = scans.poses[k, :2] + scans.ranges[k, beam, None] * np.column_stack(
        [np.cos(direction), np.sin(direction)]
    )
    wall = corridor.walls[corridor.wall_of_beam[k, beam]]
    along = wall[:, 2:] - wall[:, :2]
    normal = np.column_stack([-along[:, 1], along[:, 0]])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    distance = np.abs(np.sum((ends - wall[:, :2]) * normal, axis=1))
    assert distance.max() < 0.06  # noise of 1 cm, at most 6 sigma across the wall


def test_corridor_noise_is_one_centimetre_straight_ahead():
    corridor = data.corridor()
    scans = corridor.scans
    ahead = 90
    hit_end = corridor.wall_of_beam[:, ahead] == 9  # the far end at x = 16
    distance = (16 - scans.poses[hit_end, 0]) / np.cos(scans.poses[hit_end, 2])
    assert hit_end.sum() > 5
    assert np.abs(scans.ranges[hit_end, ahead] - distance).max() < 0.05


def test_brick_walls_lie_on_three_planes():
    # Brute force over random triples, independent of the course's own RANSAC.
    points = data.brick_walls().points
    rng = np.random.default_rng(1)
    found = []
    for _ in range(3):
        triples = points[rng.integers(len(points), size=(3, 600))]
        normals = np.cross(triples[1] - triples[0], triples[2] - triples[0])
        size = np.linalg.norm(normals, axis=1)
        triples, normals = triples[:, size > 1e-6], normals[size > 1e-6]
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        distances = np.abs(points @ normals.T - np.sum(normals * triples[0], axis=1))
        close = distances < 0.02
        best = close.sum(axis=0).argmax()
        found.append(close[:, best].sum())
        points = points[~close[:, best]]
    assert found[0] > 1400
    assert found[1] > 900
    assert found[2] > 700


@pytest.mark.parametrize(
    "load", [data.killian_court, data.corridor, data.brick_walls, data.campus_queries]
)
def test_loaders_return_the_same_object_again(load):
    assert load() is load()


def test_arrays_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        data.killian_court().ranges[0, 0] = 1
    with pytest.raises(ValueError, match="read-only"):
        data.campus_queries()["0492"][0, 0] = 0
    with pytest.raises(AttributeError):
        data.campus_queries().pop("0492")
    with pytest.raises(TypeError):
        data.campus_photographs()["0491"] = None
    with pytest.raises(ValueError, match="read-only"):
        data.corridor().scans.ranges[0, 0] = 1


@pytest.fixture
def elsewhere(tmp_path, monkeypatch):
    """The loaders, reading from a copy of the data."""
    shutil.copytree(HERE, tmp_path / "data", ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(data, "HERE", tmp_path / "data")
    return tmp_path / "data"


def test_a_missing_file_is_named_with_the_command_that_makes_it(elsewhere):
    (elsewhere / "brick_walls.npz").unlink()
    with pytest.raises(data.DataError, match=r"data/brick_walls.npz is missing.*data\.build"):
        data.brick_walls.__wrapped__()


def test_a_damaged_array_file_is_named(elsewhere):
    path = elsewhere / "killian_court.npz"
    path.write_bytes(path.read_bytes()[:5000])
    with pytest.raises(data.DataError, match=r"killian_court.npz is damaged.*data\.build"):
        data.killian_court.__wrapped__()


def test_a_damaged_or_missing_photograph_is_named(elsewhere):
    (elsewhere / "campus/queries/0508.jpg").write_bytes(b"no picture")
    with pytest.raises(data.DataError, match=r"0508.jpg is damaged.*data\.build"):
        data.campus_queries.__wrapped__()
    (elsewhere / "campus/walk/0491.jpg").unlink()
    with pytest.raises(data.DataError, match=r"walk/0491.jpg is missing.*data\.build"):
        data.campus_photographs.__wrapped__()


def test_a_photograph_that_still_decodes_with_one_wrong_byte_is_named(elsewhere):
    path = elsewhere / "campus/walk/0497.jpg"
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 0xFF
    path.write_bytes(content)
    with pytest.raises(data.DataError, match=r"0497.jpg is damaged"):
        data.campus_photographs.__wrapped__()


def test_missing_checksums_are_named(elsewhere):
    (elsewhere / "checksums.txt").unlink()
    with pytest.raises(data.DataError, match=r"checksums.txt is missing.*data\.build"):
        data.campus_photographs.__wrapped__()


@pytest.mark.parametrize("kept", [0, 100, 400])
def test_checksums_that_were_cut_short_are_named_and_not_the_data(elsewhere, kept):
    path = elsewhere / "checksums.txt"
    path.write_bytes(path.read_bytes()[:kept])
    for load in (data.campus_photographs, data.campus_queries, data.corridor):
        with pytest.raises(data.DataError, match=r"checksums.txt is damaged.*data\.build"):
            load.__wrapped__()


def test_importing_the_loaders_does_not_import_opencv():
    code = "import sys, data; sys.exit('cv2' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], cwd=HERE.parent).returncode == 0


def test_the_corridor_is_made_again_byte_for_byte(tmp_path):
    from data.making.corridor import make_corridor

    make_corridor(tmp_path)
    assert (tmp_path / "corridor.npz").read_bytes() == (HERE / "corridor.npz").read_bytes()


@pytest.mark.parametrize("arguments", [["--help"], ["--chek"], ["check"], ["--check", "--verify"]])
def test_what_the_build_does_not_know_builds_nothing(monkeypatch, capsys, arguments):
    monkeypatch.setattr(build, "build", lambda target: pytest.fail(f"wrote to {target}"))
    with pytest.raises(SystemExit):
        build.main(arguments)
    assert "usage: python -m data.build" in "".join(capsys.readouterr())


def test_the_build_verifies_without_building(monkeypatch, capsys):
    monkeypatch.setattr(build, "build", lambda target: pytest.fail(f"wrote to {target}"))
    assert build.main(["--verify"]) == 0
    assert "28 of 28 files are as they were" in capsys.readouterr().out


@pytest.mark.skipif(
    importlib.util.find_spec("mvtbdata") is None or importlib.util.find_spec("rtbdata") is None,
    reason="the sources of the data are not installed (`uv run --group data`)",
)
def test_all_data_are_made_again_byte_for_byte(capsys):
    assert build.main(["--check"]) == 0, capsys.readouterr().out
