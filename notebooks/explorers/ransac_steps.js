// RANSAC on a scan, one sample after the other, and what a hundred runs of it find.

const RUNS = 100;
const TRIES = 2000; // samples that look for the wall itself: chance hides nothing from so many
const ALLOWED = 0.05; // the probability of failure that the number of iterations allows
const ENOUGH = 0.9; // a run has found the wall if its line keeps this share of the wall's points

function render({ model, el }) {
  const { points: measured, iterations: k, threshold: first } = model.get("values");
  const root = openExplorer(el, "Explorer: RANSAC, one sample after the other");
  const percent = (value) => `${Math.round(100 * value)} %`;
  const meters = (value) => `${value.toFixed(2)} m`;
  const threshold = slider(
    "threshold",
    { min: 0.01, max: 0.5, step: 0.01, value: first, say: meters },
    restart,
  );
  const strangers = slider(
    "outliers added",
    { min: 0, max: 4, step: 0.25, value: 0, say: (times) => `${Math.round(times * measured.length)} points` },
    restart,
  );
  const noise = slider("noise added, σ", { min: 0, max: 0.2, step: 0.01, value: 0, say: meters }, restart);
  const draws = button("Draw a sample", () => step(1));
  const plays = button(`Run: ${k} samples`, play);
  const many = button(`${RUNS} runs`, runMany);
  const why = button("Why did a run fail?", explain);
  const again = button("Start again", restart);
  const result = make("p", { class: "ex-result", role: "status", "aria-live": "polite" });
  const scene = make("div", { class: "ex-pictures" });
  const needed = make("div", { class: "ex-pictures" });
  const strip = make("div", { class: "ex-strip", role: "img" });
  const summary = make("p", { role: "status" });
  const buttons = make("div", { class: "ex-row" }, draws, plays, again, many, why);
  root.append(
    threshold.row, strangers.row, noise.row, buttons, result,
    make("div", { class: "ex-pictures" }, scene, needed), summary, strip,
  );
  let cloud, run, runs, playing, rounds = 0;

  function restart() {
    clearInterval(playing);
    cloud = cloudOf(measured, Math.round(strangers.get() * measured.length), noise.get());
    runs = null;
    begin();
    summary.textContent = "";
    strip.replaceChildren();
    strip.setAttribute("aria-label", "No run yet.");
    why.disabled = true;
    result.textContent = `${cloud.length} points. Draw a sample: two points, and the line through them.`;
    show();
  }

  function begin() {
    rounds += 1;
    run = { random: randomNumbers(rounds), drawn: 0, best: null, last: null, asked: [] };
  }

  function step(count) {
    for (let n = 0; n < count; n += 1) advance(run, cloud, threshold.get());
    tell();
    show();
  }

  function play() {
    clearInterval(playing);
    begin();
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (still) return step(k);
    step(1);
    playing = setInterval(() => {
      if (run.drawn >= k || !root.isConnected) return clearInterval(playing);
      step(1);
    }, 60);
  }

  function tell() {
    const { last, best, drawn, asked } = run;
    const share = best.inliers.length / cloud.length;
    const wanted = asked.at(-1);
    const verdict = drawn >= wanted
      ? "That many are done: a program that adapts would stop here."
      : `${drawn} ${drawn === 1 ? "is" : "are"} done.`;
    result.replaceChildren(
      make("strong", {}, `Sample ${drawn}: ${last.inliers.length} of ${cloud.length} points agree.`),
      ` Best so far: ${best.inliers.length} (${percent(share)}). With this share of inliers, the formula asks ` +
        `for ${wanted.toLocaleString("en")} ${wanted === 1 ? "sample" : "samples"}. ${verdict}`,
    );
  }

  function show() {
    showScene(run.best, run.last, "");
    showNeeded();
  }

  function showScene(best, last, remark) {
    const size = [520, 400];
    const view = plot({ width: size[0], height: size[1], clipped: true, label: "", ...fitted(cloud, ...size) });
    const { picture, layer, toX, toY } = view;
    const agrees = new Set((last ?? best)?.inliers ?? []);
    const words = last
      ? `The last sample's line has ${agrees.size} points in its band.`
      : best ? `The line has ${agrees.size} points in its band.` : "No sample has been drawn.";
    picture.setAttribute("aria-label", `${cloud.length} points of a scan. ${words} ${remark}`);
    const across = Math.abs(toX(threshold.get()) - toX(0));
    if (last) line(view, last.pair, "ex-band", 2 * across);
    if (best) line(view, best.pair, "ex-best");
    if (last) line(view, last.pair, "ex-curve");
    cloud.forEach(([x, y], n) => {
      if (agrees.has(n)) draw(layer, "circle", { class: "ex-point", cx: toX(x), cy: toY(y), r: 3.5 });
      else {
        const [u, v] = [toX(x), toY(y)];
        draw(layer, "path", { class: "ex-cross", d: `M${u - 3} ${v - 3}l6 6m0-6l-6 6` });
      }
    });
    for (const n of (last ?? best)?.pair.indices ?? []) {
      draw(layer, "circle", { class: "ex-marker", cx: toX(cloud[n][0]), cy: toY(cloud[n][1]), r: 7 });
    }
    const caption = make("figcaption", {},
      "● in the band of the last line, × outside; the two large points are its sample. Dashed: the best line so far.");
    scene.replaceChildren(make("figure", {}, picture, caption));
  }

  function line({ layer, toX, toY }, { from, to }, name, width) {
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const far = 1000 / Math.hypot(dx, dy);
    const ends = { x1: toX(from[0] - far * dx), y1: toY(from[1] - far * dy), x2: toX(to[0] + far * dx), y2: toY(to[1] + far * dy) };
    draw(layer, "line", { class: name, ...ends, ...(width ? { "stroke-width": width } : {}) });
  }

  function showNeeded() {
    const { asked, drawn } = run;
    const top = 5;
    const right = Math.max(k, drawn, 10);
    const { picture, layer, toX, toY } = plot({
      width: 520,
      height: 400,
      label: drawn
        ? `Samples asked for, after each draw: ${asked[0].toLocaleString("en")} at first, now ${asked.at(-1).toLocaleString("en")}.`
        : "Samples asked for: nothing has been drawn yet.",
      x: { low: 0, high: right, label: "samples drawn" },
      y: {
        at: (value) => Math.log10(Math.min(Math.max(value, 1), 10 ** top)) / top,
        ticks: [1, 10, 100, 1e3, 1e4, 1e5],
        say: (value) => (value < 1000 ? value : `10${"³⁴⁵"[Math.log10(value) - 3]}`),
        label: "samples asked for (logarithmic)",
      },
    });
    const diagonal = Array.from({ length: 41 }, (_, n) => Math.max(1, (right * n) / 40));
    const path = (xs, ys) => xs.map((x, n) => `${n ? "L" : "M"}${toX(x)} ${toY(ys[n])}`).join("");
    draw(layer, "path", { class: "ex-guide", fill: "none", d: path(diagonal, diagonal) });
    draw(layer, "text", { x: toX(right) - 4, y: toY(right) + 22, "text-anchor": "end" }, "drawn = asked for");
    if (!drawn) return void needed.replaceChildren(picture);
    const steps = asked.flatMap((count, n) => [[n + 1, count], [n + 2, count]]).slice(0, -1);
    draw(layer, "path", { class: "ex-curve", d: path(steps.map(([x]) => x), steps.map(([, y]) => y)) });
    draw(layer, "circle", { class: "ex-marker", cx: toX(drawn), cy: toY(asked.at(-1)), r: 6 });
    needed.replaceChildren(picture);
  }

  function runMany() {
    clearInterval(playing);
    const wall = wallOf(cloud, threshold.get());
    const inWall = new Set(wall);
    runs = Array.from({ length: RUNS }, (_, n) => {
      const one = { clean: 0 };
      const look = ({ indices: [i, j] }) => { if (inWall.has(i) && inWall.has(j)) one.clean += 1; };
      one.best = bestOf(k, randomNumbers(1000 + n), cloud, threshold.get(), look);
      one.kept = one.best.inliers.filter((index) => inWall.has(index)).length;
      one.state = one.kept >= ENOUGH * wall.length ? "found" : one.clean ? "poor" : "spoilt";
      return one;
    });
    runs.wall = wall.length;
    const count = (state) => runs.filter((one) => one.state === state).length;
    const signs = { found: "", poor: "–", spoilt: "×" };
    strip.replaceChildren(...runs.map(({ state }) => make("span", { class: `ex-run ex-${state}` }, signs[state])));
    const w = wall.length / cloud.length;
    summary.textContent =
      `${k} samples were enough in ${count("found")} of ${RUNS} runs (filled squares): the best line keeps at least ` +
      `${percent(ENOUGH)} of the wall's ${wall.length} points, ${percent(w)} of all. In ${count("poor")} runs (–) a sample was ` +
      `clean and its line poor; in ${count("spoilt")} (×) every sample held an outlier.`;
    strip.setAttribute("aria-label", summary.textContent);
    why.disabled = count("found") === RUNS;
  }

  function explain() {
    const worst = runs.reduce((one, other) => (other.kept < one.kept ? other : one));
    const number = runs.indexOf(worst) + 1;
    const w = runs.wall / cloud.length;
    showScene(worst.best, null, `The best line of run ${number}.`);
    result.replaceChildren(
      make("strong", {}, `Run ${number} found the least: ${worst.kept} of the wall's ${runs.wall} points. `),
      worst.clean
        ? `${worst.clean} of its ${k} samples held two points of the wall, but points that are noisy and close ` +
          "together turn the line away from it. A fit to the consensus set repairs this, if the set is a good one."
        : `None of its ${k} samples held two points of the wall. With ${percent(w)} inliers, that happens to about ` +
          `${(100 * spoiltChance(w, k)).toPrecision(2)} % of all runs, by bad luck alone; more samples make it rarer.`,
    );
  }

  restart();
}

// The chance that all samples of two hold an outlier.
function spoiltChance(share, count) {
  let chance = 1;
  for (let n = 0; n < count; n += 1) chance -= chance * share * share;
  return chance;
}

// One more sample: the line through it, its votes, and how many samples the best so far asks for.
function advance(run, cloud, threshold) {
  const pair = samplePair(cloud, run.random);
  run.last = { pair, inliers: agreeing(cloud, pair, threshold) };
  run.drawn += 1;
  if (!run.best || run.last.inliers.length > run.best.inliers.length) run.best = run.last;
  run.asked.push(iterations(run.best.inliers.length / cloud.length, 2, ALLOWED));
}

// The best of so many samples; `seen` is told of each pair. Votes are counted, and listed only for a
// new best: a hundred runs are to be there at once.
function bestOf(count, random, cloud, threshold, seen = () => {}) {
  let best = null;
  let most = -1;
  for (let n = 0; n < count; n += 1) {
    const pair = samplePair(cloud, random);
    seen(pair);
    const votes = countAgreeing(cloud, pair, threshold);
    if (votes > most) [best, most] = [pair, votes];
  }
  return { pair: best, inliers: agreeing(cloud, best, threshold) };
}

// Two points at different places.
function samplePair(cloud, random) {
  for (;;) {
    const [i, j] = [Math.floor(random() * cloud.length), Math.floor(random() * cloud.length)];
    const [from, to] = [cloud[i], cloud[j]];
    if (from[0] !== to[0] || from[1] !== to[1]) return { indices: [i, j], from, to };
  }
}

// Whether each point agrees with the line through a pair.
function agreement({ from, to }, threshold) {
  const [x, y, dx, dy] = [from[0], from[1], to[0] - from[0], to[1] - from[1]];
  const band = threshold * Math.sqrt(dx * dx + dy * dy);
  return (point) => Math.abs((point[0] - x) * dy - (point[1] - y) * dx) <= band;
}

function agreeing(cloud, pair, threshold) {
  const agrees = agreement(pair, threshold);
  return [...cloud.keys()].filter((n) => agrees(cloud[n]));
}

function countAgreeing(cloud, pair, threshold) {
  const agrees = agreement(pair, threshold);
  let count = 0;
  for (let n = 0; n < cloud.length; n += 1) if (agrees(cloud[n])) count += 1;
  return count;
}

// The points of the largest wall: what the best of very many samples agrees with.
function wallOf(cloud, threshold) {
  return bestOf(TRIES, randomNumbers(5), cloud, threshold).inliers;
}

// The measured points, moved by noise, and strangers anywhere among them: the same at each call.
function cloudOf(measured, strangers, sigma) {
  const random = randomNumbers(3);
  const normal = () => Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
  const moved = measured.map(([x, y]) => [x + sigma * normal(), y + sigma * normal()]);
  const [xs, ys] = [measured.map(([x]) => x), measured.map(([, y]) => y)];
  const between = (values) => Math.min(...values) + random() * (Math.max(...values) - Math.min(...values));
  return [...moved, ...Array.from({ length: strangers }, () => [between(xs), between(ys)])];
}

export default { render };
