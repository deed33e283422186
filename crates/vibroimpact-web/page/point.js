/** The chosen point: its verdict, and the panels with its motion, starts, coexisting motions, orbit and stability. */

import { answer } from "./api.js";
import { colourOf } from "./colours.js";
import { Comparison } from "./compare.js";
import { byId, element } from "./dom.js";
import { numberField } from "./field.js";
import { Figure } from "./figure.js";
import { Latest } from "./latest.js";
import { MotionPanel } from "./motion.js";
import { panel } from "./panel.js";
import { PARAMETERS, patchOf, reasonAgainst, valueOf } from "./parameters.js";
import { attractorsPlan, lyapunovPlan, settlePlan, startOf, systemOf } from "./plans.js";
import { PortraitPanel } from "./portrait.js";
import { Quantities } from "./quantities.js";
import { Starts } from "./starts.js";
import { percent, short } from "./ticks.js";
import { givenValue, inUnits, machineText, shownAs, shownValue, titled } from "./units.js";
import { verdict } from "./verdict.js";
import { labelText, meaning, stability } from "./words.js";

const SYSTEM = [...Object.keys(PARAMETERS), "second"];
const SHOWN = ["wave", "portrait", "periods", "pin", "colour", "of", "machine"];

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
    const { failed } = parts;
    const figure = (name, title, ratio) => new Figure(title, ratio, failed, () => exported(name), name);
    this.motion = new MotionPanel(store, failed, () => exported("waveform"));
    this.portrait = new PortraitPanel(store, failed, () => exported("phase"));
    this.motion.player.addEventListener("time", () => this.portrait.move(this.motion.wave.track, this.motion.player.time));
    this.starts = new Starts(store, parts, { say, exported: () => exported("basin"), startAt: (at, dragging) => this.startAt(at, dragging) });
    this.circle = figure("multipliers", "Multipliers", 1.02);
    // the unit circle is a circle
    this.circle.rigid = true;
    this.sections = figure("sections", "Impact map and stroboscopic section", 1.05);
    this.exponents = figure("lyapunov", "Attractor and Lyapunov exponents", 1.05);
    this.exponentsText = element("p", { class: "note" });
    this.exponents.box.append(this.exponentsText);
    this.quantities = new Quantities(() => exported("attractors"));
    this.inMachine = element("p", { class: "note" });
    this.comparison = new Comparison(store, plane, failed);
    this.verdict = element("div", { class: "verdict" });
    this.coexisting = element("div", { class: "coexisting" });
    this.fields = element("div", { class: "fields" });
    byId("point").append(
      element("div", { class: "head" }, this.fields, this.comparison.pin), this.inMachine, this.verdict, this.comparison.box, this.motion.box,
      this.starts.box,
      panel("attractors", "Motions that coexist", { exported: () => exported("attractors") }, this.coexisting),
      this.portrait.box, this.quantities.box, this.circle.box, this.sections.box, this.exponents.box,
    );
    this.settled = new Latest((state, signal) => this.settle(state, signal), failed);
    this.heavy = new Latest((state, signal) => this.weigh(state, signal), failed);
    store.on(["point", "panel", "start", "impacts", "basin", ...SYSTEM, ...SHOWN], (_, changed) => this.refresh(changed), () => this.wait());
  }

  get basin() {
    return this.starts.basin;
  }

  /** Fields for the values of both axes. */
  planeFields() {
    const { state } = this.store;
    const own = (name) => shownAs(this.store.state, name);
    const key = [state.x, state.y].map((name) => `${name} ${titled(own(name))}`).join();
    if (this.fieldsFor !== key) {
      this.fieldsFor = key;
      this.planeInputs = [state.x, state.y].map((name) => {
        const field = numberField({
          label: own(name).words, check: (value) => reasonAgainst(own(name), givenValue(own(name), value)),
          set: (value) => this.plane.choose(patchOf(name, givenValue(own(name), value))),
        });
        return { name, field };
      });
      this.fields.replaceChildren(...this.planeInputs.map(({ name, field }) =>
        element("label", {}, element("i", { class: "math", text: titled(own(name)) }), field.input)),
      ...this.planeInputs.map(({ field }) => field.said));
    }
    for (const { name, field } of this.planeInputs) field.show(shownValue(own(name), valueOf(state, name)));
  }

  /** @param {Set<string> | null} changed null for everything */
  refresh(changed) {
    const { state } = this.store;
    byId("point").removeAttribute("data-stale");
    if (!state.point || state.panel !== "point") {
      this.stop();
      return;
    }
    this.planeFields();
    this.starts.refresh();
    this.inMachine.textContent = machineText(state);
    const of = JSON.stringify([systemOf(state), startOf(state)]);
    const drawing = JSON.stringify([of, state.wave, state.portrait, state.periods]);
    if (drawing !== this.drawing) {
      this.drawing = drawing;
      this.motion.show(state);
      this.portrait.show(state);
    }
    if (of !== this.shown) {
      this.shown = of;
      this.settled.ask(structuredClone(state));
      this.heavy.ask(structuredClone(state), true);
    }
    this.comparison.refresh();
    // the panel may have been hidden before, and have no size yet
    requestAnimationFrame(() => this.basin.refresh());
    if (changed?.has("start")) this.basin.view.draw();
  }

  stop() {
    for (const part of [this.settled, this.heavy, this.motion, this.portrait]) part.stop();
  }

  /** While a slider of the map moves, only the map is computed. */
  wait() {
    this.stop();
    this.basin.view.supply.stop();
    byId("point").toggleAttribute("data-stale", true);
    [this.shown, this.drawing] = [null, null];
  }

  /** Requests everything again, after the server was gone. */
  retry() {
    [this.shown, this.drawing] = [null, null];
    this.refresh(null);
  }

  startAt([x, v], dragging) {
    const start = [x, v, startOf(this.store.state).phase];
    if (!dragging) {
      this.store.set({ start });
      return;
    }
    const state = { ...structuredClone(this.store.state), start };
    this.starts.dragged(start);
    this.settled.ask(state);
    this.motion.show(state);
    // the drawing of the state is another one
    this.drawing = null;
  }

  async settle(state, signal) {
    const { motion } = await answer(settlePlan(state), signal).catch((error) => {
      if (!signal.aborted) this.verdict.replaceChildren(element("p", { class: "soft", text: "No verdict." }));
      throw error;
    });
    this.verdict.replaceChildren(...verdict(motion));
    this.say(`${motion.label}: ${meaning(motion)} ${stability(motion)}`);
  }

  /** Loads the parts that take longer: the coexisting motions, the figures of the settled motion, its exponents. */
  async weigh(state, signal) {
    const told = await answer(attractorsPlan(state), signal);
    this.tellCoexisting(told);
    const plan = inUnits(settlePlan(state), state);
    const settled = await answer(plan, signal);
    const { motion } = settled;
    await this.quantities.show(settled);
    const chaotic = motion.kind === "chaotic";
    const show = (figure, wanted, kind, alt) => (wanted ? figure.show(plan, { kind, alt }, true) : figure.hide());
    const name = labelText(motion.label);
    show(this.circle, motion.multipliers?.length, "multipliers", `Multipliers of the motion ${name} and the unit circle`);
    show(this.sections, motion.kind === "periodic", "sections", `Impacts and stroboscopic points of the motion ${name}`);
    if (!chaotic) this.exponents.hide();
    else await this.tellExponents(state, signal);
  }

  async tellExponents(state, signal) {
    const plan = inUnits(lyapunovPlan(state), state);
    this.exponents.show(plan, { kind: "sections", alt: "Impact map and stroboscopic section of the attractor" }, true);
    this.exponentsText.textContent = "measuring the exponents";
    const found = await answer(plan, signal);
    const told = (m) => `${short(m.value)} ± ${short(m.error)}`;
    const dimension = found.dimension?.flow;
    this.exponentsText.textContent = `Lyapunov exponents per ${found.units === "si" ? "second" : "unit of time"} ${found.exponents.map(told).join(" and ")}`
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
}
