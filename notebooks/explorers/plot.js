// Helpers of the explorers: elements, sliders, and a small plot with axes.

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value != null) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

function draw(parent, tag, attributes, text) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text != null) element.textContent = text;
  parent.append(element);
  return element;
}

// JupyterLab's single-key shortcuts must not act on the notebook while a control has the focus.
// Saving is passed on: nobody expects Ctrl+S to stop working.
function openExplorer(el, label) {
  const root = make("section", {
    class: "explorer",
    role: "group",
    "aria-label": label,
    "data-lm-suppress-shortcuts": "true",
  });
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

// A labelled slider; `say(value)` is how the value is written and read out.
function slider(name, { min, max, step, value, say }, changed) {
  const input = make("input", { type: "range", min, max, step, "aria-label": name });
  input.setAttribute("data-lm-suppress-shortcuts", "true");
  const shown = make("output", {});
  const set = (to) => {
    input.value = to;
    shown.textContent = say(Number(input.value));
    input.setAttribute("aria-valuetext", shown.textContent);
  };
  input.addEventListener("input", () => {
    set(input.value);
    changed();
  });
  set(value);
  const row = make("label", { class: "ex-row" }, make("span", {}, name), input, shown);
  return { row, set, get: () => Number(input.value), input };
}

// A labelled choice of [value, text] pairs; `get()` is the chosen value as a number.
function chooser(name, options, chosen, changed) {
  const select = make("select", { "data-lm-suppress-shortcuts": "true", onchange: changed });
  for (const [value, text] of options) select.append(make("option", { value }, text));
  select.value = chosen;
  const row = make("label", { class: "ex-row" }, make("span", {}, name), select);
  const set = (value) => void (select.value = value);
  return { row, set, get: () => Number(select.value), text: () => select.selectedOptions[0].text };
}

function button(text, pressed) {
  return make("button", { type: "button", "data-lm-suppress-shortcuts": "true", onclick: pressed }, text);
}

// Follows the pointer from where it is pressed on a plot to where it is lifted. `moved(x, y)` is
// told the position in the units of the axes.
function dragOn({ picture, toX, toY }, moved, begins = () => true) {
  const unmap = (map, pixel) => (pixel - map(0)) / (map(1) - map(0));
  const place = (event) => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.getScreenCTM().inverse());
    return [unmap(toX, at.x), unmap(toY, at.y)];
  };
  picture.classList.add("ex-scene");
  picture.addEventListener("pointerdown", (event) => {
    if (!begins(...place(event))) return;
    const move = (event) => moved(...place(event));
    const end = () => {
      document.removeEventListener("pointermove", move);
      document.removeEventListener("pointerup", end);
      document.removeEventListener("pointercancel", end);
    };
    document.addEventListener("pointermove", move);
    document.addEventListener("pointerup", end);
    document.addEventListener("pointercancel", end);
    event.preventDefault();
    move(event);
  });
}

// Ranges of x and y that hold all points in a plot of this size, with one scale for both.
function fitted(points, width, height, margin = 0.06) {
  const ends = (values) => [Math.min(...values), Math.max(...values)];
  const [left, right] = ends(points.map(([x]) => x));
  const [low, high] = ends(points.map(([, y]) => y));
  const [across, up] = [width - 72, height - 56]; // pixels between the axes' ends, as in `plot`
  const scale = (1 + 2 * margin) * Math.max((right - left) / across, (high - low) / up) || 1 / across;
  const [x, y] = [(left + right) / 2, (low + high) / 2];
  return {
    x: { low: x - (scale * across) / 2, high: x + (scale * across) / 2, label: "x (m)" },
    y: { low: y - (scale * up) / 2, high: y + (scale * up) / 2, label: "y (m)" },
  };
}

// Random numbers from 0 to 1 that `still.py` draws just so: a linear congruential generator.
function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

// Draw again and again: one more sample is needed as long as the chance that all were spoilt is
// larger than what we allow.
function iterations(share, size, allowed) {
  let clean = 1;
  for (let drawn = 0; drawn < size; drawn += 1) clean *= share;
  let spoilt = 1;
  let count = 0;
  while (spoilt > allowed && count < 1e7) {
    spoilt -= spoilt * clean;
    count += 1;
  }
  return count;
}

const degrees = (alpha) => `${Math.round((alpha * 180) / Math.PI)}°`;

// Round numbers between low and high, about `count` of them.
function ticks(low, high, count = 5) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((n) => n * power).find((n) => n >= rough);
  const found = [];
  for (let n = Math.ceil(low / step); n * step <= high + 1e-9 * step; n += 1) found.push(n * step);
  return found.map((value) => Number(value.toPrecision(10)));
}

// A plot with axes. `x` and `y` are {low, high, label, at?, ticks?, say?}; `at` maps a value to a
// position from 0 to 1. With `clipped`, nothing is drawn beyond the axes. Returns the picture, a layer to draw on, and the maps to pixels.
function plot({ width, height, x, y, label, clipped = false }) {
  const margin = { left: 58, right: 14, top: 12, bottom: 44 };
  const picture = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  picture.setAttribute("viewBox", `0 0 ${width} ${height}`);
  picture.setAttribute("role", "img");
  picture.setAttribute("aria-label", label);
  const part = (axis, value) =>
    axis.at ? axis.at(value) : (value - axis.low) / (axis.high - axis.low);
  const toX = (value) => margin.left + part(x, value) * (width - margin.left - margin.right);
  const toY = (value) => height - margin.bottom - part(y, value) * (height - margin.top - margin.bottom);
  const left = margin.left;
  const bottom = height - margin.bottom;

  for (const value of x.ticks ?? ticks(x.low, x.high)) {
    draw(picture, "line", { class: "ex-grid", x1: toX(value), x2: toX(value), y1: margin.top, y2: bottom });
    draw(picture, "text", { x: toX(value), y: bottom + 17, "text-anchor": "middle" }, (x.say ?? String)(value));
  }
  for (const value of y.ticks ?? ticks(y.low, y.high)) {
    draw(picture, "line", { class: "ex-grid", x1: left, x2: width - margin.right, y1: toY(value), y2: toY(value) });
    draw(picture, "text", { x: left - 7, y: toY(value) + 4, "text-anchor": "end" }, (y.say ?? String)(value));
  }
  draw(picture, "text", { x: (left + width - margin.right) / 2, y: height - 6, "text-anchor": "middle" }, x.label);
  const middle = (margin.top + bottom) / 2;
  const turned = { x: 14, y: middle, "text-anchor": "middle", transform: `rotate(-90 14 ${middle})` };
  draw(picture, "text", turned, y.label);
  const clip = `ex-clip-${Math.random().toString(36).slice(2)}`;
  const inside = { x: left, y: margin.top, width: width - left - margin.right, height: bottom - margin.top };
  draw(draw(picture, "clipPath", { id: clip }), "rect", inside);
  const layer = draw(picture, "g", clipped ? { "clip-path": `url(#${clip})` } : {});
  return { picture, layer, toX, toY };
}
