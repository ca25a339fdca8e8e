// A bar for each chapter: how many questions are answered, and the points.

function render({ model, el }) {
  const { label } = model.get("fixed");
  const root = openFrame(el, label);
  const list = make("ul", { class: "ag-chapters" });
  const status = make("p", { class: "ag-status", role: "status" });
  root.append(list, status);

  function draw() {
    const { chapters } = model.get("state");
    list.replaceChildren(
      ...chapters.map(({ title, answered, questions, open, later, marks, points, most }) => {
        const said = t("{answered} of {questions} answered", { answered, questions });
        const bar = make("progress", {
          class: "ag-bar",
          max: questions,
          value: answered,
          "aria-label": `${title}: ${said}`,
        });
        const earned = marks ? `${said} · ${t("{points} of {most} points", { points, most })}` : said;
        const remarks = [];
        if (answered && open.length) remarks.push(t("Open: {questions}.", { questions: open.join(", ") }));
        if (later.length) remarks.push(t("Marked after you hand in: {questions}.", { questions: later.join(", ") }));
        return make(
          "li",
          {},
          make("span", { class: "ag-title" }, title),
          bar,
          make("span", {}, earned),
          remarks.length ? make("p", { class: "ag-remarks" }, remarks.join(" ")) : null,
        );
      }),
    );
  }

  connect({
    model,
    el,
    draw,
    live() {},
    tell(text, kind) {
      status.textContent = kind === "lost" ? t("As it was last. Run this cell again to go on.") : "";
    },
  });
}

export default { render: spoken(render) };
