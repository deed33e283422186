/** Quantities of motions as colours: their names and the colours of values from the server, and the range of the colours in a view. */

/** What the server says about quantities. */
const known = { quantities: [], pixels: new Uint32Array(0), colours: [], missing: new Map() };

/** @param {string} hex `#rrggbb` @returns {number} the value of a canvas pixel */
export const pixelOf = (hex) => {
  const rgb = parseInt(hex.slice(1), 16);
  return (0xff000000 | ((rgb & 0xff) << 16) | (rgb & 0xff00) | (rgb >> 16)) >>> 0;
};

/** @param {{quantities: object[], colours: string[], missing: {name: string, colour: string, hatch: string | null}[]}} told by the server */
export function learnValues({ quantities = [], colours = [], missing = [] }) {
  Object.assign(known, { quantities, colours, pixels: Uint32Array.from(colours, pixelOf), missing: new Map(missing.map((look) => [look.name, look])) });
}

/** @returns {{name: string, description: string, unit: string}[]} all quantities */
export const quantities = () => known.quantities;

/** @returns {string[]} the colours, from the smallest value to the largest */
export const colours = () => known.colours;

/** The look of values that are no finite number: `infinite`, `not defined` or `not computed`. */
export const missingLook = (name) => known.missing.get(name) ?? { name, colour: "#b8b8b8", hatch: "#606060" };

/**
 * How a tile shows a quantity.
 * @typedef {object} Scale
 * @property {number} low value of the first colour, in the units that are shown
 * @property {number} high value of the last one
 * @property {number} factor of values of the tile
 * @property {"largest" | "smallest" | "likeliest"} of which motion of a point is shown
 */

/** @param {Scale} scale @param {number} value of a tile @returns {number} the number of its colour */
export function step({ low, high, factor }, value) {
  const place = (value * factor - low) / (high - low);
  return Math.min(known.colours.length - 1, Math.floor(Math.min(1, Math.max(0, place)) * known.colours.length));
}

/** @returns {number} the value of a canvas pixel for a finite value */
export const pixelAt = (scale, value) => known.pixels[step(scale, value)];

/** The rank of a value among those of one point: as `vibro map --of`. */
const rank = (value, name, of) => {
  if (value === Infinity) return of === "largest" ? [4, 0] : [2, 0];
  if (Number.isFinite(value)) return [3, of === "largest" ? value : -value];
  return [name === "undecided" ? 1 : 0, 0];
};

/**
 * The number of the motion that is shown, among those of a point.
 * @param {{value: number, name: string}[]} motions the most frequent first
 * @param {Scale["of"]} of
 */
export function shownOf(motions, of) {
  if (of === "likeliest") return 0;
  let best = 0;
  for (let k = 1; k < motions.length; k++) {
    const [a, b] = [rank(motions[best].value, motions[best].name, of), rank(motions[k].value, motions[k].name, of)];
    if (b[0] > a[0] || (b[0] === a[0] && b[1] > a[1])) best = k;
  }
  return best;
}

/** Parts of the range that a part of the values may fill before it is made smaller. */
const LEAST_FILLED = 0.5;
/** Values that differ by less than this fraction are one value within rounding. */
const ROUNDING = 1e-9;

/** Number of steps of the digits of the ends in the range: with few of them, a small move of the view fits the range. */
const LEAST_STEPS = 4;

/** Ends with few digits around two values. */
function rounded(low, high) {
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (high - low <= ROUNDING * size || high === low) return size ? rounded(low - size / 2, high + size / 2) : [-1, 1];
  const rough = (high - low) / LEAST_STEPS;
  const power = 10 ** Math.floor(Math.log10(rough));
  const unit = power * [5, 2, 1].find((part) => part * power <= rough);
  const to = (way, value) => Number((way(value / unit) * unit).toPrecision(12));
  return [to(Math.floor, low), to(Math.ceil, high)];
}

/**
 * The range of the colours for the values in view. It remains as it is while the values fill at least a half of it.
 * @param {[number, number] | null} before
 * @param {number} low
 * @param {number} high
 * @returns {[number, number] | null}
 */
export function rangeFor(before, low, high) {
  if (!(low <= high)) return before;
  const fits = before && low >= before[0] && high <= before[1] && high - low >= LEAST_FILLED * (before[1] - before[0]);
  return fits ? before : rounded(low, high);
}
