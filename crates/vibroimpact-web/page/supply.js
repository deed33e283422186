/**
 * The tiles of a view: which are there, which are asked for and in which order, and which are drawn.
 *
 * Every place is computed with one budget after the other; its tile with the largest budget is kept.
 */

import { COARSE_TIME, FEW, STILL_TIMES, askCoarse, tileAsked } from "./asking.js";

/** Number of coarse pictures in the cache. */
const COARSE_KEPT = 6;
/** Number of earlier pictures that are shown until those of the current source are there. */
const EARLIER = 3;
/** Difference of rank between one budget and the next: no tile is computed again before all others are there. */
export const NEXT_STAGE = 1000;
/** Milliseconds without a change after which tiles are asked for; while a slider moves only coarse pictures are. */
const CALM = 150;
/** Number of positions along each axis at which the availability of sharp tiles is checked. */
const PLACES = 8;

export class Supply {
  /**
   * @param {import("./tileview.js").TileView} view
   * @param {{cache: import("./cache.js").Cache, queue: import("./queue.js").Queue, failed: (error: Error) => void, rank?: number}} parts
   *   rank: the rank of its nearest tile in the queue
   */
  constructor(view, { cache, queue, failed, rank = 10 }) {
    Object.assign(this, { view, cache, queue, failed, rank });
    /** Sources whose pictures are shown below that of the current one, the newest last. */
    this.earlier = [];
    this.coarse = [];
    this.refused = new Set();
    /** Whether only the smallest budget is computed. */
    this.held = false;
    /** Whether nothing is computed, until a source is shown. */
    this.stopped = false;
    /**
     * Numbers of tiles in view: all, those that are there, those of which no point needs a larger budget, those in which
     * every point is computed; and the budget that is computed. Null before the first request.
     */
    this.progress = null;
    /** Time of the last change of the source. */
    this.turned = -Infinity;
  }

  /** Stops everything until a source is shown. */
  stop() {
    this.stopped = true;
    this.queue.want(this.view, []);
  }

  /** Called when the view changes to a source. @param {boolean} moved whether it has other axes */
  turn(source, moved) {
    this.stopped = false;
    const before = this.view.source;
    if (source.key === before?.key) return;
    this.turned = before ? performance.now() : -Infinity;
    if (moved) this.earlier = [];
    else if (before && !source.stages.some(({ key }) => key === before.key)) this.under(before);
    this.refused.clear();
  }

  /** The pictures of a source, if there are any, are shown until those of the current one are there. */
  under(source) {
    if (!this.known(source).length) return;
    this.earlier = [...this.earlier.filter(({ key }) => key !== source.key), source].slice(-EARLIER);
  }

  /** @returns {import("./asking.js").Stage[]} the steps in which points are computed, one after the other */
  stages({ stages } = this.view.source) {
    return stages;
  }

  tileKey(stage, level, i, j) {
    return `${stage.key}|${this.view.viewport.shapeOf(level)}|${level}|${i}|${j}`;
  }

  /** The tile of a place with the largest budget that is there, and the number of its stage; -1 if there is none. */
  best(level, i, j) {
    const stages = this.stages();
    for (let k = stages.length - 1; k >= 0; k--) {
      const tile = this.cache.get(this.tileKey(stages[k], level, i, j));
      if (tile) return { tile, stage: k };
    }
    return { tile: null, stage: -1 };
  }

  /** Requests missing parts of the view: the coarse picture first, then tiles from the pointer or the centre outwards, with one budget after the other. */
  ask() {
    if (this.stopped) return;
    const level = this.view.level();
    const jobs = [];
    const progress = { all: 0, seen: 0, full: 0, done: 0, impacts: 0 };
    for (const [a, b] of this.view.places(level)) {
      const { tile, stage, next } = this.nextOf(level, a, b);
      progress.all++;
      if (stage >= 0 || !next) progress.seen++;
      if (!next || (tile && next.whole)) progress.full++;
      if (!next) progress.done++;
      else if (stage < 0 || !this.held) jobs.push(this.tileJob(next, stage + 1, level, [a, b], tile));
    }
    this.progress = progress;
    const missing = progress.all - progress.seen;
    const left = this.turned + CALM - performance.now();
    const coarse = missing > 0.4 * progress.all ? this.coarseJob(left <= 0) : null;
    const first = jobs.reduce((best, job) => (job.rank < best.rank ? job : best), { rank: Infinity });
    progress.impacts = first.stage?.impacts ?? 0;
    if (left > 0) setTimeout(() => this.view.changed(), left);
    this.queue.want(this.view, coarse ? [coarse] : left > 0 ? [] : jobs);
    this.view.dispatchEvent(new Event("tiles"));
  }

  /** The best tile of a place, and the stage that should follow; none if the tile is final. */
  nextOf(level, a, b) {
    const { tile, stage } = this.best(level, a, b);
    const stages = this.stages();
    const following = stages.slice(stage + 1);
    // where all motions are decided, a larger budget changes nothing, but points may be left that were not computed
    const more = tile?.decided ? undefined : following.find(({ impacts }) => !tile || impacts > tile.impacts);
    const every = tile?.filled ? stages.slice(stage).find(({ impacts, whole }) => whole && impacts >= tile.impacts) : undefined;
    const next = more ?? every;
    return { tile, stage: next ? stages.indexOf(next) - 1 : stage, next: next && !this.refused.has(this.tileKey(next, level, a, b)) ? next : null };
  }

  tileJob(stage, number, level, [a, b], before) {
    const { viewport: v } = this.view;
    const { wide, high } = this.view.grid(level);
    const [x, y] = this.view.pointer ? v.toPlane(...this.view.pointer) : [v.cx, v.cy];
    const key = this.tileKey(stage, level, a, b);
    const far = Math.hypot(((a + 0.5) * wide - x) / wide, ((b + 0.5) * high - y) / high);
    const asked = tileAsked(this.view, key, stage, level, [a, b]);
    const run = (signal) => this.take(asked(signal), signal, before?.key);
    return { key, stage, rank: this.rank + NEXT_STAGE * number + far, run };
  }

  /**
   * The request for the coarse picture, which precedes all tiles; null if it or something finer is available. Only one is
   * under way.
   * @param {boolean} still whether nothing moves; the picture is finer then
   */
  coarseJob(still) {
    const [stage] = this.stages();
    if (this.seen()) return null;
    const keyOf = (time) => `${stage.key}|coarse|${time}|${this.view.viewport.window().join()}`;
    // the next one is asked for if the one before it has few points
    const known = (time) => this.coarse.find((tile) => tile.key === keyOf(time));
    const time = (still ? STILL_TIMES : [COARSE_TIME]).find((one, k, all) => !known(one) && all.slice(0, k).every((shorter) => known(shorter).columns * known(shorter).rows < FEW));
    const key = keyOf(time);
    if (!time || this.refused.has(key)) return null;
    // one for a moving slider is finished, one that takes longer gives way to it
    const quick = time === COARSE_TIME;
    if (this.sketching && (still || this.sketching.quick)) return { key: this.sketching.key, rank: 0, kept: true, run: async () => {} };
    const run = async (signal) => {
      const own = { key, quick };
      this.sketching = own;
      await this.take(askCoarse(this.view, key, stage, time, signal), signal);
      if (this.sketching === own) this.sketching = null;
      // the next one, if a slider has moved on
      this.view.changed(0);
    };
    return { key, rank: 0, kept: quick, run };
  }

  /** Whether tiles of a level fill the view. */
  covered(level) {
    for (const [a, b] of this.view.places(level)) if (!this.best(level, a, b).tile) return false;
    return true;
  }

  /** Whether tiles of at least half the resolution cover the view. */
  seen() {
    const { viewport: v } = this.view;
    const fine = (tile) => tile.hx * this.view.density < 2.1 * v.hx && tile.hy * this.view.density < 2.1 * v.hy;
    return this.cover(this.known().filter(fine));
  }

  /** Whether a part of the view shows no picture at all. */
  blank() {
    return !this.cover([...this.known(), ...this.earlier.flatMap((source) => this.known(source))]);
  }

  /** Whether tiles cover the legal part of the view, checked at a few positions. */
  cover(tiles) {
    const { viewport: v, source: { legal } } = this.view;
    const inside = (value, [least, most]) => value > least && value < most;
    const centres = Array.from({ length: PLACES }, (_, k) => (k + 0.5) / PLACES);
    return centres.every((across) => centres.every((up) => {
      const [x, y] = v.toPlane(across * v.width, up * v.height);
      return !inside(x, legal.x) || !inside(y, legal.y) || tiles.some((tile) => tile.contains(x, y));
    }));
  }

  /** Stores the answer to a request, instead of the tile before it, or records that it was refused. */
  async take({ key, stage, tile: asked }, signal, before) {
    const current = () => this.stages().some((of) => of.key === stage.key);
    const { source } = this.view;
    try {
      const tile = await asked;
      if (tile.level === -Infinity) {
        this.coarse.push(tile);
        while (this.coarse.length > COARSE_KEPT) this.coarse.shift();
        if (current()) this.earlier = [];
        // a slider has moved on meanwhile: this picture is newer than the one that is shown
        else if (this.view.source.x.name === source.x.name && this.view.source.y.name === source.y.name) this.under(source);
      } else {
        const older = before && this.cache.get(before);
        if (older) tile.adopt(older);
        this.cache.set(key, tile);
        // a tile of which a part was computed has the same key as before
        if (before && before !== key) this.cache.delete(before);
      }
    } catch (error) {
      if (signal.aborted) return;
      this.refused.add(key);
      if (current()) this.earlier = [];
      this.failed(error);
    }
    this.view.changed();
  }

  /** Repeats refused requests. */
  retry() {
    this.refused.clear();
    this.view.changed();
  }

  /** @returns {Tile[]} all available tiles of a source, in drawing order: the most suitable come last */
  known(source = this.view.source) {
    const { coarse, inexact, exact } = this.sorted(source);
    return [...coarse, ...inexact, ...exact];
  }

  /** The tiles of a source: coarse pictures, tiles of other levels, and those of the level of the view; the best of each last. */
  sorted(source) {
    const level = this.view.level();
    const shape = this.view.viewport.shapeOf(level);
    // by resolution in both axes together: the finest of coarser tiles is best, then the coarsest of finer ones
    const [fine, wanted] = [(tile) => tile.level + tile.shape / 2, level + shape / 2];
    const order = (tile) => (fine(tile) <= wanted ? fine(tile) : 2000 - fine(tile));
    const keys = this.stages(source).map(({ key }) => key);
    const ofStage = (of) => keys.flatMap((key) => of.filter((tile) => tile.source === key && tile.classes));
    const tiles = ofStage([...this.cache.all()].sort((a, b) => order(a) - order(b)));
    const isExact = (tile) => tile.level === level && tile.shape === shape;
    return { coarse: ofStage(this.coarse), inexact: tiles.filter((tile) => !isExact(tile)), exact: tiles.filter(isExact) };
  }

  /**
   * What is drawn, from the bottom: tiles, and whether their undecided points are transparent. After a zoom, points that
   * were decided with a larger budget are seen through the new tiles until these are as good.
   * @returns {[import("./tiles.js").Tile, boolean][]}
   */
  drawn() {
    const solid = (tile) => [tile, false];
    const below = this.earlier.flatMap((source) => this.known(source)).map(solid);
    const { coarse, inexact, exact } = this.sorted(this.view.source);
    const [first] = this.stages();
    const better = inexact.filter((tile) => tile.source !== first.key);
    const open = better.length ? exact.filter((tile) => tile.source === first.key && !tile.decided) : [];
    const rest = open.length ? exact.filter((tile) => !open.includes(tile)) : [];
    return [
      ...below, ...[...coarse, ...inexact, ...exact].map(solid),
      ...(open.length ? better.map(solid) : []), ...open.map((tile) => [tile, true]), ...rest.map(solid),
    ];
  }
}
