// Tables: all cases; totals of a case in groups, its solution, its input.
// Groups of totals. Names and meanings are those of the results; "also" is an alternative name
const GROUPS = [
  ["Forces on the rail", ["fz_tr", "fy_tr", "y_over_q", "fx_tr", "fx_ws", "fy_ws", "fz_ws"]],
  [
    "Forces of the patch",
    ["fn", "fx", "fy", "fx_rel", "fy_rel", "mu_scal", "bar_fn", "bar_fx", "bar_fs", "fn_damp", "fx_damp", "fy_damp"],
  ],
  ["Creepages and shifts", ["cksi", "ceta", "cphi", "shift_x", "shift_y", "rotation"]],
  ["Contact", ["pmax", "pen", "contact_area", "smallest_gap"]],
  [
    "Wear, energy and heat",
    ["friction_power", "t_gamma", "wear_index", "max_power", "max_wear", "worn_section", "friction_work", "elastic_energy"].concat(
      ["max_temp1", "max_temp2"],
    ),
  ],
  ["Fatigue", ["traction", "shakedown_load", "shakedown", "fatigue_index", "max_mises", "max_tresca"]],
  ["Contact location", ["xcp_tr", "ycp_tr", "zcp_tr", "deltcp_tr", "ycp_r", "zcp_r", "deltcp_r", "xcp_w", "ycp_w", "zcp_w"]],
  ["Wheelset and rail", ["s_ws", "y_ws", "z_ws", "roll_ws", "yaw_ws", "vpitch_ws", "dy_defl", "dz_defl"]],
  ["Moments", ["mz", "mz_elem", "bar_mn", "mx_r_tr", "my_r_tr", "mz_r_tr", "mx_w_ws", "my_w_ws", "mz_w_ws"]],
  ["Elements and iterations", ["ncon", "nadh", "nslip", "nplast", "border_elements", "force_trials"]],
];
const ALSO = {
  fz_tr: "wheel load Q",
  fy_tr: "guiding force Y",
  y_over_q: "L/V",
  mu_scal: "mu",
  cksi: "\u03be",
  ceta: "\u03b7",
  cphi: "\u03c6",
  deltcp_tr: "contact angle",
};
// Columns that are not totals, or are shown in the table of the solution
const HEADS = "case patch result_element contact_problem module line solved converged status_code missed seconds".split(" ");
const isError = name => name.endsWith("_error");
const isSkipped = name =>
  HEADS.includes(name) ||
  isError(name) ||
  /^(normal|tangential|friction)_(iterations|residual|tolerance)$|^(outer|coupled)_/.test(name);
// The estimated error of a total, if errors were computed
const errorOf = (c, p, name) => {
  const found = [p && p.totals, c && c.totals].find(totals => totals && Number.isFinite(totals[`${name}_error`]));
  return found ? found[`${name}_error`] : NaN;
};
// Derived totals: Y/Q, and frictional work per distance
const DERIVED = {
  y_over_q: { unit: "", title: "lateral over vertical force on the rail", of: t => (t.fz_tr ? t.fy_tr / t.fz_tr : NaN) },
  t_gamma: {
    unit: "J/m",
    title: "frictional work per metre travelled, T-gamma",
    of: (t, p) => (p && p.grid.veloc > 0 ? (-1000 * t.friction_power) / p.grid.veloc : NaN),
  },
};
const about = name => columns[name] || DERIVED[name] || { unit: "", title: name };
// Totals of a case and its patch, with derived totals
function totalsOf(c, p) {
  const all = {};
  for (const from of [c && c.totals, p && p.totals])
    for (const [name, value] of Object.entries(from || {}))
      if (!isSkipped(name) && value !== null) all[name] = p && from === p.totals ? shown(name, p.totals) : value;
  for (const [name, { of }] of Object.entries(DERIVED)) {
    const value = of(all, p);
    if (!(name in all) && Number.isFinite(value)) all[name] = value;
  }
  return all;
}
// Forces and moments that are round-off of the pressures are shown as zero
function shown(name, totals) {
  const small = { fx: 1, fy: 1, mz: 1, fx_rel: 1 / totals.fn, fy_rel: 1 / totals.fn }[name];
  return small && Math.abs(totals[name]) < 1e-9 * small * Math.abs(totals.fn) ? 0 : totals[name];
}
// The groups with the available totals; all other totals come last
function grouped(totals) {
  const known = new Set(GROUPS.flatMap(g => g[1])),
    more = Object.keys(totals).filter(name => !known.has(name));
  return [...GROUPS, ["More", more]]
    .map(([title, names]) => [title, names.filter(name => name in totals)])
    .filter(g => g[1].length);
}
function cell(row, text, tag = "td") {
  const td = document.createElement(tag);
  td.textContent = text;
  row.append(td);
  return td;
}
function headings(table, names) {
  const row = table.createTHead().insertRow();
  for (const name of names) cell(row, name, "th").scope = "col";
}
const capital = text => text[0].toUpperCase() + text.slice(1);

const CASE_COLUMNS = ["fn", "fx", "fy", "pmax", "fy_tr"];
function tableOfCases() {
  const table = byId("cases"),
    first = data.cases.find(c => c.patches.length),
    all = first ? totalsOf(first, first.patches[0]) : {};
  const present = CASE_COLUMNS.filter(n => n in all),
    sides = data.cases.some(c => c.side),
    many = data.cases.some(c => c.patches.length > 1);
  table.replaceChildren();
  headings(table, ["case", ...(sides ? ["side"] : []), ...(many ? ["patch"] : []), ...present.map(label)]);
  const body = table.createTBody();
  data.cases.forEach((c, index) =>
    (c.patches.length ? c.patches : [null]).forEach((p, patch) => {
      const row = body.insertRow(),
        head = cell(row, "", "th"),
        button = document.createElement("button");
      row.dataset.index = index;
      row.dataset.patch = patch;
      button.textContent = c.label + (c.status === "not converged" ? " !" : "");
      button.tabIndex = -1;
      button.setAttribute(
        "aria-label",
        caseName(c) + (many && p ? `, patch ${p.number}` : "") + (c.status === "solved" ? "" : `, ${c.status}`),
      );
      head.scope = "row";
      head.append(button);
      if (sides) cell(row, c.side || "");
      if (many) cell(row, p ? p.number : "");
      const own = p && totalsOf(c, p);
      if (p) for (const name of present) cell(row, figures(own[name]));
      else {
        const td = cell(row, !c.solved ? "no result" : c.status === "solved" ? "no contact" : "no contact, " + c.status);
        td.colSpan = present.length || 1;
      }
      if (c.status !== "solved") row.className = "bad";
    }),
  );
  body.addEventListener("click", event => {
    const row = event.target.closest("tr");
    if (row) go(Number(row.dataset.index), Number(row.dataset.patch));
  });
  body.addEventListener("keydown", event => {
    const row = event.target.closest("tr"),
      to = {
        ArrowDown: row.nextElementSibling,
        ArrowUp: row.previousElementSibling,
        Home: body.firstElementChild,
        End: body.lastElementChild,
      }[event.key];
    if (!to) return;
    event.preventDefault();
    event.stopPropagation();
    to.querySelector("button").focus();
    go(Number(to.dataset.index), Number(to.dataset.patch));
  });
}
function markCase() {
  for (const row of byId("cases").tBodies[0].rows) {
    const is = Number(row.dataset.index) === state.index && Number(row.dataset.patch) === state.patch,
      button = row.querySelector("button");
    button.tabIndex = is ? 0 : -1;
    if (is && !row.classList.contains("now")) {
      row.classList.add("now");
      row.setAttribute("aria-current", "true");
      const list = byId("cases").parentElement,
        top = row.offsetTop - list.querySelector("thead").offsetHeight;
      if (top < list.scrollTop || row.offsetTop + row.offsetHeight > list.scrollTop + list.clientHeight)
        list.scrollTop = top - list.clientHeight / 3;
    } else if (!is && row.classList.contains("now")) {
      row.classList.remove("now");
      row.removeAttribute("aria-current");
    }
  }
}
function tableOfTotals() {
  const table = byId("totals"),
    c = nowCase(),
    p = nowPatch(),
    totals = totalsOf(c, p),
    o = state.other;
  const others = o && totalsOf(o.case, o.patch),
    width = runs[1] ? 5 : 3;
  table.replaceChildren();
  if (runs[1]) headings(table, ["quantity", "this run", "other run", "difference", "unit"]);
  for (const [title, names] of grouped(others ? { ...others, ...totals } : totals)) {
    const body = table.createTBody(),
      head = cell(body.insertRow(), title, "th");
    head.colSpan = width;
    head.scope = "rowgroup";
    for (const name of names) {
      const row = body.insertRow(),
        first = cell(row, capital(about(name).title || name), "th"),
        symbol = document.createElement("span");
      first.scope = "row";
      symbol.className = "symbol";
      symbol.textContent = " " + name + (ALSO[name] ? `, ${ALSO[name]}` : "");
      first.append(symbol);
      const error = errorOf(c, p, name);
      cell(row, figures(totals[name], 6) + (Number.isFinite(error) ? ` \u00b1 ${figures(error, 2)}` : ""));
      if (runs[1]) {
        cell(row, others ? figures(others[name], 6) : "\u2013");
        cell(row, others && name in totals && name in others ? figures(totals[name] - others[name], 3) : "\u2013");
      }
      cell(row, pretty(about(name).unit)).className = "unit";
    }
  }
}
function howObtained() {
  const c = nowCase(),
    p = nowPatch(),
    notes = [];
  const note = (title, text, bad) => {
    const e = document.createElement("p");
    e.className = "note" + (bad ? " bad" : "");
    const b = document.createElement("b");
    b.textContent = title + " ";
    e.append(b, text);
    notes.push(e);
  };
  if (c.status !== "solved") note(capital(c.status) + (c.solved ? ":" : ", no result:"), c.reason, true);
  if (p) {
    if (p.border) note("Contact is cut off", `at ${p.border}: pressures and forces are those of a smaller contact area.`, true);
    if (p.coarse.length)
      note(
        "Few elements",
        `contact is ${p.coarse.join(" x ")} elements wide at most: its area, forces and pressures are inaccurate.`,
        true,
      );
    note("Effects:", p.effects || "none");
    for (const problem of ["normal", "tangential", "friction"]) {
      const s = p.solver[problem + "_method"] || p.solver[problem + "_ended"] ? p.solver : null;
      if (!s) continue;
      const residual = p.totals[problem + "_residual"],
        iterations = p.totals[problem + "_iterations"];
      note(
        capital(problem) + " problem:",
        `${s[problem + "_method"]}, ${s[problem + "_ended"]}` +
          (residual !== undefined && residual !== null ? `, residual ${figures(residual, 2)}` : "") +
          (iterations ? `, ${iterations} iteration${iterations > 1 ? "s" : ""}` : "") +
          (s[problem + "_gave_up"] ? `, after ${s[problem + "_gave_up"]} was abandoned` : ""),
      );
    }
  }
  note("Time:", `${figures(c.seconds, 3)} s`);
  if (runs[1])
    note(
      "Compared with:",
      state.other
        ? state.other.patch
          ? runs[1].data.experiment
          : `${runs[1].data.experiment}, which has no such patch in this case`
        : `${runs[1].data.experiment}, which has no such case`,
      !state.other,
    );
  byId("solution").replaceChildren(...notes);
}
const inputText = value =>
  Array.isArray(value) ? value.map(v => figures(v, 6)).join(", ") : typeof value === "number" ? figures(value, 6) : value;
const inputsOf = (run, c) => (c && c.inputs >= 0 ? run.data.inputs[c.inputs] : {});
function tableOfInputs() {
  const inputs = byId("inputs"),
    other = state.other && inputsOf(runs[1], state.other.case);
  inputs.replaceChildren();
  for (const [group, values] of Object.entries(inputsOf(runs[0], nowCase()))) {
    const h = document.createElement("h3"),
      t = document.createElement("table");
    h.textContent = group;
    t.className = "values";
    for (const [name, [value, unit, title]] of Object.entries(values)) {
      const row = t.insertRow(),
        head = cell(row, name, "th"),
        there = other && other[group] && other[group][name];
      head.title = title || "";
      head.scope = "row";
      cell(row, inputText(value));
      cell(row, pretty(unit)).className = "unit";
      if (there && JSON.stringify(there[0]) !== JSON.stringify(value)) {
        const td = cell(row, `other run: ${inputText(there[0])}`);
        td.className = "differs";
      }
    }
    inputs.append(h, t);
  }
}
