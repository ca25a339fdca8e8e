// A round of practice: start, the question, next, and what is known.

function render({ model, el }) {
  const { label, boxes, known } = model.get("fixed");
  const root = openFrame(el, label);
  const controls = make("fieldset", { class: "ag-controls", "aria-label": label });
  const start = make("button", { type: "button", class: "ag-check" }, t("Start a round of ten minutes"));
  const next = make("button", { type: "button", class: "ag-check" }, t("Next question"));
  const stop = make("button", { type: "button" }, t("End the round"));
  const clock = make("span", { class: "ag-note" });
  const status = make("p", { class: "ag-status", role: "status" });
  const tell = teller(status);
  const place = make("div", { class: "ag-fresh" });
  const said = make("p", { class: "ag-summary", tabindex: "-1", "aria-live": "polite" });
  const table = make("table", { class: "ag-boxes", "aria-label": t("The boxes") });
  keepKeys(start, next, stop, said);
  let ends = 0;
  let tick = null;

  controls.append(make("div", { class: "ag-actions" }, start, next, stop, clock));
  root.append(place, controls, status, said, table);

  async function go(message) {
    const reply = await send(message, false);
    if (!reply) return;
    if (!reply.ok) return tell(reply.said, "lost");
    tell("", "");
    if (reply.child) await showChild(model, place, reply.child);
    else {
      place.replaceChildren();
      said.focus();
    }
  }
  start.addEventListener("click", () => go({ do: "start" }));
  next.addEventListener("click", () => go({ do: "next" }));
  stop.addEventListener("click", () => go({ do: "stop" }));

  function draw() {
    const state = model.get("state");
    start.hidden = state.running;
    next.hidden = stop.hidden = !state.running;
    ends = Date.now() + 1000 * state.left;
    showClock(state.running);
    const done = state.asked ? t("This round: {right} of {asked} right. ", state) : "";
    said.textContent = done + state.summary;
    const numbers = Array.from({ length: boxes }, (_, at) => at + 1);
    const heads = numbers.map((n) => make("th", { scope: "col", class: "ag-box" }, `${n}`));
    const rows = state.rows.map((row) =>
      make(
        "tr",
        {},
        make("th", { scope: "row" }, `${row.id} `, make("span", { html: row.title })),
        ...numbers.map((n) => cell(row, n)),
        make("td", {}, row.asked ? t("{right} of {asked} right", row) : t("not practised yet")),
      ),
    );
    table.replaceChildren(
      make("thead", {}, make("tr", {}, make("th", { scope: "col" }, t("Box")), ...heads, make("td", {}))),
      make("tbody", {}, ...rows),
    );
    table.hidden = !rows.length;
  }

  function cell(row, n) {
    const here = row.box === n;
    const name = here ? `ag-box ag-here ${n >= known ? "ag-known" : ""}` : "ag-box";
    return make("td", { class: name }, here ? (n >= known ? "✓" : "●") : "");
  }

  function showClock(running) {
    clearInterval(tick);
    const write = () => {
      const minutes = Math.ceil((ends - Date.now()) / 60000);
      clock.textContent = !running ? "" : minutes > 0 ? t("{minutes} min left", { minutes }) : t("Time is over: this is the last one.");
      if (!el.isConnected) clearInterval(tick);
    };
    write();
    if (running) tick = setInterval(write, 5000);
  }

  const send = connect({ model, el, tell, draw, live: (yes) => (controls.disabled = !yes) });
}

export default { render: spoken(render) };
