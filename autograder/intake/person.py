"""A person of the class, as the learning systems know them."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime


@dataclass(frozen=True)
class Person:
    """One student of the class; what is not known is empty.

    ``id`` is the learning system's own number, ``sis_id`` the university's, ``github`` a login
    there, ``number`` Moodle's participant number (for one assignment only), and ``submission`` the
    name of what they handed in where it is called none of these. ``handed_in`` is a time that
    settles it, ``noted_time`` what a grading worksheet says.
    """

    name: str
    id: str = ""
    sis_id: str = ""
    login: str = ""
    email: str = ""
    section: str = ""
    submission: str = ""
    extension_days: float = 0.0
    handed_in: datetime | None = None
    github: str = ""
    number: str = ""
    noted_time: datetime | None = None

    def identifiers(self) -> tuple[str, ...]:
        """What belongs to this person alone: login, e-mail, ids; never the name."""
        found = (self.login, self.email, self.id, self.sis_id, self.github)
        return tuple(dict.fromkeys(text for text in found if text))

    def names_said(self) -> tuple[str, ...]:
        """Everything that they may call themselves in a notebook."""
        last, comma, first = self.name.partition(",")
        turned = f"{first.strip()} {last.strip()}" if comma else ""
        said = (self.name, turned, self.number, *self.identifiers())
        return tuple(dict.fromkeys(text for text in said if text.strip()))

    def text(self) -> str:
        """The person for a list: the name, and what tells two of one name apart."""
        apart = self.email or self.login or self.sis_id or self.id or self.github
        return f"{self.name} ({apart})" if apart and apart != self.name else self.name
