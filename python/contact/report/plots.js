// Plots of totals over the cases, and of the profiles of wheel and rail.
const SERIES = ["#1f5fa8", "#c96a12", "#2c7a4b", "#8a4fa8", "#a8323e", "#4b6478"];
// Totals against each other, one point per patch. There are separate lines for sides, patches, problems and runs
class Curve extends Frame {
  collect() {
    const [nx, ny] = [byId("curve-x").value, byId("curve-y").value],
      series = new Map();
    runs.forEach((run, k) =>
      run.data.cases.forEach((c, index) =>
        c.patches.forEach((p, patch) => {
          const x = valueOf(c, p, nx),
            y = valueOf(c, p, ny);
          if (!Number.isFinite(x) || !Number.isFinite(y)) return;
          const key = [k, c.problem, c.side || "", p.number].join("|");
          if (!series.has(key)) series.set(key, { run: k, side: c.side, problem: c.problem, patch: p.number, points: [] });
          series.get(key).points.push({ x, y, index, patch, run: k });
        }),
      ),
    );
    const list = [...series.values()],
      differ = name => new Set(list.map(s => s[name])).size > 1;
    const colours = new Map();
    for (const s of list) {
      const parts = [
        differ("side") && s.side && `${s.side} wheel`,
        differ("problem") && s.problem,
        differ("patch") && `patch ${s.patch}`,
      ].filter(Boolean);
      const name = parts.join(", ");
      if (!colours.has(name)) colours.set(name, SERIES[colours.size % SERIES.length]);
      s.colour = colours.get(name);
      s.name = [name, differ("run") && (s.run ? "other run" : "this run")].filter(Boolean).join(", ");
    }
    return list;
  }
  draw() {
    const name = [byId("curve-x").value, byId("curve-y").value],
      series = (this.series = this.collect());
    this.points = series.flatMap(s => s.points);
    if (!this.points.length) return this.blank("no values");
    const [x0, x1] = rangeOf(this.points.map(p => p.x)),
      [y0, y1] = rangeOf(this.points.map(p => p.y));
    const widen = (a, b) => (b > a ? 0.06 * (b - a) : Math.max(Math.abs(a) * 0.1, 1e-12)),
      wx = widen(x0, x1),
      wy = widen(y0, y1);
    const entries = series.length > 1 ? series.slice(0, 12).map(s => [s.name, s.colour, s.run ? [5, 4] : null]) : [],
      c = this.begin([x0 - wx, x1 + wx, y0 - wy, y1 + wy], entries),
      many = this.points.length > 300;
    this.grid();
    for (const s of series) {
      c.strokeStyle = s.colour;
      c.lineWidth = 1.3;
      c.setLineDash(s.run ? [5, 4] : []);
      c.beginPath();
      s.points.forEach((p, i) => {
        if (i) c.lineTo(this.X(p.x), this.Y(p.y));
        else c.moveTo(this.X(p.x), this.Y(p.y));
      });
      c.stroke();
      c.setLineDash([]);
      for (const p of s.points) {
        c.fillStyle = s.run ? "#fff" : s.colour;
        c.lineWidth = 1.2;
        c.beginPath();
        c.arc(this.X(p.x), this.Y(p.y), many ? 1.8 : 3.2, 0, 7);
        c.fill();
        if (s.run) c.stroke();
      }
    }
    const now = this.points.find(p => p.run === 0 && p.index === state.index && p.patch === state.patch);
    if (now) {
      c.strokeStyle = "#c2452d";
      c.lineWidth = 2.5;
      c.beginPath();
      c.arc(this.X(now.x), this.Y(now.y), 7, 0, 7);
      c.stroke();
    }
    this.end(label(name[0]), label(name[1]));
    legend(c, this, entries);
    this.announce(
      `${name[1]} over ${name[0]}, ${this.points.length} points in ${series.length} line${series.length > 1 ? "s" : ""}; ` +
        `${name[1]} from ${withUnit(y0, meta(name[1]).unit)} to ${withUnit(y1, meta(name[1]).unit)}` +
        (now ? `; this case: ${figures(now.y, 5)} at ${figures(now.x, 5)}` : ""),
    );
  }
  near(px, py) {
    let best = null,
      distance = 400;
    for (const p of this.points || []) {
      const d = (this.X(p.x) - px) ** 2 + (this.Y(p.y) - py) ** 2;
      if (d < distance) {
        distance = d;
        best = p;
      }
    }
    return best;
  }
  point(x, y, px, py) {
    const p = this.near(px, py),
      shown = p || { x, y };
    read([
      ["case", p ? runs[p.run].data.cases[p.index].label + (p.run ? " of the other run" : "") : "\u2013"],
      [byId("curve-x").value, figures(shown.x, 6)],
      [byId("curve-y").value, figures(shown.y, 6)],
    ]);
  }
  click(x, y, px, py) {
    const p = this.near(px, py);
    if (p && p.run === 0) go(p.index, p.patch);
  }
  // Arrow keys move from point to point
  move(dx, dy) {
    const own = this.points.filter(p => p.run === 0),
      from = this.chosen || own.find(p => p.index === state.index && p.patch === state.patch);
    const p = (this.chosen =
      own[
        Math.min(
          own.length - 1,
          Math.max(0, own.findIndex(q => from && q.index === from.index && q.patch === from.patch) + (dx || dy)),
        )
      ]);
    if (!p) return;
    this.cursor = [p.x, p.y];
    this.point(p.x, p.y, this.X(p.x), this.Y(p.y));
    changed();
  }
}

// A point of a profile in track coordinates
function turned(points, oy, oz, roll) {
  const list = [];
  for (let i = 0; points && i < points.length; i += 2)
    list.push([
      oy + points[i] * Math.cos(roll) - points[i + 1] * Math.sin(roll),
      oz + points[i] * Math.sin(roll) + points[i + 1] * Math.cos(roll),
    ]);
  return list;
}
const railLine = c => turned(state.profiles.rail, c.markers.y_r, c.markers.z_r, c.markers.roll_r);
// Position of the middle of a row of elements: y, z and inclination in track coordinates
function rowPlace(p, iy) {
  const t = p.totals,
    s = p.grid.yl + (iy + 0.5) * p.grid.dy;
  if (p.curve) return { y: p.curve.y[iy], z: p.curve.z[iy], angle: p.curve.angle[iy] };
  return { y: t.ycp_tr + s * Math.cos(t.deltcp_tr), z: t.zcp_tr + s * Math.sin(t.deltcp_tr), angle: t.deltcp_tr };
}
// Profiles and contact patches
class Profiles extends Frame {
  draw() {
    const c0 = nowCase();
    if (!c0.markers) return;
    const m = c0.markers,
      rail = railLine(c0),
      wheel = turned(state.profiles.wheel, m.y_w, m.z_w, m.roll_w);
    const near = c0.patches.length ? c0.patches.map(p => [p.totals.ycp_tr, p.totals.zcp_tr]) : rail.slice(0, 1);
    // a step to the other side of the track, or far along the rail's head, moves the view
    const inView = ([y, z]) => y > this.own[0] && y < this.own[1] && z > this.own[2] && z < this.own[3];
    if (this.own && this.seen !== state.index && !near.some(inView)) this.own = null;
    this.seen = state.index;
    const [y0, y1] = rangeOf(near.map(p => p[0])),
      [z0, z1] = rangeOf(near.map(p => p[1])),
      reach = 45;
    this.home = [y0 - reach, y1 + reach, z0 - 14, z1 + 22];
    this.down = true;
    this.equal = true;
    const c = this.begin();
    this.grid();
    for (const [list, colour] of [
      [wheel, "#5b6b7b"],
      [rail, "#1d2733"],
    ]) {
      c.beginPath();
      list.forEach(([y, z], i) => {
        if (i) c.lineTo(this.X(y), this.Y(z));
        else c.moveTo(this.X(y), this.Y(z));
      });
      c.strokeStyle = colour;
      c.lineWidth = 2;
      c.stroke();
    }
    const most = Math.max(...c0.patches.flatMap(q => q.rowPressure)) || 1;
    c0.patches.forEach((p, k) => this.pressure(c, p, most, k === state.patch ? "rgba(210,67,76,.75)" : "rgba(229,138,60,.6)"));
    this.labels(c, c0.patches);
    this.end("y [mm]", "z [mm]");
    legend(c, this, [
      ["wheel", "#5b6b7b"],
      ["rail", "#1d2733"],
      ["pressure over the row", "#d2434c"],
    ]);
    this.announce(
      `${caseName(c0)}; ` +
        (c0.patches
          .map(
            p =>
              `patch ${p.number} at y ${figures(p.totals.ycp_tr, 5)} mm, ` +
              `inclined ${figures((p.totals.deltcp_tr * 180) / Math.PI, 3)} degrees, ${figures(p.totals.fn)} N`,
          )
          .join("; ") || "no contact"),
    );
  }
  pressure(c, p, most, colour) {
    c.fillStyle = colour;
    for (let iy = 0; iy < p.grid.my; iy++)
      if (p.rowPressure[iy] > 0) {
        const { y, z, angle } = rowPlace(p, iy),
          half = p.grid.dy / 2,
          height = (46 * p.rowPressure[iy]) / most;
        const nx = -Math.sin(angle),
          nz = Math.cos(angle),
          tx = Math.cos(angle),
          tz = Math.sin(angle);
        const corner = (a, b) => [this.X(y + a * half * tx) + b * nx, this.Y(z + a * half * tz) + b * nz];
        c.beginPath();
        c.moveTo(...corner(-1, 0));
        c.lineTo(...corner(1, 0));
        c.lineTo(...corner(1, height));
        c.lineTo(...corner(-1, height));
        c.fill();
      }
  }
  // Labels of the patches below them, moved down to avoid overlap, with a line to the patch
  labels(c, patches) {
    const taken = (this.taken = []);
    c.textAlign = "center";
    c.textBaseline = "top";
    for (const p of [...patches].sort((a, b) => a.totals.ycp_tr - b.totals.ycp_tr)) {
      const text = `patch ${p.number}`,
        w = c.measureText(text).width + 8,
        x = this.X(p.totals.ycp_tr),
        top = this.Y(p.totals.zcp_tr);
      let y = top + 52;
      while (taken.some(t => Math.abs(t.x - x) < (t.w + w) / 2 && Math.abs(t.y - y) < 15)) y += 15;
      taken.push({ x, y, w });
      c.strokeStyle = "#9aa7b4";
      c.lineWidth = 1;
      c.beginPath();
      c.moveTo(x, top);
      c.lineTo(x, y);
      c.stroke();
      c.fillStyle = "rgba(255,255,255,.85)";
      c.fillRect(x - w / 2, y, w, 14);
      c.fillStyle = "#33414f";
      c.fillText(text, x, y + 1);
    }
  }
  point(y, z) {
    read([
      ["y", figures(y, 6) + " mm"],
      ["z", figures(z, 6) + " mm"],
    ]);
  }
}
