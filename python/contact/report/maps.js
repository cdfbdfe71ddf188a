// Maps of the elements, and sections through them.
class ElementMap extends Frame {
  // Contents: the name of a field, and whether it is that of this run, of the other one, or their difference
  constructor(id, choose, mode) {
    super(id, { equal: true, right: 92, shared: true });
    this.choose = choose;
    this.mode = mode;
  }
  // Key of the user limits of the colours
  get key() {
    return (this.mode() === "difference" ? "difference " : "") + this.choose();
  }
  point(x, y) {
    readElement(x, y);
  }
  click(x, y) {
    const e = elementAt(x, y);
    if (e) {
      state.row = e.iy;
      state.column = e.ix;
      plots.section.own = null;
      draw();
    }
  }
  step() {
    const g = nowPatch().grid;
    return [g.dx, g.dy];
  }
  middle() {
    const g = nowPatch().grid;
    return [g.xl + (sectionColumn() + 0.5) * g.dx, g.yl + (sectionRow() + 0.5) * g.dy];
  }
  draw() {
    const patch = nowPatch(),
      name = this.choose(),
      shown = patch && picture(name, this.mode()),
      discrete = name === "eldiv";
    if (!patch) return this.blank();
    if (!shown) return this.blank("the other run has no such case or patch");
    if (!shown.values) return this.blank("not part of this case");
    const { grid, totals } = shown.patch,
      values = shown.values,
      inside = shown.fields.eldiv;
    this.equal = ratioIsPlain(state.view);
    const c = this.begin();
    const scale = (this.scale = discrete
      ? null
      : scaleFor(
          this.key,
          values.filter((_, i) => inside[i] > 0),
          kindOf(name),
        ));
    this.elements(c, grid, i =>
      discrete || inside[i] === 0 ? rgbOf(STATES[inside[i]][1]) : scale.colour((values[i] - scale.low) / (scale.high - scale.low)),
    );
    this.outline(c, grid, inside);
    if ((shown.mode === "difference" || (discrete && comparing())) && state.other && state.other.patch)
      this.border(c, state.other.patch.grid, state.other.fields.eldiv, v => v > 0, "#c2452d", 1.4);
    if (name === "pt" && shown.mode !== "difference") this.arrows(c, shown);
    this.sectionLines(c);
    const rolls = grid.chi !== undefined && Math.abs(grid.chi) < 1e-6;
    this.end("x [mm]" + (rolls ? ", rolling \u2192" : ""), nowCase().module === 1 ? "s [mm]" : "y [mm]");
    if (discrete) this.states(c, inside);
    else colourBar(this, scale, pretty(unitOf(shown.patch, name)));
    this.describe(name, shown, values, inside, totals);
  }
  describe(name, shown, values, inside) {
    const { grid } = shown.patch,
      what =
        `${shown.mode === "this" ? "" : shown.mode + ", "}${nameOf(name)}, ` +
        `${caseName(nowCase())}, patch ${shown.patch.number}`;
    if (name === "eldiv")
      return this.announce(
        `${what}; ` +
          STATES.map(([text], k) => [text, inside.reduce((n, v) => n + (v === k), 0)])
            .filter(s => s[1])
            .map(s => `${s[1]} elements ${s[0]}`)
            .join(", "),
      );
    let low = -1,
      high = -1;
    inside.forEach((v, i) => {
      if (v) {
        if (low < 0 || values[i] < values[low]) low = i;
        if (high < 0 || values[i] > values[high]) high = i;
      }
    });
    const place = i =>
      `x ${figures(grid.xl + ((i % grid.mx) + 0.5) * grid.dx, 3)}, ` +
      `y ${figures(grid.yl + (Math.floor(i / grid.mx) + 0.5) * grid.dy, 3)} mm`;
    return this.announce(
      high < 0
        ? `${what}; no contact`
        : `${what}; from ${withUnit(values[low], unitOf(shown.patch, name))} at ${place(low)} ` +
            `to ${withUnit(values[high], unitOf(shown.patch, name))} at ${place(high)}`,
    );
  }
  elements(c, { mx, my, xl, yl, dx, dy }, colour) {
    const image = document.createElement("canvas"),
      pixels = new ImageData(mx, my);
    image.width = mx;
    image.height = my;
    for (let iy = 0; iy < my; iy++)
      for (let ix = 0; ix < mx; ix++) pixels.data.set([...colour(ix + mx * iy), 255], 4 * (ix + mx * (my - 1 - iy)));
    image.getContext("2d").putImageData(pixels, 0, 0);
    c.imageSmoothingEnabled = false;
    c.drawImage(image, this.X(xl), this.Y(yl + my * dy), this.X(xl + mx * dx) - this.X(xl), this.Y(yl) - this.Y(yl + my * dy));
  }
  states(c, inside) {
    const left = this.width - this.right + 12;
    c.textAlign = "left";
    c.textBaseline = "middle";
    c.lineWidth = 1;
    STATES.map((s, k) => [s, k])
      .filter(([, k]) => k === 0 || inside.includes(k))
      .forEach(([s], k) => {
        c.fillStyle = s[1];
        c.fillRect(left, MARGIN.top + 4 + 20 * k, 12, 12);
        c.strokeStyle = "#b7c2cd";
        c.strokeRect(left + 0.5, MARGIN.top + 4.5 + 20 * k, 12, 12);
        c.fillStyle = "#33414f";
        c.fillText(s[0], left + 17, MARGIN.top + 10 + 20 * k);
      });
  }
  sectionLines(c) {
    const g = nowPatch().grid,
      y = this.Y(g.yl + (sectionRow() + 0.5) * g.dy),
      x = this.X(g.xl + (sectionColumn() + 0.5) * g.dx),
      along = byId("direction").value === "x";
    c.strokeStyle = "rgba(29,39,51,.55)";
    c.setLineDash([4, 4]);
    c.lineWidth = 1;
    c.beginPath();
    if (along) {
      c.moveTo(MARGIN.left, y);
      c.lineTo(this.width, y);
    } else {
      c.moveTo(x, 0);
      c.lineTo(x, this.height);
    }
    c.stroke();
    c.setLineDash([]);
  }
  // Borders of the contact area and of the slip area
  outline(c, grid, inside) {
    this.border(c, grid, inside, v => v > 0, "rgba(29,39,51,.8)", 1.2);
    if (inside.includes(1) && inside.includes(2)) this.border(c, grid, inside, v => v === 1, "rgba(29,39,51,.5)", 1);
  }
  border(c, { mx, my, xl, yl, dx, dy }, inside, test, style, width) {
    c.strokeStyle = style;
    c.lineWidth = width;
    c.beginPath();
    const is = (ix, iy) => ix >= 0 && iy >= 0 && ix < mx && iy < my && test(inside[ix + mx * iy]);
    for (let iy = 0; iy < my; iy++)
      for (let ix = 0; ix < mx; ix++)
        if (is(ix, iy)) {
          const x = this.X(xl + ix * dx),
            x1 = this.X(xl + (ix + 1) * dx),
            y = this.Y(yl + iy * dy),
            y1 = this.Y(yl + (iy + 1) * dy);
          if (!is(ix - 1, iy)) {
            c.moveTo(x, y);
            c.lineTo(x, y1);
          }
          if (!is(ix + 1, iy)) {
            c.moveTo(x1, y);
            c.lineTo(x1, y1);
          }
          if (!is(ix, iy - 1)) {
            c.moveTo(x, y);
            c.lineTo(x1, y);
          }
          if (!is(ix, iy + 1)) {
            c.moveTo(x, y1);
            c.lineTo(x1, y1);
          }
        }
    c.stroke();
  }
  arrows(c, shown) {
    const { mx, my, xl, yl, dx, dy } = shown.patch.grid,
      { px, py, pt, eldiv } = shown.fields,
      most = rangeOf(pt)[1];
    if (!(most > 0)) return;
    const ex = Math.abs(this.X(dx) - this.X(0)),
      ey = Math.abs(this.Y(dy) - this.Y(0));
    const kx = Math.max(1, Math.round(17 / ex)),
      ky = Math.max(1, Math.round(17 / ey)),
      longest = 1.25 * Math.max(9, Math.min(kx * ex, ky * ey));
    c.strokeStyle = "#14202c";
    c.fillStyle = "#14202c";
    c.lineWidth = 1.2;
    for (let iy = Math.floor(ky / 2); iy < my; iy += ky)
      for (let ix = Math.floor(kx / 2); ix < mx; ix += kx) {
        const i = ix + mx * iy;
        if (!eldiv[i] || pt[i] < 0.02 * most) continue;
        arrow(
          c,
          this.X(xl + (ix + 0.5) * dx),
          this.Y(yl + (iy + 0.5) * dy),
          px[i] / pt[i],
          -py[i] / pt[i],
          Math.min((longest * pt[i]) / most, 34),
        );
      }
  }
}
// An arrow centred at a point, along a unit vector
function arrow(c, x, y, ux, uy, length) {
  const x0 = x - (ux * length) / 2,
    y0 = y - (uy * length) / 2,
    x1 = x + (ux * length) / 2,
    y1 = y + (uy * length) / 2,
    head = Math.min(5, 1 + length / 3);
  c.beginPath();
  c.moveTo(x0, y0);
  c.lineTo(x1 - ux * head * 0.7, y1 - uy * head * 0.7);
  c.stroke();
  c.beginPath();
  c.moveTo(x1, y1);
  c.lineTo(x1 - ux * head - uy * head * 0.5, y1 - uy * head + ux * head * 0.5);
  c.lineTo(x1 - ux * head + uy * head * 0.5, y1 - uy * head - ux * head * 0.5);
  c.fill();
}

// Pressure, tractions and their bound along one row or column of elements
class Section extends Frame {
  // Abscissas and lines [name, colour, values, dash] of a patch
  lines(patch, f, along, at, faint) {
    const { mx, my, xl, yl, dx, dy } = patch.grid,
      n = along ? mx : my;
    const cut = (values, factor) =>
      Array.from({ length: n }, (_, k) => {
        const i = along ? k + mx * at : at + mx * k;
        return values[i] * (factor ? factor[i] : 1);
      });
    const places = Array.from({ length: n }, (_, k) => (along ? xl + (k + 0.5) * dx : yl + (k + 0.5) * dy)),
      list = [];
    const add = (name, colour, values, dash) =>
      list.push({ name: faint ? name && name + ", other run" : name, colour, values, dash: faint ? [2, 3] : dash, places });
    if (f.px) {
      const bound = cut(f.mu || f.pn.map(() => patch.totals.mu_scal), f.pn);
      if (!faint) {
        add("\u00b1 mu pn", "#7e8b98", bound, [5, 4]);
        add(
          "",
          "#7e8b98",
          bound.map(v => -v),
          [5, 4],
        );
      }
      add("px", "#c2452d", cut(f.px));
      add("py", "#1f5fa8", cut(f.py));
    } else add("pn", "#c2452d", cut(f.pn));
    return list;
  }
  draw() {
    const patch = nowPatch(),
      along = byId("direction").value === "x";
    if (!patch) {
      byId("section-row").textContent = "";
      return this.blank();
    }
    const { mx, my, xl, yl, dx, dy } = patch.grid,
      at = along ? sectionRow() : sectionColumn(),
      place = along ? yl + (at + 0.5) * dy : xl + (at + 0.5) * dx;
    this.drawn = this.lines(patch, state.fields, along, at, false);
    const o = state.other && state.other.patch && comparing() ? state.other : null;
    if (o) {
      const g = o.patch.grid,
        k = Math.floor(along ? (place - g.yl) / g.dy : (place - g.xl) / g.dx);
      if (k >= 0 && k < (along ? g.my : g.mx)) this.drawn.push(...this.lines(o.patch, o.fields, along, k, true));
    }
    let [low, high] = rangeOf([0, ...this.drawn.flatMap(l => l.values)]);
    if (high === low) {
      high = 1;
      low = -1;
    }
    const side = along ? state.home.slice(0, 2) : state.home.slice(2);
    const entries = this.drawn.filter(l => l.name).map(l => [l.name, l.colour, l.dash]),
      c = this.begin([...side, low - 0.06 * (high - low), high + 0.06 * (high - low)], entries);
    this.grid();
    c.strokeStyle = "#8a98a6";
    c.lineWidth = 1;
    c.beginPath();
    c.moveTo(MARGIN.left, this.Y(0));
    c.lineTo(this.width, this.Y(0));
    c.stroke();
    for (const { colour, values, dash, places } of this.drawn) {
      c.strokeStyle = colour;
      c.lineWidth = dash ? 1.4 : 2;
      c.setLineDash(dash || []);
      c.beginPath();
      values.forEach((v, k) => {
        const x = this.X(places[k]),
          y = this.Y(v);
        if (k) c.lineTo(x, y);
        else c.moveTo(x, y);
      });
      if (values.length === 1) {
        c.moveTo(this.X(places[0]) - 6, this.Y(values[0]));
        c.lineTo(this.X(places[0]) + 6, this.Y(values[0]));
      }
      c.stroke();
    }
    c.setLineDash([]);
    this.end(along ? "x [mm]" : nowCase().module === 1 ? "s [mm]" : "y [mm]", "N/mm\u00b2");
    legend(c, this, entries);
    const section = along
      ? `row ${at + 1} of ${my}, y = ${figures(place)} mm`
      : `column ${at + 1} of ${mx}, x = ${figures(place)} mm`;
    byId("section-row").textContent = section;
    byId("section-row").title = `${section}; click in a map for another`;
    this.announce(
      `${section}; ` +
        this.drawn
          .filter(l => l.name && !l.name.startsWith("\u00b1"))
          .map(l => {
            const [a, b] = rangeOf(l.values);
            return `${l.name} from ${figures(a)} to ${figures(b)} N/mm\u00b2`;
          })
          .join(", "),
    );
  }
  point(u) {
    const g = nowPatch() && nowPatch().grid;
    if (!g) return;
    if (byId("direction").value === "x") readElement(u, g.yl + (sectionRow() + 0.5) * g.dy);
    else readElement(g.xl + (sectionColumn() + 0.5) * g.dx, u);
  }
  step() {
    const g = nowPatch().grid;
    return [byId("direction").value === "x" ? g.dx : g.dy, (this.shown[3] - this.shown[2]) / 40];
  }
}

function elementAt(x, y) {
  const p = nowPatch();
  if (!p) return null;
  const ix = Math.floor((x - p.grid.xl) / p.grid.dx),
    iy = Math.floor((y - p.grid.yl) / p.grid.dy);
  return ix >= 0 && iy >= 0 && ix < p.grid.mx && iy < p.grid.my ? { ix, iy, i: ix + p.grid.mx * iy } : null;
}
function readElement(x, y) {
  const p = nowPatch(),
    e = elementAt(x, y),
    pairs = [
      ["x", figures(x) + " mm"],
      ["y", figures(y) + " mm"],
    ];
  if (e) {
    const f = state.fields;
    pairs.push(["element", `${e.ix + 1}, ${e.iy + 1}`], ["", STATES[f.eldiv[e.i]][0]], ["pn", `${figures(f.pn[e.i])} N/mm\u00b2`]);
    if (f.px) pairs.push(["px", figures(f.px[e.i])], ["py", figures(f.py[e.i])], ["|pt|", figures(f.pt[e.i])]);
    if (f.slip) pairs.push(["slip", withUnit(f.slip[e.i], unitOf(p, "slip"))]);
    if (f.temp1) pairs.push(["temperatures", `${figures(f.temp1[e.i])}, ${figures(f.temp2[e.i])} \u00b0C`]);
    const more = byId("quantity").value;
    if (f[more] && !["px", "py", "pn", "slip", "temp1", "temp2"].includes(more))
      pairs.push([nameOf(more), withUnit(f[more][e.i], unitOf(p, more))]);
    if (comparing())
      for (const name of [...new Set(["pn", "pt", more])]) {
        const shown = f[name] && picture(name, "difference");
        if (shown && shown.values) pairs.push([`difference of ${nameOf(name)}`, withUnit(shown.values[e.i], unitOf(p, name))]);
      }
  }
  read(pairs);
}
function read(pairs) {
  byId("readout").replaceChildren(
    ...pairs.map(([name, value]) => {
      const span = document.createElement("span"),
        mark = document.createElement("i");
      mark.textContent = name + " ";
      span.append(mark, String(value) + " ");
      return span;
    }),
  );
}
// Row and column of the sections: the selected ones, or those through the largest pressure
function sectionRow() {
  const p = nowPatch();
  if (state.row !== null && state.row < p.grid.my) return state.row;
  return middleOfTop(p.grid.my, iy => {
    let most = 0;
    for (let ix = 0; ix < p.grid.mx; ix++) most = Math.max(most, state.fields.pn[ix + p.grid.mx * iy]);
    return most;
  });
}
function sectionColumn() {
  const p = nowPatch();
  if (state.column !== null && state.column < p.grid.mx) return state.column;
  return middleOfTop(p.grid.mx, ix => {
    let most = 0;
    for (let iy = 0; iy < p.grid.my; iy++) most = Math.max(most, state.fields.pn[ix + p.grid.mx * iy]);
    return most;
  });
}
// The middle one of equal values
function middleOfTop(n, value) {
  const all = Array.from({ length: n }, (_, k) => value(k)),
    most = Math.max(...all),
    near = v => v >= most * (1 - 1e-6);
  return Math.floor((all.findIndex(near) + all.findLastIndex(near)) / 2);
}
