// Three functions to read, and two questions about them.

function render({ model, el }) {
  const { label, codes, function: name, called, call, values, foot } = model.get("fixed");
  const root = openFrame(el, label);
  const controls = make("fieldset", { class: "ag-controls", "aria-label": label });
  const check = make("button", { type: "button", class: "ag-check" }, t("Check"));
  const status = make("p", { class: "ag-status", role: "status" });
  const say = teller(status);
  const tell = (text, kind) => say(text === t("Kept.") ? "" : text, kind);
  const verdict = make("div", { class: "ag-mark", "aria-live": "polite", hidden: true });
  keepKeys(check);
  const letters = codes.map((code, at) => "ABC"[at]);
  const listing = codes.map((code) => {
    const shown = make("pre", { tabindex: "0" }, code);
    keepKeys(shown); // a long line scrolls, and can then have the focus
    return shown;
  });
  const which = options(withCode(t("Which of them does what {code} should do?"), name), letters);
  const what = options(
    withCode(t("What does {code} return?"), call),
    values.map((value) => make("code", {}, value)),
  );
  controls.append(
    make("p", {}, t("Three functions that somebody wrote for {name}. One is right.", { name })),
    make("div", { class: "ag-codes" }, ...listing),
    which.group,
    what.group,
    make("div", { class: "ag-actions" }, check, status),
  );
  root.append(controls, verdict, make("p", { class: "ag-foot" }, foot));

  // A sentence with code in the place of `{code}`.
  function withCode(sentence, code) {
    const [before, after] = sentence.split("{code}");
    return make("span", {}, before, make("code", {}, code), after);
  }

  function options(question, texts) {
    const group = uniqueId("read");
    const inputs = texts.map((text, value) => {
      const input = make("input", { type: "radio", name: group, value });
      keepKeys(input);
      return input;
    });
    const labels = texts.map((text, at) => make("label", {}, inputs[at], text));
    return {
      group: make("fieldset", { class: "ag-options" }, make("legend", {}, question), ...labels),
      chosen: () => inputs.findIndex((input) => input.checked),
    };
  }

  check.addEventListener("click", () => {
    const [chosen, returned] = [which.chosen(), what.chosen()];
    if (chosen < 0 || returned < 0) return tell(t("Answer both parts."), "waiting");
    send({ do: "check", chosen, returned });
  });

  function draw() {
    const said = model.get("state").verdict;
    verdict.hidden = !said.said;
    if (!said.said || verdict.childElementCount) return;
    verdict.className = `ag-mark ${said.right ? "ag-right" : "ag-wrong"}`;
    const signs = said.parts.map((right) => (right ? "✓" : "✗")).join(" ");
    verdict.append(
      make("p", { class: "ag-verdict" }, make("strong", {}, `${signs} ${said.right ? t("right") : t("not yet")}`)),
      make("p", { html: said.said }),
    );
    check.disabled = true;
  }

  const send = connect({ model, el, tell, draw, live: (yes) => (controls.disabled = !yes) });
}

export default { render: spoken(render) };
