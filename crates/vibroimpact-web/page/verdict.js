/** The verdict on a motion: its label in its colour, its meaning and its stability. */

import { colourOf } from "./colours.js";
import { element, swatch } from "./dom.js";
import { labelText, meaning, stability } from "./words.js";

/** @param {object} motion of an answer @returns {HTMLElement[]} */
export function verdict(motion) {
  const colour = colourOf(motion.label);
  return [
    element("p", { class: "label" }, colour ? swatch(colour) : null, motion.kind === "no_impact" ? "0" : labelText(motion.label)),
    element("div", {}, element("p", { text: meaning(motion) }), element("p", { class: "soft", text: stability(motion) })),
  ];
}
