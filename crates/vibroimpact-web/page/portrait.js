/** The phase portrait: velocity over position, with the stops, and the jumps at impacts. */

import { choice, drawn, element } from "./dom.js";
import { Latest } from "./latest.js";
import { panel } from "./panel.js";
import { Plot } from "./plot.js";
import { PARTS, range, trackOf } from "./track.js";

/** Maximum number of impacts with a dashed jump each. */
const MARKED = 120;

export class Portrait {
  /** @param {string} [label] */
  constructor(label = "Phase portrait: velocity over position") {
    this.plot = new Plot({ label, x: { symbol: "ξ", unit: "" }, y: { symbol: "velocity ξ′", unit: "" }, zooms: "xy", height: 0.78 });
    this.track = null;
    this.plot.painters.push(() => this.paint());
  }

  /** @param {import("./track.js").Track} shown */
  show(shown) {
    this.track = shown;
    const si = shown.units === "si";
    this.plot.x.unit = si ? "mm" : "";
    this.plot.x.factor = si ? 1000 : 1;
    this.plot.y.unit = si ? "m/s" : "";
    const [left, right] = shown.extent();
    const [low, high] = range(shown.velocity);
    const air = (a, b) => (b > a ? 0.06 * (b - a) : 0.5);
    const [dx, dy] = [air(left, right), air(low, high)];
    this.plot.show([left - dx, right + dx, low - dy, high + dy]);
  }

  paint() {
    const { plot, track: shown } = this;
    if (!shown) return;
    const { time, position, velocity } = shown;
    const jumps = (k) => time[k] === time[k - 1] && velocity[k] !== velocity[k - 1];
    const walls = shown.stops.map((at, k) => plot.wall(at, k === 0 ? 1 : -1, "x"));
    const few = shown.impacts.length <= MARKED;
    plot.curves.append(...walls.filter(Boolean),
      drawn("path", { class: few ? "motion" : "motion thin", d: plot.path(position, velocity, [0, time.length], jumps) }));
    if (!few) return;
    const marked = new Set();
    for (let k = 1; k < time.length; k++) {
      if (!jumps(k)) continue;
      const [x, from, to] = [plot.toX(position[k]), plot.toY(velocity[k - 1]), plot.toY(velocity[k])];
      // the same jump in the next period would fill the gaps of the dashes
      const place = [x, from, to].map(Math.round).join();
      if (marked.has(place)) continue;
      marked.add(place);
      plot.curves.append(drawn("path", { class: "jump", d: `M${x} ${from}V${to}` }),
        drawn("circle", { class: "impact", r: 0.2 * plot.em, cx: x, cy: from }),
        drawn("circle", { class: "impact after", r: 0.2 * plot.em, cx: x, cy: to }));
    }
  }
}

export class PortraitPanel {
  /**
   * @param {import("./state.js").Store} store
   * @param {(error: Error) => void} failed
   * @param {() => void} exported
   */
  constructor(store, failed, exported) {
    this.portrait = new Portrait();
    this.from = choice({ id: "portrait", onchange: (event) => store.set({ portrait: event.target.value }) }, PARTS.toReversed());
    this.dot = drawn("circle", { class: "cursor-dot" });
    this.note = element("p", { class: "note", text: "Dashed: the jump of the velocity at an impact." });
    const zoom = (factor) => this.portrait.track && this.portrait.plot.zoom(factor);
    this.box = panel("portrait", "Phase portrait", { exported, zoom },
      element("div", { class: "controls span" },
        element("label", {}, element("span", { class: "visually-hidden", text: "Part of the motion in the portrait" }), this.from)),
      this.portrait.plot.host, this.note);
    this.asked = new Latest((question, signal) => this.fetch(question, signal), failed);
  }

  /** @param {import("./state.js").State} state */
  show(state) {
    this.from.value = state.portrait;
    this.asked.ask(structuredClone(state));
  }

  async fetch(state, signal) {
    this.portrait.show(await trackOf(state, state.portrait, signal));
  }

  stop() {
    this.asked.stop();
  }

  /** Shows where the animation is, if it shows the same motion. */
  move(shown, time) {
    const { plot, track: own } = this.portrait;
    if (own !== shown || !plot.size) {
      this.dot.remove();
      return;
    }
    const { x, v } = shown.at(time);
    this.dot.setAttribute("cx", plot.toX(x));
    this.dot.setAttribute("cy", plot.toY(v));
    this.dot.setAttribute("r", String(0.36 * plot.em));
    if (!this.dot.parentNode) plot.over.append(this.dot);
  }
}
