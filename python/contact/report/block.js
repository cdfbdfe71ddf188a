// Stresses in a plane through a block of points below the surface, or along a line of points.
const PLANES = { y: ["x", "z"], x: ["y", "z"], z: ["x", "y"] };
const STRESSES = {
  sigvm: "von Mises stress",
  sighyd: "mean stress",
  sigtr: "Tresca's stress",
  sigma1: "largest principal stress",
  sigma2: "middle principal stress",
  sigma3: "smallest principal stress",
  sigxx: "\u03c3xx",
  sigyy: "\u03c3yy",
  sigzz: "\u03c3zz",
  sigxy: "\u03c3xy",
  sigxz: "\u03c3xz",
  sigyz: "\u03c3yz",
  ux: "displacement ux",
  uy: "displacement uy",
  uz: "displacement uz",
};
const WHOSE = { this: "", other: " of the other run", difference: ", this minus other," };
const stressUnit = name => (name.startsWith("u") ? "mm" : "N/mm\u00b2");
class Plane extends Frame {
  constructor(id) {
    super(id, { right: 78 });
  }
  get key() {
    const b = state.block;
    return (b && b.mode === "difference" ? "difference " : "") + "block " + (b ? b.name : "");
  }
  // Index of a point, from its indices along the two axes of the plane
  at(block, i, j) {
    const n = [block.x.length, block.y.length],
      { plane, place } = block;
    const [ix, iy, iz] = plane === "y" ? [i, place, j] : plane === "x" ? [place, i, j] : [i, j, place];
    return ix + n[0] * (iy + n[1] * iz);
  }
  draw() {
    const b = state.block;
    if (!b) return;
    if (!b.values) return this.blank("the other run has no block with these points");
    const [across, along] = PLANES[b.plane].map(axis => b[axis]);
    const values = Array.from({ length: along.length }, (_, j) => across.map((_, i) => b.values[this.at(b, i, j)])),
      flat = values.flat();
    const { low, high, colour } = (this.scale = scaleFor(this.key, flat, kindOf(b.name)));
    this.down = b.plane !== "z";
    if (across.length < 2 || along.length < 2) return this.line(b, across, along, flat);
    const first = list => list[0],
      last = list => list[list.length - 1];
    this.home = [first(across), last(across), Math.min(first(along), last(along)), Math.max(first(along), last(along))];
    this.equal = ratioIsPlain(this.own);
    const c = this.begin(),
      ratio = this.ratio;
    const x0 = Math.max(MARGIN.left, this.X(first(across))),
      x1 = Math.min(MARGIN.left + this.w, this.X(last(across)));
    const ya = this.Y(first(along)),
      yb = this.Y(last(along)),
      y0 = Math.max(MARGIN.top, Math.min(ya, yb)),
      y1 = Math.min(MARGIN.top + this.h, Math.max(ya, yb));
    const width = Math.round((x1 - x0) * ratio),
      height = Math.round((y1 - y0) * ratio);
    if (width > 0 && height > 0) {
      // linear interpolation between the points
      const cells = (list, n, place) =>
        Array.from({ length: n }, (_, k) => {
          const p = place((k + 0.5) / ratio);
          let i = 0;
          while (i < list.length - 2 && p > list[i + 1]) i++;
          return [i, Math.min(1, Math.max(0, (p - list[i]) / (list[i + 1] - list[i])))];
        });
      const columns = cells(across, width, k => this.back(x0 + k, 0)[0]),
        rows = cells(along, height, k => this.back(0, y0 + k)[1]);
      const image = document.createElement("canvas");
      image.width = width;
      image.height = height;
      const pixels = new ImageData(width, height),
        table = Array.from({ length: 257 }, (_, k) => colour(k / 256));
      rows.forEach(([j, g], ky) =>
        columns.forEach(([i, f], kx) => {
          const v =
            (values[j][i] * (1 - f) + values[j][i + 1] * f) * (1 - g) + (values[j + 1][i] * (1 - f) + values[j + 1][i + 1] * f) * g;
          const rgb = table[Math.round(256 * Math.min(1, Math.max(0, (v - low) / (high - low))))];
          pixels.data.set([rgb[0], rgb[1], rgb[2], 255], 4 * (kx + width * ky));
        }),
      );
      image.getContext("2d").putImageData(pixels, 0, 0);
      c.imageSmoothingEnabled = true;
      c.drawImage(image, x0, y0, x1 - x0, y1 - y0);
    }
    if (this.down) {
      c.strokeStyle = "rgba(29,39,51,.5)";
      c.lineWidth = 1;
      c.beginPath();
      c.moveTo(MARGIN.left, this.Y(0));
      c.lineTo(this.width, this.Y(0));
      c.stroke();
    }
    const names = PLANES[b.plane];
    this.end(names[0] + " [mm]", names[1] + (names[1] === "z" ? " [mm], positive in body 1" : " [mm]"));
    colourBar(this, this.scale, stressUnit(b.name));
    this.describe(b, flat);
  }
  describe(b, flat) {
    const [low, high] = rangeOf(flat);
    this.announce(
      `${STRESSES[b.name]}${WHOSE[b.mode]} in ${b.plane} = ${figures(b[b.plane][b.place])} mm, ` +
        `from ${figures(low)} to ${figures(high)} ${stressUnit(b.name)}`,
    );
  }
  // A line or a single point
  line(b, across, along, values) {
    const k = across.length > 1 ? 0 : 1,
      places = [across, along][k];
    if (places.length < 2)
      return this.blank(`${STRESSES[b.name]} ${figures(values[0], 5)} ${stressUnit(b.name)} at the only point`);
    this.down = this.equal = false;
    let [low, high] = rangeOf([0, ...values]);
    if (high === low) high = low + 1;
    this.home = [places[0], places[places.length - 1], low - 0.06 * (high - low), high + 0.06 * (high - low)];
    const c = this.begin();
    this.grid();
    c.strokeStyle = "#c2452d";
    c.lineWidth = 2;
    c.beginPath();
    places.forEach((p, i) => {
      if (i) c.lineTo(this.X(p), this.Y(values[i]));
      else c.moveTo(this.X(p), this.Y(values[i]));
    });
    c.stroke();
    this.end(PLANES[b.plane][k] + " [mm]", stressUnit(b.name));
    this.describe(b, values);
  }
  point(u, v) {
    const b = state.block,
      nearest = (list, p) => list.reduce((best, q, i) => (Math.abs(q - p) < Math.abs(list[best] - p) ? i : best), 0);
    if (!b || !b.values) return;
    const [across, along] = PLANES[b.plane].map(axis => b[axis]);
    const one = across.length < 2,
      i = one ? 0 : nearest(across, u),
      j = along.length < 2 ? 0 : nearest(along, one ? u : v),
      k = this.at(b, i, j);
    const place = { [PLANES[b.plane][0]]: across[i], [PLANES[b.plane][1]]: along[j], [b.plane]: b[b.plane][b.place] };
    read([
      ...["x", "y", "z"].map(axis => [axis, `${figures(place[axis])} mm`]),
      [STRESSES[b.name], `${figures(b.values[k], 5)} ${stressUnit(b.name)}`],
    ]);
  }
}
// Values at the same points in the other run, from the block with equal coordinates; null if there is none
async function otherBlock(other, number, block, name) {
  const there = other && other.patch && other.patch.blocks && other.patch.blocks[number];
  const same = axis =>
    there[axis].length === block[axis].length &&
    there[axis].every((v, i) => Math.abs(v - block[axis][i]) <= 1e-5 * Math.max(1, Math.abs(v)));
  return there && name in there.fields && ["x", "y", "z"].every(same) ? load(other.run, there.fields[name]) : null;
}
// The selected block, stress and plane of the patch; the selection is kept if possible. The plot cannot show both runs side by
// side, so it shows their difference then
async function chosenBlock(p, other) {
  const blocks = p && p.blocks ? p.blocks : [];
  byId("card-block").hidden = !blocks.length;
  if (!blocks.length) return null;
  const offer = (id, names, fallback) => {
    const select = byId(id),
      keep = select.value,
      values = names.map(n => n[0]);
    select.replaceChildren(...names.map(n => new Option(n[1], n[0])));
    select.value = values.includes(keep) ? keep : fallback;
    return select.value;
  };
  const number = Number(
      offer(
        "block",
        blocks.map((b, k) => [String(k), `block ${k + 1}`]),
        "0",
      ),
    ),
    block = blocks[number];
  byId("block").hidden = blocks.length < 2;
  const name = offer(
    "stress",
    Object.keys(STRESSES)
      .filter(n => n in block.fields)
      .map(n => [n, STRESSES[n]]),
    "sigvm",
  );
  const size = axis => (block[axis].length > 1 ? 1 : 0),
    best = ["y", "x", "z"].sort((a, b) => size(a) - size(b))[0];
  const fits = ["y", "x", "z"].filter(
    axis => PLANES[axis].reduce((sum, other) => sum + size(other), 0) === PLANES[best].reduce((sum, other) => sum + size(other), 0),
  );
  const plane = offer(
    "plane",
    fits.map(axis => [axis, `${axis} = constant`]),
    fits[0],
  );
  const count = block[plane].length,
    slider = byId("depth"),
    key = `${plane}${count}`;
  slider.max = count - 1;
  if (slider.dataset.key !== key) {
    // through the middle; for planes of constant depth a little below the surface
    slider.dataset.key = key;
    slider.value = Math.floor((count - 1) / 2);
  }
  slider.hidden = count < 2;
  const place = Number(slider.value);
  byId("depth-text").textContent = `${plane} = ${figures(block[plane][place])} mm`;
  slider.setAttribute("aria-valuetext", byId("depth-text").textContent);
  const mode = !runs[1] ? "this" : sideBySide() ? "difference" : byId("show").value;
  let values = await load(runs[0], block.fields[name]);
  if (mode !== "this") {
    const theirs = await otherBlock(other, number, block, name);
    if (mode === "difference") values = theirs && values.map((v, i) => v - theirs[i]);
    else values = theirs;
  }
  byId("card-block").querySelector("h2 .name").textContent =
    "Below the surface" + { this: "", other: ", other run", difference: ", this minus other" }[mode];
  return { ...block, name, plane, place, mode, values };
}
