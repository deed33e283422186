/** A window of a plane: the mapping between coordinates and pixels. */

/** Smallest distance of neighbouring points, in units in the last place of the coordinate. */
const LEAST_ULPS = 8;
/** Smallest zoom of an axis. */
const LEAST_ZOOM = -5;
/**
 * Step between levels of tiles, and between shapes of their cells, in powers of two. With steps, tiles can be used in
 * several views; with small steps, they have not many more points than the view has pixels.
 */
const STEP = 1 / 8;
/** Tolerance of zoom and shape, because a window in an address has few digits. */
const SLACK = 1e-3;

/** @param {number} x @returns {number} the distance between neighbouring doubles at `x` */
export const ulp = (x) => 2 ** (Math.floor(Math.log2(Math.max(Math.abs(x), 2 ** -1000))) - 52);

export class Viewport {
  /**
   * The zoom of the abscissa is `z`, that of the ordinate `z + shape`.
   * @param {number} stepX size of a pixel at zoom 0
   * @param {number} stepY
   */
  constructor(stepX, stepY) {
    Object.assign(this, { stepX, stepY, cx: 0, cy: 0, z: 0, shape: 0, width: 100, height: 100 });
  }

  get hx() {
    return this.stepX * 2 ** -this.z;
  }

  get hy() {
    return this.stepY * 2 ** -(this.z + this.shape);
  }

  /**
   * @param {number[]} window the new window: left, right, bottom, top
   * @param {number} density device pixels a pixel
   */
  fit([left, right, bottom, top], density) {
    this.cx = (left + right) / 2;
    this.cy = (bottom + top) / 2;
    const zx = Math.log2((this.stepX * this.width) / (right - left));
    const zy = Math.log2((this.stepY * this.height) / (top - bottom));
    const [mostX, mostY] = this.deepest(density, [zx, zy]);
    this.z = Math.min(zx, mostX);
    this.shape = Math.min(zy, mostY) - this.z;
  }

  /** @returns {number[]} left, right, bottom, top, with as many digits as a pixel needs */
  window() {
    const [w, h] = [(this.hx * this.width) / 2, (this.hy * this.height) / 2];
    const round = (value, pixel) => Number(value.toFixed(Math.min(20, Math.max(0, Math.ceil(-Math.log10(pixel)) + 2))));
    return [
      round(this.cx - w, this.hx), round(this.cx + w, this.hx), round(this.cy - h, this.hy), round(this.cy + h, this.hy),
    ];
  }

  toPixel(x, y) {
    return [(x - this.cx) / this.hx + this.width / 2, this.height / 2 - (y - this.cy) / this.hy];
  }

  toPlane(px, py) {
    return [this.cx + (px - this.width / 2) * this.hx, this.cy - (py - this.height / 2) * this.hy];
  }

  /** Whether a pixel, if there is one, is in the window. */
  holds(px) {
    return Boolean(px) && px[0] >= 0 && px[1] >= 0 && px[0] <= this.width && px[1] <= this.height;
  }

  pan(dx, dy) {
    this.cx -= dx * this.hx;
    this.cy += dy * this.hy;
  }

  /**
   * Zooms by a number of levels about a pixel, whose coordinates do not change.
   * @param {number} levels
   * @param {number} px
   * @param {number} py
   * @param {number} density device pixels a pixel
   * @param {"x" | "y" | null} [along] the only axis to zoom; null for both
   * @returns {boolean} whether the numeric limit was reached
   */
  zoom(levels, px, py, density, along = null) {
    const [x, y] = this.toPlane(px, py);
    const [z, zy] = [this.z, this.z + this.shape];
    const [mostX, mostY] = this.deepest(density);
    const most = Math.min(along === "y" ? Infinity : mostX - z, along === "x" ? Infinity : mostY - zy);
    const least = Math.max(along === "y" ? -Infinity : LEAST_ZOOM - z, along === "x" ? -Infinity : LEAST_ZOOM - zy);
    const by = Math.max(Math.min(0, least), Math.min(most, levels));
    if (along !== "y") this.z = z + by;
    this.shape = (along === "x" ? zy : zy + by) - this.z;
    this.cx = x - (px - this.width / 2) * this.hx;
    this.cy = y + (py - this.height / 2) * this.hy;
    return levels > most;
  }

  /** The level of tiles whose cells have the width of a device pixel or are slightly finer. */
  levelOf(density) {
    return STEP * Math.ceil((this.z + Math.log2(density) - SLACK) / STEP);
  }

  /** The shape of the cells of a level: that of the pixels or slightly finer in the ordinate, within the numeric limit. */
  shapeOf(level) {
    const steps = Math.ceil((this.shape - SLACK) / STEP);
    return STEP * Math.min(steps, Math.floor((this.limits()[1] - level) / STEP));
  }

  /** The level of each axis at which neighbouring points are a few units in the last place apart. */
  limits([z, zy] = [this.z, this.z + this.shape]) {
    const level = (step, centre, span) => Math.log2(step / (LEAST_ULPS * ulp(Math.abs(centre) + span / 2)));
    return [
      level(this.stepX, this.cx, this.stepX * 2 ** -z * this.width), level(this.stepY, this.cy, this.stepY * 2 ** -zy * this.height),
    ];
  }

  /** The zooms of both axes at which the points of tiles reach this limit. */
  deepest(density, zooms) {
    return this.limits(zooms).map((limit) => Math.floor(limit) - Math.log2(density));
  }

  /** A value rounded to the fewest decimals that distinguish pixels. */
  static rounded(value, pixel) {
    const decimals = Math.min(17, Math.max(0, Math.ceil(-Math.log10(pixel))));
    const rounded = Number(value.toFixed(decimals));
    return Math.abs(rounded - value) <= pixel ? rounded : value;
  }
}
