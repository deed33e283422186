/** Tiles of a plane: points with their motions, and their pictures. */

import { missingLook, pixelAt, pixelOf, shownOf } from "./values.js";

/** Points of a tile along each axis. */
export const SIDE = 128;

/** Period of the stripes of coexisting motions, in pixels. */
export const STRIPE = 12;

/** The remainder of a position, so that patterns continue from tile to tile: a multiple of the periods of all patterns. */
const WRAP = 84;

/** @param {number} place a column or row @returns {number} where it is in the patterns */
export const wrapped = (place) => ((place % WRAP) + WRAP) % WRAP;

/** Distance of the lines that hatch undecided points, in pixels, and their colour. */
const HATCH = 7;
const HATCH_LINE = "#d02020";
/** Largest number of pixels of a coarse picture, which must be painted quickly. */
const COARSE_PIXELS = 100000;

/** A colour on the way to grey, for motions other than those that are isolated. */
const faded = (pixel) => {
  const mix = (shift) => ((((pixel >>> shift) & 0xff) + 5 * 0xd8) / 6) << shift;
  return (0xff000000 | mix(0) | mix(8) | mix(16)) >>> 0;
};

/** The colour of a boundary over a motion: dark, or light over a dark colour. */
const edged = (pixel) => {
  const at = (shift) => (pixel >>> shift) & 0xff;
  const towards = 0.3 * at(0) + 0.6 * at(8) + 0.1 * at(16) > 90 ? 0 : 255;
  const mix = (shift) => Math.round(0.3 * at(shift) + 0.7 * towards) << shift;
  return (0xff000000 | mix(0) | mix(8) | mix(16)) >>> 0;
};

/**
 * How tiles are painted.
 * @typedef {object} Look
 * @property {Set<number> | null} only the motions that keep their colours; null for all
 * @property {boolean} stripes whether coexisting motions are drawn as stripes
 * @property {boolean} boundaries whether boundaries between motions are drawn
 * @property {import("./values.js").Scale | null} scale of a quantity; null where motions have their colours
 * @property {number} density device pixels a pixel
 * @property {number} pixel width of a device pixel, in units of the abscissa
 */

/**
 * Points on a grid with their motions.
 *
 * `x0`, `y0` are the lower left corner of the first cell, `hx`, `hy` the size of a cell. `classes` has `per` numbers of
 * motions for each point (-1 for none), in rows from the bottom; `shares` has as many shares, or is null; `values` those of a
 * quantity, if one is asked for, and `own` says of each point whether it was computed itself (1) or has the motions of its
 * neighbours (2); null if all were computed. `filled` tells whether there are points of the second kind. `look` returns
 * the name and colour of a motion; `impacts` is the budget of the computation. `phase` and `slant` are the place of the
 * first cell in patterns along both diagonals.
 */
export class Tile {
  constructor({ source, look, impacts, key, level, shape, x0, y0, hx, hy, columns, rows, phase, slant }) {
    Object.assign(this, { source, look, impacts, key, level, shape, x0, y0, hx, hy, columns, rows, phase, slant });
    Object.assign(this, { classes: null, shares: null, per: 1, pictures: new Map(), ids: [], undecided: new Set(), filled: false });
  }

  /** Takes the answer of the server, whose cells may be larger. @param {[number, number]} shape numbers of its rows and columns */
  fill({ classes, shares, per, values = null, own = null }, [rows, columns]) {
    const [hx, hy] = [(this.hx * this.columns) / columns, (this.hy * this.rows) / rows];
    Object.assign(this, { classes, shares, per, values, own, hx, hy, rows, columns });
    this.pictures.clear();
    this.examine();
  }

  /** Whether a larger budget would change nothing: every motion is decided. */
  get decided() {
    return this.undecided.size === 0;
  }

  /** Whether a point was computed itself, and not given the motions of its neighbours. */
  isOwn(point) {
    return this.own === null || this.own[point] === 1;
  }

  /**
   * Takes points that were not computed with this budget from the tile of a smaller one, if they were computed and decided with
   * that; and points without any motion.
   */
  adopt(older) {
    const { own, per, classes, shares, values } = this;
    if (!own || older.classes?.length !== classes.length) return;
    for (let point = 0; point < own.length; point++) {
      const begin = point * per;
      const taken = older.classes.subarray(begin, begin + per);
      if (own[point] === 1) continue;
      const decided = older.isOwn(point) && !taken.some((id) => older.undecided.has(id));
      if (!decided && own[point] !== 0) continue;
      classes.set(taken, begin);
      shares?.set(older.shares.subarray(begin, begin + per), begin);
      values?.set(older.values.subarray(begin, begin + per), begin);
      own[point] = decided ? 1 : 2;
    }
    this.examine();
  }

  examine() {
    this.filled = this.own?.some((how) => how !== 1) ?? false;
    this.ids = [...new Set(this.classes)].filter((id) => id !== -1);
    this.undecided = new Set(this.ids.filter((id) => this.look(id).name === "undecided"));
  }

  /** The motions of a point with the values of the quantity, as for `shownOf`. */
  motionsAt(begin) {
    const motions = [];
    for (let k = begin; k < begin + this.per && this.classes[k] !== -1; k++) {
      motions.push({ value: this.values[k], name: this.look(this.classes[k]).name });
    }
    return motions;
  }

  /** The index of the motion of a point whose value is shown. */
  shownAt(begin, of) {
    return this.per === 1 ? begin : begin + shownOf(this.motionsAt(begin), of);
  }

  /** The word for a value that is no finite number. */
  missingAt(k) {
    if (this.values[k] === Infinity) return "infinite";
    const { name } = this.look(this.classes[k]);
    if (name === "undecided") return name;
    return this.isOwn(Math.floor(k / this.per)) || name === "chaotic" ? "not defined" : "not computed";
  }

  /** Adds the values of the points of some rows and columns to `found`. @param {{low: number, high: number, missing: Set<string>}} found */
  extremes(found, [c0, c1], [r0, r1], of) {
    for (let row = r0; row < r1; row++) {
      for (let column = c0; column < c1; column++) {
        const begin = (row * this.columns + column) * this.per;
        if (this.classes[begin] === -1) continue;
        const k = this.shownAt(begin, of);
        const value = this.values[k];
        if (!Number.isFinite(value)) found.missing.add(this.missingAt(k));
        else {
          if (value < found.low) found.low = value;
          if (value > found.high) found.high = value;
        }
      }
    }
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
      found.push({ id: this.classes[k], share: this.shares ? this.shares[k] : 1, impacts: this.impacts, value: this.values?.[k], missing: this.values && !Number.isFinite(this.values[k]) ? this.missingAt(k) : "" });
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
   * The tile as a picture. It is painted only when the look has changed, or the colour of a motion, because others with its label
   * were found.
   * @param {Look} look
   * @param {boolean} [open] whether undecided points are transparent, so that what is below is seen
   * @returns {HTMLCanvasElement}
   */
  picture(look, open = false) {
    const how = JSON.stringify([look.only ? [...look.only] : null, look.stripes, look.boundaries, look.density, look.scale, this.foldFor(look), this.ids.map((id) => this.look(id).colour)]);
    let picture = this.pictures.get(open);
    if (picture?.how !== how) {
      const [{ columns, rows }, fold] = [this, this.foldFor(look)];
      const canvas = Object.assign(picture?.canvas ?? document.createElement("canvas"), { width: fold * columns, height: fold * rows });
      picture = { how, canvas };
      this.pictures.set(open, picture);
      this.paint(canvas.getContext("2d"), look, open, fold);
    }
    return picture.canvas;
  }

  /** Pixels of the picture for each point along each axis: in the coarse picture as many as on the screen, so that hatched places look as in tiles. */
  foldFor({ pixel }) {
    if (this.level !== -Infinity || (!this.undecided.size && !this.values)) return 1;
    const most = Math.floor(Math.sqrt(COARSE_PIXELS / (this.columns * this.rows)));
    // a picture of one column has no distance between columns
    return Math.max(1, Math.min(most, Math.round(this.hx / pixel) || 1));
  }

  paint(context, { only, stripes, boundaries, density, scale }, open, fold) {
    const wide = fold * this.columns;
    const high = fold * this.rows;
    const image = context.createImageData(wide, high);
    const pixels = new Uint32Array(image.data.buffer);
    const palette = new Map();
    const paintOf = (id) => {
      if (!palette.has(id)) {
        const pixel = pixelOf(this.look(id).colour);
        palette.set(id, only === null || only.has(id) ? pixel : faded(pixel));
      }
      return palette.get(id);
    };
    const thick = density > 1.4 ? 2 : 1;
    const [lines, period] = [pixelOf(HATCH_LINE), HATCH * thick];
    const hatched = (column, row) =>
      (column + row + this.phase) % period < thick || (column - row + this.slant + period * high) % period < thick;
    for (let y = 0; y < high; y++) {
      const [row, line] = [Math.floor(y / fold), (high - 1 - y) * wide];
      for (let x = 0; x < wide; x++) {
        const column = Math.floor(x / fold);
        const at = (row * this.columns + column) * this.per;
        if (scale && this.values) {
          pixels[line + x] = this.valuePixel(at, scale, open, { hatched: hatched(x, y), rising: (x + y + this.phase) % period < thick, lines });
          continue;
        }
        const id = this.classes[stripes && this.per > 1 ? this.striped(at, column + row) : at];
        if (id === -1) continue;
        const undecided = this.undecided.has(id);
        let pixel = paintOf(id);
        if (undecided && open) pixel = 0;
        else if (undecided && (only === null || only.has(id)) && hatched(x, y)) pixel = lines;
        if (boundaries && this.borders(at, column, row)) pixel = edged(paintOf(id));
        pixels[line + x] = pixel;
      }
    }
    context.putImageData(image, 0, 0);
  }

  /** The pixel of a point in the colours of a quantity. */
  valuePixel(at, scale, open, { hatched, rising, lines }) {
    if (this.classes[at] === -1) return 0;
    const k = this.shownAt(at, scale.of);
    const value = this.values[k];
    if (Number.isFinite(value)) return pixelAt(scale, value);
    const missing = this.missingAt(k);
    // what is below is seen, or the dots of places that are not computed
    if (missing === "not computed" || (missing === "undecided" && open)) return 0;
    if (missing === "undecided") return hatched ? lines : pixelOf(this.look(this.classes[k]).colour);
    const { colour, hatch } = missingLook(missing);
    return pixelOf(hatch && rising ? hatch : colour);
  }

  /** Whether the neighbour to the right or above has another motion. */
  borders(at, column, row) {
    const { classes, columns, rows, per } = this;
    return (column + 1 < columns && classes[at + per] !== classes[at]) || (row + 1 < rows && classes[at + columns * per] !== classes[at]);
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
