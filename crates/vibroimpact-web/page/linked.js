/** The bifurcation diagram along the line and the map show the same place: a mark in one for the pointer in the other. */

import { element, strokes } from "./dom.js";
import { placed } from "./plane.js";
import { alongLine } from "./plans.js";

/** Largest distance from the line in the map, in pixels, at which its place is marked in the diagram. */
const NEAR = 12;

export class LinkedDiagram {
  /**
   * @param {import("./figure.js").Figure} figure of the diagram
   * @param {import("./state.js").Store} store
   * @param {import("./plane.js").Plane} plane
   */
  constructor(figure, store, plane) {
    Object.assign(this, { figure, store, plane, frame: null, part: null });
    this.mark = element("div", { class: "linked-mark", hidden: true });
    this.said = element("p", { class: "note linked-note", text: "Move the pointer over the diagram to see the place on the map; click to choose it." });
    figure.sheet.append(this.mark);
    figure.sheet.classList.add("linked");
    figure.box.append(this.said);
    figure.sheet.addEventListener("pointermove", (event) => this.show(this.partAt(event), true));
    figure.sheet.addEventListener("pointerleave", () => this.show(null, true));
    figure.sheet.addEventListener("click", (event) => this.choose(this.partAt(event)));
    plane.view.addEventListener("hover", ({ detail }) => this.show(detail && this.partNear(detail), false));
    plane.view.painters.push((context, viewport, frame) => this.paint(context, viewport, frame));
  }

  /** Learns where the frame of the diagram is. @param {string} svg */
  drawn(svg) {
    const root = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
    const frame = root.querySelector("clipPath rect");
    const [, , width, height] = (root.getAttribute("viewBox") ?? "").split(" ").map(Number);
    const number = (name) => Number(frame?.getAttribute(name));
    this.frame = frame && width ? { left: number("x"), top: number("y"), wide: number("width"), high: number("height"), width, height } : null;
    this.show(null, true);
  }

  /** The frame in pixels of the sheet, whose picture keeps its proportions. */
  placeOf({ left, top, wide, high, width, height }) {
    const { width: w, height: h } = this.figure.sheet.getBoundingClientRect();
    const scale = Math.min(w / width, h / height);
    const [x, y] = [(w - scale * width) / 2, (h - scale * height) / 2];
    return { left: x + scale * left, top: y + scale * top, wide: scale * wide, high: scale * high };
  }

  /** The part of the line, from 0 to 1, below the pointer in the diagram; null outside its frame. */
  partAt(event) {
    if (!this.frame || !this.store.state.line) return null;
    const { left, wide } = this.placeOf(this.frame);
    const part = (event.clientX - this.figure.sheet.getBoundingClientRect().left - left) / wide;
    return part >= 0 && part <= 1 ? part : null;
  }

  /** The part of the line next to a pixel of the map; null if it is not near. */
  partNear(px) {
    const { line, panel } = this.store.state;
    if (!this.frame || !line || panel !== "line") return null;
    const { viewport: v } = this.plane.view;
    const [[ax, ay], [bx, by]] = [0, 1].map((part) => v.toPixel(...this.at(part)));
    const [dx, dy] = [bx - ax, by - ay];
    const along = ((px[0] - ax) * dx + (px[1] - ay) * dy) / (dx * dx + dy * dy);
    const part = Math.min(1, Math.max(0, along));
    return Math.hypot(px[0] - ax - part * dx, px[1] - ay - part * dy) < NEAR ? part : null;
  }

  /** The point of the plane at a part of the line. */
  at(part) {
    const both = alongLine(this.store.state).map(({ parameter, from, to }) => [parameter, from + part * (to - from)]);
    const values = Object.fromEntries(both);
    return [values[this.store.state.x], values[this.store.state.y]];
  }

  /** Marks a part of the line; on the map only if the pointer is in the diagram. */
  show(part, fromDiagram) {
    this.part = part;
    this.fromDiagram = fromDiagram;
    this.mark.hidden = part === null;
    if (part !== null) {
      const { left, top, wide, high } = this.placeOf(this.frame);
      Object.assign(this.mark.style, { left: `${left + part * wide}px`, top: `${top}px`, height: `${high}px` });
      const { place, motions } = this.plane.tell(this.plane.view.viewport.toPixel(...this.at(part)));
      this.said.textContent = `${place}   ${motions}`;
    }
    this.plane.view.draw();
  }

  choose(part) {
    if (part === null) return;
    const { state } = this.store;
    const [x, y] = this.at(part);
    this.plane.choose(placed(state, Number(x.toPrecision(12)), Number(y.toPrecision(12))));
  }

  paint(context, viewport, frame) {
    if (this.part === null || !this.fromDiagram || !this.store.state.line) return;
    const [px, py] = viewport.toPixel(...this.at(this.part));
    strokes(context, [[5, "#ffffff"], [2.4, "#b5221b"]], () => context.arc(px, py, 0.5 * frame.em, 0, 2 * Math.PI));
  }
}
