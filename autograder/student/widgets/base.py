"""What all widgets of the course share: messages that are answered, and a state that follows."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

import anywidget
import traitlets

from autograder.errors import AutograderError
from autograder.language import _
from autograder.student.desk import Desk
from autograder.student.receipts import RECEIPT, receipt

if TYPE_CHECKING:
    from IPython.display import DisplayHandle

_HERE = Path(__file__).parent
SENTENCE = re.compile(r'\bt\(\s*"((?:[^"\\]|\\.)*)"')  # in a widget's module: t("Kept.")


@lru_cache(maxsize=32)
def source(*names: str | Path) -> str:
    """Files, one after the other: a module and the helpers it uses, which are in this folder."""
    return "\n".join((_HERE / name).read_text(encoding="utf-8") for name in names)


def sentences(module: str) -> dict[str, str]:
    """The sentences of a widget's module that the spoken language has in other words."""
    written = dict.fromkeys(SENTENCE.findall(module))
    return {text: sentence for text in written if (sentence := _(text)) != text}


def escaped(text: str) -> str:
    """Text as HTML that shows it."""
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def receipt_output(words: str, id: str, response: object) -> dict[str, object]:
    """The output that says in words what was kept, with the receipt where anything was."""
    output: dict[str, object] = {
        "text/plain": words,
        # Hidden while the widget itself is drawn.
        "text/html": f'<p class="autograder-receipt"><small>{escaped(words)}</small></p>',
    }
    if response is not None:
        output[RECEIPT] = receipt(id, response)
    return output


class CourseWidget(anywidget.AnyWidget):
    """A widget whose truth lies in the desk's files and never in the browser.

    The browser sends ``{"seq": n, "do": name, ...}``. The method ``do_name`` acts, the state is
    sent, and then ``{"seq": n, "ok": ..., "said": ...}``: only this reply tells the browser that
    an answer is kept.
    """

    _css = source("common.css")
    fixed = traitlets.Dict().tag(sync=True)  # what is asked
    state = traitlets.Dict().tag(sync=True)  # what is answered
    translated = traitlets.Dict().tag(sync=True)  # its sentences, in the language that is spoken

    topic = ""  # what it is about: a question's id, or nothing

    def __init__(self, desk: Desk) -> None:
        self.desk = desk
        self.receipt_display: DisplayHandle | None = None
        translated = sentences(str(self._esm))
        super().__init__(
            fixed=self.what_is_fixed(), state=self.what_is_kept(), translated=translated
        )
        self.on_msg(self._receive)
        desk.watch(self)

    def what_is_fixed(self) -> dict[str, object]:
        """What the browser needs once."""
        raise NotImplementedError

    def what_is_kept(self) -> dict[str, object]:
        """What the browser shows as answered, read anew from the truth."""
        raise NotImplementedError

    def receipt(self) -> dict[str, object] | None:
        """The output that stays readable in the saved notebook."""
        return None

    def follow(self, id: str) -> None:
        """Show the truth again after the question with this id has changed."""
        if self.topic in ("", id):
            self.state = self.what_is_kept()
            receipt = self.receipt()
            if self.receipt_display is not None and receipt is not None:
                self.receipt_display.update(receipt, raw=True)

    def close(self) -> None:
        """Take the widget off the desk too, with all that belongs to it."""
        self.desk.unwatch(self)
        self.layout.close()
        super().close()

    def _receive(self, widget: object, message: dict[str, object], buffers: object) -> None:
        reply: dict[str, object] = {"seq": message.get("seq"), "ok": True, "said": ""}
        try:
            reply |= getattr(self, f"do_{message['do']}")(message) or {}
        except AutograderError as error:
            reply |= {"ok": False, "said": str(error)}
        except Exception as error:
            reply |= {
                "ok": False,
                "said": _("This did not work ({error}); run the cell again.").format(
                    error=type(error).__name__
                ),
            }
        self.state = self.what_is_kept()
        self.send(reply)

    def do_hello(self, message: dict[str, object]) -> dict[str, object]:
        """The browser asks whether anybody is here."""
        return {}
