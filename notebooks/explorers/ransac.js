// How many iterations RANSAC needs, and whether a thousand simulated runs agree.

const RUNS = 1000;
const PATIENCE = 2e4; // more iterations than this, and we simulate fewer runs
const LEAST = 0.25; // the smallest share of inliers on offer
const MOST = 0.95;
const SAMPLES = [
  [2, "2 (line)"],
  [3, "3 (plane)"],
  [4, "4 (homography)"],
  [8, "8 (fundamental matrix)"],
];

// The number of the first sample without an outlier, in one simulated run.
function firstClean(share, size, limit) {
  for (let count = 1; count <= limit; count += 1) {
    let drawn = 0;
    while (drawn < size && Math.random() < share) drawn += 1;
    if (drawn === size) return count;
  }
  return Infinity;
}

function render({ el }) {
  const root = openExplorer(el, "Explorer: how many iterations RANSAC needs");
  const percent = (value) => `${Math.round(100 * value)} %`;
  const share = slider(
    "share of inliers w",
    { min: LEAST, max: MOST, step: 0.05, value: 0.5, say: percent },
    update,
  );
  const chance = chooser("probability of success p", [
    [0.9, "90 %"],
    [0.99, "99 %"],
    [0.999, "99.9 %"],
  ], 0.99, update);
  const size = chooser("points in a sample s", SAMPLES, 2, update);
  const result = make("p", { class: "ex-result", role: "status" });
  const pictures = make("div", { class: "ex-pictures" });
  const simulate = button("Simulate", run);
  const simulated = make("p", { role: "status" });
  const histogram = make("div", { class: "ex-pictures" });
  root.append(share.row, chance.row, size.row, result, pictures, simulate, simulated, histogram);

  function update() {
    const [w, p, s] = [share.get(), chance.get(), size.get()];
    const k = iterations(w, s, 1 - p);
    result.replaceChildren(
      make("strong", {}, `k = ${k.toLocaleString("en")} ${k === 1 ? "iteration" : "iterations"}`),
      ` ${k === 1 ? "is" : "are"} needed: with ${percent(w)} inliers and samples of ${s} points, at least one sample ` +
        `is clean with a probability of at least ${chance.text()}.`,
    );
    simulated.textContent = "";
    histogram.replaceChildren();

    const top = 6;
    const { picture, layer, toX, toY } = plot({
      width: 560,
      height: 320,
      label: `Curve: ${k} iterations at ${percent(w)} inliers; more inliers need fewer.`,
      x: { low: 0.2, high: 1, label: "share of inliers w", ticks: [0.2, 0.4, 0.6, 0.8, 1] },
      y: {
        at: (value) => Math.log10(value) / top,
        ticks: [1, 10, 100, 1e3, 1e4, 1e5, 1e6],
        say: (value) => (value < 1000 ? value : `10${"³⁴⁵⁶"[Math.log10(value) - 3]}`),
        label: "iterations k (logarithmic)",
      },
    });
    for (const [other] of SAMPLES) {
      const steps = Array.from({ length: 57 }, (_, n) => LEAST + ((MOST - LEAST) * n) / 56);
      const path = steps
        .map((x, n) => `${n ? "L" : "M"}${toX(x)} ${toY(Math.max(1, iterations(x, other, 1 - p)))}`)
        .join("");
      draw(layer, "path", { class: other === s ? "ex-curve" : "ex-faint", d: path });
      const end = { x: toX(LEAST) - 5, y: toY(iterations(LEAST, other, 1 - p)) + 4, "text-anchor": "end" };
      draw(layer, "text", end, `s=${other}`);
    }
    draw(layer, "line", { class: "ex-guide", x1: toX(w), x2: toX(w), y1: toY(1), y2: toY(k) });
    draw(layer, "circle", { class: "ex-marker", cx: toX(w), cy: toY(k), r: 6 });
    pictures.replaceChildren(picture);
  }

  function run() {
    const [w, p, s] = [share.get(), chance.get(), size.get()];
    const k = iterations(w, s, 1 - p);
    const runs = k > PATIENCE ? RUNS / 10 : RUNS;
    const firsts = Array.from({ length: runs }, () => firstClean(w, s, 3 * k));
    const successes = firsts.filter((first) => first <= k).length;
    const expected = Math.round(runs * (1 - (1 - w ** s) ** k)); // more than runs * p: k is rounded up
    const samples = k === 1 ? "the first sample" : `at least one of the first ${k.toLocaleString("en")} samples`;
    simulated.textContent =
      `In ${successes} of ${runs} simulated runs, ${samples} was clean (expected: about ${expected}).`;

    const bins = Math.min(30, Math.ceil(1.5 * k));
    const width = Math.ceil((1.5 * k) / bins);
    const counts = new Array(bins).fill(0);
    for (const first of firsts) {
      const bin = Math.floor((first - 1) / width);
      if (bin < bins) counts[bin] += 1;
    }
    const { picture, layer, toX, toY } = plot({
      width: 560,
      height: 240,
      label: `Histogram of the first clean samples; the line stands at k = ${k.toLocaleString("en")}.`,
      x: { low: 0, high: bins * width, label: "iteration that drew the first clean sample" },
      y: { low: 0, high: Math.max(...counts, 1) * 1.05, label: "runs" },
    });
    counts.forEach((count, bin) =>
      draw(layer, "rect", {
        class: "ex-bar",
        x: toX(bin * width) + 0.5,
        width: Math.max(1, toX(width) - toX(0) - 1),
        y: toY(count),
        height: toY(0) - toY(count),
      }),
    );
    draw(layer, "line", { class: "ex-limit", x1: toX(k), x2: toX(k), y1: toY(0), y2: 12 });
    draw(layer, "text", { x: toX(k) - 5, y: 24, "text-anchor": "end" }, `k = ${k.toLocaleString("en")}`);
    histogram.replaceChildren(picture);
  }

  update();
}

export default { render };
