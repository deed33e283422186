/** The basin of the chosen point: the motion to which each start leads. The chosen start can be dragged. */

import { CYCLES, Cycles } from "./cycles.js";
import { strokes } from "./dom.js";
import { START } from "./parameters.js";
import { basinPlan, room, startOf, systemOf } from "./plans.js";
import { budgets } from "./state.js";
import { TileView } from "./tileview.js";
import { Viewport } from "./viewport.js";
import { quantityOf, shownAs } from "./units.js";
import { legendText, placeText, valueText } from "./words.js";

/**
 * Step of the points of the first picture, and of those that are computed first with the largest budget, which take seconds
 * where the motion is chaotic. Basins have thin arms, so with budgets up to `BRIEF` every point is computed, and at last with every budget.
 */
const STEP = 2;
const BRIEF = 1000;

/** @param {import("./state.js").State} state @returns {number[]} the initial window of the basin */
export function basinWindow(state) {
  const [lowest, highest] = room(state);
  if (Number.isFinite(lowest) && lowest < highest) {
    const air = 0.05 * (highest - lowest);
    return [lowest - air, highest + air, ...START.v.window];
  }
  return [Math.min(START.x.window[0], highest - 8), highest + 0.4, ...START.v.window];
}

export class Basin {
  /**
   * @param {HTMLElement} host
   * @param {import("./state.js").Store} store
   * @param {{cache: object, queue: object, failed: (error: Error) => void}} parts
   * @param {{dragged: (start: number[]) => void, dropped: (start: number[]) => void}} heard
   */
  constructor(host, store, parts, heard) {
    Object.assign(this, { store, heard, labels: new Map(), cycles: new Map(), dot: null });
    this.view = new TileView(host, {
      ...parts, rank: 5,
      label: "Starts: initial position and velocity. Arrow keys move, plus and minus zoom, x and y zoom along one axis, Enter puts the start at the cross.",
    });
    this.view.painters.push((context, viewport, frame) => this.paint(context, viewport, frame));
    this.view.grab = (px, xy, touch) => this.hold(px, touch);
    this.view.hand = (px) => this.near(px, 12);
    this.view.addEventListener("pick", ({ detail }) => this.put(detail));
    this.view.addEventListener("view", () => store.set({ basin: this.view.viewport.window() }, "replace"));
    this.view.addEventListener("home", () => store.set({ basin: null }));
  }

  /** Shows the basin of the chosen point; nothing if no point is chosen. */
  refresh() {
    const { state } = this.store;
    const source = this.source();
    this.dot = null;
    const window = state.basin ?? basinWindow(state);
    const elsewhere = JSON.stringify(window) !== JSON.stringify(this.view.viewport.window());
    this.view.show(source, elsewhere || !this.view.home ? window : null);
  }

  /** @returns {import("./tileview.js").Source} */
  source() {
    const state = structuredClone(this.store.state);
    const of = JSON.stringify([systemOf(state), startOf(state).phase]);
    const key = (impacts, step = 1) => `basin|${of}|${impacts}|${step}|${state.colour}`;
    const [first] = budgets(state.impacts);
    if (!this.cycles.has(of)) this.cycles.set(of, new Cycles());
    const cycles = this.cycles.get(of);
    return {
      key: key(state.impacts),
      stages: [
        { key: key(first, STEP), impacts: first, refine: STEP },
        ...budgets(state.impacts).map((impacts) => (impacts <= BRIEF ? { key: key(impacts), impacts, whole: true } : { key: key(impacts), impacts, refine: STEP })),
        { key: `${key(state.impacts)}|every`, impacts: state.impacts, whole: true },
      ],
      impacts: state.impacts,
      quantity: quantityOf(state),
      x: shownAs(state, "x"),
      y: shownAs(state, "v"),
      legal: { x: room(state), y: [-Infinity, Infinity] },
      plan: (overX, overY, step) => basinPlan(state, overX, overY, step),
      look: (id) => (id >= CYCLES ? cycles.look(id) : this.labels.get(id)) ?? { name: "undecided", colour: "#ffffff" },
      read: ({ header, fields }) => {
        for (const [code, look] of Object.entries(header.labels)) this.labels.set(Number(code), look);
        const numbers = header.cycles.map((cycle) => cycles.number(cycle));
        const classes = fields.label.values.map((label, at) => {
          const cycle = fields.cycle.values[at];
          return cycle >= 0 ? numbers[cycle] : label;
        });
        return { classes, shares: null, per: 1, values: fields[state.colour]?.values, own: fields.computed?.values };
      },
    };
  }

  get place() {
    const { x, v } = startOf(this.store.state);
    return this.dot ?? [x, v];
  }

  near(px, reach) {
    const [x, y] = this.view.viewport.toPixel(...this.place);
    return Math.hypot(px[0] - x, px[1] - y) < reach;
  }

  hold(px, touch) {
    if (!this.near(px, touch ? 26 : 12)) return null;
    return {
      move: (at) => {
        this.dot = this.legal(at);
        this.view.draw();
        this.heard.dragged(this.dot);
      },
      up: () => {
        if (this.dot) this.heard.dropped(this.dot);
        this.dot = null;
      },
      cancel: () => {
        this.dot = null;
        this.view.draw();
      },
    };
  }

  put(px) {
    this.heard.dropped(this.legal(px));
  }

  /** The start at a pixel, restricted to positions within the stops. */
  legal(px) {
    const { viewport: v } = this.view;
    const [x, y] = v.toPlane(...px);
    const [lowest, highest] = room(this.store.state);
    return [Math.min(highest, Math.max(lowest, Viewport.rounded(x, v.hx))), Viewport.rounded(y, v.hy)];
  }

  paint(context, viewport, frame) {
    for (const at of room(this.store.state).filter(Number.isFinite)) {
      const [px] = viewport.toPixel(at, 0);
      strokes(context, [[2, frame.colours.ink]], () => {
        context.moveTo(px, 0);
        context.lineTo(px, viewport.height);
      });
    }
    const [px, py] = viewport.toPixel(...this.place);
    for (const [r, colour] of [[0.62, "#000000"], [0.5, "#ffffff"], [0.34, "#b5221b"]]) {
      context.fillStyle = colour;
      context.beginPath();
      context.arc(px, py, r * frame.em, 0, 2 * Math.PI);
      context.fill();
    }
  }

  tell(px) {
    const { viewport: v } = this.view;
    const { x, y, found } = this.view.at(...px);
    const [lowest, highest] = room(this.store.state);
    const { quantity } = this.view.source;
    const value = found.length && quantity ? `   ${valueText(found, quantity)}` : "";
    const motion = found.length ? legendText(found[0].name, found[0].impacts) + value
      : x > highest || x < lowest ? "beyond the stop" : "not computed yet";
    const { x: across, y: up } = this.view.source;
    return { place: `${placeText(across, x, v.hx)}   ${placeText(up, y, v.hy)}`, motions: motion, colour: found[0]?.colour ?? null };
  }
}
