/** Verdicts as text. */

import { digits, grouped, percent, short } from "./ticks.js";
import { shownOf } from "./values.js";

const NUMBERS = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"];

const counted = (n, one) => `${NUMBERS[n] ?? n} ${one}${n === 1 ? "" : "s"}`;

const every = (n) => (n === 1 ? "every forcing period" : `every ${counted(n, "forcing period")}`);

const capital = (text) => text[0].toUpperCase() + text.slice(1);

/** @param {string} label @returns {string} its text on the page */
export const labelText = (label) => label.replace(/^inf\//, "∞/");

/**
 * A label in a legend.
 * @param {string} label
 * @param {number | null} impacts the budget with which it was computed; null if a larger one follows
 */
export function legendText(label, impacts) {
  if (label === "0") return "no impact";
  if (label === "undecided") return impacts === null ? "undecided so far" : `undecided in ${grouped(impacts)} impacts`;
  if (label.startsWith("inf/")) return `${labelText(label)} chatter`;
  return label;
}

/**
 * A coordinate of a place as text, in the units that are shown.
 * @param {{symbol: string, unit: string, factor: number}} coordinate
 * @param {number} value
 * @param {number} pixel the difference that must be visible
 */
export const placeText = ({ symbol, unit, factor }, value, pixel) =>
  `${symbol} ${digits(value * factor, pixel * factor)}${unit ? ` ${unit}` : ""}`;

/** @param {object} motion of an answer @returns {string} its meaning, as a sentence */
export function meaning(motion) {
  const { kind, label } = motion;
  if (kind === "periodic") {
    const [m, n] = label.split("/");
    if (m === "0" || n === undefined) return "The steady motion, without impacts.";
    const rests = motion.sticks ?? 0;
    const rest = rests ? `, and ${counted(rests, "rest")} on the stop` : "";
    if (m === "inf") return capital(`a complete chatter (infinitely many impacts)${rest} ${every(Number(n))}.`);
    return capital(`${counted(Number(m), "impact")}${rest} ${every(Number(n))}.`);
  }
  if (kind === "no_impact") {
    const { horizon } = motion;
    if (horizon?.kind === "periods") return `No impact for at least ${short(horizon.periods)} forcing periods.`;
    if (horizon?.why === "graze_limit") return "Ever gentler impacts: in the limit it only touches the stop.";
    if (horizon?.why === "landing") return "It rests on the stop and lands on it again without impact.";
    if (horizon?.why === "grazing") return "It touches the stop without impact.";
    return "No more impacts, ever.";
  }
  if (kind === "chaotic") return motion.seen_events ? `No repetition in ${grouped(motion.seen_events)} impacts.` : "Impacts that do not repeat.";
  if (kind === "stuck") return `At rest on the ${motion.stop === "lower" ? "second stop" : "stop"} for ever.`;
  return "Nothing could be shown within the budget of impacts.";
}

const complex = ([re, im]) => (im ? `${short(re)} ${im < 0 ? "−" : "+"} ${short(Math.abs(im))} i` : short(re));

/** @param {object} motion @returns {string} its multipliers or exponents; empty if it has none */
export function stability(motion) {
  const list = motion.multipliers;
  if (motion.kind === "chaotic") {
    const { value, error } = motion.lyapunov ?? {};
    return value === undefined ? "Every single motion in it is unstable."
      : `Largest Lyapunov exponent ${short(value)} ± ${short(error)} per unit of time.`;
  }
  if (!list?.length) return "";
  const pair = list.length === 2 && list[0][1] !== 0 && list[0][1] === -list[1][1];
  const [re, im] = list[0];
  const told = pair ? `${short(re)} ± ${short(Math.abs(im))} i (modulus ${short(Math.hypot(re, im))})`
    : list.map(complex).join(", ");
  return `${capital(motion.stability)}; multipliers ${told}.`;
}

/**
 * The value of a quantity at a point as text.
 * @param {{value: number, name: string, missing: string}[]} found the motions, the most frequent first
 * @param {{description: string, unit: string, factor: number, of: string}} quantity
 */
export function valueText(found, { description, unit, factor, of }) {
  const { value, missing } = found[shownOf(found, of)];
  return `${description} ${missing || `${short(value * factor)}${unit ? ` ${unit}` : ""}`}`;
}

/**
 * The motions of a point as text, the most frequent first.
 * @param {{name: string, share: number, impacts: number}[]} found
 * @param {number} most the largest budget: a point that is undecided with a smaller one is computed again
 */
export function motionsText(found, most) {
  const name = ({ name: label, impacts }) => {
    const text = legendText(label, impacts);
    return label === "undecided" && impacts < most ? `${text} so far` : text;
  };
  if (found.length === 1) return name(found[0]);
  return found.map((motion) => `${name(motion)} ${percent(motion.share)}`).join(", ");
}
