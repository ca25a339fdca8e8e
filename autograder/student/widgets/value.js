// A number, an expression or a function: what was understood, and a field to type into.

const PAUSE = 300; // ms without a key until what is typed is read

function render({ model, el }) {
  const fixed = model.get("fixed");
  const understood = make("div", { class: "ag-understood", "aria-live": "polite" });
  keepKeys(understood); // a long formula scrolls, and can then have the focus
  let typing = null;
  let unread = false; // the field holds something that was not read yet

  const id = uniqueId("field");
  const field = make("input", {
    id,
    type: "text",
    class: "ag-field",
    autocomplete: "off",
    autocapitalize: "off",
    spellcheck: "false",
    "data-lm-suppress-shortcuts": "true",
  });

  const show = (html) => {
    understood.innerHTML = html;
    understood.hidden = !html;
  };

  function draw(state, lost) {
    if (lost) {
      clearTimeout(typing);
      unread = false;
    }
    if (fixed.field && !unread && (lost || document.activeElement !== field)) {
      field.value = state.response ?? "";
    }
    show(state.understood);
  }

  const unkept = () => (unread ? field.value.trim() : "");
  const frame = openQuestion({ model, el, draw, unkept, checkable: fixed.field });
  if (fixed.symbols.length) {
    const names = fixed.symbols.map(({ name, meaning }) =>
      make("li", {}, make("code", {}, name), " ", make("span", { html: meaning })),
    );
    frame.body.append(make("ul", { class: "ag-symbols" }, ...names));
  }
  if (!fixed.field) {
    frame.body.append(understood);
    return;
  }

  async function read(action) {
    clearTimeout(typing);
    const text = field.value;
    if (!text.trim()) {
      unread = false;
      if (model.get("state").response != null) {
        frame.tell(t("An empty field changes nothing: your last answer is still kept."), "waiting");
      }
      return;
    }
    const reply = await frame.send({ do: action, text });
    if (reply === null) return;
    if (field.value === text) unread = !reply.ok; // what is refused stays to be mended
    field.setAttribute("aria-invalid", String(!reply.ok));
  }

  field.addEventListener("input", () => {
    clearTimeout(typing);
    unread = true;
    typing = setTimeout(() => read("type"), PAUSE);
  });
  field.addEventListener("change", () => unread && read("type"));
  field.addEventListener("keydown", (event) => {
    if (event.key === "Enter") read("check");
  });
  // The button marks what stands in the field now, even if it was not read yet.
  const check = frame.check.cloneNode(true);
  frame.check.replaceWith(check);
  check.addEventListener("click", () => read("check"));

  frame.body.append(
    make(
      "p",
      { class: "ag-entry" },
      make("label", { for: id }, fixed.prompt ? t("Your answer: ") : t("Or type it here: "), make("code", {}, `${fixed.name} =`)),
      field,
      fixed.unit ? make("span", { class: "ag-unit" }, fixed.unit) : null,
    ),
    understood,
  );
}

export default { render: spoken(render) };
