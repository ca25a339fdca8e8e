// A field for a few lines of Markdown; what is kept is shown below it as it will be read.

const PAUSE = 600; // ms without a key until what is typed is kept

function render({ model, el }) {
  const { label, longest } = model.get("fixed");
  const shown = make("div", { class: "ag-shown" });
  keepKeys(shown);
  let typing = null;
  let unread = false;
  const field = make("textarea", {
    class: "ag-text",
    rows: "6",
    maxlength: String(longest),
    "aria-label": t("{label}: your answer, in Markdown", { label }),
    "data-lm-suppress-shortcuts": "true",
  });

  function draw(state, lost) {
    if (lost) {
      clearTimeout(typing);
      unread = false;
    }
    if (!unread && (lost || document.activeElement !== field)) field.value = state.response ?? "";
    shown.innerHTML = state.shown;
    shown.hidden = !state.shown;
  }

  const unkept = () => (unread ? field.value.trim() : "");
  const frame = openQuestion({ model, el, draw, unkept, checkable: false });

  async function keep() {
    clearTimeout(typing);
    const text = field.value;
    const reply = await frame.send({ do: "write", text });
    if (reply === null) return;
    if (field.value === text) unread = !reply.ok;
    field.setAttribute("aria-invalid", String(!reply.ok));
  }

  field.addEventListener("input", () => {
    clearTimeout(typing);
    unread = true;
    typing = setTimeout(keep, PAUSE);
  });
  field.addEventListener("change", () => unread && keep());
  frame.body.append(field, shown);
}

export default { render: spoken(render) };
