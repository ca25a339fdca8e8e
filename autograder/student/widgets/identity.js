// Who the student is: a name in a field, and a second look before it is changed.

function render({ model, el }) {
  const { label } = model.get("fixed");
  const root = openFrame(el, label);
  const controls = make("fieldset", { class: "ag-controls", "aria-label": label });
  const id = uniqueId("name");
  const field = make("input", {
    id,
    type: "text",
    class: "ag-field",
    autocomplete: "name",
    spellcheck: "false",
    maxlength: "200",
  });
  const keep = make("button", { type: "button", class: "ag-check" }, t("This is me"));
  const warning = make("p", { class: "ag-refusal", role: "alert", hidden: true });
  const change = make("button", { type: "button" }, t("Change it"));
  const leave = make("button", { type: "button" }, t("Leave it"));
  const sure = make("p", { class: "ag-actions", hidden: true }, change, leave);
  const status = make("p", { class: "ag-status", role: "status" });
  const tell = teller(status);
  keepKeys(field, keep, change, leave);
  controls.append(
    make(
      "p",
      { class: "ag-entry" },
      make("label", { for: id }, t("Your name or number, as the class list has it:")),
      field,
      keep,
    ),
    warning,
    sure,
  );
  root.append(controls, status);

  function ask(text) {
    warning.textContent = text;
    warning.hidden = sure.hidden = !text;
    if (text) change.focus();
  }

  async function say(confirmed) {
    if (!field.value.trim()) return field.focus();
    const reply = await send({ do: "say", name: field.value, sure: confirmed });
    if (!reply?.ok) return;
    ask(reply.warning ?? "");
    tell(reply.told ?? "", reply.told ? "kept" : "");
    if (reply.told) field.focus();
  }

  field.addEventListener("keydown", (event) => event.key === "Enter" && say(false));
  keep.addEventListener("click", () => say(false));
  change.addEventListener("click", () => say(true));
  leave.addEventListener("click", () => {
    ask("");
    field.value = model.get("state").name;
    field.focus();
  });

  function draw(lost) {
    if (lost || document.activeElement !== field) field.value = model.get("state").name;
  }

  const send = connect({
    model,
    el,
    tell,
    draw,
    live: (yes) => (controls.disabled = !yes),
    unkept: () => (field.value === model.get("state").name ? "" : field.value.trim()),
  });
}

export default { render: spoken(render) };
