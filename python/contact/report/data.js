// Data of the page: the results of one run, or of two for comparison. page.py writes the arrays, deflated and in base64.
const byId = id => document.getElementById(id);
const embedded = id => JSON.parse(byId(id).textContent);
const runOf = (data, blobs) => ({ data, blobs, decoded: new Map() });
// The run of the page, and optionally another one for comparison
const runs = [runOf(embedded("data"), embedded("blobs"))];
if (embedded("data-other")) runs.push(runOf(embedded("data-other"), embedded("blobs-other")));
const data = runs[0].data;
const columns = data.columns;
// Current selection: case, patch, row and column of the sections, view of the maps; and data derived from it
const state = { index: 0, patch: 0, row: null, column: null, view: null, home: null, fields: null, other: null, ready: false };

const STATES = [
  ["exterior", "#e9edf2"],
  ["adhesion", "#3f78b5"],
  ["slip", "#e58a3c"],
  ["plastic", "#8a4fa8"],
];
const NAMES = {
  pn: "pressure",
  px: "longitudinal traction",
  py: "lateral traction",
  pt: "tangential traction",
  slip: "slip",
  sx: "longitudinal slip",
  sy: "lateral slip",
  mu: "friction coefficient",
  gap: "gap",
  use: "utilised friction, |pt| / (mu pn)",
  power: "frictional power",
  wear: "wear depth",
  temp1: "temperature of body 1",
  temp2: "temperature of body 2",
  taucrt: "yield limit",
  upls: "plastic displacement",
};
// Fields that are not offered as maps, because they are part of other displays
const PARTS = ["eldiv", "uplsx", "uplsy"];
const nameOf = name => NAMES[name] || data.titles[name] || name;

// One array of a run; numbers of 4 bytes are stored as four planes of bytes
function load(run, id) {
  if (!run.decoded.has(id)) run.decoded.set(id, unpack(run.blobs[id]));
  return run.decoded.get(id);
}
async function unpack(blob) {
  const text = atob(blob.data),
    packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  if (blob.kind === "u1") return bytes;
  const n = bytes.length / 4,
    whole = new Uint8Array(bytes.length);
  for (let k = 0; k < 4; k++) for (let i = 0; i < n; i++) whole[4 * i + k] = bytes[k * n + i];
  const view = new DataView(whole.buffer),
    numbers = new Float32Array(n);
  for (let i = 0; i < n; i++) numbers[i] = view.getFloat32(4 * i, true);
  return numbers;
}
// All fields of a patch, and derived fields; read.py computes their ranges in the same way
async function fieldsOf(run, patch) {
  const fields = {};
  for (const name of Object.keys(patch.fields)) fields[name] = await load(run, patch.fields[name]);
  const n = patch.grid.mx * patch.grid.my;
  const derive = make => {
    const a = new Float32Array(n);
    for (let i = 0; i < n; i++) a[i] = make(i);
    return a;
  };
  if (fields.px) {
    const { pn, px, py, sx, sy, mu } = fields,
      veloc = patch.grid.veloc;
    fields.pt = derive(i => Math.hypot(px[i], py[i]));
    if (sx) fields.slip = derive(i => Math.hypot(sx[i], sy[i]));
    if (mu) fields.use = derive(i => (pn[i] > 0 && mu[i] > 0 ? Math.min(1.5, fields.pt[i] / (mu[i] * pn[i])) : 0));
    // slip is relative in rolling: N/mm2 times mm/s, converted to W/mm2
    if (sx && "cksi" in patch.totals && veloc > 0)
      fields.power = derive(i => (Math.abs(px[i] * sx[i] + py[i] * sy[i]) * veloc) / 1000);
  }
  if (fields.uplsx) fields.upls = derive(i => Math.hypot(fields.uplsx[i], fields.uplsy[i]));
  return fields;
}
const DERIVED_UNITS = { pt: "N/mm2", use: "-", upls: "mm", gap: "mm", power: "W/mm2" };
const unitOf = (patch, name) => (name === "slip" ? patch.units.sx : DERIVED_UNITS[name]) || patch.units[name] || "";
const pretty = unit =>
  (unit || "").replace("mm2", "mm\u00b2").replace("mm3", "mm\u00b3").replace("degC", "\u00b0C").replace(/^-$/, "");
function figures(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "\u2013";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3)
    return value
      .toExponential(digits - 1)
      .replace("e+", "e")
      .replace(/-/g, "\u2212");
  return Number(value.toPrecision(digits)).toString().replace("-", "\u2212");
}
const withUnit = (value, unit, digits) => figures(value, digits) + (pretty(unit) ? " " + pretty(unit) : "");
const meta = name => columns[name] || { unit: "", title: name };
const label = name => name + (pretty(meta(name).unit) ? ` [${pretty(meta(name).unit)}]` : "");
// Value of a total, of a patch or of its case
function valueOf(c, p, name) {
  if (name === "case") return c.number;
  if (p && name in p.totals) return p.totals[name];
  return c.totals && name in c.totals ? c.totals[name] : NaN;
}
const nowCase = () => data.cases[state.index];
const nowPatch = () => nowCase().patches[state.patch] || null;
const caseName = c => `case ${c.label}` + (c.side ? `, ${c.side} wheel` : "");

// The case of the other run that has the same number, result element and contact problem; its patch of the same number
function counterpart(index, patch) {
  const run = runs[1],
    mine = data.cases[index],
    found = run && run.data.cases.find(c => c.label === mine.label);
  if (!found) return null;
  const number = mine.patches[patch] && mine.patches[patch].number;
  return { run, case: found, patch: found.patches.find(p => p.number === number) || null };
}
// Values of a field of the other patch at the element centres of this one: bilinear interpolation, exact on equal grids, zero
// outside of its grid, where there is no contact
function resampled(values, from, to) {
  const result = new Float32Array(to.mx * to.my);
  for (let iy = 0; iy < to.my; iy++)
    for (let ix = 0; ix < to.mx; ix++) {
      const u = (to.xl + (ix + 0.5) * to.dx - from.xl) / from.dx - 0.5,
        v = (to.yl + (iy + 0.5) * to.dy - from.yl) / from.dy - 0.5;
      const i = Math.floor(u + 1e-6),
        j = Math.floor(v + 1e-6),
        f = Math.max(0, u - i),
        g = Math.max(0, v - j);
      const at = (a, b) => (a >= 0 && b >= 0 && a < from.mx && b < from.my ? values[a + from.mx * b] : 0);
      const mix = (a, b, t) => (t < 1e-4 ? a : a * (1 - t) + b * t);
      result[ix + to.mx * iy] =
        g < 1e-4 ? mix(at(i, j), at(i + 1, j), f) : mix(mix(at(i, j), at(i + 1, j), f), mix(at(i, j + 1), at(i + 1, j + 1), f), g);
    }
  return result;
}
// Patch, fields and values that a map shows: of this run, of the other one, or their difference on the grid of this one
const comparing = () => runs[1] && byId("show").value !== "this";
const sideBySide = () => runs[1] && byId("show").value === "side";
function picture(name, mode) {
  const p = nowPatch(),
    other = state.other;
  const mine = p && { patch: p, fields: state.fields, values: state.fields[name], mode };
  if (mode === "this") return mine;
  if (!other || !other.patch) return null;
  if (mode === "other") return { patch: other.patch, fields: other.fields, values: other.fields[name], mode };
  if (!mine || !mine.values || !other.fields[name]) return mine && { ...mine, values: undefined };
  if (name === "eldiv") return mine;
  if (!other.differences.has(name)) {
    const theirs = resampled(other.fields[name], other.patch.grid, p.grid),
      touch = resampled(other.fields.eldiv, other.patch.grid, p.grid);
    const inside = state.fields.eldiv.map((v, i) => v || (touch[i] > 0 ? 2 : 0));
    other.differences.set(name, {
      ...mine,
      fields: { ...state.fields, eldiv: inside },
      values: mine.values.map((v, i) => v - theirs[i]),
    });
  }
  return other.differences.get(name);
}
