// One cloud in three views: points to drag, their cost over r and α, and the cost over α alone.

const NOISE = 0.1; // m, of each point in the simulated repetitions
const REPETITIONS = 200;
const BAND = 0.3; // m, half the width of the band in which points agree with a line
const HALF_TURN = [-90, -45, 0, 45, 90];

function render({ model, el }) {
  const given = model.get("values");
  const root = openExplorer(el, "Explorer: one cloud of points in three views");
  let points = given.points.map((point) => [...point]);
  const last = points.length - 1;
  const names = points.map((_, n) => [n, n === last ? "the outlier" : `point ${n + 1}`]);
  const reach = Math.ceil(Math.max(...points.map(([x, y]) => Math.hypot(x, y))) + 0.5);
  const chosen = chooser("point to move", names, last, update);
  const place = (name) =>
    slider(name, { min: -reach, max: reach, step: 0.05, value: 0, say: (at) => `${at.toFixed(2)} m` }, moved);
  const [x, y] = [place("its x"), place("its y")];
  const turn = slider(
    "turn the cloud by",
    { min: -90, max: 90, step: 1, value: 0, say: (angle) => `${angle}°` },
    turned,
  );
  const again = button("Start again", () => {
    points = given.points.map((point) => [...point]);
    turn.set(0);
    turnedBy = 0;
    update();
  });
  const result = make("p", { class: "ex-result", role: "status" });
  const size = [440, 380];
  const views = [0, 1, 2, 3].map(() => make("div", {}));
  const guess = given.predicted ? `You predicted that it jumps: ${plainText(given.predicted)}.` : "You have not predicted when it jumps.";
  root.append(
    make("p", {}, "Drag the points, or choose one and move it with the sliders. ■ is the outlier."),
    chosen.row, x.row, y.row, turn.row, again, result, make("p", {}, guess), make("div", { class: "ex-pictures ex-views" }, ...views),
  );
  let turnedBy = 0;
  const frame = fitted([[-1, -1], [reach, reach]], ...size);
  const scene = plot({ width: size[0], height: size[1], label: "", clipped: true, ...frame });
  views[0].append(scene.picture);
  dragOn(scene, (atX, atY) => {
    points[chosen.get()] = [atX, atY];
    update();
  }, (atX, atY) => {
    const gap = ([px, py]) => Math.hypot(px - atX, py - atY);
    const nearest = points.reduce((best, point, n) => (gap(point) < gap(points[best]) ? n : best), 0);
    chosen.set(nearest);
    return true;
  });

  function moved() {
    points[chosen.get()] = [x.get(), y.get()];
    update();
  }

  function turned() {
    const by = ((turn.get() - turnedBy) * Math.PI) / 180;
    turnedBy = turn.get();
    const { centre } = sums(points.slice(0, last)); // the outlier stays where it is
    points = points.map(([px, py], n) => {
      if (n === last) return [px, py];
      const [dx, dy] = [px - centre[0], py - centre[1]];
      return [
        centre[0] + dx * Math.cos(by) - dy * Math.sin(by),
        centre[1] + dx * Math.sin(by) + dy * Math.cos(by),
      ];
    });
    update();
  }

  function update() {
    [x, y].forEach((control, axis) => control.set(points[chosen.get()][axis]));
    const fit = stationary(points);
    const agreed = consensus(points);
    showScene(fit, agreed);
    showHeat(fit);
    showCost(fit);
    showEllipse(fit);
    const { Sxx, Syy } = sums(points);
    const plain = Math.abs(fit.valley.alpha) <= Math.PI / 4 ? "the valley too" : "the hill, the worst line";
    result.replaceChildren(
      make("strong", {}, `Least squares: r = ${fit.valley.r.toFixed(2)} m, α = ${degrees(fit.valley.alpha)}, ` +
        `S = ${fit.valley.cost.toPrecision(3)} m².`),
      ` S_xx = ${Sxx.toFixed(2)}, S_yy = ${Syy.toFixed(2)} m²: the plain arctan finds ${plain}. ` +
        `Consensus: α = ${degrees(agreed.line.alpha)}, by ${agreed.members.length} of ${points.length} points.`,
    );
  }

  function showScene({ valley }, { line, members }) {
    const { picture, layer, toX, toY } = scene;
    layer.replaceChildren();
    const across = ({ r, alpha }, name) => {
      const [c, s, far] = [Math.cos(alpha), Math.sin(alpha), 10 * reach];
      draw(layer, "line", {
        class: name,
        x1: toX(r * c - far * s), y1: toY(r * s + far * c), x2: toX(r * c + far * s), y2: toY(r * s - far * c),
      });
    };
    across(line, "ex-best");
    across(valley, "ex-curve");
    points.forEach(([px, py], n) => {
      const [u, v] = [toX(px), toY(py)];
      const name = n === chosen.get() ? "ex-marker" : "ex-point";
      if (n === last) draw(layer, "rect", { class: `${name} ex-outlier`, x: u - 6, y: v - 6, width: 12, height: 12 });
      else draw(layer, "circle", { class: name, cx: u, cy: v, r: 6 });
    });
    picture.setAttribute(
      "aria-label",
      `${points.length} points. The line of least squares (solid) has its normal at ${degrees(valley.alpha)}; ` +
        `the line on which ${members.length} points agree (dashed) at ${degrees(line.alpha)}.`,
    );
  }

  function showHeat({ valley, hill }) {
    const view = plot({
      width: size[0],
      height: size[1],
      clipped: true,
      label:
        `Map of the cost over α and r, with a curve for each point. Lowest (circle) at ${degrees(valley.alpha)}, ` +
        `the other stationary angle (triangle) at ${degrees(hill.alpha)}.`,
      x: { low: -90, high: 90, ticks: HALF_TURN, label: "angle α (degrees)" },
      y: { low: -reach, high: reach, label: "distance r (m)" },
    });
    const { picture, layer, toX, toY } = view;
    const [left, top, wide, high] = [toX(-90), toY(reach), toX(90) - toX(-90), toY(-reach) - toY(reach)];
    const image = draw(layer, "image", { x: left, y: top, width: wide, height: high, preserveAspectRatio: "none" });
    image.setAttribute("href", heat());
    for (const [px, py] of points) {
      const d = Array.from({ length: 61 }, (_, n) => {
        const alpha = ((-90 + 3 * n) * Math.PI) / 180;
        return `${n ? "L" : "M"}${toX(-90 + 3 * n)} ${toY(px * Math.cos(alpha) + py * Math.sin(alpha))}`;
      });
      draw(layer, "path", { class: "ex-sinusoid", d: d.join("") });
    }
    mark(view, valley, valley.r, "circle");
    mark(view, hill, hill.r, "triangle");
    views[1].replaceChildren(picture);
  }

  // The logarithm of the cost, dark where it is low, in 90 by 60 pixels.
  function heat() {
    const canvas = make("canvas", { width: 90, height: 60 });
    const context = canvas.getContext("2d");
    const pixels = context.createImageData(90, 60);
    const costs = new Float64Array(90 * 60);
    for (let column = 0; column < 90; column += 1) {
      const alpha = ((-89 + 2 * column) * Math.PI) / 180;
      const [c, s] = [Math.cos(alpha), Math.sin(alpha)];
      for (let row = 0; row < 60; row += 1) {
        const r = reach - ((row + 0.5) * 2 * reach) / 60;
        let cost = 0.01;
        for (const [px, py] of points) cost += (r - px * c - py * s) ** 2;
        costs[90 * row + column] = Math.log(cost);
      }
    }
    const [low, high] = costs.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
    costs.forEach((value, n) => {
      const part = (value - low) / (high - low || 1);
      pixels.data.set([40 + 205 * part, 70 + 170 * part, 140 + 90 * part, 255], 4 * n);
    });
    context.putImageData(pixels, 0, 0);
    return canvas.toDataURL();
  }

  function showCost({ valley, hill, costAt }) {
    const angles = Array.from({ length: 121 }, (_, n) => -90 + 1.5 * n);
    const costs = angles.map((angle) => costAt((angle * Math.PI) / 180));
    const view = plot({
      width: size[0],
      height: size[1],
      label: `Cost over α with the best r for each: valley at ${degrees(valley.alpha)}, hill at ${degrees(hill.alpha)}.`,
      x: { low: -90, high: 90, ticks: HALF_TURN, label: "angle α (degrees), best r for each" },
      y: { low: 0, high: 1.1 * hill.cost || 1, label: "cost S (m²)" },
    });
    const { picture, layer, toX, toY } = view;
    for (const edge of [-45, 45]) {
      draw(layer, "line", { class: "ex-guide", x1: toX(edge), x2: toX(edge), y1: 12, y2: toY(0) });
    }
    draw(layer, "text", { x: toX(0), y: 24, "text-anchor": "middle" }, "plain arctan looks here");
    const path = angles.map((angle, n) => `${n ? "L" : "M"}${toX(angle)} ${toY(costs[n])}`);
    draw(layer, "path", { class: "ex-curve", d: path.join("") });
    mark(view, valley, valley.cost, "circle");
    mark(view, hill, hill.cost, "triangle");
    views[2].replaceChildren(picture);
  }

  function mark({ layer, toX, toY }, { alpha }, height, shape) {
    const [u, v] = [toX((alpha * 180) / Math.PI), toY(height)];
    if (shape === "circle") draw(layer, "circle", { class: "ex-marker", cx: u, cy: v, r: 7 });
    else draw(layer, "path", { class: "ex-marker", d: `M${u} ${v - 9}l8 14h-16z` });
  }

  function showEllipse({ valley }) {
    const { lines, spread, ellipse } = repeated(points, valley);
    const angles = lines.map(({ alpha }) => (alpha * 180) / Math.PI);
    const all = [...lines.map(({ r }, n) => [angles[n], r]), ...ellipse];
    const ends = (values) => [Math.min(...values), Math.max(...values)];
    const [a, b] = ends(all.map(([angle]) => angle));
    const [c, d] = ends(all.map(([, r]) => r));
    const { picture, layer, toX, toY } = plot({
      width: size[0],
      height: size[1],
      clipped: true,
      label:
        `Where the line of least squares falls when every point is measured ${REPETITIONS} times with σ = ${NOISE} m: ` +
        `σ_r = ${spread.r.toFixed(3)} m, σ_α = ${spread.alpha.toFixed(1)}°.`,
      x: { low: a, high: b, label: `α (degrees) of ${REPETITIONS} repetitions` },
      y: { low: c, high: d, label: "r (m)" },
    });
    lines.forEach(({ r }, n) => draw(layer, "circle", { class: "ex-point", cx: toX(angles[n]), cy: toY(r), r: 2 }));
    const path = ellipse.map(([angle, r], n) => `${n ? "L" : "M"}${toX(angle)} ${toY(r)}`).join("");
    draw(layer, "path", { class: "ex-curve", d: `${path}Z` });
    views[3].replaceChildren(picture);
  }

  update();
}

// What a formula in a sentence looks like without its signs for typesetting.
function plainText(sentence) {
  return sentence.replaceAll(/[${}]/g, "");
}

// The centre, and the sums of squares and products around it.
function sums(points) {
  const mean = (axis) => points.reduce((sum, point) => sum + point[axis], 0) / points.length;
  const centre = [mean(0), mean(1)];
  let [Sxx, Syy, Sxy] = [0, 0, 0];
  for (const [x, y] of points) {
    const [dx, dy] = [x - centre[0], y - centre[1]];
    Sxx += dx * dx;
    Syy += dy * dy;
    Sxy += dx * dy;
  }
  return { centre, Sxx, Syy, Sxy };
}

// The two lines through the centre at which the cost is stationary; their normals are the axes of
// the cloud, and the valley's is the one along which it is thin. Angles lie within half a turn.
function stationary(points) {
  const { centre, Sxx, Syy, Sxy } = sums(points);
  const least = (Sxx + Syy) / 2 - Math.hypot((Sxx - Syy) / 2, Sxy);
  const one = [Sxy, least - Sxx];
  const other = [least - Syy, Sxy];
  const normal = Math.hypot(...one) > Math.hypot(...other) ? one : other;
  const costAt = (alpha) => {
    const [c, s] = [Math.cos(alpha), Math.sin(alpha)];
    return Sxx * c * c + 2 * Sxy * c * s + Syy * s * s;
  };
  const at = (nx, ny) => {
    let alpha = Math.atan2(ny, nx);
    if (alpha > Math.PI / 2) alpha -= Math.PI;
    if (alpha <= -Math.PI / 2) alpha += Math.PI;
    return { alpha, r: centre[0] * Math.cos(alpha) + centre[1] * Math.sin(alpha), cost: costAt(alpha) };
  };
  return { valley: at(...normal), hill: at(-normal[1], normal[0]), costAt };
}

// The line through two points with which most others agree, fitted again to all that agree.
function consensus(points) {
  let members = [];
  for (let i = 0; i < points.length; i += 1) {
    for (let j = 0; j < i; j += 1) {
      const [dx, dy] = [points[j][0] - points[i][0], points[j][1] - points[i][1]];
      const band = BAND * Math.hypot(dx, dy);
      if (!band) continue;
      const found = points.filter(([x, y]) => Math.abs((x - points[i][0]) * dy - (y - points[i][1]) * dx) <= band);
      if (found.length > members.length) members = found;
    }
  }
  return { members, line: stationary(members.length ? members : points).valley };
}

// Measure every point again and again, fit each time, and draw two standard deviations around.
function repeated(points, { alpha: middle }) {
  const random = randomNumbers(11);
  const normal = () => Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
  const lines = Array.from({ length: REPETITIONS }, () => {
    const { r, alpha } = stationary(points.map(([x, y]) => [x + NOISE * normal(), y + NOISE * normal()])).valley;
    // The same line on the other side of a quarter turn: (r, α) and (-r, α ± π).
    if (alpha - middle > Math.PI / 2) return { r: -r, alpha: alpha - Math.PI };
    if (alpha - middle < -Math.PI / 2) return { r: -r, alpha: alpha + Math.PI };
    return { r, alpha };
  });
  const { centre, Sxx, Syy, Sxy } = sums(lines.map(({ alpha, r }) => [(alpha * 180) / Math.PI, r]));
  const [vx, vy, vxy] = [Sxx, Syy, Sxy].map((sum) => sum / (REPETITIONS - 1));
  const [sx, across] = [Math.sqrt(vx), Math.sqrt(Math.max(0, vy - (vxy * vxy) / (vx || 1)))];
  const ellipse = Array.from({ length: 48 }, (_, n) => {
    const [c, s] = [2 * Math.cos((n * Math.PI) / 24), 2 * Math.sin((n * Math.PI) / 24)];
    return [centre[0] + sx * c, centre[1] + (vxy / (sx || 1)) * c + across * s];
  });
  return { lines, ellipse, spread: { alpha: sx, r: Math.sqrt(vy) } };
}

export default { render };
