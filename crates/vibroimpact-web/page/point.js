/** The chosen point: its verdict, waveform, starts, coexisting motions, orbit and stability. */

import { answer } from "./api.js";
import { Basin } from "./basin.js";
import { colourOf } from "./colours.js";
import { byId, debounced, element, swatch } from "./dom.js";
import { Figure } from "./figure.js";
import { Latest } from "./latest.js";
import { Legend } from "./legend.js";
import { PARAMETERS, legal, patchOf, valueOf } from "./parameters.js";
import { attractorsPlan, lyapunovPlan, settlePlan, simulatePlan, startOf, systemOf } from "./plans.js";
import { percent, short } from "./ticks.js";
import { labelText, meaning, stability } from "./words.js";

const SYSTEM = [...Object.keys(PARAMETERS), "second"];

export class Point {
  /**
   * @param {import("./state.js").Store} store
   * @param {import("./plane.js").Plane} plane
   * @param {{cache: object, queue: object, failed: (error: Error) => void}} parts
   * @param {(text: string) => void} say sends a message to screen readers
   * @param {(view: string) => void} exported opens the export of a view
   */
  constructor(store, plane, parts, say, exported) {
    Object.assign(this, { store, plane, say });
    const figure = (title, ratio, view) => new Figure(title, ratio, parts.failed, () => exported(view));
    this.wave = figure("Waveform", 0.58, "waveform");
    this.phase = figure("Phase portrait of the steady motion", 0.85, "phase");
    this.circle = figure("Multipliers", 1.02, "multipliers");
    this.sections = figure("Impact map and stroboscopic section", 1.05, "sections");
    this.exponents = figure("Attractor and Lyapunov exponents", 1.05, "lyapunov");
    this.exponentsText = element("p", { class: "note" });
    this.exponents.box.append(this.exponentsText);
    this.verdict = element("div", { class: "verdict" });
    this.coexisting = element("div", { class: "coexisting" });
    this.build(exported);
    this.basin = new Basin(this.basinHost, store, parts, {
      dragged: (at) => this.startAt(at, true), dropped: (at) => this.startAt(at, false),
    });
    this.legend = new Legend(this.basinLegend, this.basin.view, store);
    this.basin.view.addEventListener("hover", ({ detail }) => this.hoverBasin(detail));
    const spoken = debounced((px) => {
      const { place, motions } = this.basin.tell(px);
      say(`${place}: ${motions}`);
    }, 400);
    this.basin.view.addEventListener("crosshair", ({ detail }) => spoken(detail));
    this.settled = new Latest((state, signal) => this.settle(state, signal), parts.failed);
    this.heavy = new Latest((state, signal) => this.weigh(state, signal), parts.failed);
    store.on(["point", "panel", "start", "impacts", "basin", ...SYSTEM], (_, changed) => this.refresh(changed));
  }

  build(exported) {
    this.fields = { plane: element("div", { class: "fields" }), start: element("div", { class: "fields" }) };
    this.basinHost = element("div", { class: "view basin", id: "basin" });
    this.basinLegend = element("div", { class: "legend across" });
    this.basinSaid = element("p", { class: "readout", text: "Drag the dot: the start." });
    const exportOf = (view, what) => element("button", {
      type: "button", class: "quiet", text: "Export", "aria-label": `Export ${what}`, onclick: () => exported(view),
    });
    byId("point").append(
      this.fields.plane,
      this.verdict,
      this.wave.box,
      element("section", { class: "starts", "aria-labelledby": "starts-title" },
        element("header", { class: "head" }, element("h3", { id: "starts-title", text: "Which start leads where" }), exportOf("basin", "the basin")),
        this.basinHost, this.basinSaid, this.basinLegend, this.fields.start),
      element("section", { "aria-labelledby": "coexisting-title" },
        element("header", { class: "head" }, element("h3", { id: "coexisting-title", text: "Motions that coexist" }), exportOf("attractors", "the motions that coexist")),
        this.coexisting),
      this.phase.box, this.circle.box, this.sections.box, this.exponents.box,
    );
    this.startFields();
  }

  /** Fields for the start: position, velocity, phase. */
  startFields() {
    this.startInputs = [["ξ₀", "initial position"], ["u₀", "initial velocity"], ["φ", "phase of the force"]].map(([symbol, words], k) => {
      const input = element("input", {
        type: "number", step: "any", "aria-label": words,
        onchange: (event) => {
          const { x, v, phase } = startOf(this.store.state);
          const next = [x, v, phase];
          next[k] = Number(event.target.value);
          if (event.target.value !== "" && Number.isFinite(next[k])) this.store.set({ start: next });
        },
      });
      this.fields.start.append(element("label", {}, element("i", { class: "math", text: symbol }), input));
      return input;
    });
    this.fields.start.append(element("button", { type: "button", class: "quiet", text: "at rest", onclick: () => this.store.set({ start: null }) }));
  }

  /** Fields for the values of both axes. */
  planeFields() {
    const { state } = this.store;
    const key = `${state.x} ${state.y}`;
    if (this.fieldsFor !== key) {
      this.fieldsFor = key;
      this.planeInputs = [state.x, state.y].map((name) => {
        const input = element("input", {
          type: "number", step: "any", "aria-label": PARAMETERS[name].words,
          onchange: (event) => {
            const value = Number(event.target.value);
            if (event.target.value === "" || !legal(PARAMETERS[name], value)) return;
            this.plane.choose(patchOf(name, value));
          },
        });
        return { name, input };
      });
      this.fields.plane.replaceChildren(...this.planeInputs.map(({ name, input }) =>
        element("label", {}, element("i", { class: "math", text: PARAMETERS[name].symbol }), input)));
    }
    for (const { name, input } of this.planeInputs) {
      input.value = String(valueOf(state, name));
    }
  }

  /** @param {Set<string> | null} changed null for everything */
  refresh(changed) {
    const { state } = this.store;
    if (!state.point || state.panel !== "point") {
      this.settled.stop();
      this.heavy.stop();
      return;
    }
    this.planeFields();
    const { x, v, phase } = startOf(state);
    [x, v, phase].forEach((value, k) => {
      this.startInputs[k].value = String(value);
    });
    const of = JSON.stringify([systemOf(state), startOf(state)]);
    if (of !== this.shown) {
      this.shown = of;
      this.settled.ask(structuredClone(state));
      this.wave.show(simulatePlan(state), { alt: "Waveform from the chosen start, with the stop and the impacts" });
      this.heavy.ask(structuredClone(state), true);
    }
    // the panel may have been hidden before, and have no size yet
    requestAnimationFrame(() => this.basin.refresh());
    if (changed?.has("start")) this.basin.view.draw();
  }

  startAt([x, v], dragging) {
    const start = [x, v, startOf(this.store.state).phase];
    if (!dragging) {
      this.store.set({ start });
      return;
    }
    const state = { ...structuredClone(this.store.state), start };
    this.startInputs[0].value = String(x);
    this.startInputs[1].value = String(v);
    this.settled.ask(state);
    this.wave.show(simulatePlan(state), { alt: "Waveform from the start that is dragged" });
  }

  async settle(state, signal) {
    const { motion } = await answer(settlePlan(state), signal).catch((error) => {
      this.verdict.replaceChildren(element("p", { class: "soft", text: "No verdict." }));
      throw error;
    });
    const colour = colourOf(motion.label);
    this.verdict.replaceChildren(
      element("p", { class: "label" }, colour ? swatch(colour) : null, motion.kind === "no_impact" ? "0" : labelText(motion.label)),
      element("div", {}, element("p", { text: meaning(motion) }), element("p", { class: "soft", text: stability(motion) })),
    );
    this.say(`${motion.label}: ${meaning(motion)} ${stability(motion)}`);
  }

  /** Loads the parts that take longer: the coexisting motions, the figures of the settled motion, its exponents. */
  async weigh(state, signal) {
    const told = await answer(attractorsPlan(state), signal);
    this.tellCoexisting(told);
    const { motion } = await answer(settlePlan(state), signal);
    const plan = settlePlan(state);
    const chaotic = motion.kind === "chaotic";
    const orbit = motion.kind === "periodic" || motion.kind === "no_impact" || chaotic;
    const show = (figure, wanted, kind, alt) => (wanted ? figure.show(plan, { kind, alt }, true) : figure.hide());
    const name = labelText(motion.label);
    show(this.phase, orbit, "phase", `Phase portrait of the motion ${name}`);
    show(this.circle, motion.multipliers?.length, "multipliers", `Multipliers of the motion ${name} and the unit circle`);
    show(this.sections, motion.kind === "periodic", "sections", `Impacts and stroboscopic points of the motion ${name}`);
    if (!chaotic) this.exponents.hide();
    else await this.tellExponents(state, signal);
  }

  async tellExponents(state, signal) {
    const plan = lyapunovPlan(state);
    this.exponents.show(plan, { kind: "sections", alt: "Impact map and stroboscopic section of the attractor" }, true);
    this.exponentsText.textContent = "measuring the exponents";
    const found = await answer(plan, signal);
    const told = (m) => `${short(m.value)} ± ${short(m.error)}`;
    const dimension = found.dimension?.flow;
    this.exponentsText.textContent = `Lyapunov exponents per unit of time ${found.exponents.map(told).join(" and ")}`
      + (dimension ? `; dimension of the attractor ${told(dimension)}.` : ".");
  }

  tellCoexisting({ motions, starts }) {
    const rows = motions.map((motion) => {
      const fill = element("span", { class: "fill" });
      fill.style.width = `${100 * motion.share}%`;
      fill.style.backgroundColor = colourOf(motion.label) ?? "#9a9a9a";
      return element("li", {},
        element("span", { class: "name", text: motion.kind === "no_impact" ? "no impact" : labelText(motion.label) }),
        element("span", { class: "bar", "aria-hidden": "true" }, fill),
        element("span", { class: "share", text: percent(motion.share) }),
        element("span", { class: "soft", text: meaning(motion).replace(/\.$/, "") }));
    });
    this.coexisting.replaceChildren(
      element("ul", { class: "bars" }, ...rows),
      element("p", { class: "note", text: `Of ${starts} scattered starts.` }),
    );
  }

  hoverBasin(px) {
    const { viewport: v } = this.basin.view;
    const inside = px && px[0] >= 0 && px[1] >= 0 && px[0] <= v.width && px[1] <= v.height;
    if (!inside || !this.basin.view.source) {
      this.basinSaid.textContent = "Drag the dot: the start.";
      return;
    }
    const { place, motions, colour } = this.basin.tell(px);
    this.basinSaid.replaceChildren(element("span", { class: "place", text: place }), colour ? swatch(colour) : "", motions);
  }
}
