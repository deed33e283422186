/** A window on a plane: which coordinates are at which pixel. */

/** Smallest distance of neighbouring points, in units in the last place of the coordinate. */
const LEAST_ULPS = 8;
/** A shape of the pixel this close to the one before, in powers of two, is the same: a window comes with few digits. */
const SAME_SHAPE = 1e-3;

/** @param {number} x @returns {number} the distance of neighbouring doubles at `x` */
export const ulp = (x) => 2 ** (Math.floor(Math.log2(Math.max(Math.abs(x), 2 ** -1000))) - 52);

export class Viewport {
  /** @param {number} stepX size of a pixel at zoom 0 @param {number} stepY */
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
   * @param {number[]} window left, right, bottom, top: what is shown from now on
   * @param {number} density device pixels a pixel
   */
  fit([left, right, bottom, top], density) {
    this.cx = (left + right) / 2;
    this.cy = (bottom + top) / 2;
    const zx = Math.log2((this.stepX * this.width) / (right - left));
    const zy = Math.log2((this.stepY * this.height) / (top - bottom));
    if (Math.abs(zy - zx - this.shape) > SAME_SHAPE) this.shape = zy - zx;
    this.z = zx;
    this.z = Math.min(zx, this.deepest(density));
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

  pan(dx, dy) {
    this.cx -= dx * this.hx;
    this.cy += dy * this.hy;
  }

  /**
   * Zooms by a number of levels, the point under the pixel staying where it is.
   * @param {number} levels
   * @param {number} px
   * @param {number} py
   * @param {number} density device pixels a pixel
   * @returns {boolean} whether the numeric limit was met
   */
  zoom(levels, px, py, density) {
    const [x, y] = this.toPlane(px, py);
    const most = this.deepest(density);
    const wanted = this.z + levels;
    this.z = Math.max(-5, Math.min(most, wanted));
    this.cx = x - (px - this.width / 2) * this.hx;
    this.cy = y + (py - this.height / 2) * this.hy;
    return wanted > most;
  }

  /** The zoom beyond which neighbouring points of a tile are less than a few units in the last place apart. */
  deepest(density) {
    const level = (step, centre, span) => Math.log2(step / (LEAST_ULPS * ulp(Math.abs(centre) + span / 2)));
    const x = level(this.stepX, this.cx, this.hx * this.width);
    const y = level(this.stepY, this.cy, this.hy * this.height) - this.shape;
    return Math.floor(Math.min(x, y)) - Math.log2(density);
  }

  /** A value rounded to as few decimals as tell pixels apart. */
  static rounded(value, pixel) {
    const decimals = Math.min(17, Math.max(0, Math.ceil(-Math.log10(pixel))));
    const rounded = Number(value.toFixed(decimals));
    return Math.abs(rounded - value) <= pixel ? rounded : value;
  }
}
