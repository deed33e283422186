/** The panel of the starts: the basin over position and velocity at a phase of the force, and fields for the start. */

import { Basin } from "./basin.js";
import { debounced, element, swatch } from "./dom.js";
import { numberField } from "./field.js";
import { Legend } from "./legend.js";
import { panel } from "./panel.js";
import { startOf } from "./plans.js";
import { givenValue, shownAs, shownValue, titled } from "./units.js";

const TURN = 2 * Math.PI;
/** Steps of the slider of the phase. */
const STEPS = 240;

const PHASE = { symbol: "φ", unit: "", factor: 1 };

const HINT = "Drag the dot to move the start.";

export class Starts {
  /**
   * @param {import("./state.js").Store} store
   * @param {{cache: object, queue: object, failed: (error: Error) => void}} parts
   * @param {{say: (text: string) => void, exported: () => void, startAt: (at: number[], dragging: boolean) => void}} heard
   */
  constructor(store, parts, { say, exported, startAt }) {
    this.store = store;
    this.host = element("div", { class: "view basin", id: "basin" });
    this.said = element("p", { class: "readout", text: HINT });
    const across = element("div", { class: "legend across" });
    this.fields = element("div", { class: "fields" });
    this.box = panel("basin", "Basins of the starts", { exported }, this.phase(), this.host, this.said, across, this.fields);
    this.basin = new Basin(this.host, store, parts, { dragged: (at) => startAt(at, true), dropped: (at) => startAt(at, false) });
    this.legend = new Legend(across, this.basin.view, store);
    this.basin.view.addEventListener("hover", ({ detail }) => this.hover(detail));
    this.basin.view.spoken((px) => this.basin.tell(px), say);
    this.inputs = this.startFields();
  }

  /** The slider of the phase of the force at the start. */
  phase() {
    this.turn = element("output", { for: "phase" });
    const live = debounced((phase) => this.setPhase(phase, "quiet"), 60);
    this.slider = element("input", {
      type: "range", id: "phase", min: 0, max: STEPS, step: 1,
      oninput: () => {
        const phase = (Number(this.slider.value) * TURN) / STEPS;
        this.tellPhase(phase);
        live(phase);
      },
      // after the last event of the slider
      onchange: () => setTimeout(() => this.setPhase((Number(this.slider.value) * TURN) / STEPS, "push"), 70),
    });
    return element("div", { class: "phase" },
      element("label", { for: "phase" }, element("i", { class: "math", text: "φ" }), " phase of the force at the start"), this.slider, this.turn);
  }

  setPhase(phase, how) {
    const { x, v } = startOf(this.store.state);
    const rounded = Number(phase.toFixed(4));
    const rest = x === 0 && v === 0 && rounded === 0 && !this.store.state.start;
    if (!rest) this.store.set({ start: [x, v, rounded] }, how);
  }

  tellPhase(phase) {
    const part = (phase / Math.PI).toFixed(2);
    this.turn.value = `${part} π`;
    this.slider.setAttribute("aria-valuetext", `${part} pi`);
  }

  /** Fields for the start: position, velocity, phase. */
  startFields() {
    this.symbols = [];
    const inputs = [["x", "initial position"], ["v", "initial velocity"], [null, "phase of the force"]].map(([name, words], k) => {
      const own = () => (name ? shownAs(this.store.state, name) : PHASE);
      const symbol = element("i", { class: "math" });
      this.symbols.push(() => {
        symbol.textContent = titled(own());
      });
      const field = numberField({
        label: words, check: () => "",
        set: (value) => {
          const { x, v, phase } = startOf(this.store.state);
          const next = [x, v, phase];
          next[k] = givenValue(own(), value);
          this.store.set({ start: next });
        },
      });
      this.fields.append(element("label", {}, symbol, field.input), field.said);
      return { ...field, show: (value) => field.show(shownValue(own(), value)) };
    });
    this.fields.append(element("button", {
      type: "button", class: "quiet", text: "Reset start", title: "Velocity 0 and phase 0, where the spring is free or at the stop",
      onclick: () => this.store.set({ start: null }),
    }));
    return inputs;
  }

  /** Shows the start of the state in the fields. */
  refresh() {
    const { x, v, phase } = startOf(this.store.state);
    for (const name of this.symbols) name();
    [x, v, phase].forEach((value, k) => {
      this.inputs[k].show(value);
    });
    const turned = phase - TURN * Math.floor(phase / TURN);
    if (document.activeElement !== this.slider) this.slider.value = String(Math.round((turned / TURN) * STEPS));
    this.tellPhase(turned);
  }

  /** Shows a start that is dragged. */
  dragged([x, v]) {
    this.inputs[0].show(x);
    this.inputs[1].show(v);
  }

  hover(px) {
    if (!this.basin.view.viewport.holds(px) || !this.basin.view.source) {
      this.said.textContent = HINT;
      return;
    }
    const { place, motions, colour } = this.basin.tell(px);
    this.said.replaceChildren(element("span", { class: "place", text: place }), colour && !this.basin.view.source.quantity ? swatch(colour) : "", motions);
  }
}
