/** The layers over the plane: boundaries of regions, the amplitude of the motion without impacts, points of the paper. */

import { layer } from "./api.js";
import { byId, debounced, element, strokes } from "./dom.js";
import { Latest } from "./latest.js";
import { PARAMETERS } from "./parameters.js";
import { mapPlan, over, systemOf, within } from "./plans.js";

const NAMES = {
  regions: "regions of stability",
  amplitude: "free amplitude |f|",
  paper: "points of the 1971 paper",
  stripes: "stripes for coexistence",
  boundaries: "lines between motions",
};

/** A layer is requested again if the view is smaller than its window by this factor. */
const SHARPER = 3;
/** A layer is computed for a window that extends beyond the view by this fraction on each side. */
const MARGIN = 0.25;

export class Layers {
  /**
   * @param {import("./plane.js").Plane} plane
   * @param {import("./state.js").Store} store
   * @param {(error: Error) => void} failed
   */
  constructor(plane, store, failed) {
    Object.assign(this, { plane, store, known: {} });
    const work = (kind) => (window, signal) => this.fetch(kind, window, signal);
    this.asked = Object.fromEntries(["regions", "amplitude"].map((kind) => [kind, new Latest(work(kind), failed)]));
    this.boxes = Object.fromEntries(Object.keys(NAMES).map((name) => [name, this.box(name)]));
    plane.view.painters.unshift((context, viewport, frame) => this.paint(context, viewport, frame));
    this.settle = debounced(() => this.refresh(), 500);
    plane.view.addEventListener("view", this.settle);
    store.on(["x", "y", ...Object.keys(PARAMETERS), "second", "view"], this.settle, () => this.wait());
    store.on(["layers", "x", "y", "colour"], () => this.refresh());
    this.refresh();
  }

  box(name) {
    const input = element("input", { type: "checkbox", onchange: (event) => this.toggle(name, event.target.checked) });
    const progress = element("span", { class: "soft" });
    byId("layers").append(element("label", { class: "check" }, input, element("span", { text: NAMES[name] }), progress));
    return { input, progress };
  }

  toggle(name, on) {
    const others = this.store.state.layers.filter((other) => other !== name);
    this.store.set({ layers: on ? [...others, name] : others });
  }

  /** The reason why a layer cannot be shown; empty if it can. */
  hindered(name) {
    const { x, y, colour } = this.store.state;
    if (colour && (name === "stripes" || name === "boundaries")) return "shows motions, not quantities";
    if (name === "amplitude" && x !== "gap" && y !== "gap") return "needs the gap on an axis";
    return "";
  }

  refresh() {
    const { state } = this.store;
    this.plane.view.stripes = state.layers.includes("stripes") && !state.colour;
    this.plane.view.boundaries = state.layers.includes("boundaries") && !state.colour;
    for (const [name, { input, progress }] of Object.entries(this.boxes)) {
      const why = this.hindered(name);
      input.checked = state.layers.includes(name);
      input.disabled = why !== "";
      if (why || !input.checked) progress.textContent = why;
    }
    for (const kind of Object.keys(this.asked)) {
      if (!state.layers.includes(kind) || this.hindered(kind)) this.asked[kind].stop();
      else if (!this.fits(kind)) this.asked[kind].ask(this.wanted(), true);
    }
    this.plane.view.draw();
  }

  /** While a slider of the map moves, only the map is computed. */
  wait() {
    for (const asked of Object.values(this.asked)) asked.stop();
  }

  systemKey() {
    const { state } = this.store;
    return JSON.stringify([state.x, state.y, systemOf(state, { [state.x]: 0, [state.y]: 0 })]);
  }

  /** The window of the view with a margin, restricted to legal values. */
  wanted() {
    const [left, right, bottom, top] = this.plane.view.viewport.window();
    const { legal, x, y } = this.plane.view.source;
    const part = (range, coordinate, low, high) => {
      const air = MARGIN * (high - low);
      return within(range, coordinate, low - air, high + air);
    };
    return [...part(legal.x, x, left, right), ...part(legal.y, y, bottom, top)];
  }

  fits(kind) {
    const known = this.known[kind];
    if (known?.system !== this.systemKey()) return false;
    const [left, right, bottom, top] = this.plane.view.viewport.window();
    const [l, r, b, t] = known.window;
    const [wl, wr, wb, wt] = this.wanted();
    const holds = Math.max(left, wl) >= l && Math.min(right, wr) <= r && Math.max(bottom, wb) >= b && Math.min(top, wt) <= t;
    return holds && right - left > (r - l) / SHARPER / (1 + 2 * MARGIN);
  }

  async fetch(kind, window, signal) {
    const { state } = this.store;
    const system = this.systemKey();
    const plan = mapPlan({ ...state, starts: 1 }, over(window[0], window[1], 64), over(window[2], window[3], 64));
    const { progress } = this.boxes[kind];
    progress.textContent = "computing";
    try {
      const found = await layer(kind, plan, signal, (part) => {
        progress.textContent = `${Math.round(100 * part)} %`;
      });
      this.known[kind] = { system, window, ...found };
    } finally {
      progress.textContent = "";
    }
    this.plane.view.draw();
  }

  paint(context, viewport, frame) {
    const { layers } = this.store.state;
    const shown = (kind) => layers.includes(kind) && this.known[kind]?.system === this.systemKey() && this.known[kind];
    for (const region of (shown("regions") || { regions: [] }).regions) {
      for (const ring of region.rings) this.path(context, viewport, ring, [[2.6, "#ffffff"], [1.1, "#000000"]], []);
    }
    for (const curve of (shown("amplitude") || { curves: [] }).curves) {
      this.path(context, viewport, curve, [[3.4, "#ffffff"], [1.8, "#8c1d18"]], [7, 4]);
    }
    this.points(context, viewport, frame);
  }

  path(context, viewport, points, looks, dash) {
    context.lineJoin = "round";
    strokes(context, looks, (width) => {
      context.setLineDash(width > 2 ? [] : dash);
      for (const [x, y] of points) context.lineTo(...viewport.toPixel(x, y));
    });
    context.setLineDash([]);
  }

  points(context, viewport, frame) {
    context.font = `600 ${frame.em}px "STIX Two Text", Cambria, Georgia, serif`;
    context.textAlign = "left";
    context.textBaseline = "alphabetic";
    context.lineJoin = "round";
    for (const { name, x, y } of this.plane.visiblePoints()) {
      const [px, py] = viewport.toPixel(x, y);
      const r = 0.24 * frame.em;
      context.beginPath();
      context.arc(px, py, r, 0, 2 * Math.PI);
      context.fillStyle = "#000000";
      context.strokeStyle = "#ffffff";
      context.lineWidth = 1.5;
      context.fill();
      context.stroke();
      context.lineWidth = 3;
      context.strokeText(name, px + 2 * r, py - 1.4 * r);
      context.fillText(name, px + 2 * r, py - 1.4 * r);
    }
  }
}
