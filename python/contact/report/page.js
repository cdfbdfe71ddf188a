// The page: selection of the case, its link in the address, and drawing of all parts.
const maps = [],
  plots = {};
function resetView() {
  const p = nowPatch();
  if (!p) return;
  const { mx, my, xl, yl, dx, dy } = p.grid,
    inside = state.fields.eldiv;
  let x0 = mx,
    x1 = -1,
    y0 = my,
    y1 = -1;
  inside.forEach((v, i) => {
    if (v) {
      const ix = i % mx,
        iy = Math.floor(i / mx);
      x0 = Math.min(x0, ix);
      x1 = Math.max(x1, ix);
      y0 = Math.min(y0, iy);
      y1 = Math.max(y1, iy);
    }
  });
  if (x1 < 0) {
    x0 = 0;
    x1 = mx - 1;
    y0 = 0;
    y1 = my - 1;
  }
  const padX = Math.max(1, 0.12 * (x1 - x0 + 1)),
    padY = Math.max(my > 1 ? 1 : 0, 0.12 * (y1 - y0 + 1) * (my > 1 ? 1 : 0));
  state.view = state.home = [xl + (x0 - padX) * dx, xl + (x1 + 1 + padX) * dx, yl + (y0 - padY) * dy, yl + (y1 + 1 + padY) * dy];
  for (const plot of Object.values(plots)) plot.own = null;
  draw();
}
let queued = false;
function changed() {
  if (queued) return;
  queued = true;
  requestAnimationFrame(() => {
    queued = false;
    draw();
  });
}
function draw() {
  if (!state.ready) return;
  for (const map of maps) map.draw();
  for (const plot of Object.values(plots)) if (plot.canvas.offsetParent !== null) plot.draw();
}
// Data of all patches of a case for the plots of wheel and rail
async function prepareRail(c) {
  if (c.module !== 1) return;
  for (const q of c.patches) {
    if (!q.shown) q.shown = await fieldsOf(runs[0], q);
    if (!q.rowPressure)
      q.rowPressure = Array.from({ length: q.grid.my }, (_, iy) => {
        let most = 0;
        for (let ix = 0; ix < q.grid.mx; ix++) most = Math.max(most, q.shown.pn[ix + q.grid.mx * iy]);
        return most;
      });
    if (q.curveBlob !== undefined && !q.curve) {
      const k = await load(runs[0], q.curveBlob),
        n = q.grid.my;
      q.curve = { y: k.slice(0, n), z: k.slice(n, 2 * n), angle: k.slice(2 * n) };
    }
  }
  const before = nowCase();
  if (before !== c) for (const q of before.patches) q.shown = null;
}
let turn = 0;
async function go(index, patch = 0) {
  const mine = ++turn;
  index = Math.max(0, Math.min(data.cases.length - 1, index));
  const before = state.ready ? nowPatch() : null,
    c = data.cases[index];
  patch = Math.max(0, Math.min(c.patches.length - 1, patch));
  const p = c.patches[patch],
    fields = p ? await fieldsOf(runs[0], p) : null,
    profiles = {},
    other = counterpart(index, patch);
  if (other && other.patch) Object.assign(other, { fields: await fieldsOf(other.run, other.patch), differences: new Map() });
  for (const body of ["rail", "wheel"])
    if (c.profiles && body in c.profiles) profiles[body] = await load(runs[0], c.profiles[body]);
  const block = await chosenBlock(p, other);
  if (mine !== turn) return; // a later selection has been drawn already
  await prepareRail(c);
  if (mine !== turn) return;
  const same = before && p && ["xl", "dx", "mx", "my"].every(key => before.grid[key] === p.grid[key]) && state.view;
  const isChanged = state.ready && (state.index !== index || state.patch !== patch);
  Object.assign(state, { index, patch, fields, profiles, block, other, ready: true });
  if (!same) {
    state.row = null;
    state.column = null;
  }
  showWhere(c, isChanged);
  chooseFields(p, fields);
  plots.section.own = null;
  tableOfTotals();
  howObtained();
  tableOfInputs();
  if (!same && p) resetView();
  else draw();
}
// Case and patch in the header, in the table and in the address
function showWhere(c, isChanged) {
  const { index, patch } = state,
    text = `${caseName(c)} (${index + 1} of ${data.cases.length})`;
  byId("slider").value = index;
  byId("slider").setAttribute("aria-valuetext", text);
  byId("where").textContent = text;
  byId("previous").disabled = index === 0;
  byId("next").disabled = index === data.cases.length - 1;
  const tabs =
    c.patches.length > 1
      ? c.patches.map((q, k) => {
          const b = document.createElement("button");
          b.textContent = `patch ${q.number}`;
          b.setAttribute("aria-pressed", k === patch);
          b.onclick = () => go(index, k);
          return b;
        })
      : [];
  byId("patches").replaceChildren(...tabs);
  markCase();
  if (isChanged) history.replaceState(null, "", addressOf(c, patch));
}
const addressOf = (c, patch) => `#case=${c.label}` + (patch ? `&patch=${c.patches[patch].number}` : "");
// Case and patch of an address; the first ones by default
function fromAddress(hash) {
  const found = /^#case=([0-9:\/]+)(?:&patch=(\d+))?$/.exec(hash);
  if (!found) return null;
  const index = data.cases.findIndex(c => c.label === found[1]),
    rest = index < 0 ? data.cases.findIndex(c => String(c.number) === found[1]) : index;
  if (rest < 0) return null;
  return [
    rest,
    found[2]
      ? Math.max(
          0,
          data.cases[rest].patches.findIndex(p => String(p.number) === found[2]),
        )
      : 0,
  ];
}
function chooseFields(p, fields) {
  byId("card-profiles").hidden = byId("card-scene").hidden = !nowCase().markers;
  byId("card-pt").hidden = !!fields && !fields.pt && !sideBySide();
  const select = byId("quantity"),
    keep = select.value,
    offer = [...new Set([...Object.keys(NAMES), ...Object.keys(fields || {})])]
      .filter(n => fields && fields[n] && !PARTS.includes(n))
      .sort((a, b) => ["pn", "pt"].includes(a) - ["pn", "pt"].includes(b));
  const option = n => new Option(nameOf(n) + (pretty(unitOf(p, n)) ? ` [${pretty(unitOf(p, n))}]` : ""), n);
  select.replaceChildren(...offer.map(option));
  select.value = offer.includes(keep)
    ? keep
    : offer.includes("temp1")
      ? "temp1"
      : runs[1] && offer.includes("pn")
        ? "pn"
        : offer[0] || "";
  nameMaps();
  const scene = byId("scene-field"),
    was = scene.value,
    there = [...new Set(["pn", "pt", ...offer])].filter(n => fields && fields[n]);
  scene.replaceChildren(...there.map(option));
  scene.value = there.includes(was) ? was : there[0] || "";
}
// Titles of the maps: the field, or the run if two runs are shown side by side
function nameMaps() {
  const field = capital(nameOf(byId("quantity").value)),
    side = [`${field}, this run`, `${field}, other run`, `${field}, this minus other`];
  maps.forEach((map, k) => {
    map.title = sideBySide() ? (k === 3 ? "Stick and slip, red: other" : side[k]) : map.name;
    map.canvas.closest(".card").querySelector("h2 .name").textContent = map.title;
  });
  byId("hint-pt").hidden = sideBySide();
  // the selection of a field is placed at its map
  const select = byId("quantity"),
    head = maps[sideBySide() ? 0 : 3].canvas.closest(".card").querySelector("h2 .name");
  if (head.nextElementSibling !== select) head.after(select);
}
function chooseCurves() {
  const names = Object.keys(columns).filter(
    n => !isSkipped(n) && data.cases.some(c => c.patches.some(p => Number.isFinite(valueOf(c, p, n)))),
  );
  const varies = name => {
    const [low, high] = rangeOf(data.cases.flatMap(c => c.patches.map(p => valueOf(c, p, name))).filter(Number.isFinite));
    return high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high));
  };
  const fill = (id, first) => {
    byId(id).replaceChildren(...names.map(n => new Option(n, n)));
    byId(id).value = first;
    byId(id).addEventListener("change", () => {
      plots.curve.own = null;
      draw();
    });
  };
  names.sort((a, b) => a.localeCompare(b));
  names.unshift("case");
  const x =
    ["cksi", "ceta", "cphi", "shift_x", "shift_y", "rotation", "y_ws"].filter(n => names.includes(n) && varies(n))[0] || "case";
  const y = ["fx_rel", "fy_rel", "fn", "pmax"].filter(n => names.includes(n) && varies(n))[0] || "fn";
  fill("curve-x", x);
  fill("curve-y", names.includes(y) ? y : names[0]);
}

// ---------------------------------------------------------------- play

let playing = null;
function play(on) {
  clearTimeout(playing);
  playing = null;
  byId("play").setAttribute("aria-pressed", String(on));
  byId("play").textContent = on ? "pause" : "play";
  if (!on) return;
  const pause = () => 1000 / Number(byId("speed").value);
  const step = async () => {
    await go(state.index + 1 < data.cases.length ? state.index + 1 : 0, state.patch);
    if (playing !== null) playing = setTimeout(step, pause());
  };
  playing = setTimeout(step, state.index + 1 < data.cases.length ? pause() : 0);
}

// ---------------------------------------------------------------- another run

function showRuns() {
  const other = runs[1];
  byId("compared").hidden = !other;
  document.body.classList.toggle("two", Boolean(other));
  byId("about").textContent =
    `${data.cases.length} case${data.cases.length === 1 ? "" : "s"} \u00b7 ${data.program}` +
    (other ? ` \u00b7 compared with ${other.data.experiment}` : "");
  const missing = runs
    .filter(run => run.data.run && !run.data.run.complete)
    .map(
      ({ data: d }) =>
        `${runs[1] ? d.experiment + " is " : ""}NOT COMPLETE: ${d.run.cases_finished} of ` +
        `${d.run.input_readable ? "" : "at least "}${d.run.cases_planned} cases finished; ${d.run.reason}`,
    );
  byId("incomplete").textContent = missing.join(" \u00b7 ");
  byId("incomplete").hidden = !missing.length;
}
// Load the page of another run from a file, and use its data as the other run
async function compareWith(file) {
  const found = new DOMParser().parseFromString(await file.text(), "text/html");
  try {
    const [there, arrays] = ["data", "blobs"].map(id => JSON.parse(found.getElementById(id).textContent));
    if (!Array.isArray(there.cases) || !Array.isArray(arrays)) throw new Error("no results");
    runs[1] = runOf(there, arrays);
  } catch {
    read([["", `${file.name} is not a page of contact report`]]);
    return;
  }
  showRuns();
  plots.curve.own = null;
  await go(state.index, state.patch);
}

// ---------------------------------------------------------------- start

function makePictures() {
  const field = () => byId("quantity").value,
    show = () => (runs[1] ? byId("show").value : "this");
  const add = (id, name, side, mode) =>
    maps.push(
      new ElementMap(
        id,
        () => (sideBySide() ? side() : name()),
        () => (sideBySide() ? mode : show()),
      ),
    );
  add("map-pn", () => "pn", field, "this");
  add("map-pt", () => "pt", field, "other");
  add("map-eldiv", () => "eldiv", field, "difference");
  add("map-more", field, () => "eldiv", "this");
  plots.section = new Section("plot-section");
  plots.curve = new Curve("plot-curve");
  plots.profiles = new Profiles("plot-profiles");
  plots.block = new Plane("map-block");
  plots.scene = new Scene("plot-scene");
  const card = picture => picture.canvas.closest(".card");
  for (const map of maps) addTools(card(map), { what: map.canvas.id.slice(4), plot: map, rows: () => csvOfMap(map) });
  for (const [what, rows] of [
    ["section", csvOfSection],
    ["curve", csvOfCurve],
    ["profiles", csvOfProfiles],
    ["block", csvOfBlock],
    ["scene", csvOfScene],
  ])
    addTools(card(plots[what]), { what, plot: plots[what], rows });
  for (const [what, rows] of [
    ["cases", csvOfCases],
    ["totals", csvOfTotals],
    ["inputs", csvOfInputs],
  ])
    addTools(byId(what).closest(".card"), { what, rows });
}
function listen() {
  for (const id of ["block", "stress", "plane", "depth"])
    byId(id).addEventListener("input", async () => {
      if (id === "block" || id === "plane") plots.block.own = null;
      state.block = await chosenBlock(nowPatch(), state.other);
      draw();
    });
  byId("previous").onclick = () => go(state.index - 1, state.patch);
  byId("next").onclick = () => go(state.index + 1, state.patch);
  byId("reset").onclick = () => {
    plots.scene.whole();
    resetView();
  };
  byId("slider").oninput = event => go(Number(event.target.value), state.patch);
  byId("play").onclick = () => play(playing === null);
  for (const id of ["quantity", "scene-field", "scale", "show"])
    byId(id).addEventListener("change", async () => {
      if (id === "show") state.block = await chosenBlock(nowPatch(), state.other);
      for (const bar of document.querySelectorAll(".tools:not([hidden])")) if (bar.refresh) bar.refresh();
      byId("card-pt").hidden = !!state.fields && !state.fields.pt && !sideBySide();
      nameMaps();
      draw();
    });
  byId("scene-wheel").onchange = () => draw();
  byId("direction").onchange = () => {
    plots.section.own = null;
    draw();
  };
  byId("compare").onclick = () => byId("compare-file").click();
  byId("compare-file").onchange = event => {
    if (event.target.files[0]) compareWith(event.target.files[0]);
    event.target.value = "";
  };
  document.addEventListener("keydown", event => {
    if (["SELECT", "INPUT", "CANVAS"].includes(event.target.tagName) || event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === "ArrowLeft") go(state.index - 1, state.patch);
    if (event.key === "ArrowRight") go(state.index + 1, state.patch);
  });
  addEventListener("hashchange", () => {
    const to = fromAddress(location.hash);
    if (to && (to[0] !== state.index || to[1] !== state.patch)) go(...to);
  });
  for (const name of ["beforeprint", "afterprint"]) addEventListener(name, () => draw());
  new ResizeObserver(() => changed()).observe(byId("panels"));
}
function start() {
  byId("title").textContent = data.experiment;
  showRuns();
  byId("slider").max = Math.max(0, data.cases.length - 1);
  if (!data.cases.length) {
    byId("where").textContent = "no cases";
    return;
  }
  tableOfCases();
  makePictures();
  chooseCurves();
  listen();
  byId("print-note").textContent = data.cases.length > 60 ? `The first of ${data.cases.length} cases are printed.` : "";
  for (const id of ["play", "speed"]) byId(id).hidden = data.cases.length < 2;
  read([
    [
      "",
      matchMedia("(pointer:coarse)").matches
        ? "tap a plot to read values; two fingers pan and zoom"
        : "point at a plot to read values; drag to move, Ctrl and wheel to zoom, double click to see all; " +
          "arrow keys step through the cases",
    ],
  ]);
  go(...(fromAddress(location.hash) || [0, 0]));
}
window.contactReport = { state, data, runs, plots, maps, limits, go, play };
start();
