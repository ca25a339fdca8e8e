"""Feedback as e-mail: a message for each person, as ``.eml`` files or sent by SMTP.

A message holds the points in words and the page as an attachment: mail programs change the styles
of pages that are shown inline. Messages are written by `email.policy.SMTP` (RFC 5322, RFC 2047).
"""

from __future__ import annotations

import smtplib
import ssl
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from email.errors import MessageError
from email.headerregistry import Address
from email.message import EmailMessage
from email.policy import SMTP
from email.utils import format_datetime, localtime, make_msgid

from autograder.course import Course
from autograder.errors import AutograderError
from autograder.exchange.printable import printable
from autograder.gradebook.record import Record
from autograder.intake.person import Person
from autograder.reports.json_output import most_for
from autograder.reports.returning.parcel import Left, Page, Parcel
from autograder.reports.whole_files import file_name


class MailError(AutograderError):
    """The mail server did not take a message."""


@dataclass(frozen=True)
class Letter:
    """One message to one person."""

    record: Record
    person: Person
    message: EmailMessage


def messages(
    course: Course, pages: Sequence[Page], title: str, sender: str
) -> tuple[list[Letter], list[Left]]:
    """A message for each person who handed in, and the work of those without an address."""
    letters, left = [], []
    for page in pages:
        if not page.record.people:
            left.append(Left(page.record, "it is not certain whose it is"))
        for person in page.record.people:
            address = _address(person.name, person.email)
            if address is None:
                alone = len(page.record.people) == 1
                whose = "there is" if alone else f"{person.name} has"
                said = f"{whose} no e-mail address in the class list"
                left.append(Left(page.record, said))
            else:
                message = _message(course, page, title, sender, address)
                letters.append(Letter(page.record, person, message))
    return letters, left


def as_parcel(letters: Sequence[Letter], left: Sequence[Left]) -> Parcel:
    """The messages as ``.eml`` files, each under its address."""
    files = {
        f"{file_name(letter.person.email)}.eml": letter.message.as_bytes(policy=SMTP)
        for letter in letters
    }
    return Parcel(files, left)


def send(
    letters: Sequence[Letter], host: str, port: int, user: str, password: str, secure: str
) -> Iterator[Letter]:
    """Send the messages one after the other, and yield each that the server took.

    ``secure`` is ``starttls``, ``tls`` or ``none``.

    Raises:
        MailError: if the server refuses; those that were yielded are on their way.
    """
    context = ssl.create_default_context()
    try:
        connection = (
            smtplib.SMTP_SSL(host, port, timeout=60, context=context)
            if secure == "tls"
            else smtplib.SMTP(host, port, timeout=60)
        )
        with connection as server:
            if secure == "starttls":
                server.starttls(context=context)
            if user:
                server.login(user, password)
            for letter in letters:
                server.send_message(letter.message)
                yield letter
    except (OSError, smtplib.SMTPException) as error:
        raise MailError(
            f"{host}:{port} refused: {error}. Messages named above were sent; the others were not."
        ) from None


def _message(course: Course, page: Page, title: str, sender: str, address: Address) -> EmailMessage:
    record = page.record
    message = EmailMessage(policy=SMTP)
    message["Subject"] = _line(f"Feedback: {title}")
    if sender:
        message["From"] = _line(sender)
    message["To"] = address
    message["Date"] = format_datetime(localtime())
    message["Message-ID"] = make_msgid(domain="autograder.invalid")
    message["X-Unsent"] = "1"  # Outlook opens the file as a draft, ready to send
    points = f"{record.total:g} of {most_for(course, record):g} points"
    open_ones = (
        f" so far; {', '.join(record.open)} will be marked by a person." if record.open else "."
    )
    message.set_content(
        f"Dear {_line(record.name)},\n\nyour work for {_line(title)} has {points}{open_ones}\n"
        "The attached page tells you more; open it in a browser.\n"
    )
    message.add_attachment(
        page.html.encode(), maintype="text", subtype="html", filename="feedback.html"
    )
    return message


def _address(name: str, email: str) -> Address | None:
    try:
        found = Address(_line(name), addr_spec=email.strip()) if email.strip() else None
    except (ValueError, MessageError, IndexError):
        return None
    return found if found is not None and found.domain else None


def _line(text: str) -> str:
    return " ".join(printable(text, " ").split())
