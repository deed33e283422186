/** Two points side by side: a pinned one and the chosen one, each with its verdict, waveform and phase portrait. */

import { answer } from "./api.js";
import { element, strokes } from "./dom.js";
import { Latest } from "./latest.js";
import { panel } from "./panel.js";
import { PARAMETERS, valueOf } from "./parameters.js";
import { settlePlan, startOf } from "./plans.js";
import { Portrait } from "./portrait.js";
import { short } from "./ticks.js";
import { trackOf } from "./track.js";
import { inUnits, shownAs } from "./units.js";
import { verdict } from "./verdict.js";
import { Waveform } from "./waveform.js";

/** The numbers of a pinned point, in the order in which the address has them. */
const NAMES = ["inverse_beta", "gap", "restitution", "damping", "second_gap", "second_restitution"];

/** @param {import("./state.js").State} state @returns {number[]} the chosen point as numbers for the address */
function pinOf(state) {
  const { x, v, phase } = startOf(state);
  return [...NAMES.map((name) => state[name]), state.second ? 1 : 0, state.beta ?? 0, x, v, phase];
}

/** The state with the pinned point as the chosen one. */
function pinned(state) {
  const { length } = NAMES;
  const [second, beta, ...start] = state.pin.slice(length);
  const point = Object.fromEntries(NAMES.map((name, k) => [name, state.pin[k]]));
  return { ...state, ...point, second: second === 1, beta: beta || null, start };
}

/** The parameters of a point in which it differs from the other one, and those of both axes. */
function names(state, other) {
  const shown = Object.keys(PARAMETERS).filter((name) => name !== (state.beta === null ? "beta" : "inverse_beta"));
  return shown.filter((name) => [state.x, state.y].includes(name) || (state[name] !== other[name] && (state.second || !name.startsWith("second"))));
}

class Side {
  constructor(title, failed) {
    this.verdict = element("div", { class: "verdict" });
    this.values = element("p", { class: "values" });
    this.wave = new Waveform({ height: 0.62, label: `Waveform of the ${title} point` });
    this.portrait = new Portrait(`Phase portrait of the ${title} point`);
    this.box = element("div", { class: "side" }, element("h4", { text: `The ${title} point` }), this.values, this.verdict,
      this.wave.plot.host, this.portrait.plot.host);
    this.asked = new Latest((state, signal) => this.fetch(state, signal), failed);
  }

  show(state, other) {
    const start = startOf(state);
    const from = JSON.stringify(start) === JSON.stringify(startOf(other)) ? ""
      : `, start ${["x", "v"].map((name) => {
        const { unit, factor } = shownAs(state, name);
        return short(start[name] * factor) + (unit && ` ${unit}`);
      }).join(", ")}, φ ${short(start.phase)}`;
    this.values.textContent = names(state, other).map((name) => {
      const { symbol, unit, factor } = shownAs(state, name);
      return `${symbol} ${short(valueOf(state, name) * factor)}${unit && ` ${unit}`}`;
    }).join(", ") + from;
    const key = JSON.stringify([inUnits(settlePlan(state), state), state.wave, state.portrait, state.periods]);
    if (key === this.shown) return;
    this.shown = key;
    this.asked.ask(structuredClone(state), true);
  }

  async fetch(state, signal) {
    try {
      const { motion } = await answer(settlePlan(state), signal);
      this.verdict.replaceChildren(...verdict(motion));
      this.wave.show(await trackOf(state, state.wave, signal));
      this.portrait.show(await trackOf(state, state.portrait, signal));
    } catch (error) {
      this.shown = null;
      throw error;
    }
  }
}

export class Comparison {
  /**
   * @param {import("./state.js").Store} store
   * @param {import("./plane.js").Plane} plane
   * @param {(error: Error) => void} failed
   */
  constructor(store, plane, failed) {
    Object.assign(this, { store, plane });
    this.sides = [new Side("pinned", failed), new Side("chosen", failed)];
    const button = (text, onclick) => element("button", { type: "button", text, onclick });
    this.swap = button("Exchange", () => this.exchange());
    this.box = panel("compare", "Two points compared", {},
      element("div", { class: "controls" }, this.swap, button("Remove the pin", () => store.set({ pin: null }))),
      element("div", { class: "sides" }, ...this.sides.map(({ box }) => box)));
    this.pin = element("button", { type: "button", class: "pin", text: "Pin", title: "Keep this point, and compare it with the next one", onclick: () => store.set({ pin: pinOf(store.state) }) });
    plane.view.painters.push((context, viewport, frame) => this.paint(context, viewport, frame));
    store.on(["pin"], () => plane.view.draw());
  }

  refresh() {
    const { state } = this.store;
    this.box.hidden = !state.pin;
    if (!state.pin) return;
    const other = pinned(state);
    this.sides[0].show(other, state);
    this.sides[1].show(state, other);
  }

  exchange() {
    const { state } = this.store;
    const { inverse_beta, beta, gap, restitution, damping, second, second_gap, second_restitution, start } = pinned(state);
    this.store.set({ inverse_beta, beta, gap, restitution, damping, second, second_gap, second_restitution, start, basin: null, pin: pinOf(state) });
  }

  /** The mark of the pinned point on the map, where it differs from the chosen one. */
  paint(context, viewport, frame) {
    const { state } = this.store;
    if (!state.pin || !state.point) return;
    const other = pinned(state);
    const [px, py] = viewport.toPixel(valueOf(other, state.x), valueOf(other, state.y));
    const r = 0.45 * frame.em;
    strokes(context, [[4.5, "#ffffff"], [2, "#000000"]], () => context.rect(px - r, py - r, 2 * r, 2 * r));
  }
}
