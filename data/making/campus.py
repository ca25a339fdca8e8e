"""The campus photographs: PNG from the package mvtb-data, stored as JPEG."""

from __future__ import annotations

from pathlib import Path

import cv2

QUALITY = 88


def make_campus(source: Path, target: Path) -> None:
    """Write 20 photographs of the walk to ``target/walk`` and 5 queries to ``target/queries``."""
    images = source / "images" / "campus"
    for folder, paths in {
        "walk": sorted(images.glob("*.png")),
        "queries": sorted((images / "holdout").glob("*.png")),
    }.items():
        (target / folder).mkdir(parents=True, exist_ok=True)
        for path in paths:
            name = path.stem.removeprefix("P107")  # P1070491 -> 0491
            jpeg = target / folder / f"{name}.jpg"
            cv2.imwrite(str(jpeg), cv2.imread(str(path)), [cv2.IMWRITE_JPEG_QUALITY, QUALITY])
