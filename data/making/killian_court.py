"""The Killian Court scans: text records of the package rtb-data, stored as one array file."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np

from data.making.archive import write_arrays

BEAMS = 180


def make_killian_court(source: Path, target: Path) -> None:
    """Write ranges (3873, 180) in centimetres and poses (3873, 3) in m, m, rad.

    A record reads ``ROBOTLASER1 type start field step maximum accuracy mode BEAMS`` and then
    the ranges; the pose of scan i is ``VERTEX_SE2 i x y theta``.
    """
    with zipfile.ZipFile(source / "data" / "killian.g2o.zip") as archive:
        records = [line.split() for line in archive.read("killian.g2o").decode().splitlines()]
    ranges = np.array([r[9 : 9 + BEAMS] for r in records if r[0] == "ROBOTLASER1"], dtype=float)
    poses = np.array([r[2:5] for r in records if r[0] == "VERTEX_SE2"], dtype=float)
    write_arrays(
        target / "killian_court.npz",
        ranges_cm=np.rint(ranges * 100).astype(np.uint16),  # exact: the scanner's own steps
        poses=poses,
    )
