/** Tiles of a plane, the cache of tiles, and the queue of requests. */

/** Points of a tile along each axis. */
export const SIDE = 128;

/** Period of the stripes of coexisting motions, in pixels. */
export const STRIPE = 12;

/** @param {string} hex `#rrggbb` @returns {number} the value of a canvas pixel */
const pixelOf = (hex) => {
  const rgb = parseInt(hex.slice(1), 16);
  return (0xff000000 | ((rgb & 0xff) << 16) | (rgb & 0xff00) | (rgb >> 16)) >>> 0;
};

/** The colour of a motion while another one is pointed at: three quarters of the way to grey. */
const faded = (pixel) => {
  const mix = (shift) => ((((pixel >>> shift) & 0xff) + 3 * 0xc4) >> 2) << shift;
  return (0xff000000 | mix(0) | mix(8) | mix(16)) >>> 0;
};

/**
 * Points on a grid with their motions.
 *
 * `x0`, `y0` are the lower left corner of the first cell, `hx`, `hy` the size of a cell. `classes` has `per` numbers of
 * motions for each point (-1 for none), in rows from the bottom; `shares` has as many shares, or is null. `look` returns
 * the name and colour of a motion; `impacts` is the budget of the computation.
 */
export class Tile {
  constructor({ source, look, impacts, key, level, shape, x0, y0, hx, hy, columns, rows, phase }) {
    Object.assign(this, { source, look, impacts, key, level, shape, x0, y0, hx, hy, columns, rows, phase });
    Object.assign(this, { classes: null, shares: null, per: 1, canvas: null, painted: "" });
  }

  fill({ classes, shares, per }) {
    Object.assign(this, { classes, shares, per });
  }

  contains(x, y) {
    return x >= this.x0 && y >= this.y0 && x < this.x0 + this.columns * this.hx && y < this.y0 + this.rows * this.hy;
  }

  /** @returns {{id: number, share: number, impacts: number}[]} the motions of the point whose cell holds these coordinates */
  at(x, y) {
    const column = Math.min(this.columns - 1, Math.floor((x - this.x0) / this.hx));
    const row = Math.min(this.rows - 1, Math.floor((y - this.y0) / this.hy));
    const begin = (row * this.columns + column) * this.per;
    const found = [];
    for (let k = begin; k < begin + this.per && this.classes[k] !== -1; k++) {
      found.push({ id: this.classes[k], share: this.shares ? this.shares[k] : 1, impacts: this.impacts });
    }
    return found;
  }

  /** Adds the shares of the points of some rows and columns to `counts`. */
  count(counts, [c0, c1], [r0, r1]) {
    for (let row = r0; row < r1; row++) {
      for (let column = c0; column < c1; column++) {
        const begin = (row * this.columns + column) * this.per;
        for (let k = begin; k < begin + this.per && this.classes[k] !== -1; k++) {
          counts.set(this.classes[k], (counts.get(this.classes[k]) ?? 0) + (this.shares ? this.shares[k] : 1));
        }
      }
    }
  }

  /**
   * Paints the tile, unless it is already painted in this way.
   * @param {number | null} highlight the only motion that keeps its colour; null for all
   * @param {boolean} stripes whether coexisting motions are drawn as stripes
   */
  paint(highlight, stripes) {
    const how = `${highlight}|${stripes}`;
    if (this.painted === how) return;
    this.painted = how;
    this.canvas ??= Object.assign(document.createElement("canvas"), { width: this.columns, height: this.rows });
    const context = this.canvas.getContext("2d");
    const image = context.createImageData(this.columns, this.rows);
    const pixels = new Uint32Array(image.data.buffer);
    const palette = new Map();
    const paintOf = (id) => {
      if (!palette.has(id)) {
        const pixel = pixelOf(this.look(id).colour);
        palette.set(id, highlight === null || id === highlight ? pixel : faded(pixel));
      }
      return palette.get(id);
    };
    for (let row = 0; row < this.rows; row++) {
      const line = (this.rows - 1 - row) * this.columns;
      for (let column = 0; column < this.columns; column++) {
        const at = (row * this.columns + column) * this.per;
        const shown = stripes && this.per > 1 ? this.striped(at, column + row) : at;
        pixels[line + column] = this.classes[shown] === -1 ? 0 : paintOf(this.classes[shown]);
      }
    }
    context.putImageData(image, 0, 0);
  }

  /** The motion of a point that is drawn at a position in the stripes, according to the shares. */
  striped(at, place) {
    let rest = (((place + this.phase) % STRIPE) + 0.5) / STRIPE;
    let shown = at;
    for (let k = at; k < at + this.per && this.classes[k] !== -1; k++) {
      shown = k;
      rest -= this.shares[k];
      if (rest < 0) break;
    }
    return shown;
  }
}

/** A cache of the most recently used tiles. */
export class Cache {
  constructor(most = 400) {
    this.most = most;
    this.tiles = new Map();
  }

  get(key) {
    const tile = this.tiles.get(key);
    if (tile) {
      this.tiles.delete(key);
      this.tiles.set(key, tile);
    }
    return tile;
  }

  has(key) {
    return this.tiles.has(key);
  }

  set(key, tile) {
    this.tiles.set(key, tile);
    for (const oldest of this.tiles.keys()) {
      if (this.tiles.size <= this.most) break;
      this.tiles.delete(oldest);
    }
  }

  /** @returns {Tile[]} the tiles of a source */
  of(source) {
    return [...this.tiles.values()].filter((tile) => tile.source === source);
  }
}

/**
 * A queue of requests in the order of their rank, with a few running at a time. Each owner repeatedly declares the
 * requests it needs; requests that it no longer needs are cancelled.
 */
export class Queue {
  constructor(most = 3) {
    this.most = most;
    this.waiting = new Map();
    this.running = new Map();
    this.paused = false;
  }

  /**
   * @param {object} owner
   * @param {{key: string, rank: number, run: (signal: AbortSignal) => Promise<void>}[]} jobs all requests that it needs
   */
  want(owner, jobs) {
    const keys = new Set(jobs.map((job) => job.key));
    for (const [key, { owner: of, control }] of this.running) {
      if (of === owner && !keys.has(key)) control.abort();
    }
    this.waiting.set(owner, jobs.filter((job) => !this.running.has(job.key)));
    this.pump();
  }

  pause(paused) {
    this.paused = paused;
    this.pump();
  }

  pump() {
    while (!this.paused && this.running.size < this.most) {
      const all = [...this.waiting.entries()].flatMap(([owner, jobs]) => jobs.map((job) => ({ owner, job })));
      if (!all.length) return;
      const { owner, job } = all.reduce((best, other) => (other.job.rank < best.job.rank ? other : best));
      this.waiting.set(owner, this.waiting.get(owner).filter((other) => other !== job));
      const control = new AbortController();
      this.running.set(job.key, { owner, control });
      job.run(control.signal).finally(() => {
        this.running.delete(job.key);
        this.pump();
      });
    }
  }
}
