// Colour scales and their ranges: common to all cases, of each plot separately, or set by the user.
const MAPS = {
  pressure: ["#f7f4fb", "#fde0b8", "#fbb36b", "#f07c4a", "#d2434c", "#9b2062", "#551a64", "#1c0f38"],
  calm: ["#f5f9f7", "#cfe8e0", "#93cfc3", "#55ada9", "#2b8491", "#1e5b77", "#153457"],
  signed: ["#1b4f93", "#4f8cc4", "#a9cde5", "#f6f6f4", "#f3bd94", "#d8704a", "#96261f"],
};
const rgbOf = text => [1, 3, 5].map(k => parseInt(text.slice(k, k + 2), 16));
function ramp(name) {
  const stops = MAPS[name].map(rgbOf);
  return t => {
    const at = Math.min(Math.max(t, 0), 1) * (stops.length - 1),
      k = Math.min(Math.floor(at), stops.length - 2),
      f = at - k;
    return stops[k].map((v, c) => Math.round(v + f * (stops[k + 1][c] - v)));
  };
}
const kindOf = name => (/^(pn|temp|sigvm|sigtr|power|wear)/.test(name) ? "pressure" : "calm");
function rangeOf(values) {
  let low = Infinity,
    high = -Infinity;
  for (const v of values) {
    low = Math.min(low, v);
    high = Math.max(high, v);
  }
  return [low, high];
}
// Colour scale of a range: symmetric about zero if both signs occur, and for differences; starting at zero if that is near
function coloursOf([low, high], map) {
  if (!(high >= low)) {
    low = 0;
    high = 1;
  }
  const negative = low < 0 && high <= -0.02 * low && map !== "signed";
  const signed = map === "signed" || (low < 0 && high > 0 && -low > 0.02 * high && !negative);
  if (signed) {
    high = Math.max(high, -low) || 1;
    low = -high;
  } else if (low > 0 && low < 0.6 * high) low = 0;
  if (high <= low) {
    const middle = low,
      half = 0.5 * Math.max(Math.abs(middle), 1e-30);
    low = middle - half;
    high = middle + half;
  }
  if (negative && high < 0 && high > 0.6 * low) high = 0;
  const scale = ramp(signed ? "signed" : map);
  return { low, high, colour: negative ? t => scale(1 - t) : scale };
}
// User limits by the name of the quantity; differences and stresses have separate names
const limits = new Map();
function scaleFor(key, values, map) {
  const given = limits.get(key);
  if (given) return { low: given[0], high: given[1], colour: ramp(given[0] < 0 && given[1] > 0 ? "signed" : map), given: true };
  const common = byId("scale").value === "common" && !key.startsWith("difference ");
  const known = common ? runs.map(run => run.data.ranges && run.data.ranges[key]).filter(Boolean) : [];
  if (known.length) return coloursOf([Math.min(...known.map(r => r[0])), Math.max(...known.map(r => r[1]))], map);
  return coloursOf(rangeOf(values), key.startsWith("difference ") ? "signed" : map);
}
