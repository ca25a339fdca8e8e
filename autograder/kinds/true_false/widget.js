// Statements as the rows of a table, with a radio button for true and one for false.

function render({ model, el }) {
  const { statements, label } = model.get("fixed");
  const group = uniqueId("statements");
  const rows = statements.map((statement, at) => {
    const text = make("span", { id: `${group}-${at}`, html: statement });
    const part = make("div", { class: "ag-part", hidden: true });
    const choices = [true, false].map((said) =>
      make("input", {
        type: "radio",
        name: `${group}-${at}`,
        "aria-labelledby": `${group}-${at} ${group}-${said}`,
        "data-lm-suppress-shortcuts": "true",
        onchange: () => frame.send({ do: "choose", statement: at, said }),
      }),
    );
    const cells = choices.map((choice) => make("td", {}, make("label", {}, choice)));
    const row = make("tr", {}, make("th", { scope: "row" }, text, part), ...cells);
    return { row, choices, part };
  });

  function draw(state) {
    rows.forEach(({ choices, part }, at) => {
      const said = state.response?.[at] ?? null;
      choices[0].checked = said === true;
      choices[1].checked = said === false;
      drawPart(part, state.mark?.parts[at], t("look again"));
    });
  }

  const frame = openQuestion({ model, el, draw });
  frame.body.append(
    make(
      "table",
      { class: "ag-statements", "aria-label": label },
      make(
        "thead",
        {},
        make(
          "tr",
          {},
          make("th", { scope: "col" }, t("Statement")),
          make("th", { scope: "col", id: `${group}-true` }, t("True")),
          make("th", { scope: "col", id: `${group}-false` }, t("False")),
        ),
      ),
      make("tbody", {}, ...rows.map(({ row }) => row)),
    ),
  );
}

export default { render: spoken(render) };
