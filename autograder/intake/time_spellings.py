"""How people and systems write a time, and the names of the months in their languages."""

from __future__ import annotations

import re
from datetime import UTC, datetime, tzinfo

_MONTHS = {
    name: number
    for names in (
        "january february march april may june july august september october november december",
        "januar februar märz april mai juni juli august september oktober november dezember",
        "janvier février mars avril mai juin juillet août septembre octobre novembre décembre",
        "enero febrero marzo abril mayo junio julio agosto septiembre octubre noviembre diciembre",
        "gennaio febbraio marzo aprile maggio giugno luglio agosto settembre ottobre novembre "
        "dicembre",
        "janeiro fevereiro março abril maio junho julho agosto setembro outubro novembro dezembro",
        "januari februari maart april mei juni juli augustus september oktober november december",
        "jan feb mar apr may jun jul aug sep oct nov dec",
    )
    for number, name in enumerate(names.split(), 1)
}
_WRITTEN = re.compile(
    r"(?:(?P<day>\d{1,2})\.?\s+(?:de\s+)?(?P<month>[^\W\d]{3,})|(?P<month2>[^\W\d]{3,})\s+(?P<day2>\d{1,2}))"
    r"\.?,?\s+(?:de\s+)?(?P<year>\d{4}),?\s+(?:at\s+|um\s+|à\s+)?"
    r"(?P<hour>\d{1,2})[:h.](?P<minute>\d\d)(?::(?P<second>\d\d))?\s*(?P<half>[ap]\.?m\.?)?",
    re.IGNORECASE,
)
_NUMERIC = re.compile(
    r"(?P<day>\d{1,2})\.(?P<month>\d{1,2})\.(?P<year>\d{4}),?\s+"
    r"(?P<hour>\d{1,2}):(?P<minute>\d\d)(?::(?P<second>\d\d))?"
)


def read_time(text: str, zone: tzinfo | None) -> datetime | None:
    """A time as people and systems write it; without a zone it is in ``zone`` or this machine's.

    ISO 8601, ``1.11.2026 12:30``, and Moodle's ``Sunday, 1 November 2026, 12:30 PM``. Dates of
    numbers and slashes are not read: they mean two things.
    """
    text = " ".join(text.split())
    if not text or text == "-":
        return None
    try:
        return _with_zone(datetime.fromisoformat(re.sub(r" ?(UTC|GMT)$", "+00:00", text)), zone)
    except ValueError:
        pass
    spaced = re.fullmatch(r"(\d{4}-\d\d-\d\d \d\d:\d\d(?::\d\d(?:\.\d+)?)?) ([+-]\d\d:?\d\d)", text)
    if spaced:
        try:
            return _with_zone(datetime.fromisoformat(spaced[1] + spaced[2]), zone)
        except ValueError:
            return None
    found = _WRITTEN.search(text)
    numeric = None if found else _NUMERIC.search(text)
    if found is None and numeric is None:
        return None
    try:
        if found is not None:
            month = _MONTHS[(found["month"] or found["month2"]).casefold()]
            day, half = int(found["day"] or found["day2"]), (found["half"] or "").lower()
            hour = int(found["hour"])
            if half:
                hour = hour % 12 + (12 if half[0] == "p" else 0)
            parts = found
        else:
            assert numeric is not None
            parts, month, day, hour = (
                numeric,
                int(numeric["month"]),
                int(numeric["day"]),
                int(numeric["hour"]),
            )
        second = int(parts["second"] or 0)
        time = datetime(int(parts["year"]), month, day, hour, int(parts["minute"]), second)
        return _with_zone(time, zone)
    except (KeyError, ValueError):
        return None


def _with_zone(time: datetime, zone: tzinfo | None) -> datetime:
    if time.tzinfo is not None:
        return time
    return time.astimezone(UTC) if zone is None else time.replace(tzinfo=zone)
