// A keypoint's journey: its way down the tree, its votes, and where it must lie in the best candidate.

const PATCH = 52; // pixels of a spot's surroundings, drawn upright
const SEEN = 6; // SIFT looks at about six times the keypoint's size
const STEPS = 40; // pictures of the votes while they grow
const SECONDS = 4;

function render({ model, el }) {
  const given = model.get("values");
  const { query, places, spots, trees, size } = given;
  const root = openExplorer(el, "Explorer: the journey of a keypoint");
  const images = loaded(given.photographs, () => showWay());
  let [hovered, playing] = [null, null];
  const chosen = slider(
    "keypoint",
    { min: 1, max: spots.length, step: 1, value: given.first + 1, say: (n) => `${n} of ${spots.length}` },
    update,
  );
  const voters = slider(
    "keypoints that have voted",
    { min: 0, max: spots.length, step: 1, value: spots.length, say: String },
    update,
  );
  const children = chooser(
    "children of a node, k",
    trees.map((tree, n) => [n, tree.children]),
    Math.min(1, trees.length - 1),
    update,
  );
  const depth = chooser("levels of the tree", trees[0].levels.map((_, n) => [n, n + 1]), trees[0].levels.length - 1, update);
  const weighing = chooser("a vote counts", [[0, "one"], [1, "the weight of its word"]], 0, update);
  const other = chooser("compare with", [[-1, "the best candidate"], ...places.map((name, n) => [n, name])], -1, update);
  const grows = button("Let the votes grow", play);
  const result = make("p", { class: "ex-result", role: "status", "aria-live": "polite" });
  const [way, row, votes, pair] = [0, 1, 2, 3].map(() => make("div", {}));
  const photo = photograph([query], "ex-photo");
  root.append(
    make("p", {}, "Click on a spot of the photograph, or choose a keypoint with the slider. Move the pointer over the photograph for the last picture."),
    make("div", { class: "ex-pictures" }, photo.picture, make("div", {},
      chosen.row, children.row, depth.row, weighing.row, other.row, voters.row, make("div", { class: "ex-row" }, grows))),
    result, way, row, make("div", { class: "ex-pictures" }, votes), pair,
  );
  const thumbnails = places.map((name) =>
    make("figure", {}, make("img", { src: given.photographs[name], alt: "", width: 84 }), make("figcaption", {}, name)));
  const shelf = make("div", { class: "ex-shelf" }, ...thumbnails);
  const rowSays = make("p", {});
  row.append(rowSays, shelf);
  listen(photo.picture);
  spots.forEach(([x, y]) => draw(photo.layer, "circle", { class: "ex-spot", cx: x, cy: y, r: 2.5 }));
  const onPhoto = draw(photo.picture, "g", {});
  let drawn = null; // the pair of photographs that is on the screen
  // JupyterLab renders before it shows: how wide the window is turns out later.
  new ResizeObserver(() => drawn && isNarrow() !== drawn.narrow && showPair(drawn.place)).observe(root);

  function isNarrow() {
    return root.clientWidth > 0 && root.clientWidth < 560;
  }

  // Photographs side by side in one drawing, or one above the other in a narrow window.
  function photograph(names, style) {
    const narrow = isNarrow();
    const [wide, high] = size;
    const gap = 14;
    const offsets = names.map((_, n) => (narrow ? [0, n * (high + gap)] : [n * (wide + gap), 0]));
    const last = offsets.at(-1);
    const picture = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    picture.setAttribute("viewBox", `0 0 ${last[0] + wide} ${last[1] + high}`);
    picture.setAttribute("role", "img");
    picture.setAttribute("class", style);
    names.forEach((name, n) => {
      const [x, y] = offsets[n];
      draw(picture, "image", { href: given.photographs[name], x, y, width: wide, height: high });
    });
    return { picture, offsets, layer: draw(picture, "g", {}) };
  }

  // A click chooses the nearest keypoint; a pointer that moves shows its line at once.
  function listen(picture) {
    const place = (event) => {
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.getScreenCTM().inverse());
      return at.x <= size[0] && at.y <= size[1] ? [at.x, at.y] : null;
    };
    picture.addEventListener("pointermove", (event) => {
      hovered = place(event);
      showLine();
    });
    picture.addEventListener("pointerleave", () => {
      hovered = null;
      showLine();
    });
    picture.addEventListener("click", (event) => {
      const at = place(event);
      if (!at) return;
      const gap = ([x, y]) => Math.hypot(x - at[0], y - at[1]);
      chosen.set(1 + spots.reduce((best, spot, n) => (gap(spot) < gap(spots[best]) ? n : best), 0));
      update();
    });
  }

  const levelNow = () => trees[children.get()].levels[depth.get()];

  function update() {
    const counted = count(levelNow(), voters.get());
    const best = counted ? counted.indexOf(Math.max(...counted)) : 0;
    const place = other.get() < 0 ? best : other.get();
    showPhoto();
    showWay();
    showRow();
    showVotes(counted, best);
    if (drawn?.place === place) showLine();
    else showPair(place);
    tell(counted, best, place);
  }

  // The votes of the first keypoints for each place: every one goes to the places of its word's row.
  function count({ words, rows, weights }, upTo) {
    if (!words || !rows || (weighing.get() && !weights)) return null;
    const sums = new Array(places.length).fill(0);
    for (let n = 0; n < upTo; n += 1) {
      for (const place of rows[words[n]]) sums[place] += weighing.get() ? weights[words[n]] : 1;
    }
    return sums;
  }

  function play() {
    clearInterval(playing);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    voters.set(still ? spots.length : 0);
    update();
    if (still) return;
    playing = setInterval(() => {
      voters.set(Math.min(spots.length, voters.get() + Math.ceil(spots.length / STEPS)));
      update();
      if (voters.get() >= spots.length || !root.isConnected) clearInterval(playing);
    }, (1000 * SECONDS) / STEPS);
  }

  function tell(counted, best, place) {
    const { words, rows } = levelNow();
    const word = words?.[chosen.get() - 1];
    const { agree } = given.matches[place];
    const good = agree.reduce((sum, one) => sum + one, 0);
    result.replaceChildren(
      make("strong", {}, words ? `Keypoint ${chosen.get()} is word ${word}. ` : `Keypoint ${chosen.get()}. `),
      rows ? `${rows[word].length} of ${places.length} places have this word. ` : "",
      counted
        ? `Best candidate of ${voters.get()} votes: ${places[best]}, with ${number(counted[best])}. `
        : `For the votes write ${missing().join(", ")}, and run this cell again. `,
      `${good} of ${agree.length} matches with ${places[place]} agree with one geometry.`,
    );
  }

  function missing() {
    const { words, rows, weights } = levelNow();
    if (!words) return ["descend_tree"];
    return [...(rows ? [] : ["build_inverted_file"]), ...(weighing.get() && !weights ? ["idf_weights"] : [])];
  }

  const number = (value) => (weighing.get() ? value.toFixed(1) : String(value));

  function showPhoto() {
    onPhoto.replaceChildren();
    circle(onPhoto, spots[chosen.get() - 1]);
    photo.picture.setAttribute("aria-label",
      `Photograph ${query} with ${spots.length} keypoints; number ${chosen.get()} is chosen.`);
  }

  // A keypoint as the descriptor sees it: its size and direction.
  function circle(layer, [x, y, wide, angle]) {
    const [radius, turn] = [Math.max(6, wide / 2), (angle * Math.PI) / 180];
    for (const style of ["ex-halo", "ex-chosen"]) {
      draw(layer, "circle", { class: style, cx: x, cy: y, r: radius });
      draw(layer, "line", { class: style, x1: x, y1: y, x2: x + radius * Math.cos(turn), y2: y + radius * Math.sin(turn) });
    }
  }

  function showWay() {
    const tree = trees[children.get()];
    const own = spots[chosen.get() - 1];
    const cards = tree.levels.slice(0, depth.get() + 1).map(({ words, sizes, examples }, n) => {
      const node = words?.[chosen.get() - 1];
      const inside = words ? examples[node].map((patch) => given.patches[patch]) : [];
      const says = words
        ? `Level ${n + 1}: child ${(node % tree.children) + 1} of ${tree.children}, row ${node}. In training ${sizes[node]} spots of the walk were here, such as:`
        : `Level ${n + 1}: write descend_tree, and run this cell again.`;
      return make("div", { class: "ex-level" }, make("p", {}, says), strip(own, inside));
    });
    way.replaceChildren(...cards);
  }

  // The chosen keypoint, and beside it spots of the walk that came to the same node.
  function strip(own, inside) {
    const all = [[query, ...own], ...inside.map(([place, ...spot]) => [places[place], ...spot])];
    const canvas = make("canvas", {
      width: all.length * (PATCH + 6) + 10,
      height: PATCH,
      role: "img",
      "aria-label": `The surroundings of the keypoint, and of spots in ${inside.map(([place]) => places[place]).join(", ") || "no photograph"}.`,
    });
    const context = canvas.getContext("2d");
    all.forEach(([name, x, y, wide, angle], n) => {
      const image = images[name];
      if (!image.complete || !image.naturalWidth) return;
      const [scale, turn] = [PATCH / (SEEN * wide), (angle * Math.PI) / 180];
      const [c, s] = [scale * Math.cos(turn), scale * Math.sin(turn)];
      const left = n * (PATCH + 6) + (n ? 10 : 0);
      context.save();
      context.beginPath();
      context.rect(left, 0, PATCH, PATCH);
      context.clip();
      context.translate(left + PATCH / 2, PATCH / 2);
      context.transform(c, -s, s, c, 0, 0);
      context.drawImage(image, -x, -y);
      context.restore();
    });
    return canvas;
  }

  function showRow() {
    const { words, rows, weights } = levelNow();
    const word = words?.[chosen.get() - 1];
    const listed = new Set(rows?.[word] ?? []);
    thumbnails.forEach((figure, n) => (figure.hidden = !listed.has(n)));
    if (!rows) return void (rowSays.textContent = "The row of the inverted file: nothing is written yet.");
    const worth = weights ? `, and a vote of it is worth ${weights[word].toFixed(2)}` : "";
    rowSays.textContent =
      `Row ${word} of the inverted file, of ${rows.length}: ${listed.size} of ${places.length} places have this word${worth}.`;
  }

  function showVotes(counted, best) {
    const mine = new Set(levelNow().rows?.[levelNow().words?.[chosen.get() - 1]] ?? []);
    const { picture, layer, toX, toY } = plot({
      width: 620,
      height: 260,
      label: counted
        ? `Votes of ${voters.get()} keypoints: ${places.map((name, n) => `${name} ${number(counted[n])}`).join(", ")}.`
        : "Votes: nothing can be counted yet.",
      x: { low: -0.6, high: places.length - 0.4, label: "place (the end of its number)", ticks: places.map((_, n) => n), say: (n) => places[n].slice(-2) },
      y: { low: 0, high: Math.max(1, ...(counted ?? [])) * 1.08, label: "votes" },
    });
    (counted ?? []).forEach((value, n) => {
      const box = { x: toX(n - 0.36), y: toY(value), width: toX(0.36) - toX(-0.36), height: toY(0) - toY(value) };
      draw(layer, "rect", { class: n === best ? "ex-winner" : "ex-bar", ...box });
      if (mine.has(n)) draw(layer, "circle", { class: "ex-marker", cx: toX(n), cy: toY(value), r: 5 });
    });
    votes.replaceChildren(make("figure", {}, picture,
      make("figcaption", {}, "Striped edge: the best candidate. ● the places that the chosen keypoint votes for.")));
  }

  function showPair(place) {
    const name = places[place];
    const { pairs, agree } = given.matches[place];
    const { picture, offsets, layer } = photograph([query, name], "ex-photo");
    const [dx, dy] = offsets[1];
    for (const good of [0, 1]) {
      pairs.forEach(([x, y, u, v], n) => {
        if (agree[n] !== good) return;
        draw(layer, "line", { class: good ? "ex-match" : "ex-wrong", x1: x, y1: y, x2: u + dx, y2: v + dy });
      });
    }
    const clip = `ex-clip-${Math.random().toString(36).slice(2)}`;
    draw(draw(picture, "clipPath", { id: clip }), "rect", { x: dx, y: dy, width: size[0], height: size[1] });
    const lines = draw(picture, "g", { "clip-path": `url(#${clip})` });
    drawn = { place, narrow: isNarrow(), picture, lines, marks: draw(picture, "g", {}), offset: offsets[1] };
    const note = make("figcaption", {});
    drawn.note = note;
    pair.replaceChildren(make("figure", {}, picture, note));
    listen(picture);
    showLine();
  }

  // The line on which the spot under the pointer, or the chosen one, must lie in the candidate.
  function showLine() {
    const { place, picture, lines, marks, offset, note } = drawn;
    const { fundamental, agree } = given.matches[place];
    const good = agree.reduce((sum, one) => sum + one, 0);
    const spot = hovered ?? spots[chosen.get() - 1];
    lines.replaceChildren();
    marks.replaceChildren();
    if (!hovered) circle(marks, spot);
    else for (const style of ["ex-halo", "ex-chosen"]) draw(marks, "circle", { class: style, cx: spot[0], cy: spot[1], r: 8 });
    const what = `${query} and ${places[place]}: ${good} matches agree with one geometry (solid), ${agree.length - good} do not (dotted).`;
    picture.setAttribute("aria-label", what);
    if (!fundamental) return void (note.textContent = `${what} They are too few to look for one.`);
    note.textContent = `${what} The thick line: where the circled spot must lie in ${places[place]}, if that geometry is right.`;
    const [a, b, c] = fundamental.map((entries) => entries[0] * spot[0] + entries[1] * spot[1] + entries[2]);
    const square = a * a + b * b;
    if (!square) return;
    const [footX, footY] = [offset[0] - (a * c) / square, offset[1] - (b * c) / square];
    const far = 1e5 / Math.sqrt(square);
    const ends = { x1: footX - far * b, y1: footY + far * a, x2: footX + far * b, y2: footY - far * a };
    for (const style of ["ex-halo", "ex-chosen"]) draw(lines, "line", { class: `${style} ex-thick`, ...ends });
  }

  update();
}

// The photographs as elements to draw from; `ready()` is called as each has been decoded.
function loaded(sources, ready) {
  return Object.fromEntries(Object.entries(sources).map(([name, source]) => {
    const image = new Image();
    image.addEventListener("load", ready);
    image.src = source;
    return [name, image];
  }));
}

export default { render };
