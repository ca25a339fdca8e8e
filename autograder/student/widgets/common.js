// Helpers that every widget of the course uses. They stand before the widget's own module.

const BUSY_AFTER = 1500; // ms without a reply until we say that the answer waits

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

// The line to the kernel. An answer counts as kept when the kernel has said so, and not before.
//
//   tell(text, kind)   shows a sentence; kind is "", "waiting", "kept" or "lost"
//   live(yes)          switches the controls on or off
//   draw()             shows the model's state, which is the truth
//
// Returns `send(message)`, a promise of the reply, or of null where the answer was not kept.
function connect({ model, el, tell, live, draw }) {
  const waiting = new Map();
  let next = 1;
  let gone = false;
  let timer = null;

  const disconnected = () => el.closest(".jupyter-widgets-disconnected") !== null;

  function lose() {
    if (gone) return;
    gone = true;
    const lost = waiting.size > 0 && [...waiting.values()].some((entry) => entry.matters);
    for (const entry of waiting.values()) entry.resolve(null);
    waiting.clear();
    clearTimeout(timer);
    live(false);
    draw();
    tell(
      (lost ? "Your last answer was NOT kept. " : "") +
        "This is what was kept last; it cannot be changed now. Run this cell again to go on.",
      "lost",
    );
  }

  function send(message, matters = true) {
    if (gone || disconnected()) {
      lose();
      return Promise.resolve(null);
    }
    const seq = next++;
    return new Promise((resolve) => {
      waiting.set(seq, { resolve, matters });
      try {
        model.send({ ...message, seq });
      } catch {
        lose();
        return;
      }
      clearTimeout(timer);
      timer = setTimeout(() => {
        const answers = [...waiting.values()].some((entry) => entry.matters);
        if (answers) tell("The kernel is busy: your answer waits and is NOT kept yet.", "waiting");
        else if (waiting.size) tell("The kernel is busy. This wakes up when it is done.", "waiting");
      }, BUSY_AFTER);
    });
  }

  model.on("msg:custom", (reply) => {
    const entry = waiting.get(reply?.seq);
    if (!entry) return; // another view of this widget asked
    waiting.delete(reply.seq);
    if (waiting.size === 0) clearTimeout(timer);
    if (gone) return;
    live(true);
    if (!reply.ok) tell(reply.said, "lost");
    else if (entry.matters) tell("Kept.", "kept");
    else if (waiting.size === 0) tell("", "");
    if (waiting.size === 0) draw();
    entry.resolve(reply);
  });
  // While answers are on their way, what comes back may be older than what is on the screen.
  model.on("change:state", () => waiting.size === 0 && draw());
  model.on("comm_live_update", () => setTimeout(() => disconnected() && lose(), 0));

  draw();
  live(false);
  // A notebook that was reopened shows the widget as it was saved, with no kernel behind it.
  setTimeout(() => (disconnected() ? lose() : send({ do: "hello" }, false)), 0);
  return send;
}

