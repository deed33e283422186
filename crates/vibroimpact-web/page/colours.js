/** Colours of labels, the same in every figure: the server has those of the groups; labels of a group have shades of it. */

import { GROUP_RULES, SHADES } from "./tables.js";

const byLabel = new Map();

/** @param {string} label @returns {string} its group in the legends of all figures */
export function groupOf(label) {
  const [m, n] = label.split("/");
  if (n === undefined || byLabel.has(label)) return label;
  if (m === "inf") return "inf/n";
  const holds = ([[fewest, most], [shortest, longest], equal]) =>
    fewest <= +m && +m <= most && shortest <= +n && +n <= longest && (!equal || m === n);
  return GROUP_RULES.find(holds)?.at(-1) ?? "other";
}

/** @param {{name: string, colour: string}[]} groups names and colours of the groups */
export function learn(groups) {
  for (const { name, colour } of groups) byLabel.set(name, colour);
}

/** @param {string} label @returns {string | null} */
export function colourOf(label) {
  const group = groupOf(label);
  const [m, n] = label.split("/");
  const number = ((m === "inf" ? 0 : +m) + 2 * +n) % 5;
  return (label !== group && SHADES[group]?.[number - 1]) || (byLabel.get(group) ?? null);
}

/** @returns {string} the label of a group as words of a legend */
export const groupText = (group) => ({
  "m/1": "m/1, m ≥ 5", "1/n": "1/n, n ≥ 4", "k/k": "k/k, k ≥ 2", "m/n": "other m/n", "inf/n": "∞/n, chatter",
})[group] ?? group;
