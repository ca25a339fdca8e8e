"""A view that is shown as a widget, with its plain form beside it for where no widget runs."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import Protocol

from autograder.student.frontend import current_cell

WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"


class View(Protocol):
    """The readable form."""

    def _repr_mimebundle_(self) -> dict[str, object]: ...


class Shown(Protocol):
    """A widget; ``receipt_display`` is the output that holds its receipt, once there is one."""

    model_id: str
    topic: str
    receipt_display: object

    def receipt(self) -> dict[str, object] | None:
        """What the receipt says; None if there is none."""

    def close(self) -> None:
        """Take it off the page."""


_shown: weakref.WeakValueDictionary[tuple[object, ...], Shown] = weakref.WeakValueDictionary()


class Live:
    """A plain view that shows itself as a widget; nothing slow is loaded before that.

    Two outputs are written: the widget with the view as its readable form, and, for a question, a
    receipt that follows what is answered. The receipt is an output of its own because replacing the
    widget's would take the keyboard's focus away at every click.
    """

    def __init__(self, view: View, widget: Callable[[], Shown]) -> None:
        self.view = view
        self._widget = widget

    def __getattr__(self, name: str) -> object:
        return getattr(self.view, name)

    def __repr__(self) -> str:
        return repr(self.view)

    def _ipython_display_(self) -> None:
        from IPython.display import display

        widget = self._widget()
        bundle = self.view._repr_mimebundle_()
        bundle[WIDGET_VIEW] = {
            "version_major": 2,
            "version_minor": 0,
            "model_id": widget.model_id,
        }
        _replace(widget)
        display(bundle, raw=True)
        receipt = widget.receipt()
        if receipt is not None:
            widget.receipt_display = display(receipt, raw=True, display_id=True)


def _replace(widget: Shown) -> None:
    """Close the widget that the same cell showed before: nobody sees it any more."""
    cell = current_cell()
    if cell is None:
        return
    key = (cell, type(widget).__name__, widget.topic)
    former = _shown.get(key)
    if former is not None:
        former.close()
    _shown[key] = widget
