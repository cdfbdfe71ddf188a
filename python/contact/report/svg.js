// A drawing context that produces SVG, with the subset of the canvas interface used by this page.
const SVG = "http://www.w3.org/2000/svg";
class SvgContext {
  constructor(width, height) {
    this.root = this.make("svg", { width, height, viewBox: `0 0 ${width} ${height}` });
    this.defs = this.root.appendChild(this.make("defs", {}));
    Object.assign(this, {
      group: this.root,
      stack: [],
      path: "",
      clips: 0,
      dash: [],
      fillStyle: "#000",
      strokeStyle: "#000",
      lineWidth: 1,
      font: "12px sans-serif",
      textAlign: "left",
      textBaseline: "alphabetic",
      imageSmoothingEnabled: true,
      move: [0, 0],
      turn: 0,
    });
    this.ruler = document.createElement("canvas").getContext("2d");
  }
  make(name, attributes) {
    const node = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes))
      node.setAttribute(key, typeof value === "number" ? +value.toFixed(2) : value);
    return node;
  }
  add(name, attributes) {
    if (this.turn || this.move[0] || this.move[1])
      attributes.transform =
        `translate(${this.move.map(v => +v.toFixed(2))})` + (this.turn ? ` rotate(${(this.turn * 180) / Math.PI})` : "");
    return this.group.appendChild(this.make(name, attributes));
  }
  save() {
    this.stack.push([this.group, this.move, this.turn]);
  }
  restore() {
    [this.group, this.move, this.turn] = this.stack.pop();
  }
  translate(x, y) {
    this.move = [this.move[0] + x, this.move[1] + y];
  }
  rotate(angle) {
    this.turn += angle;
  }
  setTransform() {}
  clearRect() {}
  beginPath() {
    this.path = "";
  }
  moveTo(x, y) {
    this.path += `M${x.toFixed(2)} ${y.toFixed(2)}`;
  }
  lineTo(x, y) {
    this.path += `${this.path ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}`;
  }
  closePath() {
    this.path += "Z";
  }
  rect(x, y, w, h) {
    this.path += `M${x} ${y}h${w}v${h}h${-w}Z`;
  }
  arc(x, y, r) {
    this.path += `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0`;
  }
  clip() {
    const id = `clip${++this.clips}`,
      region = this.defs.appendChild(this.make("clipPath", { id }));
    region.append(this.make("path", { d: this.path }));
    this.group = this.group.appendChild(this.make("g", { "clip-path": `url(#${id})` }));
  }
  setLineDash(list) {
    this.dash = list;
  }
  stroke() {
    if (this.path)
      this.add("path", {
        d: this.path,
        fill: "none",
        stroke: this.strokeStyle,
        "stroke-width": this.lineWidth,
        "stroke-linejoin": "round",
        ...(this.dash.length ? { "stroke-dasharray": this.dash.join(" ") } : {}),
      });
  }
  fill() {
    if (this.path) this.add("path", { d: this.path, fill: this.fillStyle });
  }
  fillRect(x, y, width, height) {
    this.add("rect", { x, y, width, height, fill: this.fillStyle });
  }
  strokeRect(x, y, width, height) {
    this.add("rect", { x, y, width, height, fill: "none", stroke: this.strokeStyle, "stroke-width": this.lineWidth });
  }
  measureText(text) {
    this.ruler.font = this.font;
    return this.ruler.measureText(text);
  }
  fillText(text, x, y) {
    const [, size, family] = /([\d.]+)px (.*)/.exec(this.font),
      down = { top: 0.8, middle: 0.35, bottom: -0.2 }[this.textBaseline] || 0;
    this.add("text", {
      x,
      y: y + down * Number(size),
      fill: this.fillStyle,
      "font-size": size,
      "font-family": family,
      "text-anchor": { center: "middle", right: "end" }[this.textAlign] || "start",
    }).textContent = text;
  }
  drawImage(image, x, y, width, height) {
    this.add("image", {
      x,
      y,
      width,
      height,
      preserveAspectRatio: "none",
      href: image.toDataURL("image/png"),
      ...(this.imageSmoothingEnabled ? {} : { style: "image-rendering:pixelated" }),
    });
  }
  text() {
    return new XMLSerializer().serializeToString(this.root);
  }
}
