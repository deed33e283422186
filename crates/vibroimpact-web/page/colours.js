/** Colours of labels from the server: that of the label if a tile contained it, or else that of its group. */

import { GROUP_RULES } from "./tables.js";

const byLabel = new Map();

/** The group of a label in the legends of all figures. */
function group(label) {
  const [m, n] = label.split("/");
  if (n === undefined || byLabel.has(label)) return label;
  if (m === "inf") return "inf/n";
  const holds = ([[fewest, most], [shortest, longest], equal]) =>
    fewest <= +m && +m <= most && shortest <= +n && +n <= longest && (!equal || m === n);
  return GROUP_RULES.find(holds)?.at(-1) ?? "other";
}

/** @param {{name: string, colour: string}[]} looks names and colours to add */
export function learn(looks) {
  for (const { name, colour } of looks) byLabel.set(name, colour);
}

/** @param {string} label @returns {string | null} */
export const colourOf = (label) => byLabel.get(group(label)) ?? null;
