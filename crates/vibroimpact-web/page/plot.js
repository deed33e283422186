/** A graph with axes, in SVG and in the colours of the page. It is drawn again when its place changes its size. */

import { drawn } from "./dom.js";
import { ticks } from "./ticks.js";
import { titled } from "./units.js";

/** Largest zoom. */
const MOST = 2000;

/** Ticks of an axis in its unit, at the numbers of the graph. */
const axisTicks = ({ factor = 1 }, low, high, most) =>
  ticks(low * factor, high * factor, most).ticks.map(({ value, text }) => ({ value: value / factor, text }));

let plots = 0;

/**
 * @typedef {object} Axis
 * @property {string} symbol
 * @property {string} unit of physical quantities; empty for others
 * @property {number} [factor] one unit of the numbers of the graph in that unit
 */

export class Plot extends EventTarget {
  /**
   * @param {{label: string, x: Axis, y: Axis, zooms: string, column?: number, height?: number}} shape `zooms`: the axes that zoom, `x` or
   *   `xy`; `column`: width in em left of the axes, for a drawing; `height` of the graph over its width
   */
  constructor({ label, x, y, zooms, column = 0, height = 0.6 }) {
    super();
    Object.assign(this, { x, y, zooms, column, height, home: null, window: null, painters: [], clip: `clip-${++plots}` });
    this.axes = drawn("g", { class: "axes" });
    this.curves = drawn("g", { "clip-path": `url(#${this.clip})` });
    this.over = drawn("g");
    this.clipped = drawn("rect");
    this.svg = drawn("svg", { class: "plot", role: "img", "aria-label": label },
      drawn("defs", {}, drawn("clipPath", { id: this.clip }, this.clipped)), this.axes, this.curves, this.over);
    this.host = Object.assign(document.createElement("div"), { className: "graph" });
    this.host.style.setProperty("--height", String(height));
    this.host.append(this.svg);
    new ResizeObserver(() => this.draw()).observe(this.host);
    this.gestures();
  }

  /** @param {number[]} home left, right, bottom, top; the window is set to it */
  show(home) {
    this.home = home;
    this.window = [...home];
    this.draw();
  }

  get zoomed() {
    return this.window !== null && this.window.some((value, k) => value !== this.home[k]);
  }

  toX(x) {
    const [left, right] = this.window;
    return this.left + ((x - left) / (right - left)) * this.wide;
  }

  toY(y) {
    const [, , bottom, top] = this.window;
    return this.top + ((top - y) / (top - bottom)) * this.high;
  }

  /** The time, or other abscissa, at a position of the pointer. */
  fromX(clientX) {
    const [left, right] = this.window;
    const box = this.svg.getBoundingClientRect();
    return left + ((clientX - box.left - this.left) / this.wide) * (right - left);
  }

  fromY(clientY) {
    const [, , bottom, top] = this.window;
    const box = this.svg.getBoundingClientRect();
    return top - ((clientY - box.top - this.top) / this.high) * (top - bottom);
  }

  /** Zooms by a factor about a point of the graph. */
  zoom(factor, x = (this.window[0] + this.window[1]) / 2, y = (this.window[2] + this.window[3]) / 2) {
    const cut = (at, [low, high], [least, most]) => {
      const size = Math.min(most - least, Math.max((most - least) / MOST, (high - low) / factor));
      const part = (at - low) / (high - low);
      const begin = Math.min(most - size, Math.max(least, at - part * size));
      return [begin, begin + size];
    };
    const { window: w, home: h } = this;
    const across = cut(x, [w[0], w[1]], [h[0], h[1]]);
    const up = this.zooms === "xy" ? cut(y, [w[2], w[3]], [h[2], h[3]]) : [w[2], w[3]];
    this.window = [...across, ...up];
    this.draw();
  }

  /** Moves the window by parts of its size, within its home. */
  pan(dx, dy) {
    const moved = (low, high, by, least, most) => {
      const shift = Math.min(most - high, Math.max(least - low, by * (high - low)));
      return [low + shift, high + shift];
    };
    const { window: w, home: h } = this;
    this.window = [...moved(w[0], w[1], dx, h[0], h[1]), ...moved(w[2], w[3], dy, h[2], h[3])];
    this.draw();
  }

  /** The wheel zooms, and dragging moves, only while the graph is enlarged: elsewhere they scroll the page. */
  gestures() {
    const large = () => this.window && this.svg.closest("dialog");
    this.svg.addEventListener("wheel", (event) => {
      if (!large()) return;
      event.preventDefault();
      this.zoom(2 ** (-event.deltaY / 250), this.fromX(event.clientX), this.fromY(event.clientY));
    }, { passive: false });
    let last = null;
    this.svg.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || !this.window) return;
      if (this.zooms === "x") {
        this.svg.setPointerCapture(event.pointerId);
        this.dispatchEvent(new CustomEvent("place", { detail: this.fromX(event.clientX) }));
        last = [event.clientX, event.clientY];
      } else if (large()) {
        this.svg.setPointerCapture(event.pointerId);
        last = [event.clientX, event.clientY];
      }
    });
    this.svg.addEventListener("pointermove", (event) => {
      if (!last) return;
      if (this.zooms === "x") this.dispatchEvent(new CustomEvent("place", { detail: this.fromX(event.clientX) }));
      else this.pan((last[0] - event.clientX) / this.wide, (event.clientY - last[1]) / this.high);
      last = [event.clientX, event.clientY];
    });
    for (const name of ["pointerup", "pointercancel"]) {
      this.svg.addEventListener(name, () => {
        last = null;
      });
    }
  }

  draw() {
    const { width, height } = this.host.getBoundingClientRect();
    if (!width || !height || !this.window) return;
    const em = parseFloat(getComputedStyle(this.host).fontSize);
    this.em = em;
    this.size = [width, height];
    this.top = 0.6 * em;
    this.high = Math.max(10, height - this.top - 2.9 * em);
    this.up = axisTicks(this.y, this.window[2], this.window[3], this.high / (2.4 * em));
    // room for the longest number
    const longest = Math.max(4, ...this.up.map(({ text }) => text.length));
    this.left = (1.5 + 0.48 * longest + this.column) * em;
    this.wide = Math.max(10, width - this.left - 0.6 * em);
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    for (const [name, value] of Object.entries({ x: this.left, y: this.top, width: this.wide, height: this.high })) {
      this.clipped.setAttribute(name, value);
    }
    this.frame();
    this.curves.replaceChildren();
    this.over.replaceChildren();
    for (const paint of this.painters) paint(this);
  }

  /** The axes with their ticks and names. */
  frame() {
    const { em, left, top, wide, high } = this;
    const [x0, x1] = this.window;
    const [bottom, parts] = [top + high, []];
    const line = (xa, ya, xb, yb) => drawn("path", { class: "tick", d: `M${xa} ${ya}L${xb} ${yb}` });
    const text = (x, y, said, anchor, kind) => drawn("text", { x, y, "text-anchor": anchor, class: kind, text: said });
    for (const { value, text: said } of axisTicks(this.x, x0, x1, wide / (4.2 * em))) {
      const at = this.toX(value);
      parts.push(line(at, bottom, at, bottom + 5), text(Math.min(at, left + wide - 0.6 * em), bottom + 1.2 * em, said, "middle", "number"));
    }
    for (const { value, text: said } of this.up) {
      const at = this.toY(value);
      parts.push(line(left - 5, at, left, at), text(left - 8, at + 0.3 * em, said, "end", "number"));
    }
    parts.push(
      drawn("rect", { class: "frame", x: left, y: top, width: wide, height: high }),
      text(left + wide / 2, bottom + 2.5 * em, titled(this.x), "middle", "name"),
      drawn("text", {
        class: "name", "text-anchor": "middle", text: titled(this.y),
        transform: `translate(${(this.column + 0.9) * em} ${top + high / 2}) rotate(-90)`,
      }),
    );
    this.axes.replaceChildren(...parts);
  }

  /** A stop: a hatched strip from its position to the edge of the graph. */
  wall(at, beyond, along) {
    const { left, top, wide, high } = this;
    const box = along === "y"
      ? { x: left, width: wide, y: beyond > 0 ? top : this.toY(at), height: beyond > 0 ? this.toY(at) - top : top + high - this.toY(at) }
      : { y: top, height: high, x: beyond > 0 ? this.toX(at) : left, width: beyond > 0 ? left + wide - this.toX(at) : this.toX(at) - left };
    if (!(box.width > 0 && box.height > 0)) return null;
    const edge = along === "y" ? `M${left} ${this.toY(at)}h${wide}` : `M${this.toX(at)} ${top}v${high}`;
    return drawn("g", { class: "stop" }, drawn("rect", box), drawn("path", { d: edge }));
  }

  /** The path through points, broken where `lift` holds. */
  path(xs, ys, [from, to] = [0, xs.length], lift = () => false) {
    const parts = [];
    for (let k = from; k < to; k++) {
      parts.push(`${k === from || lift(k) ? "M" : "L"}${this.toX(xs[k]).toFixed(2)} ${this.toY(ys[k]).toFixed(2)}`);
    }
    return parts.join("");
  }
}
