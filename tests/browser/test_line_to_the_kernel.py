"""What a widget says of its answers, with a kernel that the test plays itself."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

import autograder.student.widgets as widgets

HELPERS = [Path(widgets.__file__).with_name(f"{name}.js") for name in ("common", "kernel_line")]
# A model as anywidget hands it out. `sent` are the messages, `answer` is the kernel's reply to all
# views, as it comes: a view must know its own.
KERNEL = """
const listeners = {};
const sent = [];
const own = { comm_live: true, widget_manager: { kernel: { status: "idle" } } };
const model = {
  on: (name, listener) => (listeners[name] ??= []).push(listener),
  off: (name, listener) => (listeners[name] = listeners[name].filter((l) => l !== listener)),
  set: (name) => (listeners[`change:${name}`] ?? []).forEach((listener) => listener(own)),
  send: (message) => sent.push(message),
};
const answer = (reply) => listeners["msg:custom"].forEach((listener) => listener(reply));
function open(unkept) {
  const view = { said: [], live: [], drawn: [] };
  view.send = connect({
    model,
    el: document.body,
    tell: (text, kind) => view.said.push(text),
    live: (yes) => view.live.push(yes),
    draw: (lost) => view.drawn.push(lost === true),
    unkept,
  });
  return view;
}
"""


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    context = browser.new_context()
    opened = context.new_page()
    helpers = "\n".join(path.read_text(encoding="utf-8") for path in HELPERS)
    opened.add_script_tag(content=helpers + KERNEL)
    yield opened
    context.close()


def test_a_reply_to_one_tab_is_not_taken_for_one_to_another(page: Page):
    said = page.evaluate(
        """() => {
            const [one, other] = [open(), open()];
            one.send({ do: "choose" });
            other.send({ do: "choose" });
            answer({ seq: sent[0].seq, ok: true, said: "" });
            return [one.said.at(-1), other.said.at(-1)];
        }"""
    )
    assert said == ["Kept.", ""]


def test_a_refusal_is_not_hidden_by_the_answer_after_it(page: Page):
    said = page.evaluate(
        """() => {
            const view = open();
            view.send({ do: "choose" });
            view.send({ do: "choose" });
            answer({ seq: sent[0].seq, ok: false, said: "NOT saved." });
            answer({ seq: sent[1].seq, ok: true, said: "" });
            const first = view.said.at(-1);
            view.send({ do: "choose" });
            answer({ seq: sent[2].seq, ok: true, said: "" });
            return [first, view.said.at(-1)];
        }"""
    )
    assert said == ["NOT saved.", "Kept."]


def test_a_click_that_finds_the_kernel_gone_is_not_kept_and_says_so(page: Page):
    said, replies, live, drawn = page.evaluate(
        """async () => {
            const view = open();
            own.widget_manager.kernel.status = "dead";
            const replies = [await view.send({ do: "choose" }), await view.send({ do: "order" })];
            return [view.said.at(-1), replies, view.live, view.drawn.slice(-2)];
        }"""
    )
    assert said.startswith("Your last answer was NOT kept. This is what was kept last")
    assert replies == [None, None]
    assert live == [False, False]  # off until the kernel has answered, and off for good
    assert drawn == [True, True]  # what was moved after the end goes back too


def test_an_answer_under_way_when_the_kernel_ends_is_not_kept(page: Page):
    said, reply = page.evaluate(
        """async () => {
            const view = open();
            const reply = view.send({ do: "choose" });
            own.comm_live = false;
            listeners["comm_live_update"].forEach((listener) => listener());
            return [view.said.at(-1), await reply];
        }"""
    )
    assert said.startswith("Your last answer was NOT kept. ")
    assert reply is None


def test_what_was_typed_and_not_kept_is_repeated_once_the_kernel_has_gone(page: Page):
    said = page.evaluate(
        """() => {
            const view = open(() => "2*(w+1");
            own.widget_manager.kernel.status = "dead";
            listeners["comm_live_update"].forEach((listener) => listener());
            return view.said.at(-1);
        }"""
    )
    assert said.startswith("Your last answer was NOT kept: 2*(w+1. This is what was kept last")
