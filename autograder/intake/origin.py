"""Where a submission comes from: what its place in a download says, never what is inside it.

This is kept in the gradebook with the submission, so that exports and feedback can go back to where
the work came from, and so that whose it is can be settled later, without running anything again.
"""

from __future__ import annotations

import os
from dataclasses import asdict, dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from urllib.parse import unquote_to_bytes

from autograder.exchange.messages import Message

LAYOUT, TIMES_FILE, CLASS_LIST, INSIDE, FILE = (
    "layout",  # a side file, a name or a repository of the download
    "times.csv",
    "class list",
    "submit()",  # written into the zip where students can change it: a hint
    "file",  # the file's own time, often that of the download
)


@dataclass(frozen=True)
class Claim:
    """What a download says about one person who handed something in; what it does not say is "".

    ``name`` is written as the layout has it, ``number`` is Moodle's participant number, which
    counts for one assignment only, and ``called`` may be any of a person's names, as where a zip is
    called ``ada.zip``.
    """

    name: str = ""
    login: str = ""
    email: str = ""
    id: str = ""
    number: str = ""
    called: str = ""

    def text(self) -> str:
        """The claim for a person to read."""
        return self.name or self.called or self.login or self.email or self.id or self.number


@dataclass(frozen=True)
class Piece:
    """A part of a submission: a file or folder, or what is ``inside`` a zip there.

    ``inside`` leads from the zip at ``path`` to an entry of it, and from there, if that is a zip
    too, to an entry of that one. An entry that ends in ``/`` stands for everything below it. With a
    ``commit`` the files are those that the repository at the place had at that time.
    """

    path: Path
    inside: tuple[str, ...] = ()
    commit: str = ""

    @property
    def name(self) -> str:
        """The last name on the way to the piece."""
        return self.inside[-1].rstrip("/").rpartition("/")[2] if self.inside else self.path.name


@dataclass(frozen=True)
class Origin:
    """Where a submission comes from.

    ``prefix`` is what its files or its folder are called in the download: Moodle's feedback import
    wants it back, and ``students.toml`` names the submission by it. ``handed_in`` knows its zone;
    ``time_from`` says where it was found. There are several ``claims`` when a group hands in.
    """

    layout: str = "plain"
    prefix: str = ""
    claims: tuple[Claim, ...] = ()
    attempt: str = ""
    handed_in: datetime | None = None
    time_from: str = ""
    called_late: bool = False  # the layout itself says so
    pieces: tuple[Piece, ...] = ()

    def at(self, time: datetime | None, time_from: str) -> Origin:
        """The same, handed in at another time."""
        return replace(self, handed_in=time, time_from=time_from if time is not None else "")

    def to_dict(self) -> dict[str, object]:
        """As plain data, for the gradebook."""
        table: dict[str, object] = {"layout": self.layout, "prefix": self.prefix}
        table["claims"] = [
            {key: value for key, value in asdict(claim).items() if value} for claim in self.claims
        ]
        table |= {"attempt": self.attempt, "time_from": self.time_from}
        table["handed_in"] = as_utc_text(self.handed_in)
        table["called_late"] = self.called_late
        table["pieces"] = [
            {"path": path_to_text(piece.path), "inside": piece.inside, "commit": piece.commit}
            for piece in self.pieces
        ]
        return table

    @staticmethod
    def from_dict(table: Message) -> Origin:
        """What `to_dict` wrote; nothing was written before the gradebook kept origins."""
        handed_in = table.get("handed_in")
        return Origin(
            table.get("layout", "plain"),
            table.get("prefix", ""),
            tuple(Claim(**claim) for claim in table.get("claims", ())),
            table.get("attempt", ""),
            datetime.fromisoformat(handed_in) if handed_in else None,
            table.get("time_from", ""),
            table.get("called_late", False),
            tuple(
                Piece(path_from_text(p["path"]), tuple(p["inside"]), p.get("commit", ""))
                for p in table.get("pieces", ())
            ),
        )


def as_utc_text(time: datetime | None) -> str | None:
    """A time in UTC, ISO 8601, to the second."""
    return None if time is None else time.astimezone(UTC).isoformat(timespec="seconds")


def path_to_text(path: Path) -> str:
    """A path as text that any database takes."""
    try:
        str(path).encode()
    except UnicodeEncodeError:  # a name that is not UTF-8, which SQLite would refuse
        return path.as_uri()
    return str(path)


def path_from_text(text: str) -> Path:
    """What `path_to_text` wrote."""
    if text.startswith("file://"):
        return Path(os.fsdecode(unquote_to_bytes(text.removeprefix("file://"))))
    return Path(text)
