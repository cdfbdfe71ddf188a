// The page of one experiment: maps of the contact, curves over the cases, profiles.
// DATA and BLOBS are written by page.py; everything else happens here, without any network.
const data = JSON.parse(document.getElementById("data").textContent);
const blobs = JSON.parse(document.getElementById("blobs").textContent);
const byId = id => document.getElementById(id);
const state = { index: 0, patch: 0, row: null, view: null, fields: null, ready: false };
const columns = data.columns;
const STATES = [["exterior", "#e9edf2"], ["adhesion", "#3f78b5"], ["slip", "#e58a3c"], ["plastic", "#8a4fa8"]];
const NAMES = { pn: "pressure", px: "longitudinal traction", py: "lateral traction", pt: "tangential traction",
  slip: "slip", sx: "longitudinal slip", sy: "lateral slip", mu: "friction coefficient", gap: "gap",
  use: "use of friction, |pt| / (mu pn)", temp1: "temperature of body 1", temp2: "temperature of body 2",
  taucrt: "yield limit", upls: "plastic displacement" };
// Fields that are shown in other ways than by themselves
const PARTS = ["eldiv", "uplsx", "uplsy"];
const nameOf = name => NAMES[name] || data.titles[name] || name;

// ---------------------------------------------------------------- data

const decoded = new Map();
// One array: base64 of deflated bytes; numbers of 4 bytes are stored as four planes of bytes
function load(id) {
  if (!decoded.has(id)) decoded.set(id, unpack(blobs[id]));
  return decoded.get(id);
}
async function unpack(blob) {
  const text = atob(blob.data), packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  if (blob.kind === "u1") return bytes;
  const n = bytes.length / 4, whole = new Uint8Array(bytes.length);
  for (let k = 0; k < 4; k++) for (let i = 0; i < n; i++) whole[4 * i + k] = bytes[k * n + i];
  const view = new DataView(whole.buffer), numbers = new Float32Array(n);
  for (let i = 0; i < n; i++) numbers[i] = view.getFloat32(4 * i, true);
  return numbers;
}
// All fields of a patch, and those that follow from them
async function fieldsOf(patch) {
  const fields = {};
  for (const name of Object.keys(patch.fields)) fields[name] = await load(patch.fields[name]);
  const n = patch.grid.mx * patch.grid.my;
  const derive = make => { const a = new Float32Array(n); for (let i = 0; i < n; i++) a[i] = make(i); return a; };
  if (fields.px) {
    fields.pt = derive(i => Math.hypot(fields.px[i], fields.py[i]));
    fields.slip = derive(i => Math.hypot(fields.sx[i], fields.sy[i]));
    if (fields.mu) fields.use = derive(i => fields.pn[i] > 0 && fields.mu[i] > 0 ? Math.min(1.5, fields.pt[i] / (fields.mu[i] * fields.pn[i])) : 0);
  }
  if (fields.uplsx) fields.upls = derive(i => Math.hypot(fields.uplsx[i], fields.uplsy[i]));
  return fields;
}
const unitOf = (patch, name) => ({ pt: "N/mm2", use: "-", slip: patch.units.sx, upls: "mm", gap: "mm" })[name] || patch.units[name] || "";
const pretty = unit => (unit || "").replace("mm2", "mm\u00b2").replace("mm3", "mm\u00b3").replace("degC", "\u00b0C").replace(/^-$/, "");
function figures(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "\u2013";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(digits - 1).replace("e+", "e").replace("-", "\u2212").replace("e-", "e\u2212");
  return Number(value.toPrecision(digits)).toString().replace("-", "\u2212");
}

// ---------------------------------------------------------------- colours

const MAPS = {
  pressure: ["#f7f4fb", "#fde0b8", "#fbb36b", "#f07c4a", "#d2434c", "#9b2062", "#551a64", "#1c0f38"],
  calm: ["#f5f9f7", "#cfe8e0", "#93cfc3", "#55ada9", "#2b8491", "#1e5b77", "#153457"],
  signed: ["#1b4f93", "#4f8cc4", "#a9cde5", "#f6f6f4", "#f3bd94", "#d8704a", "#96261f"],
};
function ramp(name) {
  const stops = MAPS[name].map(c => [1, 3, 5].map(k => parseInt(c.slice(k, k + 2), 16)));
  return t => {
    const at = Math.min(Math.max(t, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2), f = at - k;
    return stops[k].map((v, c) => Math.round(v + f * (stops[k + 1][c] - v)));
  };
}

// ---------------------------------------------------------------- drawing

const MARGIN = { left: 64, right: 18, top: 12, bottom: 40 };
// A canvas with axes; children draw inside. View is [x0, x1, y0, y1].
class Frame {
  constructor(id, options = {}) {
    this.canvas = byId(id);
    this.context = this.canvas.getContext("2d");
    Object.assign(this, { equal: false, right: MARGIN.right, shared: false, own: null }, options);
    this.handle();
  }
  get view() { return this.shared ? state.view : this.own; }
  set view(v) { if (this.shared) state.view = v; else this.own = v; }
  begin() {
    const ratio = window.devicePixelRatio || 1, box = this.canvas.getBoundingClientRect();
    this.width = box.width; this.height = box.height;
    if (this.canvas.width !== Math.round(box.width * ratio) || this.canvas.height !== Math.round(box.height * ratio)) {
      this.canvas.width = Math.round(box.width * ratio); this.canvas.height = Math.round(box.height * ratio);
    }
    const c = this.context;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, this.width, this.height);
    c.font = "12px system-ui, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";
    c.fillStyle = "#fff"; c.fillRect(0, 0, this.width, this.height);
    let [x0, x1, y0, y1] = this.view;
    let w = this.width - MARGIN.left - this.right, h = this.height - MARGIN.top - MARGIN.bottom;
    if (this.equal) {
      const scale = Math.min(w / (x1 - x0), h / (y1 - y0));
      const growX = w / scale - (x1 - x0), growY = h / scale - (y1 - y0);
      x0 -= growX / 2; x1 += growX / 2; y0 -= growY / 2; y1 += growY / 2;
    }
    this.shown = [x0, x1, y0, y1]; this.w = w; this.h = h;
    this.X = x => MARGIN.left + (x - x0) / (x1 - x0) * w;
    this.Y = this.down ? y => MARGIN.top + (y - y0) / (y1 - y0) * h : y => MARGIN.top + (y1 - y) / (y1 - y0) * h;
    c.save(); c.beginPath(); c.rect(MARGIN.left, MARGIN.top, w, h); c.clip();
    return c;
  }
  back(px, py) {
    const [x0, x1, y0, y1] = this.shown, fy = (py - MARGIN.top) / this.h;
    return [x0 + (px - MARGIN.left) / this.w * (x1 - x0), this.down ? y0 + fy * (y1 - y0) : y1 - fy * (y1 - y0)];
  }
  end(labelX, labelY) {
    const c = this.context, [x0, x1, y0, y1] = this.shown;
    c.restore();
    c.strokeStyle = "#b7c2cd"; c.lineWidth = 1; c.strokeRect(MARGIN.left + .5, MARGIN.top + .5, this.w, this.h);
    c.fillStyle = "#5b6b7b"; c.strokeStyle = "#b7c2cd";
    c.textAlign = "center"; c.textBaseline = "top";
    for (const t of ticks(x0, x1, this.w / 70)) {
      const x = Math.round(this.X(t)) + .5;
      c.beginPath(); c.moveTo(x, MARGIN.top + this.h); c.lineTo(x, MARGIN.top + this.h + 4); c.stroke();
      c.fillText(tickText(t, x1 - x0), x, MARGIN.top + this.h + 6);
    }
    c.textAlign = "right"; c.textBaseline = "middle";
    for (const t of ticks(y0, y1, this.h / 42)) {
      const y = Math.round(this.Y(t)) + .5;
      c.beginPath(); c.moveTo(MARGIN.left - 4, y); c.lineTo(MARGIN.left, y); c.stroke();
      c.fillText(tickText(t, y1 - y0), MARGIN.left - 6, y);
    }
    c.textAlign = "center"; c.textBaseline = "bottom"; c.fillStyle = "#33414f";
    c.fillText(labelX, MARGIN.left + this.w / 2, this.height - 4);
    c.save(); c.translate(10, MARGIN.top + this.h / 2); c.rotate(-Math.PI / 2); c.textBaseline = "middle"; c.fillText(labelY, 0, 0); c.restore();
  }
  grid() {
    const c = this.context, [x0, x1, y0, y1] = this.shown;
    c.strokeStyle = "#edf1f5"; c.lineWidth = 1; c.beginPath();
    for (const t of ticks(x0, x1, this.w / 70)) { c.moveTo(Math.round(this.X(t)) + .5, 0); c.lineTo(Math.round(this.X(t)) + .5, this.height); }
    for (const t of ticks(y0, y1, this.h / 42)) { c.moveTo(0, Math.round(this.Y(t)) + .5); c.lineTo(this.width, Math.round(this.Y(t)) + .5); }
    c.stroke();
  }
  handle() {
    const canvas = this.canvas;
    let from = null, moved = false;
    const at = event => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
    canvas.addEventListener("pointerdown", event => {
      if (!this.shown) return;
      canvas.setPointerCapture(event.pointerId); from = { at: at(event), view: this.shown.slice() }; moved = false;
    });
    canvas.addEventListener("pointermove", event => {
      if (!this.shown) return;
      const [px, py] = at(event);
      if (from) {
        const dx = px - from.at[0], dy = py - from.at[1];
        if (Math.abs(dx) + Math.abs(dy) > 3) moved = true;
        if (moved) {
          const [x0, x1, y0, y1] = from.view, sx = (x1 - x0) / this.w * dx, sy = (y1 - y0) / this.h * (this.down ? -dy : dy);
          this.view = [x0 - sx, x1 - sx, y0 + sy, y1 + sy]; changed(this);
          return;
        }
      }
      const [x, y] = this.back(px, py);
      if (this.point) this.point(x, y, px, py);
    });
    canvas.addEventListener("pointerup", event => {
      if (from && !moved && this.click) { const [px, py] = at(event); this.click(...this.back(px, py), px, py); }
      from = null;
    });
    canvas.addEventListener("wheel", event => {
      if (!this.shown) return;
      event.preventDefault();
      const factor = Math.exp(Math.max(-1, Math.min(1, event.deltaY / 300)));
      const [x, y] = this.back(...at(event)), [x0, x1, y0, y1] = this.shown;
      this.view = [x + (x0 - x) * factor, x + (x1 - x) * factor, y + (y0 - y) * factor, y + (y1 - y) * factor];
      changed(this);
    }, { passive: false });
    canvas.addEventListener("dblclick", () => { this.view = null; if (this.shared) resetView(); else changed(this); });
  }
}
function ticks(low, high, about) {
  const rough = (high - low) / Math.max(2, about), power = 10 ** Math.floor(Math.log10(rough)), lead = rough / power;
  const step = (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10) * power, list = [];
  for (let t = Math.ceil(low / step - 1e-9) * step; t <= high + step * 1e-9 && list.length < 60; t += step) list.push(Math.abs(t) < step * 1e-9 ? 0 : t);
  return list;
}
function tickText(value, range) {
  if (value === 0) return "0";
  if (range < 1e-3 || Math.abs(value) >= 1e5) return Number(value.toPrecision(3)).toExponential().replace("e+", "e").replace(/-/g, "\u2212");
  return Number(value.toPrecision(6)).toString().replace("-", "\u2212");
}

// A map of the elements
class ElementMap extends Frame {
  constructor(id, choose) { super(id, { equal: true, right: 92, shared: true }); this.choose = choose; }
  point(x, y) { readElement(x, y); }
  click(x, y) { const e = elementAt(x, y); if (e) { state.row = e.iy; plots.section.own = null; draw(); } }
  draw() {
    const patch = nowPatch();
    if (!patch) return blank(this);
    const { mx, my, xl, yl, dx, dy } = patch.grid, name = this.choose(), values = state.fields[name];
    this.equal = ratioIsPlain(state.view);
    const c = this.begin();
    const image = document.createElement("canvas"); image.width = mx; image.height = my;
    const pixels = new ImageData(mx, my), inside = state.fields.eldiv;
    let colour, low = 0, high = 1;
    const discrete = name === "eldiv";
    if (!values) { c.restore(); return blank(this, "not part of this case"); }
    if (!discrete) ({ low, high, colour } = coloursFor(values.filter((_, i) => inside[i] > 0), name === "pn" || name.startsWith("temp") ? "pressure" : "calm"));
    for (let iy = 0; iy < my; iy++) for (let ix = 0; ix < mx; ix++) {
      const i = ix + mx * iy, at = 4 * (ix + mx * (my - 1 - iy));
      let rgb;
      if (discrete || inside[i] === 0) rgb = [1, 3, 5].map(k => parseInt(STATES[inside[i]][1].slice(k, k + 2), 16));
      else rgb = colour((values[i] - low) / (high - low));
      pixels.data.set([...rgb, 255], at);
    }
    image.getContext("2d").putImageData(pixels, 0, 0);
    c.imageSmoothingEnabled = false;
    c.drawImage(image, this.X(xl), this.Y(yl + my * dy), this.X(xl + mx * dx) - this.X(xl), this.Y(yl) - this.Y(yl + my * dy));
    this.outline(c, patch, inside);
    if (name === "pt") this.arrows(c, patch);
    const row = sectionRow();
    c.strokeStyle = "rgba(29,39,51,.55)"; c.setLineDash([4, 4]); c.lineWidth = 1; c.beginPath();
    c.moveTo(0, this.Y(yl + (row + .5) * dy)); c.lineTo(this.width, this.Y(yl + (row + .5) * dy)); c.stroke(); c.setLineDash([]);
    this.end("x [mm]" + (patch.grid.chi !== undefined && Math.abs(patch.grid.chi) < 1e-6 ? ", rolling \u2192" : ""), nowCase().module === 1 ? "s [mm]" : "y [mm]");
    const left = this.width - this.right + 12;
    c.textAlign = "left"; c.textBaseline = "middle"; c.fillStyle = "#33414f";
    if (discrete) {
      const used = STATES.map((s, k) => [s, k]).filter(([, k]) => k === 0 || inside.includes(k));
      used.forEach(([s], k) => {
        c.fillStyle = s[1]; c.fillRect(left, MARGIN.top + 4 + 20 * k, 12, 12); c.strokeStyle = "#b7c2cd"; c.strokeRect(left + .5, MARGIN.top + 4.5 + 20 * k, 12, 12);
        c.fillStyle = "#33414f"; c.fillText(s[0], left + 17, MARGIN.top + 10 + 20 * k);
      });
    } else colourBar(this, low, high, colour, pretty(unitOf(patch, name)));
  }
  // Border of the contact and of the slip area
  outline(c, patch, inside) {
    const { mx, my, xl, yl, dx, dy } = patch.grid;
    const path = (test, style, width) => {
      c.strokeStyle = style; c.lineWidth = width; c.beginPath();
      const is = (ix, iy) => ix >= 0 && iy >= 0 && ix < mx && iy < my && test(inside[ix + mx * iy]);
      for (let iy = 0; iy < my; iy++) for (let ix = 0; ix < mx; ix++) if (is(ix, iy)) {
        const x = this.X(xl + ix * dx), x1 = this.X(xl + (ix + 1) * dx), y = this.Y(yl + iy * dy), y1 = this.Y(yl + (iy + 1) * dy);
        if (!is(ix - 1, iy)) { c.moveTo(x, y); c.lineTo(x, y1); }
        if (!is(ix + 1, iy)) { c.moveTo(x1, y); c.lineTo(x1, y1); }
        if (!is(ix, iy - 1)) { c.moveTo(x, y); c.lineTo(x1, y); }
        if (!is(ix, iy + 1)) { c.moveTo(x, y1); c.lineTo(x1, y1); }
      }
      c.stroke();
    };
    path(v => v > 0, "rgba(29,39,51,.8)", 1.2);
    if (inside.includes(1) && inside.includes(2)) path(v => v === 1, "rgba(29,39,51,.5)", 1);
  }
  arrows(c, patch) {
    const { mx, my, xl, yl, dx, dy } = patch.grid, { px, py, pt, eldiv } = state.fields;
    let most = 0;
    for (let i = 0; i < pt.length; i++) most = Math.max(most, pt[i]);
    if (most === 0) return;
    const ex = Math.abs(this.X(dx) - this.X(0)), ey = Math.abs(this.Y(dy) - this.Y(0));
    const kx = Math.max(1, Math.round(17 / ex)), ky = Math.max(1, Math.round(17 / ey)), longest = 1.25 * Math.max(9, Math.min(kx * ex, ky * ey));
    c.strokeStyle = "#14202c"; c.fillStyle = "#14202c"; c.lineWidth = 1.2;
    for (let iy = Math.floor(ky / 2); iy < my; iy += ky) for (let ix = Math.floor(kx / 2); ix < mx; ix += kx) {
      const i = ix + mx * iy;
      if (!eldiv[i] || pt[i] < 0.02 * most) continue;
      const length = Math.min(longest * pt[i] / most, 34), ux = px[i] / pt[i], uy = -py[i] / pt[i];
      const x = this.X(xl + (ix + .5) * dx), y = this.Y(yl + (iy + .5) * dy);
      const x0 = x - ux * length / 2, y0 = y - uy * length / 2, x1 = x + ux * length / 2, y1 = y + uy * length / 2, head = Math.min(5, 1 + length / 3);
      c.beginPath(); c.moveTo(x0, y0); c.lineTo(x1 - ux * head * .7, y1 - uy * head * .7); c.stroke();
      c.beginPath(); c.moveTo(x1, y1); c.lineTo(x1 - ux * head - uy * head * .5, y1 - uy * head + ux * head * .5);
      c.lineTo(x1 - ux * head + uy * head * .5, y1 - uy * head - ux * head * .5); c.fill();
    }
  }
}
// Range of values and a colour for each of its parts: symmetric about zero when both signs occur, from zero when that is near
function coloursFor(values, map) {
  let low = Infinity, high = -Infinity;
  for (const v of values) { low = Math.min(low, v); high = Math.max(high, v); }
  if (!(high >= low)) { low = 0; high = 1; }
  const negative = low < 0 && high <= -0.02 * low;
  const signed = low < 0 && high > 0 && -low > 0.02 * high && !negative;
  if (signed) { high = Math.max(high, -low); low = -high; } else if (low > 0 && low < 0.6 * high) low = 0;
  if (high <= low) { const middle = low; low = middle - 0.5 * Math.max(Math.abs(middle), 1e-30); high = middle + 0.5 * Math.max(Math.abs(middle), 1e-30); }
  if (negative && high < 0 && high > 0.6 * low) high = 0;
  const scale = ramp(signed ? "signed" : map);
  return { low, high, colour: negative ? t => scale(1 - t) : scale };
}
function colourBar(frame, low, high, colour, unit) {
  const c = frame.context, left = frame.width - frame.right + 12, height = frame.h - 22;
  for (let k = 0; k < height; k++) { c.fillStyle = `rgb(${colour(1 - k / height)})`; c.fillRect(left, MARGIN.top + 20 + k, 12, 1.5); }
  c.strokeStyle = "#b7c2cd"; c.strokeRect(left + .5, MARGIN.top + 20.5, 12, height);
  c.textAlign = "left"; c.textBaseline = "middle";
  c.fillStyle = "#33414f"; c.fillText(unit, left, MARGIN.top + 8);
  c.fillStyle = "#5b6b7b";
  for (const t of ticks(low, high, 5)) c.fillText(tickText(t, high - low), left + 16, MARGIN.top + 20 + height * (high - t) / (high - low));
}
const ratioIsPlain = view => { const r = (view[1] - view[0]) / (view[3] - view[2]); return r < 6 && r > 1 / 6; };
function blank(frame, text = "no contact") {
  frame.own = frame.own || [0, 1, 0, 1];
  const ratio = window.devicePixelRatio || 1, box = frame.canvas.getBoundingClientRect(), c = frame.context;
  frame.canvas.width = box.width * ratio; frame.canvas.height = box.height * ratio; c.setTransform(ratio, 0, 0, ratio, 0, 0);
  c.fillStyle = "#8a98a6"; c.font = "14px system-ui, 'DejaVu Sans', sans-serif"; c.textAlign = "center"; c.fillText(text, box.width / 2, box.height / 2);
  frame.shown = null;
}

// Stresses in a plane through a block of points, or along a line of points
const PLANES = { y: ["x", "z"], x: ["y", "z"], z: ["x", "y"] };
const STRESSES = { sigvm: "von Mises stress", sighyd: "mean stress", sigtr: "Tresca's stress", sigma1: "largest principal stress",
  sigma2: "middle principal stress", sigma3: "smallest principal stress", sigxx: "\u03c3xx", sigyy: "\u03c3yy", sigzz: "\u03c3zz", sigxy: "\u03c3xy",
  sigxz: "\u03c3xz", sigyz: "\u03c3yz", ux: "displacement ux", uy: "displacement uy", uz: "displacement uz" };
const stressUnit = name => name.startsWith("u") ? "mm" : "N/mm\u00b2";
class Plane extends Frame {
  constructor(id) { super(id, { right: 78 }); }
  // Number of a point, from its numbers along the two axes of the plane
  at(block, i, j) {
    const n = [block.x.length, block.y.length], { plane, place } = block;
    const [ix, iy, iz] = plane === "y" ? [i, place, j] : plane === "x" ? [place, i, j] : [i, j, place];
    return ix + n[0] * (iy + n[1] * iz);
  }
  draw() {
    const b = state.block;
    if (!b) return;
    const [across, along] = PLANES[b.plane].map(axis => b[axis]);
    const values = Array.from({ length: along.length }, (_, j) => across.map((_, i) => b.values[this.at(b, i, j)]));
    const flat = values.flat(), { low, high, colour } = coloursFor(flat, b.name === "sigvm" || b.name === "sigtr" ? "pressure" : "calm");
    this.down = b.plane !== "z";
    if (across.length < 2 || along.length < 2) return this.line(b, across, along, flat);
    const first = list => list[0], last = list => list[list.length - 1];
    if (!this.own) this.own = [first(across), last(across), first(along), last(along)];
    this.equal = ratioIsPlain(this.own);
    const c = this.begin(), ratio = window.devicePixelRatio || 1;
    const x0 = Math.max(MARGIN.left, this.X(first(across))), x1 = Math.min(MARGIN.left + this.w, this.X(last(across)));
    const ya = this.Y(first(along)), yb = this.Y(last(along)), y0 = Math.max(MARGIN.top, Math.min(ya, yb)), y1 = Math.min(MARGIN.top + this.h, Math.max(ya, yb));
    const width = Math.round((x1 - x0) * ratio), height = Math.round((y1 - y0) * ratio);
    if (width > 0 && height > 0) {
      // linear between the points
      const cells = (list, n, place) => Array.from({ length: n }, (_, k) => {
        const p = place((k + .5) / ratio);
        let i = 0;
        while (i < list.length - 2 && p > list[i + 1]) i++;
        return [i, Math.min(1, Math.max(0, (p - list[i]) / (list[i + 1] - list[i])))];
      });
      const columns = cells(across, width, k => this.back(x0 + k, 0)[0]), rows = cells(along, height, k => this.back(0, y0 + k)[1]);
      const image = document.createElement("canvas"); image.width = width; image.height = height;
      const pixels = new ImageData(width, height), table = Array.from({ length: 257 }, (_, k) => colour(k / 256));
      rows.forEach(([j, g], ky) => columns.forEach(([i, f], kx) => {
        const v = (values[j][i] * (1 - f) + values[j][i + 1] * f) * (1 - g) + (values[j + 1][i] * (1 - f) + values[j + 1][i + 1] * f) * g;
        const rgb = table[Math.round(256 * Math.min(1, Math.max(0, (v - low) / (high - low))))];
        pixels.data.set([rgb[0], rgb[1], rgb[2], 255], 4 * (kx + width * ky));
      }));
      image.getContext("2d").putImageData(pixels, 0, 0);
      c.drawImage(image, x0, y0, x1 - x0, y1 - y0);
    }
    if (this.down) { c.strokeStyle = "rgba(29,39,51,.5)"; c.beginPath(); c.moveTo(0, this.Y(0)); c.lineTo(this.width, this.Y(0)); c.stroke(); }
    const names = PLANES[b.plane];
    this.end(names[0] + " [mm]", names[1] + (names[1] === "z" ? " [mm], positive in body 1" : " [mm]"));
    colourBar(this, low, high, colour, stressUnit(b.name));
  }
  // A line or a single point
  line(b, across, along, values) {
    const k = across.length > 1 ? 0 : 1, places = [across, along][k];
    if (places.length < 2) return blank(this, `${STRESSES[b.name]} ${figures(values[0], 5)} ${stressUnit(b.name)} in the only point`);
    this.down = this.equal = false;
    let low = Math.min(0, ...values), high = Math.max(0, ...values);
    if (high === low) high = low + 1;
    if (!this.own) this.own = [places[0], places[places.length - 1], low - .06 * (high - low), high + .06 * (high - low)];
    const c = this.begin(); this.grid();
    c.strokeStyle = "#c2452d"; c.lineWidth = 2; c.beginPath();
    places.forEach((p, i) => { if (i) c.lineTo(this.X(p), this.Y(values[i])); else c.moveTo(this.X(p), this.Y(values[i])); });
    c.stroke();
    this.end(PLANES[b.plane][k] + " [mm]", stressUnit(b.name));
  }
  point(u, v) {
    const b = state.block, nearest = (list, p) => list.reduce((best, q, i) => Math.abs(q - p) < Math.abs(list[best] - p) ? i : best, 0);
    if (!b) return;
    const [across, along] = PLANES[b.plane].map(axis => b[axis]);
    const one = across.length < 2, i = one ? 0 : nearest(across, u), j = along.length < 2 ? 0 : nearest(along, one ? u : v), k = this.at(b, i, j);
    const place = { [PLANES[b.plane][0]]: across[i], [PLANES[b.plane][1]]: along[j], [b.plane]: b[b.plane][b.place] };
    read([...["x", "y", "z"].map(axis => [axis, `${figures(place[axis])} mm`]), [STRESSES[b.name], `${figures(b.values[k], 5)} ${stressUnit(b.name)}`]]);
  }
}
// The chosen block, stress and plane of the patch; keeps what was chosen where it can
async function chosenBlock(p) {
  const blocks = p && p.blocks ? p.blocks : [];
  byId("card-block").hidden = !blocks.length;
  if (!blocks.length) return null;
  const offer = (id, names, fallback) => {
    const select = byId(id), keep = select.value, values = names.map(n => n[0]);
    select.replaceChildren(...names.map(n => new Option(n[1], n[0])));
    select.value = values.includes(keep) ? keep : fallback;
    return select.value;
  };
  const block = blocks[Number(offer("block", blocks.map((b, k) => [String(k), `block ${k + 1}`]), "0"))];
  byId("block").hidden = blocks.length < 2;
  const name = offer("stress", Object.keys(STRESSES).filter(n => n in block.fields).map(n => [n, STRESSES[n]]), "sigvm");
  const size = axis => block[axis].length > 1 ? 1 : 0, best = ["y", "x", "z"].sort((a, b) => size(a) - size(b))[0];
  const fits = ["y", "x", "z"].filter(axis => PLANES[axis].reduce((sum, other) => sum + size(other), 0) === PLANES[best].reduce((sum, other) => sum + size(other), 0));
  const plane = offer("plane", fits.map(axis => [axis, `${axis} = constant`]), fits[0]);
  const count = block[plane].length, slider = byId("depth"), key = `${plane}${count}`;
  slider.max = count - 1;
  if (slider.dataset.key !== key) {
    // through the middle; with depths a little below the surface
    slider.dataset.key = key;
    slider.value = Math.floor((count - 1) / 2);
  }
  slider.hidden = count < 2;
  const place = Number(slider.value);
  byId("depth-text").textContent = `${plane} = ${figures(block[plane][place])} mm`;
  return { ...block, name, plane, place, values: await load(block.fields[name]) };
}

// Pressure bound and tractions along one row of elements
class Section extends Frame {
  draw() {
    const patch = nowPatch();
    if (!patch) { byId("section-row").textContent = ""; return blank(this); }
    const { mx, xl, yl, dx, dy } = patch.grid, row = sectionRow(), f = state.fields, lines = [];
    const cut = (values, factor) => Array.from({ length: mx }, (_, ix) => values[ix + mx * row] * (factor ? factor[ix + mx * row] : 1));
    if (f.px) {
      const bound = cut(f.mu || f.pn.map(() => patch.totals.mu_scal), f.pn);
      lines.push(["\u00b1 mu pn", "#9aa7b4", bound, [5, 4]], ["", "#9aa7b4", bound.map(v => -v), [5, 4]], ["px", "#c2452d", cut(f.px)], ["py", "#1f5fa8", cut(f.py)]);
    } else lines.push(["pn", "#c2452d", cut(f.pn)]);
    const all = lines.flatMap(l => l[2]);
    let low = Math.min(0, ...all), high = Math.max(0, ...all);
    if (high === low) { high = 1; low = -1; }
    if (!this.own) this.own = [state.view[0], state.view[1], low - .06 * (high - low), high + .1 * (high - low)];
    const c = this.begin(); this.grid();
    c.strokeStyle = "#8a98a6"; c.beginPath(); c.moveTo(0, this.Y(0)); c.lineTo(this.width, this.Y(0)); c.stroke();
    for (const [, colour, values, dash] of lines) {
      c.strokeStyle = colour; c.lineWidth = dash ? 1.3 : 2; c.setLineDash(dash || []); c.beginPath();
      values.forEach((v, ix) => { const x = this.X(xl + (ix + .5) * dx), y = this.Y(v); if (ix) c.lineTo(x, y); else c.moveTo(x, y); });
      c.stroke();
    }
    c.setLineDash([]);
    this.end("x [mm]", "N/mm\u00b2");
    legend(c, this, lines.filter(l => l[0]).map(l => [l[0], l[1]]));
    byId("section-row").textContent = `row ${row + 1} of ${patch.grid.my}, y = ${figures(yl + (row + .5) * dy)} mm; click a map for another`;
  }
  point(x) {
    const g = nowPatch() && nowPatch().grid;
    if (g) readElement(x, g.yl + (sectionRow() + .5) * g.dy);
  }
}
function legend(c, frame, entries) {
  let x = MARGIN.left + 10;
  c.textAlign = "left"; c.textBaseline = "middle";
  for (const [text, colour] of entries) {
    c.strokeStyle = colour; c.lineWidth = 2.5; c.beginPath(); c.moveTo(x, MARGIN.top + 12); c.lineTo(x + 18, MARGIN.top + 12); c.stroke();
    c.fillStyle = "#33414f"; c.fillText(text, x + 23, MARGIN.top + 12);
    x += 38 + c.measureText(text).width;
  }
}

// Totals against each other, one point per patch
class Curve extends Frame {
  draw() {
    const name = [byId("curve-x").value, byId("curve-y").value];
    const points = this.points = [];
    data.cases.forEach((c, index) => c.patches.forEach((p, patch) => {
      const x = valueOf(c, p, name[0]), y = valueOf(c, p, name[1]);
      if (Number.isFinite(x) && Number.isFinite(y)) points.push({ x, y, index, patch });
    }));
    if (!points.length) return blank(this, "no values");
    if (!this.own) {
      let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
      for (const p of points) { x0 = Math.min(x0, p.x); x1 = Math.max(x1, p.x); y0 = Math.min(y0, p.y); y1 = Math.max(y1, p.y); }
      const widen = (a, b) => b > a ? .06 * (b - a) : Math.max(Math.abs(a) * .1, 1e-12);
      const wx = widen(x0, x1), wy = widen(y0, y1);
      this.own = [x0 - wx, x1 + wx, y0 - wy, y1 + wy];
    }
    const c = this.begin(); this.grid();
    const many = points.length > 300;
    const patches = [...new Set(points.map(p => p.patch))];
    for (const k of patches) {
      const own = points.filter(p => p.patch === k);
      c.strokeStyle = k ? "rgba(229,138,60,.45)" : "rgba(31,95,168,.4)"; c.lineWidth = 1.2; c.beginPath();
      own.forEach((p, i) => { if (i) c.lineTo(this.X(p.x), this.Y(p.y)); else c.moveTo(this.X(p.x), this.Y(p.y)); });
      c.stroke();
      c.fillStyle = k ? "#e58a3c" : "#1f5fa8";
      for (const p of own) { c.beginPath(); c.arc(this.X(p.x), this.Y(p.y), many ? 1.8 : 3.2, 0, 7); c.fill(); }
    }
    const now = points.find(p => p.index === state.index && p.patch === state.patch);
    if (now) { c.strokeStyle = "#c2452d"; c.lineWidth = 2.5; c.beginPath(); c.arc(this.X(now.x), this.Y(now.y), 7, 0, 7); c.stroke(); }
    this.end(label(name[0]), label(name[1]));
  }
  near(px, py) {
    let best = null, distance = 400;
    for (const p of this.points || []) {
      const d = (this.X(p.x) - px) ** 2 + (this.Y(p.y) - py) ** 2;
      if (d < distance) { distance = d; best = p; }
    }
    return best;
  }
  point(x, y, px, py) {
    const p = this.near(px, py);
    const shown = p || { x, y };
    read([["case", p ? data.cases[p.index].number : "\u2013"], [byId("curve-x").value, figures(shown.x, 6)], [byId("curve-y").value, figures(shown.y, 6)]]);
  }
  click(x, y, px, py) { const p = this.near(px, py); if (p) go(p.index, p.patch); }
}
const meta = name => columns[name] || { unit: "", title: name };
const label = name => name + (pretty(meta(name).unit) ? ` [${pretty(meta(name).unit)}]` : "");
function valueOf(c, p, name) {
  if (name === "case") return c.number;
  if (p && name in p.totals) return p.totals[name];
  return c.totals && name in c.totals ? c.totals[name] : NaN;
}

// Profiles and where they touch
class Profiles extends Frame {
  draw() {
    const c0 = nowCase();
    if (!c0.markers) return;
    const m = c0.markers, turn = (y, z, oy, oz, roll) => [oy + y * Math.cos(roll) - z * Math.sin(roll), oz + y * Math.sin(roll) + z * Math.cos(roll)];
    const path = (points, oy, oz, roll) => {
      const list = [];
      for (let i = 0; points && i < points.length; i += 2) list.push(turn(points[i], points[i + 1], oy, oz, roll));
      return list;
    };
    const rail = path(state.profiles.rail, m.y_r, m.z_r, m.roll_r), wheel = path(state.profiles.wheel, m.y_w, m.z_w, m.roll_w);
    const near = c0.patches.length ? c0.patches.map(p => [p.totals.ycp_tr, p.totals.zcp_tr]) : rail.slice(0, 1);
    // a step to the other side of the track, or far along the rail's head, moves the view
    const inView = ([y, z]) => y > this.own[0] && y < this.own[1] && z > this.own[2] && z < this.own[3];
    if (this.own && this.seen !== state.index && !near.some(inView)) this.own = null;
    this.seen = state.index;
    if (!this.own) {
      const ys = near.map(p => p[0]), zs = near.map(p => p[1]), reach = 45;
      this.own = [Math.min(...ys) - reach, Math.max(...ys) + reach, Math.min(...zs) - 14, Math.max(...zs) + 22];
    }
    this.down = true; this.equal = true;
    const c = this.begin(); this.grid();
    const [x0, x1, , z1] = this.shown;
    const draw = (list, colour, fill) => {
      if (!list.length) return;
      c.beginPath(); list.forEach(([y, z], i) => { if (i) c.lineTo(this.X(y), this.Y(z)); else c.moveTo(this.X(y), this.Y(z)); });
      c.strokeStyle = colour; c.lineWidth = 2; c.stroke();
    };
    draw(wheel, "#5b6b7b"); draw(rail, "#1d2733");
    c0.patches.forEach((p, k) => {
      const t = p.totals, { my, yl, dy } = p.grid, pressure = p.rowPressure, most = Math.max(...c0.patches.map(q => Math.max(...q.rowPressure))) || 1;
      c.fillStyle = k === state.patch ? "rgba(210,67,76,.75)" : "rgba(229,138,60,.6)";
      for (let iy = 0; iy < my; iy++) if (pressure[iy] > 0) {
        const s = yl + (iy + .5) * dy, half = dy / 2, angle = p.curve ? p.curve.angle[iy] : t.deltcp_tr;
        const y = p.curve ? p.curve.y[iy] : t.ycp_tr + s * Math.cos(angle), z = p.curve ? p.curve.z[iy] : t.zcp_tr + s * Math.sin(angle);
        const height = 46 * pressure[iy] / most, nx = -Math.sin(angle), nz = Math.cos(angle), tx = Math.cos(angle), tz = Math.sin(angle);
        const corner = (a, b) => [this.X(y + a * half * tx) + b * nx, this.Y(z + a * half * tz) + b * nz];
        c.beginPath(); c.moveTo(...corner(-1, 0)); c.lineTo(...corner(1, 0)); c.lineTo(...corner(1, height)); c.lineTo(...corner(-1, height)); c.fill();
      }
      c.fillStyle = "#33414f"; c.textAlign = "center"; c.textBaseline = "top";
      c.fillText(`patch ${p.number}`, this.X(t.ycp_tr), this.Y(t.zcp_tr) + 52);
    });
    this.end("y [mm]", "z [mm]");
    legend(c, this, [["wheel", "#5b6b7b"], ["rail", "#1d2733"], ["pressure over the row", "#d2434c"]]);
  }
  point(y, z) { read([["y", figures(y, 6) + " mm"], ["z", figures(z, 6) + " mm"]]); }
}

// ---------------------------------------------------------------- reading under the pointer

function read(pairs) {
  byId("readout").replaceChildren(...pairs.map(([name, value]) => {
    const span = document.createElement("span"), mark = document.createElement("i");
    mark.textContent = name; span.append(mark, String(value)); return span;
  }));
}
function elementAt(x, y) {
  const p = nowPatch();
  if (!p) return null;
  const ix = Math.floor((x - p.grid.xl) / p.grid.dx), iy = Math.floor((y - p.grid.yl) / p.grid.dy);
  return ix >= 0 && iy >= 0 && ix < p.grid.mx && iy < p.grid.my ? { ix, iy, i: ix + p.grid.mx * iy } : null;
}
function readElement(x, y) {
  const p = nowPatch(), e = elementAt(x, y), pairs = [["x", figures(x) + " mm"], ["y", figures(y) + " mm"]];
  if (e) {
    const f = state.fields;
    pairs.push(["element", `${e.ix + 1}, ${e.iy + 1}`], ["", STATES[f.eldiv[e.i]][0]], ["pn", `${figures(f.pn[e.i])} N/mm\u00b2`]);
    if (f.px) pairs.push(["px", figures(f.px[e.i])], ["py", figures(f.py[e.i])], ["|pt|", figures(f.pt[e.i])], ["slip", `${figures(f.slip[e.i])} ${pretty(unitOf(p, "slip"))}`]);
    if (f.temp1) pairs.push(["temperatures", `${figures(f.temp1[e.i])}, ${figures(f.temp2[e.i])} \u00b0C`]);
    const more = byId("quantity").value;
    if (f[more] && !["px", "py", "pn", "slip", "temp1", "temp2"].includes(more)) pairs.push([nameOf(more), `${figures(f[more][e.i])} ${pretty(unitOf(p, more))}`]);
  }
  read(pairs);
}

// ---------------------------------------------------------------- the page

const nowCase = () => data.cases[state.index];
const nowPatch = () => nowCase().patches[state.patch] || null;
function sectionRow() {
  const p = nowPatch();
  if (state.row !== null && state.row < p.grid.my) return state.row;
  let best = 0, most = -1;
  state.fields.pn.forEach((v, i) => { if (v > most) { most = v; best = Math.floor(i / p.grid.mx); } });
  // of equal rows the middle one
  let last = best;
  for (let iy = best; iy < p.grid.my; iy++) {
    let here = 0;
    for (let ix = 0; ix < p.grid.mx; ix++) here = Math.max(here, state.fields.pn[ix + p.grid.mx * iy]);
    if (here >= most * (1 - 1e-6)) last = iy;
  }
  return Math.floor((best + last) / 2);
}
function resetView() {
  const p = nowPatch();
  if (!p) return;
  const { mx, my, xl, yl, dx, dy } = p.grid, inside = state.fields.eldiv;
  let x0 = mx, x1 = -1, y0 = my, y1 = -1;
  inside.forEach((v, i) => { if (v) { const ix = i % mx, iy = Math.floor(i / mx); x0 = Math.min(x0, ix); x1 = Math.max(x1, ix); y0 = Math.min(y0, iy); y1 = Math.max(y1, iy); } });
  if (x1 < 0) { x0 = 0; x1 = mx - 1; y0 = 0; y1 = my - 1; }
  const padX = Math.max(1, .12 * (x1 - x0 + 1)), padY = Math.max(my > 1 ? 1 : 0, .12 * (y1 - y0 + 1) * (my > 1 ? 1 : 0));
  state.view = [xl + (x0 - padX) * dx, xl + (x1 + 1 + padX) * dx, yl + (y0 - padY) * dy, yl + (y1 + 1 + padY) * dy];
  for (const plot of Object.values(plots)) plot.own = null;
  draw();
}
const maps = [], plots = {};
let queued = false;
function changed(frame) {
  if (!frame.shared && !frame.view) frame.own = null;
  if (queued) return;
  queued = true;
  requestAnimationFrame(() => { queued = false; draw(); });
}
function draw() {
  if (!state.ready) return;
  for (const map of maps) map.draw();
  for (const plot of Object.values(plots)) plot.draw();
}
function cell(row, text) { const td = document.createElement("td"); td.textContent = text; row.append(td); return td; }
function tableOfCases() {
  const table = byId("cases"), first = data.cases.find(c => c.patches.length), wanted = ["fn", "fx", "fy", "pmax"].filter(n => first && n in first.patches[0].totals);
  const head = table.createTHead().insertRow();
  const plain = name => name === "case" || name === "patch" ? name : label(name);
  for (const name of ["case", ...(data.cases.some(c => c.patches.length > 1) ? ["patch"] : []), ...wanted]) { const th = document.createElement("th"); th.textContent = plain(name); head.append(th); }
  const body = table.createTBody(), many = head.cells.length > wanted.length + 1;
  data.cases.forEach((c, index) => {
    (c.patches.length ? c.patches : [null]).forEach((p, patch) => {
      const row = body.insertRow();
      row.dataset.index = index; row.dataset.patch = patch;
      cell(row, c.label + (c.status === "not converged" ? " !" : ""));
      if (many) cell(row, p ? p.number : "\u2013");
      if (p) for (const name of wanted) cell(row, figures(shown(name, p.totals)));
      else { const td = cell(row, !c.solved ? "no result" : c.status === "solved" ? "no contact" : "no contact, " + c.status); td.colSpan = wanted.length; }
      if (c.status !== "solved") row.className = "bad";
      row.addEventListener("click", () => go(index, patch));
    });
  });
}
const ORDER = ["fn", "fx", "fy", "mz", "fx_rel", "fy_rel", "mu_scal", "pen", "pmax", "cksi", "ceta", "cphi", "shift_x", "shift_y", "rotation",
  "friction_power", "friction_work", "elastic_energy", "max_temp1", "max_temp2", "contact_area", "ncon", "border_elements", "nadh", "nslip", "nplast"];
// Forces and moments that are rounding errors of the pressure are shown as zero
function shown(name, totals) {
  const small = { fx: 1, fy: 1, mz: 1, fx_rel: 1 / totals.fn, fy_rel: 1 / totals.fn }[name];
  return small && Math.abs(totals[name]) < 1e-9 * small * Math.abs(totals.fn) ? 0 : totals[name];
}
const rank = name => ORDER.includes(name) ? ORDER.indexOf(name) : ORDER.length;
function valueRow(table, name, value, unit, title) {
  const row = table.insertRow();
  cell(row, name).title = title || ""; cell(row, value); cell(row, pretty(unit));
}
function tellTotals() {
  const table = byId("totals"), c = nowCase(), p = nowPatch();
  table.replaceChildren();
  const skip = ["case", "patch", "result_element", "contact_problem", "module", "line", "solved", "converged", "status_code", "missed", "seconds"];
  for (const from of [p && p.totals, c.totals]) for (const name of Object.keys(from || {}).sort((a, b) => rank(a) - rank(b)))
    if (!skip.includes(name) && !/^(normal|tangential|friction)_(iterations|residual|tolerance)$|^outer_|^coupled_/.test(name) && from[name] !== null)
      valueRow(table, name, figures(shown(name, from), 6), meta(name).unit, meta(name).title);
  const box = byId("solution"), notes = [];
  const note = (title, text, bad) => { const e = document.createElement("p"); e.className = "note" + (bad ? " bad" : ""); const b = document.createElement("b"); b.textContent = title + " "; e.append(b, text); notes.push(e); };
  if (c.status !== "solved") note(c.status[0].toUpperCase() + c.status.slice(1) + (c.solved ? ":" : ", no result:"), c.reason, true);
  if (p) {
    if (p.border) note("Contact is cut off", `at ${p.border}: pressures and forces are those of a smaller contact area.`, true);
    if (p.coarse.length) note("Few elements", `contact is ${p.coarse.join(" x ")} elements wide at most: its area, forces and pressures are rough.`, true);
    note("Effects:", p.effects || "none");
    for (const problem of ["normal", "tangential", "friction"]) {
      const s = p.solver[problem + "_method"] || p.solver[problem + "_ended"] ? p.solver : null;
      if (!s) continue;
      const residual = p.totals[problem + "_residual"], iterations = p.totals[problem + "_iterations"];
      note(problem[0].toUpperCase() + problem.slice(1) + " problem:", `${s[problem + "_method"]}, ${s[problem + "_ended"]}`
        + (residual !== undefined && residual !== null ? `, residual ${figures(residual, 2)}` : "") + (iterations ? `, ${iterations} iteration${iterations > 1 ? "s" : ""}` : "")
        + (s[problem + "_gave_up"] ? `, after ${s[problem + "_gave_up"]} was given up` : ""));
    }
  }
  note("Time:", `${figures(c.seconds, 3)} s`);
  box.replaceChildren(...notes);
  const inputs = byId("inputs");
  inputs.replaceChildren();
  for (const [group, values] of Object.entries(c.inputs >= 0 ? data.inputs[c.inputs] : {})) {
    const h = document.createElement("h3"), t = document.createElement("table");
    h.textContent = group; t.className = "values";
    for (const [name, [value, unit, title]] of Object.entries(values)) valueRow(t, name, Array.isArray(value) ? value.map(v => figures(v, 6)).join(", ") : typeof value === "number" ? figures(value, 6) : value, unit, title);
    inputs.append(h, t);
  }
}
let turn = 0;
async function go(index, patch = 0) {
  const mine = ++turn;
  index = Math.max(0, Math.min(data.cases.length - 1, index));
  const before = nowPatch(), c = data.cases[index];
  patch = Math.max(0, Math.min(c.patches.length - 1, patch));
  const p = c.patches[patch], fields = p ? await fieldsOf(p) : null, profiles = {};
  for (const body of ["rail", "wheel"]) if (c.profiles && body in c.profiles) profiles[body] = await load(c.profiles[body]);
  for (const q of c.patches) if (c.module === 1 && !q.rowPressure) {
    const pn = await load(q.fields.pn);
    q.rowPressure = Array.from({ length: q.grid.my }, (_, iy) => { let most = 0; for (let ix = 0; ix < q.grid.mx; ix++) most = Math.max(most, pn[ix + q.grid.mx * iy]); return most; });
    if (q.curveBlob !== undefined) { const k = await load(q.curveBlob), n = q.grid.my; q.curve = { y: k.slice(0, n), z: k.slice(n, 2 * n), angle: k.slice(2 * n) }; }
  }
  const block = await chosenBlock(p);
  if (mine !== turn) return;   // a later step was faster
  const other = !before || !p || before.grid.xl !== p.grid.xl || before.grid.dx !== p.grid.dx || before.grid.mx !== p.grid.mx || before.grid.my !== p.grid.my || !state.view;
  Object.assign(state, { index, patch, fields, profiles, block, ready: true });
  if (state.row !== null && other) state.row = null;
  byId("slider").value = index;
  byId("where").textContent = `case ${c.label} (${index + 1} of ${data.cases.length})`;
  byId("previous").disabled = index === 0; byId("next").disabled = index === data.cases.length - 1;
  const tabs = c.patches.length > 1 ? c.patches.map((q, k) => { const b = document.createElement("button"); b.textContent = `patch ${q.number}`; b.setAttribute("aria-pressed", k === patch); b.onclick = () => go(index, k); return b; }) : [];
  byId("patches").replaceChildren(...tabs);
  for (const row of byId("cases").tBodies[0].rows) {
    const is = Number(row.dataset.index) === index && Number(row.dataset.patch) === patch;
    if (is && row.className.indexOf("now") < 0) { row.classList.add("now"); row.scrollIntoView({ block: "nearest" }); } else if (!is) row.classList.remove("now");
  }
  byId("card-profiles").hidden = !c.markers;
  byId("card-pt").hidden = !!fields && !fields.pt;
  const select = byId("quantity"), keep = select.value, offer = [...new Set([...Object.keys(NAMES), ...Object.keys(fields || {})])].filter(n => fields && fields[n] && !PARTS.includes(n) && n !== "pn" && n !== "pt");
  if (fields && !fields.pt) offer.unshift("pn");
  select.replaceChildren(...offer.map(n => new Option(nameOf(n) + (pretty(unitOf(p, n)) ? ` [${pretty(unitOf(p, n))}]` : ""), n)));
  select.value = offer.includes(keep) ? keep : offer.includes("temp1") ? "temp1" : offer[0] || "";
  plots.section.own = null;
  tellTotals();
  if (other && p) resetView(); else draw();
}
function chooseCurves() {
  const names = Object.keys(columns).filter(n => data.cases.some(c => c.patches.some(p => Number.isFinite(valueOf(c, p, n)))));
  const varies = name => { let low = Infinity, high = -Infinity; for (const c of data.cases) for (const p of c.patches) { const v = valueOf(c, p, name); if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); } } return high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high)); };
  const fill = (id, first) => { byId(id).replaceChildren(...names.map(n => new Option(n, n))); byId(id).value = first; byId(id).addEventListener("change", () => { plots.curve.own = null; draw(); }); };
  if (!names.includes("case")) names.unshift("case");
  const x = ["cksi", "ceta", "cphi", "shift_x", "shift_y", "rotation", "y_ws"].filter(n => names.includes(n) && varies(n))[0] || "case";
  const y = ["fx_rel", "fy_rel", "fn", "pmax"].filter(n => names.includes(n) && varies(n))[0] || "fn";
  fill("curve-x", x); fill("curve-y", names.includes(y) ? y : names[0]);
}
function start() {
  byId("title").textContent = data.experiment;
  byId("about").textContent = `${data.cases.length} case${data.cases.length === 1 ? "" : "s"} \u00b7 ${data.program}`;
  if (data.run && !data.run.complete)
    byId("about").textContent += ` \u00b7 NOT COMPLETE: ${data.run.cases_finished} of ${data.run.input_readable ? "" : "at least "}`
      + `${data.run.cases_planned} cases finished; ${data.run.reason}`;
  byId("slider").max = data.cases.length - 1;
  if (!data.cases.length) { byId("where").textContent = "no cases"; return; }
  tableOfCases(); 
  maps.push(new ElementMap("map-pn", () => "pn"), new ElementMap("map-pt", () => "pt"), new ElementMap("map-eldiv", () => "eldiv"), new ElementMap("map-more", () => byId("quantity").value));
  plots.section = new Section("plot-section"); plots.curve = new Curve("plot-curve"); plots.profiles = new Profiles("plot-profiles");
  plots.block = new Plane("map-block");
  for (const id of ["block", "stress", "plane", "depth"]) byId(id).addEventListener("input", async () => {
    if (id === "block" || id === "plane") plots.block.own = null;
    state.block = await chosenBlock(nowPatch());
    draw();
  });
  chooseCurves();
  byId("previous").onclick = () => go(state.index - 1, state.patch);
  byId("next").onclick = () => go(state.index + 1, state.patch);
  byId("reset").onclick = resetView;
  byId("slider").oninput = event => go(Number(event.target.value), state.patch);
  byId("quantity").onchange = draw;
  document.addEventListener("keydown", event => {
    if (["SELECT", "INPUT"].includes(event.target.tagName)) return;
    if (event.key === "ArrowLeft") go(state.index - 1, state.patch);
    if (event.key === "ArrowRight") go(state.index + 1, state.patch);
  });
  new ResizeObserver(() => draw()).observe(byId("panels"));
  read([["", "point at a map to read values; drag to move, wheel to zoom, double click to see all; arrow keys step through the cases"]]);
  const begin = /^#case=(\d+)/.exec(location.hash);
  const index = begin ? data.cases.findIndex(c => c.number === Number(begin[1])) : -1;
  go(index >= 0 ? index : 0);
}
window.contactReport = { state, data, plots, go };
start();
