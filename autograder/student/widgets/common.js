// Helpers that every widget of the course uses. They stand before the widget's own module.

// An element with attributes and children; `on...` attributes are listeners.
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "html") element.innerHTML = value;
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child != null));
  return element;
}

// The sentences of a widget in the language that the course speaks: `t("{minutes} min left", { minutes: 2 })`.
// Each has a translation in autograder/language, or stays English.
let words = {};
function t(text, fields = {}) {
  return (words[text] ?? text).replace(/\{(\w+)\}/g, (all, name) => fields[name] ?? all);
}

// The `render` of a widget, which knows the words before it draws anything.
function spoken(render) {
  return (context) => {
    words = context.model.get("translated") ?? {};
    return render(context);
  };
}

let counter = 0;
function uniqueId(name) {
  counter += 1;
  return `ag-${name}-${counter}-${Math.random().toString(36).slice(2, 8)}`;
}

// The frame of a widget: a group with a label, whose keys JupyterLab leaves alone.
//
// JupyterLab's single-key shortcuts (`b` inserts a cell) would act on the notebook while a control
// in here has the focus. Saving is passed on: nobody expects Ctrl+S to stop working.
function openFrame(el, label) {
  const root = make("section", { class: "autograder", role: "group", "aria-label": label });
  keepKeys(root);
  root.addEventListener("keydown", (event) => {
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "s") {
      event.preventDefault();
      const { key, code, keyCode, ctrlKey, metaKey } = event;
      const copy = { key, code, keyCode, ctrlKey, metaKey, bubbles: true, cancelable: true };
      el.parentElement?.dispatchEvent(new KeyboardEvent("keydown", copy));
    }
  });
  el.append(root);
  return root;
}

function keepKeys(...elements) {
  for (const element of elements) element.setAttribute("data-lm-suppress-shortcuts", "true");
}

// The widget manager's own model, which alone knows whether its kernel is still there. anywidget does
// not hand it out, but every event of a change does.
function ownModel(model) {
  let own = null;
  const take = (changed) => (own = changed);
  model.on("change:ag_look", take);
  model.set("ag_look", true);
  model.off("change:ag_look", take);
  model.set("ag_look", undefined, { unset: true });
  return own;
}

// Shows another widget of the kernel inside of this one, and gives its first control the focus.
async function showChild(model, place, id) {
  const manager = ownModel(model)?.widget_manager ?? model.widget_manager;
  const child = await manager.get_model(id);
  const view = await manager.create_view(child, {});
  place.replaceChildren(view.el);
  const controls = "input:enabled, button:enabled, [tabindex='0']:not(:disabled)";
  const shown = (control) => control.getClientRects().length > 0; // what is hidden takes no focus
  const focus = () => [...place.querySelectorAll(controls)].find(shown);
  const before = document.activeElement;
  // Its controls are off until it has heard from the kernel, which may have other things to do.
  for (let tries = 0; tries < 600 && view.el.isConnected && !focus(); tries++) {
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  // Whoever has gone on to something else in the meantime is left there.
  const now = document.activeElement;
  if (!now || now === before || now.contains(place)) focus()?.focus();
}
