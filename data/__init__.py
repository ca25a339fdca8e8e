"""Small real data for the course. ``README.md`` in this folder is the datasheet.

Every loader reads its file once and returns the same read-only arrays afterwards; copy an array to
change it.

Raises:
    DataError: for a file that is missing or damaged.
"""

from __future__ import annotations

import hashlib
import io
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

HERE = Path(__file__).parent
REBUILD = "uv run --group data python -m data.build"

# Photographs that show the same place, verified by SIFT matches that agree with one fundamental
# matrix: 20 or more of them, where chance reaches 14. 0497-0498 has only about 18, but the eye is
# in no doubt.
_SAME_PLACE = (
    "0491-0492 0495-0496 0497-0498 0499-0500 0499-0501 0500-0501 0500-0502 0500-0503 0501-0502 "
    "0501-0503 0502-0503 0506-0507 0506-0508 0507-0508 0507-0509 0507-0510 0508-0509 0508-0510 "
    "0509-0510"
)
# The same place to the eye, with too few matches to verify it.
_SAME_PLACE_BY_EYE = "0511-0512 0512-0513 0513-0515"
# Arcades that look alike all along a building: neither eye nor geometry can tell.
_UNDECIDED = "0496-0505 0503-0505 0506-0509"


class DataError(Exception):
    """A data file is missing or damaged."""


class Scans(NamedTuple):
    """Laser scans and the poses from which they were taken."""

    ranges: NDArray[np.float64]  # (K, B) m; at or beyond max_range: no echo
    angles: NDArray[np.float64]  # (B,) rad, of the beams, zero straight ahead, left is positive
    poses: NDArray[np.float64]  # (K, 3) x in m, y in m, heading in rad
    max_range: float  # m


class Corridor(NamedTuple):
    """A simulated drive with everything known about it."""

    scans: Scans
    walls: NDArray[np.float64]  # (M, 4) m, each wall from (x0, y0) to (x1, y1)
    wall_of_beam: NDArray[np.int8]  # (K, B) index of the wall a beam hit, -1 for anything else


class PointCloud(NamedTuple):
    """Points in space and their colours."""

    points: NDArray[np.float64]  # (N, 3) m; x to the right, y down, z ahead of the camera
    colors: NDArray[np.uint8]  # (N, 3) red, green, blue


@cache
def campus_photographs() -> Mapping[str, NDArray[np.uint8]]:
    """The 20 photographs of a walk round a campus, by number such as ``"0491"``, in order.

    Each is (426, 640, 3), red, green, blue.
    """
    return _photographs("walk", 20)


@cache
def campus_queries() -> Mapping[str, NDArray[np.uint8]]:
    """The 5 photographs of the same walk that were held back as queries, by number.

    Each is (426, 640, 3), as those of `campus_photographs`.
    """
    return _photographs("queries", 5)


def same_place_pairs(by_eye: bool = False) -> frozenset[frozenset[str]]:
    """Pairs of numbers whose photographs show the same place, from walk and queries alike.

    With ``by_eye``, also those that geometry alone could not verify.
    """
    return _pairs(f"{_SAME_PLACE} {_SAME_PLACE_BY_EYE if by_eye else ''}")


def undecided_pairs() -> frozenset[frozenset[str]]:
    """Pairs of numbers of which nobody can say whether they show the same place.

    What is counted as right or wrong should leave them out.
    """
    return _pairs(_UNDECIDED)


def _pairs(listed: str) -> frozenset[frozenset[str]]:
    return frozenset(frozenset(pair.split("-")) for pair in listed.split())


@cache
def killian_court() -> Scans:
    """3873 scans of 180 beams from MIT's Infinite Corridor round Killian Court, with poses."""
    stored = _arrays("killian_court.npz", "ranges_cm", "poses")
    angles = -np.pi / 2 + 0.017453 * np.arange(180)
    return Scans(
        _read_only(stored["ranges_cm"] / 100), _read_only(angles), stored["poses"], max_range=50.0
    )


@cache
def corridor() -> Corridor:
    """60 simulated scans of 181 beams along a corridor whose walls are known, with three people."""
    stored = _arrays("corridor.npz", "ranges", "angles", "poses", "walls", "wall_of_beam")
    ranges = _read_only(stored["ranges"].astype(np.float64))
    scans = Scans(ranges, stored["angles"], stored["poses"], max_range=20.0)
    return Corridor(scans, stored["walls"], stored["wall_of_beam"])


@cache
def brick_walls() -> PointCloud:
    """About 4000 points on two brick walls and the ground before them, from a stereo pair."""
    stored = _arrays("brick_walls.npz", "points", "colors")
    return PointCloud(_read_only(stored["points"].astype(np.float64)), stored["colors"])


def _photographs(folder: str, count: int) -> Mapping[str, NDArray[np.uint8]]:
    import cv2  # only here: it takes longer to import than everything else

    names = sorted(name for name in _checksums() if name.startswith(f"campus/{folder}/"))
    if len(names) != count:
        raise DataError(
            f"data/checksums.txt is damaged, it lists {len(names)} of the {count} photographs in "
            f"campus/{folder}; make it again: {REBUILD}"
        )
    photographs = {}
    for name in names:
        pixels = cv2.imdecode(np.frombuffer(_content(name), np.uint8), cv2.IMREAD_COLOR)
        if pixels is None:
            raise DataError(f"OpenCV cannot read data/{name}; make it again: {REBUILD}")
        number = name.rpartition("/")[2].removesuffix(".jpg")
        photographs[number] = _read_only(np.ascontiguousarray(pixels[:, :, ::-1]))
    return MappingProxyType(photographs)


def _arrays(name: str, *wanted: str) -> dict[str, NDArray[Any]]:
    with np.load(io.BytesIO(_content(name)), allow_pickle=False) as stored:
        return {key: _read_only(stored[key]) for key in wanted}


def _content(name: str) -> bytes:
    """The bytes of a data file, compared with its checksum: a JPEG hides damage otherwise."""
    content = _read(name)
    expected = _checksums().get(name, "")
    if len(expected) != 64:
        raise DataError(f"data/checksums.txt is damaged, it lacks {name}; make it again: {REBUILD}")
    if hashlib.sha256(content).hexdigest() != expected:
        raise DataError(f"data/{name} is damaged; make it again: {REBUILD}")
    return content


def _checksums() -> dict[str, str]:
    """SHA-256 of every data file by its name, as the build wrote them down."""
    lines = _read("checksums.txt").decode("utf-8", "replace").splitlines()
    return {name: digest for digest, _, name in (line.partition("  ") for line in lines)}


def _read(name: str) -> bytes:
    try:
        return (HERE / name).read_bytes()
    except OSError as error:
        reason = "is missing" if isinstance(error, FileNotFoundError) else "cannot be read"
        raise DataError(f"data/{name} {reason}; make it again: {REBUILD}") from None


def _read_only(array: NDArray[Any]) -> NDArray[Any]:
    array.setflags(write=False)
    return array
