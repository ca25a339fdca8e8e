"""Makes the data again from their sources, and compares them with what is shipped.

::

    uv run --group data python -m data.build           # write everything and its checksums
    uv run --group data python -m data.build --check   # make everything elsewhere and compare
    uv run python -m data.build --verify               # compare the files with their checksums

The array files of Killian Court and the corridor come out the same byte for byte. The photographs
depend on OpenCV's JPEG encoder and the brick walls on its SIFT, so another version of OpenCV may
write other bytes with the same meaning; ``--check`` names them.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
CHECKSUMS = HERE / "checksums.txt"
DATA = ("campus/**/*.jpg", "*.npz")


def build(target: Path) -> None:
    """Make every data set in ``target`` from the two installed packages."""
    from data.making.brick_walls import make_brick_walls
    from data.making.campus import make_campus
    from data.making.corridor import make_corridor
    from data.making.killian_court import make_killian_court

    make_campus(package("mvtbdata"), target / "campus")
    make_killian_court(package("rtbdata"), target)
    make_brick_walls(package("mvtbdata"), target)
    make_corridor(target)


def package(name: str) -> Path:
    """The folder of an installed source package."""
    found = importlib.util.find_spec(name)
    if found is None or not found.submodule_search_locations:
        sys.exit(f"The package {name} is missing; run this with: uv run --group data python -m ...")
    return Path(found.submodule_search_locations[0])


def checksums(folder: Path) -> dict[str, str]:
    """SHA-256 of every data file, by its name below the folder."""
    return {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for pattern in DATA
        for path in sorted(folder.glob(pattern))
    }


def stored_checksums() -> dict[str, str]:
    """What `build` wrote down."""
    lines = CHECKSUMS.read_text(encoding="utf-8").splitlines()
    return {name: digest for digest, _, name in (line.partition("  ") for line in lines)}


def main(arguments: list[str] | None = None) -> int:
    """Build, check or verify, as the command line says; return the exit status."""
    parser = argparse.ArgumentParser(
        prog="python -m data.build",
        description="Make the data again from their sources, and overwrite what is there.",
        allow_abbrev=False,
    )
    instead = parser.add_mutually_exclusive_group()
    instead.add_argument("--check", action="store_true", help="make them elsewhere and compare")
    instead.add_argument("--verify", action="store_true", help="only compare with the checksums")
    chosen = parser.parse_args(arguments)
    if chosen.verify:
        return _report(checksums(HERE))
    if chosen.check:
        with tempfile.TemporaryDirectory() as folder:
            build(Path(folder))
            return _report(checksums(Path(folder)))
    build(HERE)
    lines = [f"{digest}  {name}\n" for name, digest in checksums(HERE).items()]
    CHECKSUMS.write_text("".join(lines), encoding="utf-8")
    return 0


def _report(found: dict[str, str]) -> int:
    stored = stored_checksums()
    different = sorted(name for name in stored | found if stored.get(name) != found.get(name))
    for name in different:
        print(f"{name} differs from its checksum")
    print(f"{len(stored) - len(different)} of {len(stored)} files are as they were.")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
