/**
 * A plane of points on a canvas: tiles where they are available, a coarse picture elsewhere, and axes.
 *
 * A `Source` defines the contents; gestures move the viewport; a painter may draw over it.
 *
 * @typedef {object} Source
 * @property {string} key identifies everything on which the points depend
 * @property {string[]} shallower keys of the same points with smaller budgets; correct where settled, and shown until better tiles exist
 * @property {number} impacts the budget
 * @property {import("./parameters.js").Coordinate} x
 * @property {import("./parameters.js").Coordinate} y
 * @property {{x: [number, number], y: [number, number]}} legal
 * @property {(overX: string | number[], overY: string | number[], refine?: number) => object} plan
 * @property {(answer: object) => {classes: Int32Array, shares: Float64Array | null, per: number}} read
 * @property {(id: number) => {name: string, colour: string}} look
 */

import { askCoarse, askTile } from "./asking.js";
import { Frame } from "./frame.js";
import { gestures } from "./gestures.js";
import { SIDE } from "./tiles.js";
import { Viewport } from "./viewport.js";

/** Maximum number of tiles in view; with more, a coarser level is used. */
const MOST_TILES = 200;
/** Number of coarse pictures in the cache. */
const COARSE_KEPT = 6;
/** Number of positions along each axis at which the availability of sharp tiles is checked. */
const PLACES = 8;

export class TileView extends EventTarget {
  /**
   * @param {HTMLElement} host
   * @param {{cache: import("./tiles.js").Cache, queue: import("./tiles.js").Queue, label: string,
   *   failed: (error: Error) => void, rank?: number}} parts rank: the rank of its nearest tile in the queue
   */
  constructor(host, { cache, queue, label, failed, rank = 10 }) {
    super();
    Object.assign(this, { host, cache, queue, failed, rank });
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
    this.ghost = null;
    this.coarse = [];
    this.refused = new Set();
    this.highlight = null;
    this.stripes = true;
    this.painters = [];
    /** @type {((px: number[], xy: number[], touch: boolean) => object | null) | null} returns what to drag instead of panning, or null */
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
    const moved = this.source && (this.source.x !== source.x || this.source.y !== source.y);
    if (source.key !== this.source?.key) {
      const before = this.source?.key ?? null;
      this.ghost = moved || source.shallower.includes(before) ? null : before;
      this.refused.clear();
    }
    if (!this.source || moved) {
      const { width, height } = this.viewport;
      this.viewport = Object.assign(new Viewport(source.x.step, source.y.step), { width, height });
    }
    this.source = source;
    if (window) this.fit(window);
    this.frame.measure();
    this.changed();
  }

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

  /** Called when the view or its contents have changed. */
  changed() {
    this.draw();
    if (!this.source || !this.sized || this.asking) return;
    this.asking = true;
    // all changes within a frame or two lead to one set of requests
    setTimeout(() => {
      this.asking = false;
      this.ask();
    }, 40);
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

  tileKey(level, i, j) {
    return `${this.source.key}|${this.viewport.shapeOf(level)}|${level}|${i}|${j}`;
  }

  /** Requests missing parts of the view: the coarse picture first, then tiles from the pointer or the centre outwards. */
  ask() {
    const { viewport: v } = this;
    const level = this.level();
    const { i, j, wide, high } = this.grid(level);
    const [x, y] = this.pointer ? v.toPlane(...this.pointer) : [v.cx, v.cy];
    const jobs = [];
    let known = 0;
    let all = 0;
    for (let b = j[0]; b < j[1]; b++) {
      for (let a = i[0]; a < i[1]; a++) {
        const key = this.tileKey(level, a, b);
        all++;
        if (this.cache.get(key) || this.refused.has(key)) known++;
        else {
          const rank = Math.hypot(((a + 0.5) * wide - x) / wide, ((b + 0.5) * high - y) / high);
          jobs.push({ key, rank: this.rank + rank, run: (signal) => this.take(askTile(this, key, level, [a, b], signal), signal) });
        }
      }
    }
    this.progress = [known, all];
    const coarse = jobs.length > 0.4 * all ? this.coarseJob() : null;
    this.queue.want(this, coarse ? [coarse] : jobs);
    this.dispatchEvent(new Event("tiles"));
  }

  /** The request for the coarse picture, which precedes all tiles; null if it or something finer is available. */
  coarseJob() {
    const key = `${this.source.key}|coarse|${this.viewport.window().join()}`;
    if (this.refused.has(key) || this.coarse.some((tile) => tile.key === key) || this.seen()) return null;
    return { key, rank: 0, run: (signal) => this.take(askCoarse(this, key, signal), signal) };
  }

  /** The keys of the tiles of a level that are in view. */
  *keys(level) {
    const { i, j } = this.grid(level);
    for (let b = j[0]; b < j[1]; b++) {
      for (let a = i[0]; a < i[1]; a++) yield this.tileKey(level, a, b);
    }
  }

  /** Whether tiles of a level fill the view. */
  covered(level) {
    for (const key of this.keys(level)) if (!this.cache.has(key)) return false;
    return true;
  }

  /** Whether tiles of at least half the resolution cover the view, checked at a few positions. */
  seen() {
    const { viewport: v, source: { legal } } = this;
    const fine = (tile) => tile.hx * this.density < 2.1 * v.hx && tile.hy * this.density < 2.1 * v.hy;
    const tiles = this.known().filter(fine);
    const inside = (value, [least, most]) => value > least && value < most;
    const centres = Array.from({ length: PLACES }, (_, k) => (k + 0.5) / PLACES);
    return centres.every((across) => centres.every((up) => {
      const [x, y] = v.toPlane(across * v.width, up * v.height);
      return !inside(x, legal.x) || !inside(y, legal.y) || tiles.some((tile) => tile.contains(x, y));
    }));
  }

  /** Stores the answer to a request, or records that it was refused. */
  async take(asked, signal) {
    const { key, source } = asked;
    try {
      const tile = await asked.tile;
      if (tile.level === -Infinity) {
        this.coarse.push(tile);
        while (this.coarse.length > COARSE_KEPT) this.coarse.shift();
      } else this.cache.set(key, tile);
    } catch (error) {
      if (signal.aborted) return;
      this.refused.add(key);
      this.failed(error);
    }
    if (this.source?.key === source.key) this.arrived();
    // request tiles now that the coarse picture is available or was refused
    if (key.includes("|coarse|")) this.changed();
  }

  arrived() {
    this.draw();
    const level = this.level();
    const known = [...this.keys(level)].filter((key) => this.cache.has(key)).length;
    this.progress = [known, this.progress?.[1] ?? known];
    this.dispatchEvent(new Event("tiles"));
  }

  /** Repeats refused requests. */
  retry() {
    this.refused.clear();
    this.changed();
  }

  /** @returns {Tile[]} all available tiles of the contents, in drawing order: the most suitable come last */
  known() {
    return this.knownOf(...this.source.shallower, this.source.key);
  }

  /** @param {...string} sources keys, the best last @returns {Tile[]} coarse pictures first, then tiles */
  knownOf(...sources) {
    const level = this.level();
    const shape = this.viewport.shapeOf(level);
    // by resolution in both axes together: exact matches are best, then the finest of coarser tiles, the coarsest of finer ones
    const [fine, wanted] = [(tile) => tile.level + tile.shape / 2, level + shape / 2];
    const order = (tile) => {
      if (tile.level === level && tile.shape === shape) return Infinity;
      return fine(tile) <= wanted ? fine(tile) : 2000 - fine(tile);
    };
    const ordered = (source) => this.cache.of(source).filter((tile) => tile.classes).sort((a, b) => order(a) - order(b));
    return [
      ...sources.flatMap((source) => this.coarse.filter((tile) => tile.source === source && tile.classes)),
      ...sources.flatMap(ordered),
    ];
  }

  /** @returns {{x: number, y: number, found: {id: number, name: string, colour: string, share: number, impacts: number}[]}} */
  at(px, py) {
    const [x, y] = this.viewport.toPlane(px, py);
    const tile = this.known().findLast((known) => known.contains(x, y));
    const found = tile ? tile.at(x, y).map((one) => ({ ...one, ...this.source.look(one.id) })) : [];
    return { x, y, found };
  }

  /** Schedules a drawing. */
  draw() {
    if (this.drawing) return;
    this.drawing = true;
    requestAnimationFrame(() => {
      this.drawing = false;
      if (this.sized && this.source) this.frame.draw();
    });
  }
}
