// A line in polar form among points: drag it or use the sliders, and watch its cost.

function render({ model, el }) {
  const { points } = model.get("values");
  const root = openExplorer(el, "Explorer: a line in polar form and its cost");
  const view = frameOf(points);
  const radius = slider(
    "distance r",
    { min: 0, max: view.reach, step: view.reach / 200, value: view.reach / 3, say: (r) => `${r.toFixed(2)} m` },
    update,
  );
  const angle = slider(
    "angle α of the normal",
    { min: -Math.PI, max: Math.PI, step: Math.PI / 180, value: Math.PI / 4, say: degrees },
    update,
  );
  const result = make("p", { class: "ex-result", role: "status" });
  const scene = plot({
    width: 460,
    height: 460,
    label: "",
    clipped: true,
    x: { low: view.x - view.half, high: view.x + view.half, label: "x (m)" },
    y: { low: view.y - view.half, high: view.y + view.half, label: "y (m)" },
  });
  const slope = make("div", { class: "ex-pictures" });
  const note = make("p", {}, "Drag the round handle, or use the sliders. How small can you make S?");
  root.append(note, radius.row, angle.row, result, make("div", { class: "ex-pictures" }, scene.picture, slope));
  let best = Infinity;
  // The handle is the point of the line that is nearest to the origin: it sets both values at once.
  dragOn(scene, (x, y) => {
    radius.set(Math.hypot(x, y));
    angle.set(Math.atan2(y, x));
    update();
  });

  function update() {
    const [r, alpha] = [radius.get(), angle.get()];
    const cost = costOf(r, alpha);
    best = Math.min(best, cost);
    result.replaceChildren(
      make("strong", {}, `S = ${cost.toPrecision(3)} m²`),
      ` at r = ${r.toFixed(2)} m, α = ${degrees(alpha)}. Best so far: ${best.toPrecision(3)} m².`,
    );
    drawScene(r, alpha, cost);
    drawSlope(r, alpha, cost);
  }

  function costOf(r, alpha) {
    const [c, s] = [Math.cos(alpha), Math.sin(alpha)];
    return points.reduce((sum, [x, y]) => sum + (r - x * c - y * s) ** 2, 0);
  }

  function drawScene(r, alpha, cost) {
    const { picture, layer, toX, toY } = scene;
    const [c, s] = [Math.cos(alpha), Math.sin(alpha)];
    const far = 4 * (view.half + Math.hypot(view.x, view.y) + r);
    const stroke = (name, x1, y1, x2, y2) =>
      draw(layer, "line", { class: name, x1: toX(x1), y1: toY(y1), x2: toX(x2), y2: toY(y2) });
    picture.setAttribute(
      "aria-label",
      `${points.length} points and a line at distance ${r.toFixed(2)} metres, its normal at ` +
        `${degrees(alpha)}. The sum of the squared distances is ${cost.toPrecision(3)}.`,
    );
    layer.replaceChildren();
    for (const [x, y] of points) {
      const off = r - x * c - y * s;
      stroke("ex-residual", x, y, x + off * c, y + off * s);
    }
    stroke("ex-curve", r * c - far * s, r * s + far * c, r * c + far * s, r * s - far * c);
    stroke("ex-normal", 0, 0, r * c, r * s);
    for (const [x, y] of points) draw(layer, "circle", { class: "ex-point", cx: toX(x), cy: toY(y), r: 3.5 });
    draw(layer, "circle", { class: "ex-origin", cx: toX(0), cy: toY(0), r: 4 });
    draw(layer, "circle", { class: "ex-marker ex-handle", cx: toX(r * c), cy: toY(r * s), r: 9 });
  }

  function drawSlope(r, alpha, cost) {
    const angles = Array.from({ length: 181 }, (_, n) => -Math.PI + (n * Math.PI) / 90);
    const costs = angles.map((at) => costOf(r, at));
    const { picture, layer, toX, toY } = plot({
      width: 460,
      height: 240,
      label: `S over the angle at the present distance; the marker stands at ${degrees(alpha)}.`,
      x: { low: -180, high: 180, label: "angle α (degrees), r as it is", ticks: [-180, -90, 0, 90, 180] },
      y: { low: 0, high: Math.max(...costs) * 1.05 || 1, label: "cost S (m²)" },
    });
    const inDegrees = (at) => (at * 180) / Math.PI;
    const path = angles.map((at, n) => `${n ? "L" : "M"}${toX(inDegrees(at))} ${toY(costs[n])}`);
    draw(layer, "path", { class: "ex-curve", d: path.join("") });
    draw(layer, "circle", { class: "ex-marker", cx: toX(inDegrees(alpha)), cy: toY(cost), r: 6 });
    slope.replaceChildren(picture);
  }

  update();
}

// A square that holds the points and the origin, and how far a line may be away.
function frameOf(points) {
  const all = [[0, 0], ...points];
  const [xs, ys] = [all.map(([x]) => x), all.map(([, y]) => y)];
  const [left, right] = [Math.min(...xs), Math.max(...xs)];
  const [low, high] = [Math.min(...ys), Math.max(...ys)];
  const half = 0.6 * Math.max(right - left, high - low) || 1;
  const reach = Math.max(...all.map(([x, y]) => Math.hypot(x, y))) || 1;
  return { x: (left + right) / 2, y: (low + high) / 2, half, reach };
}

export default { render };
