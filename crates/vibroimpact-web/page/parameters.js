/**
 * The quantities that can be on an axis: symbol, description, legal range, initial window.
 *
 * @typedef {object} Coordinate
 * @property {string} symbol the symbol on an axis
 * @property {string} words description
 * @property {[number, number]} window initial window
 * @property {number} step size of a pixel at zoom level 0, a power of two
 * @property {number} least smallest legal value
 * @property {number} most largest legal value
 * @property {boolean} [open] whether `least` itself is excluded
 * @property {[number, number, number]} [slider] ends and step of its slider
 * @property {string} [unit] in which it is shown
 * @property {number} [factor] one nondimensional unit in it
 */

/** @type {Record<string, Coordinate>} Parameters of the oscillator. */
export const PARAMETERS = {
  inverse_beta: {
    symbol: "1/β", words: "inverse frequency", window: [0.375, 2.025], step: 2 ** -9,
    least: 0, open: true, most: Infinity, slider: [0.05, 3, 0.005],
  },
  beta: {
    symbol: "β", words: "frequency", window: [0.4, 2.8], step: 2 ** -9,
    least: 0, open: true, most: Infinity, slider: [0.3, 5, 0.005],
  },
  gap: {
    symbol: "δ", words: "gap", window: [0, 5], step: 2 ** -7,
    least: -Infinity, most: Infinity, slider: [-1, 6, 0.01],
  },
  restitution: {
    symbol: "ε", words: "restitution", window: [0, 1], step: 2 ** -9, least: 0, most: 1, slider: [0, 1, 0.01],
  },
  damping: {
    symbol: "ζ", words: "damping", window: [0, 0.25], step: 2 ** -11,
    least: 0, most: Infinity, slider: [0, 0.5, 0.005],
  },
  second_gap: {
    symbol: "δ₂", words: "second gap", window: [0, 5], step: 2 ** -7,
    least: -Infinity, most: Infinity, slider: [-1, 6, 0.01],
  },
  second_restitution: {
    symbol: "ε₂", words: "second restitution", window: [0, 1], step: 2 ** -9,
    least: 0, most: 1, slider: [0, 1, 0.01],
  },
};

/** @type {Record<string, Coordinate>} Coordinates of a start. */
export const START = {
  x: { symbol: "ξ₀", words: "initial position", window: [-8, 1], step: 2 ** -6, least: -Infinity, most: Infinity },
  v: { symbol: "ξ₀′", words: "initial velocity", window: [-8, 8], step: 2 ** -6, least: -Infinity, most: Infinity },
};

/** @param {string} name of a parameter @returns {boolean} whether it belongs to the second stop */
export const ofSecondStop = (name) => name.startsWith("second_");

/** @param {string} name of a parameter @returns {boolean} whether it is a frequency */
export const isFrequency = (name) => name === "beta" || name === "inverse_beta";

/**
 * Whether a coordinate may have a value.
 * @param {Coordinate} coordinate
 * @param {number} value
 */
export function legal(coordinate, value) {
  return Number.isFinite(value) && value <= coordinate.most
    && (coordinate.open ? value > coordinate.least : value >= coordinate.least);
}

/** @returns {string} the reason why a coordinate cannot have a value; empty if it can */
export function reasonAgainst(coordinate, value) {
  if (legal(coordinate, value)) return "";
  const { symbol, least, most, open, factor = 1, unit = "" } = coordinate;
  const shown = (number) => `${Number((number * factor).toPrecision(12))}${unit && ` ${unit}`}`;
  const range = `${Number.isFinite(least) ? `${shown(least)} ${open ? "<" : "≤"} ` : ""}${symbol}${Number.isFinite(most) ? ` ≤ ${shown(most)}` : ""}`;
  return `${symbol} = ${shown(value)} is not possible: ${range}.`;
}

/** @param {object} state @param {string} name @returns {number} the value of a parameter at the chosen point */
export const valueOf = (state, name) => (name === "beta" ? state.beta ?? 1 / state.inverse_beta : state[name]);

/**
 * The change of the state that sets a parameter. A frequency keeps the form in which it was given.
 * @param {string} name
 * @param {number} value
 */
export function patchOf(name, value) {
  if (name === "inverse_beta") return { inverse_beta: value, beta: null };
  if (name === "beta") return { beta: value, inverse_beta: 1 / value };
  return { [name]: value };
}
