// A prediction: choices to click, or a number to type; once it is kept, it stands.

function render({ model, el }) {
  const { label, prompt, choices, unit } = model.get("fixed");
  const root = openFrame(el, label);
  const controls = make("fieldset", { class: "ag-controls", "aria-label": t("Your prediction") });
  const kept = make("p", { class: "ag-predicted", tabindex: "-1" });
  const status = make("p", { class: "ag-status", role: "status" });
  const tell = teller(status);
  keepKeys(kept);
  root.append(
    make("p", { class: "ag-title" }, t("Predict")),
    make("div", { class: "ag-prompt", html: prompt }),
    controls,
    kept,
    status,
  );
  const field = choices.length ? null : numberField();
  if (choices.length) controls.append(choiceButtons());

  function choiceButtons() {
    const buttons = choices.map((html, choice) => {
      const button = make("button", { type: "button", html });
      button.addEventListener("click", () => give({ do: "choose", choice }));
      return button;
    });
    keepKeys(...buttons);
    return make("div", { class: "ag-choices" }, ...buttons);
  }

  function numberField() {
    const id = uniqueId("prediction");
    const input = make("input", {
      id,
      type: "text",
      inputmode: "decimal",
      class: "ag-field ag-number",
      autocomplete: "off",
      spellcheck: "false",
    });
    const button = make("button", { type: "button", class: "ag-check" }, t("Predict"));
    const commit = () => {
      if (input.value.trim()) give({ do: "type", text: input.value });
      else input.focus();
    };
    input.addEventListener("keydown", (event) => event.key === "Enter" && commit());
    button.addEventListener("click", commit);
    keepKeys(input, button);
    controls.append(
      make(
        "p",
        { class: "ag-entry" },
        make("label", { for: id }, t("Your prediction:")),
        input,
        unit ? make("span", { class: "ag-unit" }, unit) : null,
        button,
      ),
    );
    return input;
  }

  async function give(message) {
    const reply = await send(message);
    field?.setAttribute("aria-invalid", String(Boolean(reply && !reply.ok)));
    // The control that had the focus is gone: the sentence in its place takes it.
    if (reply?.ok) kept.focus();
  }

  function draw() {
    const { said } = model.get("state");
    controls.hidden = Boolean(said);
    kept.hidden = !said;
    const html = said ? t("You predicted: {said}. The next cell shows what is true.", { said: `<strong>${said}</strong>` }) : "";
    if (kept.innerHTML !== html) kept.innerHTML = html;
  }

  const send = connect({
    model,
    el,
    tell,
    draw,
    live: (yes) => (controls.disabled = !yes),
    unkept: () => (field && !model.get("state").said ? field.value.trim() : ""),
  });
}

export default { render: spoken(render) };
