// Helpers that every widget of the course uses. They stand before the widget's own module.

const BUSY_AFTER = 1500; // ms without a reply until we say that the answer waits
const REPLY_WITHIN = 1000; // ms after the kernel is done in which its reply may still arrive
const WATCH_EVERY = 500; // ms between two looks at whether the kernel has ended
const ENDED = ["restarting", "autorestarting", "terminating", "dead"];

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

// What `connect` tells, as a sentence in a widget's line of status.
function teller(status) {
  return (text, kind) => {
    status.textContent = text;
    status.className = `ag-status ag-${kind || "quiet"}`;
  };
}

// The line to the kernel. An answer counts as kept when the kernel has said so, and not before.
//
//   tell(text, kind)   shows a sentence; kind is "", "waiting", "kept" or "lost"
//   live(yes)          switches the controls on or off
//   draw(lost)         shows the model's state, which is the truth; `lost` when the kernel has gone
//   unkept()           text on the screen that is not kept, to be repeated where it is lost
//
// Returns `send(message)`, a promise of the reply, or of null where the answer was not kept.
function connect({ model, el, tell, live, draw, unkept = () => "" }) {
  const own = ownModel(model);
  const waiting = new Map();
  const view = uniqueId("view"); // replies go to every view of a widget: each knows its own
  let next = 1;
  let gone = false;
  let timer = null;
  let refusal = ""; // why an answer was not kept; it stays until the next answer is given

  function disconnected() {
    if (own?.comm_live === false) return true;
    const kernel = own?.widget_manager?.kernel;
    return kernel === null || ENDED.includes(kernel?.status);
  }

  function lose(answering = false) {
    const first = !gone;
    gone = true;
    const text = unkept();
    const lost = answering || text || [...waiting.values()].some((entry) => entry.matters);
    for (const entry of waiting.values()) entry.resolve(null);
    waiting.clear();
    clearTimeout(timer);
    if (first) live(false);
    draw(true);
    if (!first && !lost) return; // it has been said
    tell(
      (lost ? (text ? t("Your last answer was NOT kept: {text}. ", { text }) : t("Your last answer was NOT kept. ")) : "") +
        t("This is what was kept last; it cannot be changed now. Run this cell again to go on."),
      "lost",
    );
  }

  function send(message, matters = true) {
    if (gone || disconnected()) {
      lose(matters);
      return Promise.resolve(null);
    }
    const seq = `${view}-${next++}`;
    if (matters && waiting.size === 0) refusal = "";
    if (matters) tell("", ""); // what it says was said of the answer before
    return new Promise((resolve) => {
      waiting.set(seq, { resolve, matters });
      try {
        model.send({ ...message, seq }, { iopub: { status: (reply) => idle(reply, seq) } });
      } catch {
        lose();
        return;
      }
      clearTimeout(timer);
      timer = setTimeout(() => {
        const answers = [...waiting.values()].some((entry) => entry.matters);
        if (answers) tell(t("The kernel is busy: your answer waits and is NOT kept yet."), "waiting");
        else if (waiting.size) tell(t("The kernel is busy. This wakes up when it is done."), "waiting");
      }, BUSY_AFTER);
    });
  }

  // The kernel is done with the message and has not answered: it does not know this widget any more.
  function idle(reply, seq) {
    if (reply.content.execution_state === "idle") {
      setTimeout(() => waiting.has(seq) && lose(), REPLY_WITHIN);
    }
  }

  model.on("msg:custom", (reply) => {
    const entry = waiting.get(reply?.seq);
    if (!entry) return; // another view of this widget asked
    waiting.delete(reply.seq);
    if (waiting.size === 0) clearTimeout(timer);
    if (gone) return;
    live(true);
    if (!reply.ok) refusal = reply.said;
    if (refusal) tell(refusal, "lost");
    else if (entry.matters) tell(t("Kept."), "kept");
    else if (waiting.size === 0) tell("", "");
    if (waiting.size === 0) draw();
    entry.resolve(reply);
  });
  // While answers are on their way, what comes back may be older than what is on the screen.
  model.on("change:state", () => waiting.size === 0 && draw());
  model.on("comm_live_update", () => disconnected() && lose());
  const watch = setInterval(() => {
    if (gone || !el.isConnected) clearInterval(watch);
    else if (disconnected()) lose();
  }, WATCH_EVERY);

  draw();
  live(false);
  // A notebook that was reopened shows the widget as it was saved, with no kernel behind it.
  setTimeout(() => (disconnected() ? lose() : send({ do: "hello" }, false)), 0);
  return send;
}

