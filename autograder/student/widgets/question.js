// The parts that questions of every kind have around their own controls.
//
//   draw(state, lost)  shows what is kept in the question's own controls
//   unkept()           what they hold that is not kept
//
// Returns the frame with `body` (for the controls), `check` (a button), `send`, `tell` and `announce`.
function openQuestion({ model, el, draw, unkept, checkable = true }) {
  const fixed = model.get("fixed");
  const root = openFrame(el, fixed.label);
  const controls = make("fieldset", { class: "ag-controls" });
  const body = make("div", { class: "ag-body" });
  const check = make("button", { type: "button", class: "ag-check" }, t("Check"));
  const hint = make("button", { type: "button", class: "ag-hint" });
  const attempts = make("span", { class: "ag-attempts" });
  const hints = make("ol", { class: "ag-hints", "aria-live": "polite", "aria-label": t("Hints") });
  const mark = make("div", { class: "ag-mark", "aria-live": "polite" });
  const status = make("p", { class: "ag-status", role: "status" });
  const tell = teller(status);
  const announcer = make("p", { class: "ag-announcer", "aria-live": "assertive" });
  const refusal = make("p", { class: "ag-refusal", role: "alert", hidden: true });
  keepKeys(check, hint);

  const actions = make("div", { class: "ag-actions" });
  if (checkable && fixed.marks) actions.append(check);
  if (fixed.hints.length) actions.append(hint);
  actions.append(attempts, status);
  controls.append(body, actions);
  if (fixed.prompt) root.append(make("div", { class: "ag-prompt", html: fixed.prompt }));
  root.append(refusal, controls, mark, hints, announcer);
  if (fixed.another) root.append(practiceOf({ model, send: (message) => send(message, false) }));
  if (fixed.foot) root.append(make("p", { class: "ag-foot" }, fixed.foot));

  function drawAll(lost = false) {
    const state = model.get("state");
    draw(state, lost);
    attempts.textContent = state.attempts;
    refusal.textContent = state.refusal;
    refusal.hidden = !state.refusal;
    drawMark(mark, state.mark);
    root.classList.toggle("ag-answered", Boolean(state.attempts));
    while (hints.children.length < state.hints) {
      const text = fixed.hints[hints.children.length];
      hints.append(make("li", { html: text }));
    }
    hints.hidden = hints.children.length === 0;
    const left = fixed.hints.length - state.hints;
    hint.textContent = t("Hint {number} of {count}", {
      number: Math.min(state.hints + 1, fixed.hints.length),
      count: fixed.hints.length,
    });
    if (left <= 0) {
      hint.textContent = t("No more hints");
      hint.setAttribute("aria-disabled", "true");
    }
  }

  const send = connect({
    model,
    el,
    tell,
    unkept,
    draw: drawAll,
    live: (yes) => (controls.disabled = !yes),
  });

  check.addEventListener("click", () => send({ do: "check" }));
  hint.addEventListener("click", () => {
    if (!hint.hasAttribute("aria-disabled")) send({ do: "hint" }, false);
  });
  if (!fixed.marks && checkable) {
    actions.prepend(
      make("span", { class: "ag-note" }, t("Answers are kept as you give them and marked later.")),
    );
  }
  return { root, body, actions, check, send, tell, announce: (text) => (announcer.textContent = text) };
}

// Another one: a fresh variant below the question, in a widget of its own.
function practiceOf({ model, send }) {
  const place = make("div", { class: "ag-fresh" });
  const another = make("button", { type: "button" }, t("Another one"));
  const note = make("span", { class: "ag-note" }, t("With other numbers or statements, for practice: no points."));
  keepKeys(another);
  another.addEventListener("click", async () => {
    const reply = await send({ do: "another" }); // a refusal is told beside the question's controls
    if (reply?.child) await showChild(model, place, reply.child);
  });
  return make("div", { class: "ag-another" }, place, make("p", { class: "ag-actions" }, another, note));
}

function drawMark(place, mark) {
  const drawn = JSON.stringify(mark);
  if (place.dataset.drawn === drawn) return; // an open explanation stays open
  place.dataset.drawn = drawn;
  place.replaceChildren();
  place.hidden = !mark;
  if (!mark) return;
  place.className = `ag-mark ag-${mark.status.replaceAll(" ", "-")}`;
  place.append(
    make(
      "p",
      { class: "ag-verdict" },
      make("strong", {}, `${mark.sign} ${mark.said}`),
      mark.points ? ` · ${mark.points}` : "",
    ),
    make("p", { class: "ag-feedback", html: mark.feedback }),
  );
  if (mark.explanation) place.append(explained(mark.explanation, t("Explanation (it tells the answer)")));
}

// Folded away, because it may tell the answer.
function explained(html, title) {
  const summary = make("summary", {}, title);
  keepKeys(summary);
  return make("details", {}, summary, make("div", { html }));
}

// The verdict on one statement or card: a sign, and words for those who do not see it.
function drawPart(place, part, wrong) {
  const drawn = JSON.stringify(part ?? null);
  if (place.dataset.drawn === drawn) return; // an open explanation stays open
  place.dataset.drawn = drawn;
  place.hidden = !part || (part.right === null && !part.feedback);
  place.className = `ag-part ${part?.right ? "ag-right" : part?.right === false ? "ag-wrong" : ""}`;
  if (place.hidden) return place.replaceChildren();
  const verdict = part.right ? `✓ ${t("right")}` : part.right === false ? `✗ ${wrong}` : `○ ${t("open")}`;
  place.replaceChildren(make("strong", {}, verdict), " ", make("span", { html: part.feedback }));
  const why = part.right ? t("Why") : t("Why (it tells the answer)");
  if (part.explanation) place.append(explained(part.explanation, why));
}
