/** Ticks of an axis at any zoom, and numbers as text. */

const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

const superscript = (n) => String(n).replace("-", "⁻").replace(/\d/g, (digit) => SUPERSCRIPTS[digit]);

const minus = (text) => text.replace("-", "−");

/**
 * @typedef {object} Ticks
 * @property {{value: number, text: string}[]} ticks
 * @property {string} offset number to be added to every text; empty if there is none
 */

/**
 * Ticks at multiples of 1, 2 or 5 times a power of ten.
 * @param {number} low
 * @param {number} high
 * @param {number} most maximum number of ticks
 * @returns {Ticks}
 */
export function ticks(low, high, most) {
  const rough = (high - low) / Math.max(1, most);
  const power = Math.floor(Math.log10(rough));
  const factor = [1, 2, 5, 10].find((f) => f * 10 ** power >= rough * (1 - 1e-12));
  const exponent = factor === 10 ? power + 1 : power;
  const digit = factor === 10 ? 1 : factor;
  const decimals = Math.max(0, -exponent);
  // at deep zoom the labels contain only the digits that differ; the offset contains the rest
  const deep = decimals > 5;
  const base = deep ? Number(low.toFixed(Math.max(0, decimals - 3))) : 0;
  const unit = deep ? -exponent - 1 : 0;
  const found = [];
  for (let k = Math.ceil(low / (digit * 10 ** exponent)); found.length < 50; k++) {
    const value = exponent < 0 ? (k * digit) / 10 ** -exponent : k * digit * 10 ** exponent;
    if (!(value <= high)) break;
    const text = deep ? ((value - base) * 10 ** unit).toFixed(1) : value.toFixed(decimals);
    found.push({ value, text: minus(text === "-0.0" ? "0.0" : text) });
  }
  const offset = deep ? `${minus(base.toFixed(Math.max(0, decimals - 3)))} + … × 10${superscript(-unit)}` : "";
  return { ticks: found, offset };
}

/** @param {number} value @param {number} pixel the difference that must be visible @returns {string} */
export function digits(value, pixel) {
  return minus(value.toFixed(Math.min(17, Math.max(0, Math.ceil(-Math.log10(pixel))))));
}

/** @param {number} value @returns {string} four significant digits */
export function short(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e6) {
    const [mantissa, power] = value.toExponential(2).split("e");
    return minus(`${Number(mantissa)} × 10`) + superscript(Number(power));
  }
  return minus(String(Number(value.toPrecision(4))));
}

/** @param {number} count @returns {string} its digits, in groups of three where there are five or more */
export const grouped = (count) => (count < 10000 ? String(count) : String(count).replace(/\B(?=(\d{3})+$)/g, "\u202f"));

/** @param {number} share @returns {string} per cent */
export function percent(share) {
  const value = 100 * share;
  if (value > 0 && value < 0.05) return "< 0.1 %";
  return `${value >= 99.95 ? "100" : value.toFixed(1)} %`;
}
