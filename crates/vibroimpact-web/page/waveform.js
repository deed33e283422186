/** The waveform: position over time, with stops and impacts. */

import { drawn } from "./dom.js";
import { Plot } from "./plot.js";

/** Maximum number of impacts with a mark each. */
const MARKED = 1500;

/** The graph of a track over time, with stops and impacts. */
export class Waveform {
  /** @param {{column?: number, height?: number, label?: string}} shape */
  constructor({ column = 0, height = 0.6, label = "Waveform: position over time" } = {}) {
    this.plot = new Plot({ label, x: { symbol: "time τ", unit: "" }, y: { symbol: "ξ", unit: "" }, zooms: "x", column, height });
    this.track = null;
    this.plot.painters.push(() => this.paint());
  }

  /** @param {import("./track.js").Track} shown @param {boolean} keep whether to keep a zoom */
  show(shown, keep = false) {
    this.track = shown;
    const si = shown.units === "si";
    this.plot.x.unit = si ? "s" : "";
    this.plot.y.unit = si ? "mm" : "";
    this.plot.y.factor = si ? 1000 : 1;
    this.plot.x.symbol = si ? "time t" : "time τ";
    const [low, high] = shown.extent();
    const air = high > low ? 0.08 * (high - low) : 0.5;
    const home = [0, shown.duration || 1, low - air, high + air];
    const { window, zoomed, home: before } = this.plot;
    this.plot.show(home);
    if (keep && zoomed && before[1] === home[1]) {
      this.plot.window = [window[0], window[1], home[2], home[3]];
      this.plot.draw();
    }
  }

  paint() {
    const { plot, track: shown } = this;
    if (!shown) return;
    const [from, until] = [plot.window[0], plot.window[1]];
    const first = shown.index(from);
    const last = Math.min(shown.time.length, shown.index(until) + 2);
    const walls = shown.stops.map((at, k) => plot.wall(at, k === 0 ? 1 : -1, "y"));
    const line = drawn("path", { class: "motion", d: plot.path(shown.time, shown.position, [first, last]) });
    plot.curves.append(...walls.filter(Boolean), line);
    const hits = shown.impacts.filter(({ time }) => time >= from && time <= until);
    if (hits.length > MARKED) return;
    // neighbouring marks do not merge
    const size = Math.min(0.27 * plot.em, Math.max(0.1 * plot.em, (0.3 * plot.wide) / (hits.length || 1)));
    plot.curves.append(...hits.map(({ time, stop }) => drawn("circle", {
      class: "impact", r: size, cx: plot.toX(time), cy: plot.toY(stop === "lower" ? shown.stops[1] : shown.stops[0]),
    })));
  }
}
