// What is handed in: where the file is, what is in it, what is unanswered, and a button to pack again.

function render({ model, el }) {
  const { label } = model.get("fixed");
  const root = openFrame(el, label);
  const place = make("div", {});
  const again = make("button", { type: "button", class: "ag-check" }, "Pack again");
  const status = make("p", { class: "ag-status", role: "status" });
  const controls = make("fieldset", { class: "ag-controls" });
  keepKeys(again);
  controls.append(make("div", { class: "ag-actions" }, again, status));
  root.append(place, controls);

  function draw() {
    const state = model.get("state");
    const questions = state.chapters.flatMap((chapter) => chapter.questions);
    const open = questions.filter((question) => !question.answered).length;
    const warnings = [];
    if (state.warning) warnings.push(state.warning.replaceAll("`", ""));
    if (state.stale) warnings.push("Something has changed since. Pack again to hand that in too.");
    place.replaceChildren(
      make(
        "p",
        {},
        state.warning ? "Not ready to hand in: " : state.taken ? "Handed in: " : "Hand in ",
        make("strong", {}, state.file),
        ` (packed at ${state.packed_at}): `,
        make("code", { class: "ag-path" }, state.path),
      ),
      make(
        "p",
        {},
        "It holds ",
        ...state.names.flatMap((name, at) => [at ? ", " : null, make("code", {}, name)]),
        ". Each notebook is packed as it was last saved: save the others too.",
      ),
      state.advice ? make("p", {}, state.advice) : "",
      ...warnings.map((text) => make("p", { class: "ag-refusal", role: "alert" }, text)),
      make(
        "p",
        {},
        open
          ? `${questions.length - open} of ${questions.length} questions are answered. ` +
              "You may hand in unfinished work; what is open counts as not attempted."
          : `All ${questions.length} questions are answered.`,
      ),
      ...state.chapters.map(({ title, questions }) =>
        make(
          "section",
          {},
          make("p", { class: "ag-title" }, title),
          make(
            "ul",
            { class: "ag-answered" },
            ...questions.map(({ label, answered }) =>
              make(
                "li",
                { class: answered ? "ag-right" : "ag-open" },
                make("strong", {}, answered ? "● answered" : "○ open"),
                ` ${label}`,
              ),
            ),
          ),
        ),
      ),
    );
  }

  const send = connect({
    model,
    el,
    draw,
    live: (yes) => (controls.disabled = !yes),
    tell(text, kind) {
      status.textContent = kind === "kept" ? "Packed." : text;
      status.className = `ag-status ag-${kind || "quiet"}`;
    },
  });
  again.addEventListener("click", () => send({ do: "pack" }));
}

export default { render };
