"""Gradescope, "Export submissions": a folder for each submission and ``submission_metadata.yml``.

The side file maps each folder or file to ``:submitters:`` (name, sid, email; several for a group)
and ``:created_at:``; earlier submissions stand under ``:history:`` and are not in the export.
"""

from __future__ import annotations

from datetime import UTC, datetime

from autograder.intake.file_or_zip import Place
from autograder.intake.layouts.layout import Context, Entry, Found, side_entry
from autograder.intake.names_in_sentences import shown
from autograder.intake.notebook_reader import Unreadable
from autograder.intake.origin import LAYOUT, Claim, Origin

SIDE_FILE = "submission_metadata.yml"
_LARGEST = 64 * 2**20


class Gradescope:
    """A folder with ``submission_metadata.yml``."""

    name = "gradescope"
    rule = f"Gradescope's export: one submission for each entry of {SIDE_FILE}"

    def recognises(self, folder: Place) -> bool:
        return any(place.name == SIDE_FILE for place in folder.children())

    def read(self, folder: Place, context: Context) -> Found:
        found = Found(self.name, self.rule)
        places = {place.name: place for place in folder.children()}
        side_file = places.pop(SIDE_FILE)
        told = _metadata(side_file)
        if told is None:
            found.warnings.append(f"{SIDE_FILE} cannot be read; export it from Gradescope again.")
            told = {}
        else:
            found.pass_over(side_file, "Gradescope's own side file; it was read", False)
        for name, about in told.items():
            place = places.pop(str(name), None)
            if not isinstance(about, dict):
                continue
            claims = tuple(_claims(about))
            if place is None:
                who = ", ".join(claim.text() for claim in claims) or "nobody"
                found.warnings.append(
                    f"{SIDE_FILE} names {shown(str(name))} of {who}, which is not in the export."
                )
                continue
            time = _time(about.get(":created_at"))
            history = about.get(":history")
            count = len(history) + 1 if isinstance(history, list) else 1
            origin = Origin(
                self.name,
                str(name),
                claims,
                f"{count} of {count}" if count > 1 else "",
                time,
                LAYOUT if time else "",
                pieces=(place.piece,),
            )
            key = ", ".join(claim.name for claim in claims if claim.name) or str(name)
            apart = claims[0].id or claims[0].email if claims else str(name)
            found.entries.append(Entry(key, origin, apart or str(name)))
        for place in places.values():
            side_entry(place, found, place.name.lower().endswith((".csv", ".yml")))
        return found


def _metadata(place: Place) -> dict[str, object] | None:
    import yaml  # type: ignore[import-untyped]

    try:
        data = place.read(_LARGEST)
        loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
        told = yaml.load(data, loader) if len(data) <= _LARGEST else None
    except (Unreadable, OSError, yaml.YAMLError, ValueError, RecursionError):
        return None
    return told if isinstance(told, dict) else None


def _claims(about: dict[str, object]) -> list[Claim]:
    people = about.get(":submitters")
    return [
        Claim(
            name=_text(person.get(":name")),
            id=_text(person.get(":sid")),
            email=_text(person.get(":email")),
        )
        for person in (people if isinstance(people, list) else ())
        if isinstance(person, dict)
    ]


def _text(value: object) -> str:
    return "" if value is None or isinstance(value, dict | list) else str(value).strip()


def _time(value: object) -> datetime | None:
    if isinstance(value, datetime):  # YAML gives times with a zone in UTC, others without any
        return value.astimezone(UTC) if value.tzinfo else value.replace(tzinfo=UTC)
    try:
        time = datetime.fromisoformat(str(value))
    except ValueError:
        return None
    return time if time.tzinfo else time.replace(tzinfo=UTC)
