/**
 * A plane of points on a canvas: tiles where they are available, a coarse picture elsewhere, and axes.
 *
 * A `Source` defines the contents; gestures move the viewport; a painter may draw over it.
 *
 * @typedef {object} Source
 * @property {string} key identifies everything on which the points depend
 * @property {import("./asking.js").Stage[]} stages the steps in which its points are computed
 * @property {number} impacts the budget
 * @property {{name: string, description: string, unit: string, per: number, factor: number, of: string} | null} [quantity] whose values are the colours
 * @property {import("./parameters.js").Coordinate} x
 * @property {import("./parameters.js").Coordinate} y
 * @property {{x: [number, number], y: [number, number]}} legal
 * @property {(overX: string | number[], overY: string | number[], refine?: number) => object} plan
 * @property {(answer: object) => {classes: Int32Array, shares: Float64Array | null, per: number}} read
 * @property {(id: number) => {name: string, colour: string}} look
 */

import { debounced } from "./dom.js";
import { Frame } from "./frame.js";
import { gestures } from "./gestures.js";
import { Supply } from "./supply.js";
import { SIDE } from "./tiles.js";
import { Viewport } from "./viewport.js";

/** Maximum number of tiles in view; with more, a coarser level is used. */
const MOST_TILES = 200;

export class TileView extends EventTarget {
  /**
   * @param {HTMLElement} host
   * @param {{label: string}} parts the rest are those of `Supply`
   */
  constructor(host, { label, ...parts }) {
    super();
    this.host = host;
    this.supply = new Supply(this, parts);
    this.picture = document.createElement("canvas");
    this.picture.setAttribute("aria-hidden", "true");
    this.surface = document.createElement("canvas");
    this.surface.tabIndex = 0;
    this.surface.setAttribute("role", "application");
    this.surface.setAttribute("aria-label", label);
    host.append(this.picture, this.surface);
    this.viewport = new Viewport(1, 1);
    this.frame = new Frame(this);
    /** @type {Source | null} */
    this.source = null;
    this.only = null;
    this.stripes = true;
    this.boundaries = false;
    /** Values at the ends of the colours of a quantity, in its units. @type {[number, number] | null} */
    this.range = null;
    this.painters = [];
    /** @type {((px: number[], xy: number[], touch: boolean, shift: boolean) => object | null) | null} returns what to drag instead of panning, or null */
    this.grab = null;
    this.pointer = null;
    this.home = null;
    gestures(this);
    new ResizeObserver(() => this.resize()).observe(host);
    // another screen may have another pixel density
    addEventListener("resize", () => this.resize());
  }

  /** Device pixels per CSS pixel, at most two. */
  get density() {
    return Math.min(2, Math.max(1, devicePixelRatio || 1));
  }

  /** @param {Source} source @param {number[] | null} window the window to show; null for no change */
  show(source, window) {
    const moved = this.source && (this.source.x.name !== source.x.name || this.source.y.name !== source.y.name);
    this.supply.turn(source, moved);
    if (!this.source || moved) {
      const { width, height } = this.viewport;
      this.viewport = Object.assign(new Viewport(source.x.step, source.y.step), { width, height });
    }
    this.source = source;
    if (window) this.fit(window);
    this.frame.measure();
    this.changed(0);
  }

  /** Shows a window, and shows it again when the size changes, until a gesture moves the view. */
  fit(window) {
    this.home = window;
    this.unmoved = true;
    this.viewport.fit(window, this.density);
  }

  resize() {
    const { width, height } = this.host.getBoundingClientRect();
    if (!width || !height) return;
    for (const canvas of [this.picture, this.surface]) {
      canvas.width = Math.round(width * this.density);
      canvas.height = Math.round(height * this.density);
    }
    this.sized = true;
    this.size = [width, height];
    this.frame.measure();
    if (this.unmoved) this.fit(this.home);
    this.changed();
  }

  /**
   * Called when the view or its contents have changed.
   * @param {number} [delay] milliseconds until requests follow: all changes within a frame or two lead to one set of them
   */
  changed(delay = 40) {
    this.draw();
    if (!this.source || !this.sized) return;
    const at = performance.now() + delay;
    if (this.asking && this.asking.at <= at) return;
    clearTimeout(this.asking?.timer);
    const timer = setTimeout(() => {
      this.asking = null;
      this.supply.ask();
    }, delay);
    this.asking = { at, timer };
  }

  /** Called when a gesture has ended. */
  settled() {
    this.changed();
    this.dispatchEvent(new Event("view"));
  }

  /** The level of tiles for the resolution of the view. */
  level() {
    let level = this.viewport.levelOf(this.density);
    while (this.grid(level).count > MOST_TILES) level--;
    return level;
  }

  /** The ranges of tiles of a level that are in view. */
  grid(level) {
    const { viewport: v } = this;
    const wide = v.stepX * 2 ** -level * SIDE;
    const high = v.stepY * 2 ** -(level + v.shapeOf(level)) * SIDE;
    const [left, top] = v.toPlane(0, 0);
    const [right, bottom] = v.toPlane(v.width, v.height);
    const [{ x: lx, y: ly }, clip] = [this.source.legal, (value, [least, most]) => Math.min(most, Math.max(least, value))];
    // no tiles if the view contains no legal values
    const tiles = (from, to, size) => (from < to ? [Math.floor(from / size), Math.ceil(to / size)] : [0, 0]);
    const i = tiles(clip(left, lx), clip(right, lx), wide);
    const j = tiles(clip(bottom, ly), clip(top, ly), high);
    return { i, j, wide, high, count: Math.max(0, i[1] - i[0]) * Math.max(0, j[1] - j[0]) };
  }

  /** The columns and rows of the tiles of a level that are in view. */
  *places(level) {
    const { i, j } = this.grid(level);
    for (let b = j[0]; b < j[1]; b++) {
      for (let a = i[0]; a < i[1]; a++) yield [a, b];
    }
  }

  /** How a quantity is shown; null where motions have their colours, or before the first values are there. */
  get scale() {
    const { source, range } = this;
    if (!source?.quantity || !range) return null;
    return { low: range[0], high: range[1], factor: source.quantity.factor, of: source.quantity.of };
  }

  get progress() {
    return this.supply.progress;
  }

  /** Repeats refused requests. */
  retry() {
    this.supply.retry();
  }

  /** @returns {{x: number, y: number, found: {id: number, name: string, colour: string, share: number, impacts: number}[]}} */
  at(px, py) {
    const [x, y] = this.viewport.toPlane(px, py);
    const tile = this.supply.known().findLast((known) => known.contains(x, y));
    const found = tile ? tile.at(x, y).map((one) => ({ ...one, ...this.source.look(one.id) })) : [];
    return { x, y, found };
  }

  /** Says what is at the cross, when it rests. @param {(px: number[]) => {place: string, motions: string}} tell */
  spoken(tell, say) {
    this.addEventListener("crosshair", debounced(({ detail }) => {
      const { place, motions } = tell(detail);
      say(`${place}: ${motions}`);
    }, 400));
  }

  /** Schedules a drawing. */
  draw() {
    if (this.drawing) return;
    this.drawing = true;
    requestAnimationFrame(() => {
      this.drawing = false;
      if (!this.sized || !this.source) return;
      this.host.dataset.picture = this.frame.draw();
      this.dispatchEvent(new Event("drawn"));
    });
  }
}
