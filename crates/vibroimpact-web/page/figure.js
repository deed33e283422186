/** A figure drawn by the server in the size of its place. Of several requests in quick succession, the newest is shown. */

import { ServerError, figure as askFigure } from "./api.js";
import { element } from "./dom.js";
import { Latest } from "./latest.js";

/** Height of text in the units of a figure, and on the page relative to the text of the page. */
const TEXT = 20;
const SMALLER = 0.77;

export class Figure {
  /**
   * @param {string} title
   * @param {number} ratio height over width
   * @param {(error: Error) => void} failed
   * @param {(() => void) | null} [exported] opens the export of this figure
   */
  constructor(title, ratio, failed, exported = null) {
    this.ratio = ratio;
    this.image = element("img", { alt: "", hidden: true });
    this.sheet = element("div", { class: "sheet" }, this.image);
    this.sheet.style.setProperty("--shape", String(1 / ratio));
    this.said = element("p", { class: "note" });
    this.title = title;
    const button = exported && element("button", {
      type: "button", class: "quiet", text: "Export", "aria-label": `Export ${title.toLowerCase()}`, onclick: exported,
    });
    this.box = element("figure", { class: "figure" },
      element("figcaption", {}, element("h3", { text: title }), button), this.sheet, this.said);
    this.asked = new Latest((question, signal) => this.fetch(question, signal), (error) => this.refused(error, failed));
  }

  /**
   * @param {object} plan
   * @param {{kind?: string, alt: string}} about
   * @param {boolean} [instead] whether to cancel the current request
   */
  show(plan, about, instead = false) {
    this.box.hidden = false;
    this.asked.ask({ plan, about }, instead);
  }

  /** Shows an SVG that is already available. */
  async put(svg, alt) {
    await this.place(new Blob([svg], { type: "image/svg+xml" }), alt);
  }

  /** Width and height to request, in the units of the figure. */
  get size() {
    const css = this.box.getBoundingClientRect().width || 400;
    const text = parseFloat(getComputedStyle(this.box).fontSize) * SMALLER;
    const width = Math.round((css * TEXT) / text);
    return { width, height: Math.round(width * this.ratio) };
  }

  async fetch({ plan, about }, signal) {
    const blob = await askFigure(plan, { format: "svg", ...this.size, kind: about.kind }, signal);
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
    this.box.hidden = true;
    this.clear();
  }
}
