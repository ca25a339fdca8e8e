// What is handed in: where the file is, what is in it, what is unanswered, and a button to pack again.

function render({ model, el }) {
  const { label } = model.get("fixed");
  const root = openFrame(el, label);
  const place = make("div", {});
  const again = make("button", { type: "button", class: "ag-check" }, t("Pack again"));
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
    if (state.nameless) warnings.push(state.nameless.replaceAll("`", ""));
    if (state.warning) warnings.push(state.warning.replaceAll("`", ""));
    if (state.stale) warnings.push(t("Something has changed since. Pack again to hand that in too."));
    place.replaceChildren(
      make(
        "p",
        {},
        state.warning ? t("Not ready to hand in: ") : state.taken ? t("Handed in: ") : t("Hand in "),
        make("strong", {}, state.file),
        t(" (packed at {packed_at}): ", state),
        make("code", { class: "ag-path" }, state.path),
      ),
      make(
        "p",
        {},
        t("It holds "),
        ...state.names.flatMap((name, at) => [at ? ", " : null, make("code", {}, name)]),
        t(". Each notebook is packed as it was last saved: save the others too."),
      ),
      state.advice ? make("p", {}, state.advice) : "",
      ...warnings.map((text) => make("p", { class: "ag-refusal", role: "alert" }, text)),
      make(
        "p",
        {},
        open
          ? t("{done} of {all} questions are answered. You may hand in unfinished work; what is open counts as not attempted.", {
              done: questions.length - open,
              all: questions.length,
            })
          : t("All {all} questions are answered.", { all: questions.length }),
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
                make("strong", {}, answered ? `● ${t("answered")}` : `○ ${t("open")}`),
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
      status.textContent = kind === "kept" ? t("Packed.") : text;
      status.className = `ag-status ag-${kind || "quiet"}`;
    },
  });
  again.addEventListener("click", () => send({ do: "pack" }));
}

export default { render: spoken(render) };
