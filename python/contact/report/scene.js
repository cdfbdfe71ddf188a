// 3D view of the rail with coloured patches, tractions as arrows, and the wheel as a wire frame; rotated by dragging, seen from
// above only.
const LIGHT = [0.35, -0.45, -0.82];
class Scene extends Picture {
  constructor(id) {
    super(id);
    Object.assign(this, { turn: [0.75, 0.7], scale: 1, shift: [0, 0], free: true });
  }
  // Initially the rail is seen from the side to which its contact is inclined
  face(patches) {
    const load = patches.reduce((sum, p) => sum + p.totals.fn, 0);
    const tilt = patches.reduce((sum, p) => sum + p.totals.fn * p.totals.deltcp_tr, 0) / (load || 1);
    if (this.free && Math.abs(tilt) > 0.03) this.turn = [tilt < 0 ? Math.PI - 0.75 : 0.75, 0.7];
  }
  get key() {
    return byId("scene-field").value;
  }
  draw() {
    const c0 = nowCase();
    if (!c0.markers) return;
    if (!c0.patches.length) return this.blank();
    this.face(c0.patches);
    const c = this.prepare(),
      rail = railLine(c0),
      name = this.key;
    if (!rail.length) return this.blank("this result has no profile of the rail");
    const ys = c0.patches.flatMap(p => [0, p.grid.my - 1].map(iy => rowPlace(p, iy).y)),
      zs = c0.patches.map(p => p.totals.zcp_tr);
    const xs = c0.patches.flatMap(p => [p.grid.xl, p.grid.xl + p.grid.mx * p.grid.dx].map(x => x + (p.totals.xcp_tr || 0)));
    const [[y0, y1], [z0, z1], [x0, x1]] = [rangeOf(ys), rangeOf(zs), rangeOf(xs)];
    const reach = 1.3 * Math.max(x1 - x0, y1 - y0, 12),
      middle = [(x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2];
    const size = (this.scale * Math.min(this.width, this.height * 1.3)) / (1.7 * reach),
      [azimuth, height] = this.turn;
    const [ca, sa, ch, sh] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(height), Math.sin(height)];
    // right, up and towards the viewer; z of the track points down
    this.project = ([x, y, z]) => {
      const [u, v, w] = [x - middle[0], middle[1] - y, middle[2] - z],
        a = u * ca - v * sa,
        b = u * sa + v * ca;
      return [
        this.width / 2 + this.shift[0] + size * a,
        this.height / 2 + this.shift[1] - size * (b * sh + w * ch),
        b * ch - w * sh,
      ];
    };
    this.shown = true;
    this.rail(
      c,
      rail.filter(([y, z]) => Math.abs(y - middle[1]) < 2.2 * reach && z - middle[2] < 1.6 * reach),
      middle[0] - reach,
      middle[0] + reach,
    );
    if (byId("scene-wheel").checked) this.wheel(c, c0, middle, reach);
    const inContact = c0.patches.flatMap(p => {
      const f = p.shown;
      return f && f[name] ? [...f[name]].filter((_, i) => f.eldiv[i] > 0) : [];
    });
    const scale = scaleFor(name, inContact, kindOf(name));
    for (const p of c0.patches) this.patch(c, p, name, scale);
    for (const p of c0.patches) this.arrows(c, p, c0.patches, size);
    this.axes(c, size);
    const unit = pretty(unitOf(c0.patches[0], name));
    this.right = 78;
    this.h = this.height - 30;
    c.fillStyle = "rgba(255,255,255,.8)";
    c.fillRect(this.width - this.right + 2, 0, this.right, this.height);
    colourBar(this, scale, unit);
    this.announce(
      `${nameOf(name)} on the rail, ${caseName(c0)}; ` +
        c0.patches.map(p => `patch ${p.number} at y ${figures(p.totals.ycp_tr, 5)} mm`).join(", ") +
        "; arrows: tangential tractions on the rail",
    );
  }
  // Strips between the points of the profile, ordered from back to front
  rail(c, line, x0, x1) {
    const step = Math.max(1, Math.floor(line.length / 160)),
      points = line.filter((_, i) => i % step === 0 || i === line.length - 1),
      quads = [];
    for (let i = 0; i + 1 < points.length; i++) {
      const [[ya, za], [yb, zb]] = [points[i], points[i + 1]],
        length = Math.hypot(yb - ya, zb - za) || 1;
      const normal = [0, (zb - za) / length, -(yb - ya) / length],
        sign = normal[2] > 0 ? -1 : 1;
      const light = Math.max(0, sign * (normal[1] * LIGHT[1] + normal[2] * LIGHT[2])),
        grey = Math.round(150 + 85 * light);
      for (let k = 0; k < 8; k++) {
        const [a, b] = [x0 + ((x1 - x0) * k) / 8, x0 + ((x1 - x0) * (k + 1)) / 8];
        quads.push({
          corners: [
            [a, ya, za],
            [b, ya, za],
            [b, yb, zb],
            [a, yb, zb],
          ].map(this.project),
          colour: `rgb(${grey},${grey + 3},${grey + 6})`,
        });
      }
    }
    const ends = [x0, x1].map(x => points.map(([y, z]) => this.project([x, y, z]))).sort((a, b) => b[0][2] - a[0][2]);
    const end = line => {
      c.strokeStyle = "#5b6b7b";
      c.lineWidth = 1.2;
      c.beginPath();
      line.forEach(([u, v], i) => {
        if (i) c.lineTo(u, v);
        else c.moveTo(u, v);
      });
      c.stroke();
    };
    end(ends[0]);
    const depth = q => q.corners.reduce((sum, p) => sum + p[2], 0);
    for (const q of quads.sort((a, b) => depth(b) - depth(a))) this.polygon(c, q.corners, q.colour, true);
    end(ends[1]);
  }
  // A point of the wheel profile at an angle about the axle from the lowest position, in track coordinates
  wheelPoint(c0, [y, z], angle) {
    const m = c0.markers,
      radius = c0.radius + z,
      along = radius * Math.sin(angle),
      down = radius * Math.cos(angle) - c0.radius;
    const across = y * Math.cos(m.roll_w) - down * Math.sin(m.roll_w);
    return [
      m.x_w + along * Math.cos(m.yaw_w) - across * Math.sin(m.yaw_w),
      m.y_w + along * Math.sin(m.yaw_w) + across * Math.cos(m.yaw_w),
      m.z_w + y * Math.sin(m.roll_w) + down * Math.cos(m.roll_w),
    ];
  }
  // Circles through some points of the profile, and the profile at some angles, so that the patches remain visible
  wheel(c, c0, middle, reach) {
    const profile = state.profiles.wheel;
    if (!profile || !c0.radius) return;
    const points = [];
    for (let i = 0; i < profile.length; i += 2) {
      const at = this.wheelPoint(c0, [profile[i], profile[i + 1]], 0);
      if (Math.abs(at[1] - middle[1]) < 2.2 * reach) points.push([profile[i], profile[i + 1]]);
    }
    const most = Math.asin(Math.min(0.9, reach / c0.radius)),
      first = Math.asin(Math.max(-0.9, Math.min(0.9, (middle[0] - c0.markers.x_w) / c0.radius)));
    const angles = Array.from({ length: 17 }, (_, k) => first + (most * (k - 8)) / 8),
      step = Math.max(1, Math.floor(points.length / 28));
    const line = list => {
      c.beginPath();
      list.map(this.project).forEach(([u, v], i) => {
        if (i) c.lineTo(u, v);
        else c.moveTo(u, v);
      });
      c.stroke();
    };
    c.strokeStyle = "rgba(31,95,168,.35)";
    c.lineWidth = 1;
    for (let i = 0; i < points.length; i += step) line(angles.map(a => this.wheelPoint(c0, points[i], a)));
    for (let k = 0; k < angles.length; k += 4) line(points.map(p => this.wheelPoint(c0, p, angles[k])));
  }
  polygon(c, corners, colour, edge) {
    c.beginPath();
    corners.forEach(([u, v], i) => {
      if (i) c.lineTo(u, v);
      else c.moveTo(u, v);
    });
    c.closePath();
    c.fillStyle = colour;
    c.fill();
    if (edge) {
      c.strokeStyle = colour;
      c.lineWidth = 0.7;
      c.stroke();
    }
  }
  // A point of a patch from its x and its row, with a fraction towards the next or previous row
  place(p, x, iy, fraction) {
    const { y, z, angle } = rowPlace(p, iy),
      s = fraction * p.grid.dy;
    return [(p.totals.xcp_tr || 0) + x, y + s * Math.cos(angle), z + s * Math.sin(angle)];
  }
  patch(c, p, name, scale) {
    const f = p.shown,
      { mx, my, xl, dx } = p.grid;
    if (!f || !f[name]) return;
    for (let iy = 0; iy < my; iy++)
      for (let ix = 0; ix < mx; ix++) {
        const i = ix + mx * iy;
        if (!f.eldiv[i]) continue;
        const corners = [
          [ix, -0.5],
          [ix + 1, -0.5],
          [ix + 1, 0.5],
          [ix, 0.5],
        ].map(([k, fraction]) => this.project(this.place(p, xl + k * dx, iy, fraction)));
        this.polygon(c, corners, `rgb(${scale.colour((f[name][i] - scale.low) / (scale.high - scale.low))})`, true);
      }
  }
  arrows(c, p, patches, size) {
    const f = p.shown,
      { mx, my, xl, dx, dy } = p.grid;
    if (!f || !f.pt) return;
    const most = Math.max(...patches.map(q => (q.shown && q.shown.pt ? rangeOf(q.shown.pt)[1] : 0)));
    if (!(most > 0)) return;
    const kx = Math.max(1, Math.round(14 / (size * dx))),
      ky = Math.max(1, Math.round(10 / (size * dy)));
    c.strokeStyle = "#14202c";
    c.fillStyle = "#14202c";
    c.lineWidth = 1.1;
    const first = f.eldiv.findIndex(v => v > 0),
      start = Math.max(0, Math.floor(first / mx)) % ky;
    for (let iy = start; iy < my; iy += ky)
      for (let ix = Math.floor(kx / 2); ix < mx; ix += kx) {
        const i = ix + mx * iy;
        if (!f.eldiv[i] || f.pt[i] < 0.02 * most) continue;
        const x = xl + (ix + 0.5) * dx,
          from = this.project(this.place(p, x, iy, 0));
        const to = this.project(this.place(p, x + f.px[i] / f.pt[i], iy, f.py[i] / f.pt[i] / dy)),
          u = to[0] - from[0],
          v = to[1] - from[1],
          n = Math.hypot(u, v);
        if (n > 1e-9) arrow(c, from[0], from[1], u / n, v / n, Math.max(3, (((26 * f.pt[i]) / most) * n) / size));
      }
  }
  axes(c) {
    const [ox, oy] = [46, this.height - 40],
      origin = this.project([0, 0, 0]);
    c.font = FONT;
    c.textAlign = "center";
    c.textBaseline = "middle";
    c.lineWidth = 1.4;
    for (const [axis, end] of [
      ["x", [1, 0, 0]],
      ["y", [0, 1, 0]],
      ["z", [0, 0, 1]],
    ]) {
      const at = this.project(end),
        u = at[0] - origin[0],
        v = at[1] - origin[1],
        n =
          30 /
          (Math.hypot(
            ...[
              [1, 0, 0],
              [0, 1, 0],
              [0, 0, 1],
            ].map(e => this.project(e)[0] - origin[0]),
          ) || 1);
      c.strokeStyle = c.fillStyle = "#33414f";
      c.beginPath();
      c.moveTo(ox, oy);
      c.lineTo(ox + u * n, oy + v * n);
      c.stroke();
      c.fillText(axis, ox + u * n * 1.3, oy + v * n * 1.3 + (axis === "z" ? 4 : 0));
    }
  }
  grip() {
    return { turn: this.turn.slice(), shift: this.shift.slice() };
  }
  drag(from, dx, dy) {
    this.free = false;
    this.turn = [from.turn[0] + dx / 150, Math.min(1.55, Math.max(0.1, from.turn[1] + dy / 150))];
    changed();
  }
  zoom(factor) {
    this.scale = Math.min(12, Math.max(0.4, this.scale / factor));
    changed();
  }
  whole() {
    Object.assign(this, { turn: [0.75, 0.7], scale: 1, shift: [0, 0], free: true });
    changed();
  }
  move(dx, dy) {
    this.drag(this.grip(), 12 * dx, -12 * dy);
  }
  hover() {
    read([["", "drag to turn the rail; x along the track, z down"]]);
  }
}
