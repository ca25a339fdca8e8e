// The line to the kernel, for every widget whose answers are kept. It stands behind `common.js`.

const BUSY_AFTER = 1500; // ms without a reply until we say that the answer waits
const REPLY_WITHIN = 1000; // ms after the kernel is done in which its reply may still arrive
const WATCH_EVERY = 500; // ms between two looks at whether the kernel has ended
const ENDED = ["restarting", "autorestarting", "terminating", "dead"];

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
