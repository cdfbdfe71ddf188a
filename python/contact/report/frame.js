// A plot: a canvas that is redrawn on demand, can be panned and zoomed within limits by pointer, touch and keys, and can be
// exported to a file. Frame adds axes; subclasses draw inside. A view is [x0, x1, y0, y1].
const MARGIN = { left: 64, right: 18, top: 12, bottom: 40 };
const FONT = "12px system-ui, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";
// Size of the smallest and the largest view relative to the whole plot
const CLOSEST = 1 / 200,
  WIDEST = 3;

class Picture {
  constructor(id) {
    this.canvas = byId(id);
    this.context = this.canvas.getContext("2d");
    this.cursor = null;
    this.file = null;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-roledescription", "plot with values");
    this.canvas.setAttribute("aria-describedby", "keys");
    this.title = this.name = this.canvas.closest(".card").querySelector("h2 .name").textContent;
    this.handle();
  }
  // Size of the plot and its drawing context: that of the canvas, or the substitute of export.js
  prepare() {
    let ratio = window.devicePixelRatio || 1,
      c = this.context;
    if (this.file) {
      ({ width: this.width, height: this.height, context: c, ratio } = this.file);
    } else {
      const box = this.canvas.getBoundingClientRect(),
        w = Math.round(box.width * ratio),
        h = Math.round(box.height * ratio);
      this.width = box.width;
      this.height = box.height;
      if (this.canvas.width !== w || this.canvas.height !== h) {
        this.canvas.width = w;
        this.canvas.height = h;
      }
    }
    this.brush = c;
    this.ratio = ratio;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, this.width, this.height);
    c.font = FONT;
    c.fillStyle = "#fff";
    c.fillRect(0, 0, this.width, this.height);
    return c;
  }
  blank(text = "no contact") {
    const c = this.prepare();
    c.fillStyle = "#66737f";
    c.font = "14px system-ui, 'DejaVu Sans', sans-serif";
    c.textAlign = "center";
    c.textBaseline = "middle";
    c.fillText(text, this.width / 2, this.height / 2);
    this.shown = null;
    this.announce(text);
  }
  // Description of the plot in words, for screen readers
  announce(text) {
    const name = `${this.title}: ${text}`;
    if (!this.file && this.canvas.getAttribute("aria-label") !== name) this.canvas.setAttribute("aria-label", name);
  }
  spot(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }
  handle() {
    const canvas = this.canvas;
    let from = null,
      moved = false;
    canvas.addEventListener("pointerdown", event => {
      if (!this.shown || event.pointerType === "touch" || event.button) return;
      canvas.setPointerCapture(event.pointerId);
      from = { at: this.spot(event), view: this.grip() };
      moved = false;
    });
    canvas.addEventListener("pointermove", event => {
      if (!this.shown || event.pointerType === "touch") return;
      const [px, py] = this.spot(event);
      if (from) {
        const dx = px - from.at[0],
          dy = py - from.at[1];
        if (Math.abs(dx) + Math.abs(dy) > 3) moved = true;
        if (moved) return this.drag(from.view, dx, dy);
      }
      this.hover(px, py);
    });
    canvas.addEventListener("pointerup", event => {
      if (from && !moved) this.press(...this.spot(event));
      from = null;
    });
    canvas.addEventListener("pointercancel", () => {
      from = null;
    });
    // one finger scrolls the page, a tap shows values, two fingers pan and zoom
    let pinch = null;
    const two = list => {
      const [a, b] = [this.spot(list[0]), this.spot(list[1])];
      return { x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2, d: Math.hypot(a[0] - b[0], a[1] - b[1]) };
    };
    canvas.addEventListener(
      "touchstart",
      event => {
        if (event.touches.length === 2 && this.shown) {
          event.preventDefault();
          pinch = two(event.touches);
        }
      },
      { passive: false },
    );
    canvas.addEventListener(
      "touchmove",
      event => {
        if (!pinch || event.touches.length !== 2 || !this.shown) return;
        event.preventDefault();
        const now = two(event.touches);
        this.drag(this.grip(), now.x - pinch.x, now.y - pinch.y);
        this.zoom(Math.min(4, Math.max(0.25, pinch.d / Math.max(now.d, 1))), now.x, now.y);
        pinch = now;
      },
      { passive: false },
    );
    for (const name of ["touchend", "touchcancel"])
      canvas.addEventListener(name, () => {
        pinch = null;
      });
    canvas.addEventListener("click", event => {
      if (event.pointerType === "touch" && this.shown) {
        const [px, py] = this.spot(event);
        this.hover(px, py);
        this.press(px, py);
      }
    });
    canvas.addEventListener(
      "wheel",
      event => {
        if (!this.shown) return;
        if (!event.ctrlKey && !event.metaKey)
          return read([["", "hold Ctrl while turning the wheel to zoom; without it the page scrolls"]]);
        event.preventDefault();
        this.zoom(Math.exp(Math.max(-1, Math.min(1, event.deltaY / 300))), ...this.spot(event));
      },
      { passive: false },
    );
    canvas.addEventListener("dblclick", () => this.whole());
    canvas.addEventListener("keydown", event => this.typed(event));
    canvas.addEventListener("focus", () => changed());
    canvas.addEventListener("blur", () => changed());
  }
  typed(event) {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey || !this.shown) return;
    if (step && event.shiftKey) this.drag(this.grip(), -30 * step[0], 30 * step[1]);
    else if (step) {
      this.move(...step);
      byId("said").textContent = byId("readout").textContent;
    } else if (event.key === "+" || event.key === "=") this.zoom(0.8, this.width / 2, this.height / 2);
    else if (event.key === "-") this.zoom(1.25, this.width / 2, this.height / 2);
    else if (event.key === "Home" || event.key === "0") this.whole();
    else if (event.key === "Enter" || event.key === " ") this.enter();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
  grip() {
    return this.shown.slice();
  }
  hover() {}
  press() {}
  enter() {}
}

class Frame extends Picture {
  constructor(id, options = {}) {
    super(id);
    Object.assign(this, { equal: false, right: MARGIN.right, shared: false, own: null, ownHome: null }, options);
  }
  get view() {
    return this.shared ? state.view : this.own;
  }
  set view(v) {
    if (this.shared) state.view = v;
    else this.own = v;
  }
  get home() {
    return this.shared ? state.home : this.ownHome;
  }
  // The complete view: the initial one, and the limit of panning
  set home(v) {
    this.ownHome = v;
    if (!this.own) this.own = v;
  }
  // Set the range of all curves and the entries of a legend; the initial view has the curves below the legend
  begin(all, entries = []) {
    const c = this.prepare(),
      w = this.width - MARGIN.left - this.right,
      h = this.height - MARGIN.top - MARGIN.bottom;
    if (all) {
      const [x0, x1, low, high] = all,
        legendHeight = entries.length && Math.min(legendPlaces(c, this, entries).at(-1)[1] - MARGIN.top + 12, h / 2);
      this.home = [x0, x1, low, high + ((high - low) * legendHeight) / (h - legendHeight)];
    }
    let [x0, x1, y0, y1] = this.view;
    if (this.equal) {
      const scale = Math.min(w / (x1 - x0), h / (y1 - y0));
      const growX = w / scale - (x1 - x0),
        growY = h / scale - (y1 - y0);
      x0 -= growX / 2;
      x1 += growX / 2;
      y0 -= growY / 2;
      y1 += growY / 2;
    }
    this.shown = [x0, x1, y0, y1];
    this.w = w;
    this.h = h;
    this.X = x => MARGIN.left + ((x - x0) / (x1 - x0)) * w;
    this.Y = this.down ? y => MARGIN.top + ((y - y0) / (y1 - y0)) * h : y => MARGIN.top + ((y1 - y) / (y1 - y0)) * h;
    c.save();
    c.beginPath();
    c.rect(MARGIN.left, MARGIN.top, w, h);
    c.clip();
    return c;
  }
  back(px, py) {
    const [x0, x1, y0, y1] = this.shown,
      fy = (py - MARGIN.top) / this.h;
    return [x0 + ((px - MARGIN.left) / this.w) * (x1 - x0), this.down ? y0 + fy * (y1 - y0) : y1 - fy * (y1 - y0)];
  }
  end(labelX, labelY) {
    const c = this.brush,
      [x0, x1, y0, y1] = this.shown;
    if (this.cursor && !this.file && document.activeElement === this.canvas) this.cross(c);
    c.restore();
    c.strokeStyle = "#b7c2cd";
    c.lineWidth = 1;
    c.strokeRect(MARGIN.left + 0.5, MARGIN.top + 0.5, this.w, this.h);
    c.fillStyle = "#5b6b7b";
    c.strokeStyle = "#b7c2cd";
    c.textAlign = "center";
    c.textBaseline = "top";
    for (const t of ticks(x0, x1, this.w / 70)) {
      const x = Math.round(this.X(t)) + 0.5;
      c.beginPath();
      c.moveTo(x, MARGIN.top + this.h);
      c.lineTo(x, MARGIN.top + this.h + 4);
      c.stroke();
      c.fillText(tickText(t, x1 - x0), x, MARGIN.top + this.h + 6);
    }
    c.textAlign = "right";
    c.textBaseline = "middle";
    for (const t of ticks(y0, y1, this.h / 42)) {
      const y = Math.round(this.Y(t)) + 0.5;
      c.beginPath();
      c.moveTo(MARGIN.left - 4, y);
      c.lineTo(MARGIN.left, y);
      c.stroke();
      c.fillText(tickText(t, y1 - y0), MARGIN.left - 6, y);
    }
    c.textAlign = "center";
    c.textBaseline = "bottom";
    c.fillStyle = "#33414f";
    c.fillText(labelX, MARGIN.left + this.w / 2, this.height - 4);
    c.save();
    c.translate(10, MARGIN.top + this.h / 2);
    c.rotate(-Math.PI / 2);
    c.textBaseline = "middle";
    c.fillText(labelY, 0, 0);
    c.restore();
  }
  cross(c) {
    const x = this.X(this.cursor[0]),
      y = this.Y(this.cursor[1]);
    for (const [style, width] of [
      ["#fff", 4],
      ["#c2452d", 1.8],
    ]) {
      c.strokeStyle = style;
      c.lineWidth = width;
      c.beginPath();
      c.moveTo(x - 11, y);
      c.lineTo(x + 11, y);
      c.moveTo(x, y - 11);
      c.lineTo(x, y + 11);
      c.stroke();
    }
  }
  grid() {
    const c = this.brush,
      [x0, x1, y0, y1] = this.shown;
    c.strokeStyle = "#edf1f5";
    c.lineWidth = 1;
    c.beginPath();
    for (const t of ticks(x0, x1, this.w / 70)) {
      const x = Math.round(this.X(t)) + 0.5;
      c.moveTo(x, MARGIN.top);
      c.lineTo(x, MARGIN.top + this.h);
    }
    for (const t of ticks(y0, y1, this.h / 42)) {
      const y = Math.round(this.Y(t)) + 0.5;
      c.moveTo(MARGIN.left, y);
      c.lineTo(MARGIN.left + this.w, y);
    }
    c.stroke();
  }
  // Restrict a view to the limits of zooming and panning
  limited([x0, x1, y0, y1]) {
    const home = this.home || this.shown,
      wide = [home[1] - home[0], home[3] - home[2]];
    const part = Math.max((x1 - x0) / wide[0], (y1 - y0) / wide[1]),
      small = Math.min((x1 - x0) / wide[0], (y1 - y0) / wide[1]);
    const factor = part > WIDEST ? WIDEST / part : small < CLOSEST ? CLOSEST / small : 1;
    const axis = (a, b, low, high) => {
      const half = (factor * (b - a)) / 2,
        reach = Math.max(0, (high - low) / 2 + half - 0.2 * Math.min(high - low, 2 * half));
      const middle = (low + high) / 2,
        centre = Math.min(middle + reach, Math.max(middle - reach, (a + b) / 2));
      return [centre - half, centre + half];
    };
    return [...axis(x0, x1, home[0], home[1]), ...axis(y0, y1, home[2], home[3])];
  }
  drag([x0, x1, y0, y1], dx, dy) {
    const sx = ((x1 - x0) / this.w) * dx,
      sy = ((y1 - y0) / this.h) * (this.down ? -dy : dy);
    this.view = this.limited([x0 - sx, x1 - sx, y0 + sy, y1 + sy]);
    changed();
  }
  zoom(factor, px, py) {
    const [x, y] = this.back(px, py),
      [x0, x1, y0, y1] = this.shown;
    this.shown = this.view = this.limited([
      x + (x0 - x) * factor,
      x + (x1 - x) * factor,
      y + (y0 - y) * factor,
      y + (y1 - y) * factor,
    ]);
    changed();
  }
  whole() {
    if (this.shared) resetView();
    else {
      this.own = this.ownHome;
      changed();
    }
  }
  hover(px, py) {
    if (this.point) this.point(...this.back(px, py), px, py);
  }
  press(px, py) {
    if (this.click) this.click(...this.back(px, py), px, py);
  }
  enter() {
    if (this.cursor && this.click) this.click(...this.cursor, this.X(this.cursor[0]), this.Y(this.cursor[1]));
  }
  step() {
    return [(this.shown[1] - this.shown[0]) / 40, (this.shown[3] - this.shown[2]) / 40];
  }
  move(dx, dy) {
    const [x0, x1, y0, y1] = this.shown,
      [sx, sy] = this.step(),
      inside = (v, low, high) => Math.min(high, Math.max(low, v));
    const from =
      this.cursor && this.cursor[0] >= x0 && this.cursor[0] <= x1 && this.cursor[1] >= y0 && this.cursor[1] <= y1
        ? this.cursor
        : this.middle
          ? this.middle()
          : [(x0 + x1) / 2, (y0 + y1) / 2];
    this.cursor = [inside(from[0] + dx * sx, x0, x1), inside(from[1] + (this.down ? -dy : dy) * sy, y0, y1)];
    if (this.point) this.point(...this.cursor, this.X(this.cursor[0]), this.Y(this.cursor[1]));
    changed();
  }
}
function ticks(low, high, about) {
  const rough = (high - low) / Math.max(2, about),
    power = 10 ** Math.floor(Math.log10(rough)),
    lead = rough / power;
  const step = (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10) * power,
    list = [];
  for (let t = Math.ceil(low / step - 1e-9) * step; t <= high + step * 1e-9 && list.length < 60; t += step)
    list.push(Math.abs(t) < step * 1e-9 ? 0 : t);
  return list;
}
function tickText(value, range) {
  if (value === 0) return "0";
  if (range < 1e-3 || Math.abs(value) >= 1e5)
    return Number(value.toPrecision(3)).toExponential().replace("e+", "e").replace(/-/g, "\u2212");
  return Number(value.toPrecision(6)).toString().replace("-", "\u2212");
}
function colourBar(frame, { low, high, colour, given }, unit) {
  const c = frame.brush,
    left = frame.width - frame.right + 12,
    height = frame.h - 22;
  for (let k = 0; k < height; k++) {
    c.fillStyle = `rgb(${colour(1 - k / height)})`;
    c.fillRect(left, MARGIN.top + 20 + k, 12, 1.5);
  }
  c.strokeStyle = given ? "#c2452d" : "#b7c2cd";
  c.lineWidth = 1;
  c.strokeRect(left + 0.5, MARGIN.top + 20.5, 12, height);
  c.textAlign = "left";
  c.textBaseline = "middle";
  c.fillStyle = "#33414f";
  c.fillText(unit, left, MARGIN.top + 8);
  c.fillStyle = "#5b6b7b";
  for (const t of ticks(low, high, 5))
    c.fillText(tickText(t, high - low), left + 16, MARGIN.top + 20 + (height * (high - t)) / (high - low));
}
// Positions of the entries of a legend, in as many rows as necessary
function legendPlaces(c, frame, entries) {
  const left = MARGIN.left + 10;
  let x = left,
    y = MARGIN.top + 12;
  return entries.map(([text]) => {
    const width = c.measureText(text).width;
    if (x + 30 + width > frame.width - frame.right && x > left) {
      x = left;
      y += 16;
    }
    x += 38 + width;
    return [x - 38 - width, y];
  });
}
function legend(c, frame, entries) {
  const places = legendPlaces(c, frame, entries);
  c.textAlign = "left";
  c.textBaseline = "middle";
  entries.forEach(([text, colour, dash], k) => {
    const [x, y] = places[k];
    c.strokeStyle = colour;
    c.lineWidth = 2.5;
    c.setLineDash(dash || []);
    c.beginPath();
    c.moveTo(x, y);
    c.lineTo(x + 18, y);
    c.stroke();
    c.setLineDash([]);
    c.fillStyle = "#33414f";
    c.fillText(text, x + 23, y);
  });
}
const ratioIsPlain = view => {
  const r = (view[1] - view[0]) / (view[3] - view[2]);
  return r < 6 && r > 1 / 6;
};
