/** A figure drawn by the server in the size of its place. Of several requests in quick succession, the newest is shown. */

import { ServerError, figure as askFigure } from "./api.js";
import { debounced, element } from "./dom.js";
import { Latest } from "./latest.js";
import { panel } from "./panel.js";

/** Height of text in the units of a figure, and on the page relative to the text of the page. */
const TEXT = 20;
const SMALLER = 0.77;

/** Largest zoom of an enlarged figure. */
const MOST = 16;

export class Figure {
  /**
   * @param {string} title
   * @param {number} ratio height over width
   * @param {(error: Error) => void} failed
   * @param {(() => void) | null} [exported] opens the export of this figure
   * @param {string} [name] of its panel
   */
  constructor(title, ratio, failed, exported = null, name = "figure") {
    this.ratio = ratio;
    this.scale = 1;
    /** Whether the picture keeps its proportions in a place of any size. */
    this.rigid = false;
    this.image = element("img", { alt: "", hidden: true });
    this.sheet = element("div", { class: "sheet" }, this.image);
    this.sheet.style.setProperty("--shape", String(1 / ratio));
    this.said = element("p", { class: "note" });
    this.title = title;
    this.box = panel(name, title, { exported, zoom: (factor) => this.zoom(factor) }, this.sheet, this.said);
    this.box.classList.add("figure");
    /** @type {(() => void) | null} called when an SVG that was put here no longer has the size of its place */
    this.resized = null;
    this.asked = new Latest((question, signal) => this.fetch(question, signal), (error) => this.refused(error, failed));
    // another size of its place, such as enlarged, needs another picture
    this.again = debounced(() => {
      if (this.image.hidden || this.fits()) return;
      if (this.question) this.asked.ask(this.question);
      else this.resized?.();
    }, 200);
    new ResizeObserver(() => this.again()).observe(this.sheet);
  }

  /**
   * @param {object} plan
   * @param {{kind?: string, alt: string}} about
   * @param {boolean} [instead] whether to cancel the current request
   */
  show(plan, about, instead = false) {
    this.box.hidden = false;
    this.sheet.hidden = false;
    this.question = { plan, about };
    this.asked.ask(this.question, instead);
  }

  /** Shows an SVG that was requested in a `size`. */
  async put(svg, alt, size) {
    this.drawn = size;
    await this.place(new Blob([svg], { type: "image/svg+xml" }), alt);
  }

  /** Width and height to request, in the units of the figure. */
  get size() {
    const { width: css, height } = this.sheet.getBoundingClientRect();
    const text = parseFloat(getComputedStyle(this.box).fontSize) * SMALLER;
    const units = (pixels) => Math.min(4000, Math.max(200, Math.round((pixels * TEXT) / text)));
    const wide = units(css || 400);
    if (this.free && height && !this.rigid) return { width: wide, height: units(height) };
    const width = this.free && height ? Math.min(wide, Math.round(units(height) / this.ratio)) : wide;
    return { width, height: Math.round(width * this.ratio) };
  }

  /** Whether the place has a height of its own: enlarged, in the tour, in a presentation. */
  get free() {
    return getComputedStyle(this.sheet).aspectRatio === "auto";
  }

  /** Whether the picture has the size of its place. */
  fits() {
    const { width, height } = this.size;
    return !this.sheet.getBoundingClientRect().width || (this.drawn?.width === width && this.drawn?.height === height);
  }

  zoom(factor) {
    this.scale = Math.min(MOST, Math.max(1, this.scale * factor));
    this.image.style.width = this.image.style.height = this.scale === 1 ? "" : `${100 * this.scale}%`;
  }

  async fetch({ plan, about }, signal) {
    const { size } = this;
    const blob = await askFigure(plan, { format: "svg", ...size, kind: about.kind }, signal);
    this.drawn = size;
    await this.place(blob, about.alt);
  }

  async place(blob, alt) {
    const address = URL.createObjectURL(blob);
    const next = new Image();
    next.src = address;
    await next.decode();
    const last = this.image.src;
    this.image.src = address;
    this.image.alt = alt;
    this.image.hidden = false;
    this.sheet.hidden = false;
    this.said.textContent = "";
    if (last) URL.revokeObjectURL(last);
    // its place may have another size by now
    this.again();
  }

  refused(error, failed) {
    if (!(error instanceof ServerError)) failed(error);
    this.clear();
    this.sheet.hidden = true;
    this.said.textContent = error.message.split("\n")[0];
  }

  clear() {
    this.image.hidden = true;
    this.said.textContent = "";
  }

  hide() {
    this.asked.stop();
    this.question = null;
    this.box.hidden = true;
    this.clear();
  }
}
