/** The panel of the quantities of the settled motion: speeds, displacements, energies. */

import { about } from "./api.js";
import { element } from "./dom.js";
import { panel } from "./panel.js";
import { short } from "./ticks.js";
import { pageUnit } from "./units.js";

let names = null;

export class Quantities {
  /** @param {() => void} exported */
  constructor(exported) {
    this.rows = element("dl", { class: "quantities" });
    this.note = element("p", { class: "note" });
    this.box = panel("quantities", "Quantities of the motion", { exported }, this.rows, this.note);
  }

  /** @param {object} told the answer to a `settle` plan */
  async show({ motion: { quantities }, units }) {
    this.box.hidden = !quantities;
    if (!quantities) return;
    names ??= (await about()).quantities;
    const si = units === "si";
    const defined = names.filter(({ name }) => Number.isFinite(quantities[name]));
    this.rows.replaceChildren(...defined.flatMap(({ name, description, unit: given }) => {
      const { unit, per } = si ? pageUnit(given) : { unit: "", per: 1 };
      return [element("dt", { text: description }), element("dd", { text: `${short(per * quantities[name])}${unit && ` ${unit}`}` })];
    }));
    this.note.textContent = si ? "" : "Lengths in units of F/k, times in units of 1/ωₙ. With a body under Units they are in mm, s, J and W.";
  }
}
