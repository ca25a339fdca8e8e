// Cards to put in order: drag them, use their buttons, or use the arrow keys.
//
// The list has one tab stop (roving tabindex). Arrow keys go from card to card; with a card picked
// up (Space or Enter), or with Alt held, they move it. The card that moves is never taken out of the
// page: its neighbours are, so that it keeps the focus and the pointer.

const THRESHOLD = 4; // px before a press becomes a drag

function render({ model, el }) {
  const { cards, label } = model.get("fixed");
  const help = uniqueId("help");
  const list = make("ol", { class: "ag-cards", "aria-label": label });
  const byId = new Map();
  let picked = null; // {card, before}: the card picked up by a key, and the order to go back to

  for (const { id, text, html } of cards) {
    const grip = make("button", {
      type: "button",
      class: "ag-grip",
      tabindex: "-1",
      "aria-describedby": help,
    });
    grip.append(make("span", { "aria-hidden": "true" }, "⠿"));
    const up = button("▲", t("Move up: {text}", { text }), () => step(card, -1));
    const down = button("▼", t("Move down: {text}", { text }), () => step(card, 1));
    const part = make("div", { class: "ag-part", hidden: true });
    const words = make("span", { class: "ag-text", html });
    const item = make("li", { class: "ag-card" }, grip, words, part, up, down);
    const card = { id, text, item, grip, part };
    keepKeys(grip, up, down);
    grip.addEventListener("keydown", (event) => onKey(event, card));
    grip.addEventListener("blur", () => putDown());
    grip.addEventListener("focus", () => rove(card));
    item.addEventListener("pointerdown", (event) => drag(event, card));
    byId.set(id, card);
    list.append(item);
  }

  function button(sign, name, onclick) {
    const sighted = make("span", { "aria-hidden": "true" }, sign);
    const attributes = { type: "button", class: "ag-step", tabindex: "-1", title: name };
    return make("button", { ...attributes, "aria-label": name, onclick }, sighted);
  }

  const order = () => [...list.children].map((item) => cardOf(item).id);
  const cardOf = (item) => [...byId.values()].find((card) => card.item === item);
  const place = (card) => [...list.children].indexOf(card.item);
  const said = ({ text }, at) => ({ text, place: at + 1, count: cards.length });

  function rove(card) {
    for (const other of byId.values()) other.grip.tabIndex = other === card ? 0 : -1;
  }

  function name() {
    [...list.children].forEach((item, at) => {
      const card = cardOf(item);
      const label = t("{text}, {place} of {count}", said(card, at));
      card.grip.setAttribute("aria-label", picked?.card === card ? `${label}, ${t("picked up")}` : label);
    });
  }

  // Put the card at a place by moving its neighbours past it.
  function shift(card, to) {
    to = Math.max(0, Math.min(cards.length - 1, to));
    while (place(card) > to) card.item.after(card.item.previousElementSibling);
    while (place(card) < to) card.item.before(card.item.nextElementSibling);
    name();
  }

  function keep() {
    frame.send({ do: "order", cards: order() });
  }

  function step(card, by) {
    const to = place(card) + by;
    if (to < 0 || to >= cards.length) {
      frame.announce(by < 0 ? t("{text} is first already.", card) : t("{text} is last already.", card));
      return;
    }
    shift(card, to);
    card.item.scrollIntoView({ block: "nearest" });
    frame.announce(t("{text}: now {place} of {count}.", said(card, to)));
    keep();
  }

  function putDown() {
    if (!picked) return;
    const { card } = picked;
    picked = null;
    card.item.classList.remove("ag-picked");
    name();
  }

  function onKey(event, card) {
    const by = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (by && (event.altKey || picked)) step(card, by);
    else if (by) list.children[place(card) + by]?.querySelector(".ag-grip").focus();
    else if (event.key === "Home") list.firstElementChild.querySelector(".ag-grip").focus();
    else if (event.key === "End") list.lastElementChild.querySelector(".ag-grip").focus();
    else if (event.key === " " || event.key === "Enter") {
      if (picked) {
        putDown();
        frame.announce(t("{text} put down, {place} of {count}.", said(card, place(card))));
      } else {
        picked = { card, before: order() };
        card.item.classList.add("ag-picked");
        name();
        frame.announce(
          t("{text} picked up. Arrow keys move it, Space puts it down, Escape takes it back.", card),
        );
      }
    } else if (event.key === "Escape" && picked) {
      const { before } = picked;
      putDown();
      if (before.join() !== order().join()) {
        shift(card, before.indexOf(card.id));
        keep();
      }
      frame.announce(t("{text} is back, {place} of {count}.", said(card, place(card))));
    } else return;
    event.preventDefault();
  }

  function drag(event, card) {
    const onGrip = event.target.closest(".ag-grip") !== null;
    if (event.button !== 0 || event.target.closest(".ag-step") || list.closest(":disabled")) return;
    if (event.pointerType !== "mouse" && !onGrip) return; // a finger beside the grip scrolls
    const before = order();
    const startY = event.clientY;
    let moving = false;

    function move(event) {
      if (!moving && Math.abs(event.clientY - startY) < THRESHOLD) return;
      if (!moving) {
        moving = true;
        card.item.classList.add("ag-dragged");
      }
      event.preventDefault();
      const middle = (item) => {
        const box = item.getBoundingClientRect();
        return box.top + box.height / 2;
      };
      let previous = card.item.previousElementSibling;
      let following = card.item.nextElementSibling;
      while (previous && event.clientY < middle(previous)) {
        shift(card, place(card) - 1);
        previous = card.item.previousElementSibling;
      }
      while (following && event.clientY > middle(following)) {
        shift(card, place(card) + 1);
        following = card.item.nextElementSibling;
      }
    }

    function end(event) {
      document.removeEventListener("pointermove", move);
      document.removeEventListener("pointerup", end);
      document.removeEventListener("pointercancel", end);
      card.item.classList.remove("ag-dragged");
      if (event.type === "pointercancel") shift(card, before.indexOf(card.id));
      if (before.join() === order().join()) return;
      frame.announce(t("{text}: now {place} of {count}.", said(card, place(card))));
      keep();
    }

    document.addEventListener("pointermove", move, { passive: false });
    document.addEventListener("pointerup", end);
    document.addEventListener("pointercancel", end);
    if (!onGrip) event.preventDefault(); // no text is selected; a press on the grip may focus it
  }

  function draw(state) {
    const kept = state.response ?? cards.map(({ id }) => id);
    if (kept.join() !== order().join()) {
      const focused = document.activeElement;
      list.append(...kept.map((id) => byId.get(id).item));
      if (list.contains(focused)) focused.focus(); // moving an element takes the focus from it
    }
    const parts = state.mark?.parts ?? [];
    // Only what is out of place: that a card need not move does not mean that its number is right.
    kept.forEach((id, at) => {
      drawPart(byId.get(id).part, parts[at]?.right === false ? parts[at] : null, t("out of place"));
    });
    name();
    if (![...byId.values()].some(({ grip }) => grip.tabIndex === 0)) rove(byId.get(kept[0]));
  }

  const frame = openQuestion({ model, el, draw });
  frame.body.append(
    make(
      "p",
      { class: "ag-help", id: help },
      t("Drag a card by its handle or use its arrows. By keyboard: arrow keys choose a card, Space picks it up and puts it down, arrow keys move it, Escape takes it back."),
    ),
    list,
  );
}

export default { render: spoken(render) };
