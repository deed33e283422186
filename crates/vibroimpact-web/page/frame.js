/** Draws a tile view: the picture, the shading outside the legal range, axes, crosshair. */

import { strokes } from "./dom.js";
import { ticks } from "./ticks.js";
import { titled } from "./units.js";

const SERIF = '"STIX Two Text", "Cambria", "Georgia", "DejaVu Serif", serif';
const SANS = 'system-ui, -apple-system, "Segoe UI", "Helvetica Neue", "Noto Sans", sans-serif';

/** Colours of what is no motion: not computed, and impossible. The style sheet adapts the picture to a dark page. */
const BLANK = { ground: "#ffffff", ink: "#b4b6b0" };
const IMPOSSIBLE = { ground: "#d2d3cd", ink: "#83857f" };

/** Adds four lines around a point to a path, between two distances from it. */
export function rays(context, [x, y], near, far) {
  for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
    context.moveTo(x + near * dx, y + near * dy);
    context.lineTo(x + far * dx, y + far * dy);
  }
}

export class Frame {
  /** @param {import("./tileview.js").TileView} view */
  constructor(view) {
    this.view = view;
  }

  /** Computes the margins for the axes from the size of the text. */
  measure() {
    const { view } = this;
    if (!view.size) return;
    this.em = parseFloat(getComputedStyle(view.host).fontSize);
    const narrow = view.size[0] < 26 * this.em;
    this.left = Math.round(this.em * (narrow ? 3.2 : 4.2));
    this.bottom = Math.round(this.em * 3.3);
    this.top = Math.round(this.em * 0.7);
    this.right = Math.round(this.em * 0.9);
    view.viewport.width = view.size[0] - this.left - this.right;
    view.viewport.height = view.size[1] - this.top - this.bottom;
    const style = getComputedStyle(view.host);
    const colour = (name) => style.getPropertyValue(name).trim();
    this.colours = Object.fromEntries(["ink", "soft"].map((name) => [name, colour(`--${name}`)]));
  }

  /** @returns {string} the key of the source of the uppermost tile */
  draw() {
    const { view } = this;
    const context = view.picture.getContext("2d");
    const { density } = view;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, view.picture.width, view.picture.height);
    context.save();
    context.beginPath();
    context.rect(...[this.left, this.top, view.viewport.width, view.viewport.height].map((v) => Math.round(v * density)));
    context.clip();
    context.fillStyle = this.pattern(context, BLANK, (pen, side) => {
      pen.fillStyle = BLANK.ink;
      pen.fillRect(side / 2, side / 2, Math.max(1, side / 7), Math.max(1, side / 7));
    });
    context.fillRect(0, 0, view.picture.width, view.picture.height);
    const tiles = view.supply.drawn();
    for (const [tile, open] of tiles) this.tile(context, tile, open);
    this.outside(context);
    context.restore();
    this.over();
    return tiles.at(-1)?.[0].source ?? "";
  }

  /** A position on the canvas, rounded to pixels so that tiles join without a seam. */
  place(x, y) {
    const [px, py] = this.view.viewport.toPixel(x, y);
    return [Math.round((px + this.left) * this.view.density), Math.round((py + this.top) * this.view.density)];
  }

  tile(context, tile, open) {
    const { view } = this;
    const [x0, y1] = this.place(tile.x0, tile.y0);
    const [x1, y0] = this.place(tile.x0 + tile.columns * tile.hx, tile.y0 + tile.rows * tile.hy);
    if (x1 <= 0 || y1 <= 0 || x0 >= view.picture.width || y0 >= view.picture.height) return;
    // no stripes and lines in coarse cells, because they would look like regions of motions
    const coarse = tile.level === -Infinity;
    const { only, density, scale } = view;
    const look = { only, density, scale, pixel: view.viewport.hx / density, stripes: view.stripes && !coarse, boundaries: view.boundaries && !coarse };
    context.imageSmoothingEnabled = x1 - x0 < tile.columns;
    context.imageSmoothingQuality = "high";
    context.drawImage(tile.picture(look, open), x0, y0, x1 - x0, y1 - y0);
  }

  /** Shades the area with values that are not legal for an oscillator or a start. */
  outside(context) {
    const { view } = this;
    const { x: [x0, x1], y: [y0, y1] } = view.source.legal;
    const [w, h] = [view.picture.width, view.picture.height];
    const [left, top] = this.place(Number.isFinite(x0) ? x0 : -1e300, Number.isFinite(y1) ? y1 : 1e300);
    const [right, bottom] = this.place(Number.isFinite(x1) ? x1 : 1e300, Number.isFinite(y0) ? y0 : -1e300);
    context.fillStyle = this.pattern(context, IMPOSSIBLE, (pen, side) => {
      pen.strokeStyle = IMPOSSIBLE.ink;
      pen.lineWidth = view.density;
      pen.beginPath();
      for (const shift of [-side, 0, side]) {
        pen.moveTo(shift - 1, side + 1);
        pen.lineTo(shift + side + 1, -1);
      }
      pen.stroke();
    });
    if (left > 0) context.fillRect(0, 0, left, h);
    if (right < w) context.fillRect(right, 0, w - right, h);
    if (top > 0) context.fillRect(0, 0, w, top);
    if (bottom < h) context.fillRect(0, bottom, w, h - bottom);
  }

  /** A repeated patch of a colour with marks. */
  pattern(context, { ground }, mark) {
    const side = Math.round(8 * this.view.density);
    const patch = Object.assign(document.createElement("canvas"), { width: side, height: side });
    const pen = patch.getContext("2d");
    pen.fillStyle = ground;
    pen.fillRect(0, 0, side, side);
    mark(pen, side);
    return context.createPattern(patch, "repeat");
  }

  over() {
    const { view } = this;
    const context = view.surface.getContext("2d");
    const { density, viewport: v } = view;
    context.setTransform(density, 0, 0, density, 0, 0);
    context.clearRect(0, 0, ...view.size);
    context.save();
    context.translate(this.left, this.top);
    context.save();
    context.beginPath();
    context.rect(0, 0, v.width, v.height);
    context.clip();
    for (const paint of view.painters) paint(context, v, this);
    if (view.surface.matches(":focus-visible")) this.crosshair(context, v.width / 2, v.height / 2);
    context.restore();
    this.axes(context);
    context.restore();
  }

  crosshair(context, x, y) {
    strokes(context, [[4, "#ffffff"], [1.6, "#000000"]], () => rays(context, [x, y], 4, 1.1 * this.em));
  }

  axes(context) {
    const { viewport: v, source } = this.view;
    const [left, top] = v.toPlane(0, 0);
    const [right, bottom] = v.toPlane(v.width, v.height);
    const { em } = this;
    context.strokeStyle = this.colours.ink;
    context.fillStyle = this.colours.ink;
    context.lineWidth = 1;
    context.strokeRect(-0.5, -0.5, v.width + 1, v.height + 1);
    context.font = `${0.88 * em}px ${SANS}`;
    const [fx, fy] = [source.x.factor, source.y.factor];
    const across = ticks(left * fx, right * fx, v.width / (6 * em));
    const up = ticks(bottom * fy, top * fy, v.height / (4 * em));
    context.textAlign = "center";
    context.textBaseline = "top";
    context.beginPath();
    for (const { value, text } of across.ticks) {
      const px = Math.round(v.toPixel(value / fx, v.cy)[0]) + 0.5;
      context.moveTo(px, v.height + 1);
      context.lineTo(px, v.height + 6);
      const half = context.measureText(text).width / 2;
      const edge = v.width + this.right;
      context.fillText(text, Math.min(px, edge - half - 1), v.height + 8);
    }
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const { value, text } of up.ticks) {
      const py = Math.round(v.toPixel(v.cx, value / fy)[1]) + 0.5;
      context.moveTo(-1, py);
      context.lineTo(-6, py);
      context.fillText(text, -9, py);
    }
    context.stroke();
    this.names(context, source, across.offset, up.offset);
  }

  names(context, source, acrossOffset, upOffset) {
    const { viewport: v } = this.view;
    const { em } = this;
    context.font = `italic ${1.15 * em}px ${SERIF}`;
    context.textAlign = "center";
    context.textBaseline = "alphabetic";
    context.fillText(titled(source.x), v.width / 2, v.height + this.bottom - 0.45 * em);
    context.save();
    context.translate(-this.left + 1.05 * em, v.height / 2);
    context.rotate(titled(source.y).length > 2 ? -Math.PI / 2 : 0);
    context.fillText(titled(source.y), 0, 0.3 * em);
    context.restore();
    context.font = `${0.8 * em}px ${SANS}`;
    context.fillStyle = this.colours.soft;
    context.textAlign = "right";
    if (acrossOffset) context.fillText(acrossOffset, v.width, v.height + this.bottom - 0.45 * em);
    if (upOffset) {
      context.save();
      context.translate(-this.left + 1.05 * em, 0);
      context.rotate(-Math.PI / 2);
      context.fillText(upOffset, 0, 0);
      context.restore();
    }
  }
}
