// Export of plots as PNG and SVG, of their data and of all tables as CSV; user limits of colours. Each card has a toolbar for that.
const PICTURE = { width: 900, height: 640, scale: 2 };
function save(name, content, kind) {
  const link = document.createElement("a"),
    address = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type: kind }));
  link.setAttribute("href", address);
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}
// CSV field: texts with a comma, a quote or a line break are quoted, numbers are unchanged, missing values are empty
const csvCell = value =>
  value === null || value === undefined || Number.isNaN(value)
    ? ""
    : /[",\n\r]/.test(String(value))
      ? `"${String(value).replace(/"/g, '""')}"`
      : String(value);
const csv = rows => rows.map(row => row.map(csvCell).join(",")).join("\r\n") + "\r\n";
const fileName = (what, suffix) => {
  const patch = nowPatch() ? `_patch${nowPatch().number}` : "",
    number = nowCase().label.replace(/[^0-9]+/g, "-");
  return `${data.experiment}_${what}_case${number}${patch}.${suffix}`.replace(/[^A-Za-z0-9._-]+/g, "_");
};
// Draw a plot with another context than that of its canvas
function drawn(plot, file) {
  plot.file = file;
  try {
    plot.draw();
  } finally {
    plot.file = null;
    plot.draw();
  }
}
function savePng(plot, what) {
  const canvas = document.createElement("canvas"),
    { width, height, scale } = sizeOf(plot);
  canvas.width = width * scale;
  canvas.height = height * scale;
  drawn(plot, { width, height, ratio: scale, context: canvas.getContext("2d") });
  return new Promise(done =>
    canvas.toBlob(blob => {
      save(fileName(what, "png"), blob);
      done();
    }, "image/png"),
  );
}
function saveSvg(plot, what) {
  const { width, height } = sizeOf(plot),
    context = new SvgContext(width, height);
  drawn(plot, { width, height, ratio: 2, context });
  save(fileName(what, "svg"), context.text(), "image/svg+xml");
}
const sizeOf = plot => (plot.canvas.closest(".card").classList.contains("wide") ? { ...PICTURE, width: 1200 } : PICTURE);

// Data of the plots
function csvOfMap(map) {
  const name = map.choose(),
    shown = picture(name, map.mode()),
    p = shown && shown.patch;
  if (!shown || !shown.values) return [["nothing"]];
  const { mx, my, xl, yl, dx, dy } = p.grid,
    rows = [
      [
        "x [mm]",
        "y [mm]",
        "state",
        `${shown.mode === "difference" ? "difference of " : ""}${name}${pretty(unitOf(p, name)) ? ` [${unitOf(p, name)}]` : ""}`,
      ],
    ];
  for (let iy = 0; iy < my; iy++)
    for (let ix = 0; ix < mx; ix++) {
      const i = ix + mx * iy;
      rows.push([
        +(xl + (ix + 0.5) * dx).toPrecision(9),
        +(yl + (iy + 0.5) * dy).toPrecision(9),
        STATES[shown.fields.eldiv[i]][0],
        +shown.values[i].toPrecision(7),
      ]);
    }
  return rows;
}
function csvOfSection() {
  const lines = plots.section.drawn || [],
    rows = [["line", byId("direction").value + " [mm]", "value [N/mm2]"]];
  for (const l of lines)
    l.values.forEach((v, k) => rows.push([l.name || "-mu pn", +l.places[k].toPrecision(9), +v.toPrecision(7)]));
  return rows;
}
function csvOfCurve() {
  const rows = [["line", "case", byId("curve-x").value, byId("curve-y").value]];
  for (const s of plots.curve.series || [])
    for (const p of s.points) rows.push([s.name, runs[p.run].data.cases[p.index].label, p.x, p.y]);
  return rows;
}
function csvOfBlock() {
  const b = state.block,
    rows = [["x [mm]", "y [mm]", "z [mm]", `${b.name} [${b.name.startsWith("u") ? "mm" : "N/mm2"}]`]];
  if (!b.values) return rows;
  b.z.forEach((z, k) =>
    b.y.forEach((y, j) =>
      b.x.forEach((x, i) => rows.push([x, y, z, +b.values[i + b.x.length * (j + b.y.length * k)].toPrecision(7)])),
    ),
  );
  return rows;
}
function csvOfProfiles() {
  const m = nowCase().markers,
    rows = [["line", "y [mm]", "z [mm]"]];
  for (const [name, list] of [
    ["rail", railLine(nowCase())],
    ["wheel", turned(state.profiles.wheel, m.y_w, m.z_w, m.roll_w)],
  ])
    for (const [y, z] of list) rows.push([name, +y.toPrecision(9), +z.toPrecision(9)]);
  return rows;
}
function csvOfScene() {
  const name = plots.scene.key,
    unit = pretty(unitOf(nowCase().patches[0] || { units: {} }, name)),
    rows = [["patch", "x [mm]", "y [mm]", "z [mm]", name + (unit ? ` [${unit}]` : ""), "px [N/mm2]", "py [N/mm2]"]];
  for (const p of nowCase().patches)
    for (let iy = 0; iy < p.grid.my; iy++)
      for (let ix = 0; ix < p.grid.mx; ix++) {
        const i = ix + p.grid.mx * iy,
          f = p.shown;
        if (f && f.eldiv[i] && f[name])
          rows.push([
            p.number,
            ...plots.scene.place(p, p.grid.xl + (ix + 0.5) * p.grid.dx, iy, 0).map(v => +v.toPrecision(9)),
            f[name][i],
            f.px && f.px[i],
            f.py && f.py[i],
          ]);
      }
  return rows;
}
// All totals of all cases and patches, each with its estimated error if errors were computed
function csvOfCases() {
  const rows = [],
    names = new Set(),
    judged = new Set();
  for (const c of data.cases)
    for (const p of c.patches.length ? c.patches : [null]) {
      const totals = totalsOf(c, p);
      for (const name of Object.keys(totals)) {
        names.add(name);
        if (Number.isFinite(errorOf(c, p, name))) judged.add(name);
      }
      rows.push([c, p, totals]);
    }
  const order = grouped(Object.fromEntries([...names].map(n => [n, 0]))).flatMap(g => g[1]);
  const unit = n => (about(n).unit && about(n).unit !== "-" ? ` [${about(n).unit}]` : "");
  const head = order.flatMap(n => [n + unit(n), ...(judged.has(n) ? [`${n}_error${unit(n)}`] : [])]);
  return [
    ["case", "side", "patch", "status", ...head],
    ...rows.map(([c, p, totals]) => [
      ...[c.label, c.side || "", p ? p.number : "", c.status],
      ...order.flatMap(n => [totals[n], ...(judged.has(n) ? [errorOf(c, p, n)] : [])]),
    ]),
  ];
}
function csvOfTotals() {
  const c = nowCase(),
    p = nowPatch(),
    totals = totalsOf(c, p),
    o = state.other && totalsOf(state.other.case, state.other.patch);
  const judged = Object.keys(totals).some(n => Number.isFinite(errorOf(c, p, n)));
  const row = (group, n) => [
    group,
    n,
    about(n).title,
    totals[n],
    about(n).unit,
    ...(judged ? [errorOf(c, p, n)] : []),
    ...(o ? [o[n]] : []),
  ];
  const head = ["group", "name", "meaning", "value", "unit", ...(judged ? ["estimated error"] : []), ...(o ? ["other run"] : [])];
  return [head, ...grouped(totals).flatMap(([group, names]) => names.map(n => row(group, n)))];
}
function csvOfInputs() {
  return [
    ["group", "name", "value", "unit", "meaning"],
    ...Object.entries(inputsOf(runs[0], nowCase())).flatMap(([group, values]) =>
      Object.entries(values).map(([name, [value, unit, title]]) => [
        group,
        name,
        Array.isArray(value) ? value.join(" ") : value,
        unit,
        title,
      ]),
    ),
  ];
}

// Toolbar of a card: files, and limits of the colours if the plot has a colour scale
function addTools(card, { what, plot, rows }) {
  const name = card.querySelector("h2 .name").textContent,
    bar = document.createElement("div"),
    opener = document.createElement("button");
  bar.className = "tools";
  bar.hidden = true;
  bar.id = `tools-${what}`;
  opener.className = "opener";
  opener.textContent = "\u22ef";
  opener.title = "save, colours";
  opener.setAttribute("aria-label", `${name}: tools`);
  opener.setAttribute("aria-expanded", "false");
  opener.setAttribute("aria-controls", bar.id);
  opener.onclick = event => {
    event.preventDefault();
    bar.hidden = !bar.hidden;
    opener.setAttribute("aria-expanded", String(!bar.hidden));
    if (!bar.hidden && bar.refresh) bar.refresh();
  };
  const tool = (text, action) => {
    const b = document.createElement("button");
    b.textContent = text;
    b.setAttribute("aria-label", `${name} as ${text}`);
    b.onclick = action;
    bar.append(b);
  };
  if (plot) {
    tool("PNG", () => savePng(plot, what));
    tool("SVG", () => saveSvg(plot, what));
  }
  tool("CSV", () => save(fileName(what, "csv"), csv(rows()), "text/csv"));
  if (plot && "key" in plot && what !== "eldiv") addLimits(bar, plot, name);
  card.querySelector("h2").append(opener);
  card.querySelector("h2").after(bar);
}
function addLimits(bar, plot, name) {
  const [low, high] = ["from", "to"].map(text => {
    const l = document.createElement("label"),
      input = document.createElement("input");
    l.textContent = text;
    input.inputMode = "decimal";
    input.size = 7;
    input.setAttribute("aria-label", `colours of ${name} ${text}`);
    l.append(input);
    bar.append(l);
    input.onchange = () => {
      const pair = [low, high].map(i => (i.value.trim() === "" ? NaN : Number(i.value.replace(",", ".").replace("\u2212", "-"))));
      if (pair.every(Number.isFinite) && pair[0] < pair[1]) limits.set(plot.key, pair);
      else limits.delete(plot.key);
      [low, high].forEach(i => i.setAttribute("aria-invalid", String(pair.every(Number.isFinite) && pair[0] >= pair[1])));
      draw();
    };
    return input;
  });
  const free = document.createElement("button");
  free.textContent = "automatic";
  free.setAttribute("aria-label", `colours of ${name} automatic`);
  free.onclick = () => {
    limits.delete(plot.key);
    draw();
    bar.refresh();
  };
  bar.append(free);
  bar.refresh = () => {
    const given = limits.get(plot.key);
    [low.value, high.value] = given || ["", ""];
  };
}
