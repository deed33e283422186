/** The plane of two parameters: its source of tiles, the point under the pointer, the chosen point. */

import { strokes } from "./dom.js";
import { PARAMETERS, isFrequency, legal, ofSecondStop, patchOf, valueOf } from "./parameters.js";
import { legalRange, mapPlan, room, systemOf } from "./plans.js";
import { budgets } from "./state.js";
import { rays } from "./frame.js";
import { TileView } from "./tileview.js";
import { Viewport } from "./viewport.js";
import { quantityOf, shownAs } from "./units.js";
import { motionsText, placeText, valueText } from "./words.js";

/** Parts of the state on which the tiles depend. */
const DEPENDS = ["x", "y", ...Object.keys(PARAMETERS), "second", "starts", "impacts", "colour", "of", "machine"];

/** Gestures with less than this number of milliseconds between them are one step of undo. */
const TOGETHER = 1500;

/** Distance of the points of a tile that are computed first; those between are computed where these differ. */
const REFINE = 8;
/** Budgets up to this one are small: with them every point of a quantity is computed. */
const BRIEF = 1000;
/** Milliseconds in which a part of the points between others is computed at last. */
const PART = 3000;

/** Maximum distance, in pixels, of a click that selects a point of the paper. */
const NEAR = 9;

/** @param {import("./state.js").State} state @returns {Record<string, number | null>} the state values for a point of the plane */
export const placed = (state, x, y) => ({ ...patchOf(state.x, x), ...patchOf(state.y, y) });

/** @returns {number[]} the initial window of the plane */
export const wholeWindow = (state) => [...PARAMETERS[state.x].window, ...PARAMETERS[state.y].window];

export class Plane {
  /**
   * @param {HTMLElement} host
   * @param {import("./state.js").Store} store
   * @param {{cache: object, queue: object, failed: (error: Error) => void}} parts
   */
  constructor(host, store, parts) {
    this.store = store;
    this.view = new TileView(host, {
      ...parts,
      label: "Map of motions. Arrow keys move, plus and minus zoom, x and y zoom along one axis, Enter chooses the point at the cross.",
    });
    this.looks = new Map();
    this.points = [];
    this.view.painters.push((context, viewport, frame) => this.paintChosen(context, viewport, frame));
    this.view.addEventListener("pick", ({ detail }) => this.pick(detail));
    this.view.addEventListener("view", () => this.looked());
    this.view.addEventListener("home", () => store.set({ view: null }));
    store.on(DEPENDS, (_, changed) => this.refresh(changed));
    store.on(["view"], () => this.moved());
    store.on(["point", ...DEPENDS], () => this.view.draw());
  }

  /** @param {{name: string, inverse_beta: number, gap: number, restitution: number}[]} points of the paper */
  named(points) {
    this.points = points;
    this.view.draw();
  }

  start() {
    this.view.show(this.source(), this.store.state.view ?? wholeWindow(this.store.state));
  }

  refresh(changed) {
    const { state } = this.store;
    const axes = changed.has("x") || changed.has("y");
    const source = this.source();
    const before = this.view.source;
    const same = source.key === before.key && source.x === before.x && source.y === before.y;
    if (same && JSON.stringify(source.quantity) === JSON.stringify(before.quantity)) return;
    this.view.show(source, axes ? state.view ?? wholeWindow(state) : null);
  }

  /** Called when the view of the state differs from that on the screen: after back and forward, or a step of the tour. */
  moved() {
    const { view } = this.store.state;
    const window = view ?? wholeWindow(this.store.state);
    if (JSON.stringify(window) === JSON.stringify(this.view.viewport.window())) return;
    this.view.fit(window);
    this.view.changed();
  }

  /** @returns {import("./tileview.js").Source} */
  source() {
    const state = structuredClone(this.store.state);
    const free = { [state.x]: 0, [state.y]: 0 };
    const key = (impacts) => JSON.stringify([state.x, state.y, systemOf(state, free), state.starts, impacts, state.colour]);
    // between points that agree a quantity is not the same; with the largest budget values between are those of a smaller one
    const refine = (impacts) => (state.colour && impacts <= BRIEF ? undefined : REFINE);
    // budgets between decide few points more, and what they follow is followed again
    const [first, last] = [budgets(state.impacts)[0], state.impacts];
    const stages = [...new Set([first, last])].map((impacts) => ({ key: key(impacts), impacts, refine: refine(impacts) }));
    // at last all points that have the motions of their neighbours are computed
    const after = stages.toReversed().map((stage) => (stage.refine ? `${stage.impacts}:${stage.refine}` : stage.impacts)).join();
    stages.push({ key: `${key(state.impacts)}|every`, impacts: state.impacts, whole: true, parts: { within: PART, after } });
    return {
      key: key(state.impacts),
      stages,
      impacts: state.impacts,
      quantity: quantityOf(state),
      beyond: "no such oscillator",
      x: shownAs(state, state.x),
      y: shownAs(state, state.y),
      legal: { x: legalRange(state, state.x), y: legalRange(state, state.y) },
      plan: (overX, overY, refine) => mapPlan(state, overX, overY, refine),
      look: (id) => this.looks.get(id) ?? { name: "undecided", colour: "#e8eaee" },
      read: ({ header, fields }) => {
        for (const [code, look] of Object.entries(header.labels)) this.looks.set(Number(code), look);
        const { label, share, computed } = fields;
        return { classes: label.values, shares: share.values, per: label.per, values: fields[state.colour]?.values, own: computed?.values };
      },
    };
  }

  /** Puts the window into the address. Gestures in quick succession are undone together. */
  looked() {
    const now = performance.now();
    const follows = this.store.depth === this.lookedAt?.depth && now - this.lookedAt.time < TOGETHER;
    this.store.set({ view: this.view.viewport.window() }, follows ? "replace" : "push");
    this.lookedAt = { depth: this.store.depth, time: now };
  }

  pick(px) {
    const { state } = this.store;
    const { viewport } = this.view;
    const near = this.visiblePoints().find(({ x, y }) => {
      const [qx, qy] = viewport.toPixel(x, y);
      return Math.hypot(px[0] - qx, px[1] - qy) < NEAR;
    });
    const [x, y] = viewport.toPlane(...px);
    const values = near ? [near.x, near.y] : [Viewport.rounded(x, viewport.hx), Viewport.rounded(y, viewport.hy)];
    if (!legal(PARAMETERS[state.x], values[0]) || !legal(PARAMETERS[state.y], values[1])) return;
    this.choose(placed(state, ...values));
  }

  /** @param {Partial<import("./state.js").State>} values of the chosen point */
  choose(values) {
    const state = { ...this.store.state, ...values };
    const [lowest, highest] = room(state);
    const start = state.start && state.start[0] <= highest && state.start[0] >= lowest ? state.start : null;
    const basin = this.store.state.gap === state.gap ? state.basin : null;
    this.store.set({ ...values, point: true, panel: "point", start, basin });
  }

  /** The points of the paper that lie in the current plane, with their positions. */
  visiblePoints() {
    const { state } = this.store;
    if (!state.layers.includes("paper") || state.second) return [];
    const values = (point) => ({ ...point, beta: 1 / point.inverse_beta, damping: 0 });
    const fixed = ["inverse_beta", "gap", "restitution", "damping"].filter((name) => {
      const onAxis = [state.x, state.y];
      return !onAxis.includes(name) && !(name === "inverse_beta" && onAxis.some(isFrequency));
    });
    return this.points.map(values)
      .filter((point) => fixed.every((name) => Math.abs(point[name] - state[name]) < 1e-9))
      .filter((point) => !ofSecondStop(state.x) && !ofSecondStop(state.y) && point[state.x] !== undefined)
      .map((point) => ({ name: point.name, x: point[state.x], y: point[state.y] }));
  }

  paintChosen(context, viewport, frame) {
    const { state } = this.store;
    if (!state.point) return;
    const [px, py] = viewport.toPixel(valueOf(state, state.x), valueOf(state, state.y));
    const r = 0.5 * frame.em;
    strokes(context, [[4.5, "#ffffff"], [2, "#000000"]], () => {
      context.arc(px, py, r, 0, 2 * Math.PI);
      rays(context, [px, py], r, 1.9 * r);
    });
  }

  /**
   * The motions at a pixel, for the line below the plane.
   * @returns {{place: string, motions: string, colours: string[], pattern: string}}
   */
  tell(px) {
    const { source, viewport: v } = this.view;
    const { x, y, found } = this.view.at(...px);
    const place = `${placeText(source.x, x, v.hx)}   ${placeText(source.y, y, v.hy)}`;
    const { state } = this.store;
    const outside = !legal(PARAMETERS[state.x], x) || !legal(PARAMETERS[state.y], y);
    const value = found.length && source.quantity ? `   ${valueText(found, source.quantity)}` : "";
    const motions = found.length ? motionsText(found, source.impacts) + value : outside ? source.beyond : "not computed yet";
    const pattern = found[0]?.name === "undecided" ? "undecided" : found.length ? "" : outside ? "impossible" : "blank";
    return { place, motions, colours: found.map(({ colour }) => colour), pattern };
  }
}
