"""Marking on a page: served to this machine alone, at an address that holds a token."""

from __future__ import annotations

import argparse
import secrets
from collections.abc import Callable, Iterable
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, HTTPServer
from urllib.parse import parse_qs, urlsplit

from rich.console import Console

from autograder.errors import UsageError
from autograder.gradebook import Gradebook
from autograder.gradebook.by_hand import Item, give
from autograder.reports.html_page import page
from autograder.reports.markdown import isolated, markdown, text

MOST_BYTES = 200_000


def serve(
    parsed: argparse.Namespace,
    console: Console,
    book: Gradebook,
    look: Callable[[], list[Item]],
    marked: set[str],
) -> None:
    """Serve until Ctrl-C; students that were marked are added to ``marked``."""
    server = make_server(parsed.port, parsed.anonymous, parsed.author, book, look, marked)
    console.print(f"Mark at {server.address}  (Ctrl-C ends it)", markup=False, soft_wrap=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        console.print("")
    finally:
        server.server_close()


class MarkServer(HTTPServer):
    """One request after the other, so that the gradebook has one writer."""

    address = ""


def make_server(
    port: int,
    anonymous: bool,
    author: str,
    book: Gradebook,
    look: Callable[[], list[Item]],
    marked: set[str],
) -> MarkServer:
    """The server, listening on loopback only; ``address`` is where to go."""
    token = secrets.token_urlsafe(24)
    pages = _Pages(token, anonymous, author, book, look, marked)

    class Handler(BaseHTTPRequestHandler):
        timeout = 30

        def do_GET(self) -> None:
            self._answer(None)

        def do_POST(self) -> None:
            size = self.headers.get("Content-Length", "")
            if not size.isdigit() or int(size) > MOST_BYTES:
                self.send_error(HTTPStatus.REQUEST_ENTITY_TOO_LARGE)
                return
            body = self.rfile.read(int(size)).decode("utf-8", "replace")
            self._answer({k: v[-1] for k, v in parse_qs(body, max_num_fields=200).items()})

        def _answer(self, form: dict[str, str] | None) -> None:
            here = f"127.0.0.1:{server.server_port}"
            origin = self.headers.get("Origin")
            path = urlsplit(self.path)
            at_home = self.headers.get("Host") == here and origin in (None, f"http://{here}")
            if not at_home or not secrets.compare_digest(path.path.encode(), f"/{token}/".encode()):
                self.send_error(HTTPStatus.NOT_FOUND)
                return
            said = ""
            if form is not None:
                said = pages.take(form)
                if not said:
                    self.send_response(HTTPStatus.SEE_OTHER)
                    after = f"?after={form['item']}" if "later" in form else ""
                    self.send_header("Location", f"/{token}/{after}")
                    self.send_header("Content-Length", "0")
                    self.end_headers()
                    return
            after = parse_qs(path.query).get("after", [""])[-1]
            html = pages.show(form["item"] if form else "", after, said, form or {}).encode()
            self.send_response(HTTPStatus.OK)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(html)))
            self.send_header("Cache-Control", "no-store")
            self.send_header("Referrer-Policy", "same-origin")
            self.end_headers()
            self.wfile.write(html)

        def log_message(self, format: str, *args: object) -> None:
            """Say nothing: the terminal is for people."""

    server = MarkServer(("127.0.0.1", port), Handler)
    server.address = f"http://127.0.0.1:{server.server_port}/{token}/"
    return server


class _Pages:
    def __init__(
        self,
        salt: str,
        anonymous: bool,
        author: str,
        book: Gradebook,
        look: Callable[[], list[Item]],
        marked: set[str],
    ) -> None:
        self._salt, self._anonymous, self._author = salt, anonymous, author
        self._book, self._look, self._marked = book, look, marked

    def take(self, form: dict[str, str]) -> str:
        """Keep a verdict; returns what is wrong with it, or nothing."""
        form.setdefault("item", "")
        item = self._find(self._look(), form["item"])
        if item is None or "later" in form:
            return ""  # somebody else has marked it by now
        levels = {
            criterion.name: criterion.levels[int(chosen)].name
            for number, criterion in enumerate(item.rubric)
            if (chosen := form.get(f"c{number}", "")).isdecimal()
            and int(chosen) < len(criterion.levels)
        }
        try:
            points = float(form["points"]) if form.get("points") else None
            give(self._book, item, levels, points, form.get("comment", ""), self._author)
        except (UsageError, ValueError) as error:
            return str(error)
        self._marked.add(item.record.student)
        return ""

    def show(self, chosen: str, after: str, said: str, form: dict[str, str]) -> str:
        """The page of an item: the chosen one, the one after another, or the first."""
        items = self._look()
        if not items:
            return page("Marking", "<h1>Everything is marked</h1>", "<p>Close this page.</p>", "")
        names = [item.secret_name(self._salt) for item in items]
        at = names.index(chosen) if chosen in names else 0
        if after in names:
            at = (names.index(after) + 1) % len(items)
        item = items[at]
        who = "" if self._anonymous else f" · {isolated(item.called)}"
        header = (
            f"<h1>{text(item.question.id)} · {text(item.question.title)}</h1>"
            f'<p class="soft">{at + 1} of {len(items)} that wait{who}: {text(item.why)}.</p>'
        )
        problem = f'<p class="byhand" role="alert">{text(said)}</p>' if said else ""
        response = markdown(item.response) if item.response else "<p>Nothing can be shown.</p>"
        main = (
            f"{problem}<details open><summary>The question</summary>"
            f"{markdown(item.question.prompt)}</details>"
            f'<p class="label">The answer</p><div class="said prose">{response}</div>'
            f'<form method="post" action="/{self._salt}/">'
            f'<input type="hidden" name="item" value="{names[at]}">'
            f"{''.join(_fields(item, form))}"
            '<label>Comment for the student<textarea name="comment" rows="3">'
            f"{text(form.get('comment', ''))}</textarea></label>"
            "<p><button>Keep, and the next</button> "
            '<button class="quiet" name="later" value="1" formnovalidate>Later</button></p></form>'
        )
        footer = "<p>Each verdict is kept at once, with your name and the time.</p>"
        return page("Marking", header, main, footer, forms=True)

    def _find(self, items: list[Item], name: str) -> Item | None:
        return next((item for item in items if item.secret_name(self._salt) == name), None)


def _fields(item: Item, form: dict[str, str]) -> Iterable[str]:
    if not item.rubric:
        yield (
            f'<label>Points of {item.question.points:g} <input type="number" name="points" min="0" '
            f'step="0.25" required value="{text(form.get("points", ""))}"></label>'
        )
    for number, criterion in enumerate(item.rubric):
        choices = "".join(
            f'<label><input type="radio" name="c{number}" value="{place}" required'
            f"{' checked' if form.get(f'c{number}') == str(place) else ''}> "
            f'{text(level.name)} <span class="soft">({level.points:g})</span></label>'
            for place, level in enumerate(criterion.levels)
        )
        yield f"<fieldset><legend>{text(criterion.name)}</legend>{choices}</fieldset>"
