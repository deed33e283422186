/** Zoom to a rectangle that is dragged in the plane, with the button Box or with Shift held. */

import { byId, strokes } from "./dom.js";

/** A rectangle with a side shorter than this number of pixels is ignored. */
const SHORTEST = 8;

export class BoxZoom {
  /**
   * @param {import("./state.js").Store} store
   * @param {import("./plane.js").Plane} plane
   * @param {(text: string) => void} say
   */
  constructor(store, { view }, say) {
    Object.assign(this, { store, view, say, active: false, box: null });
    this.button = byId("box-tool");
    this.button.addEventListener("click", () => this.use(!this.active));
    const before = view.grab;
    view.grab = (px, xy, touch, shift) => (this.active || shift ? this.hold(px) : before?.(px, xy, touch, shift) ?? null);
    view.painters.push((context, viewport, frame) => this.paint(context, frame));
  }

  use(active) {
    this.active = active;
    this.button.setAttribute("aria-pressed", String(active));
    this.view.surface.classList.toggle("draws", active);
    if (active) this.say("Box: drag from one corner of the part to show to the other.");
  }

  hold(px) {
    this.box = [px, px];
    const end = () => {
      this.box = null;
      this.view.draw();
    };
    return {
      move: (at) => {
        this.box = [px, at];
        this.view.draw();
      },
      up: (at) => {
        end();
        this.zoom(px, at);
        this.use(false);
      },
      cancel: end,
    };
  }

  zoom([ax, ay], [bx, by]) {
    if (Math.min(Math.abs(ax - bx), Math.abs(ay - by)) < SHORTEST) return;
    const { viewport: v } = this.view;
    const [left, top] = v.toPlane(Math.min(ax, bx), Math.min(ay, by));
    const [right, bottom] = v.toPlane(Math.max(ax, bx), Math.max(ay, by));
    // rounded to a tenth of a pixel of the new view
    const round = (value, size) => Number(value.toFixed(Math.min(17, Math.max(0, Math.ceil(3.5 - Math.log10(size))))));
    const [wide, high] = [right - left, top - bottom];
    this.store.set({ view: [round(left, wide), round(right, wide), round(bottom, high), round(top, high)] });
  }

  paint(context, frame) {
    if (!this.box) return;
    const [[ax, ay], [bx, by]] = this.box;
    strokes(context, [[3.5, "#ffffff"], [1.5, "#000000"]], (width) => {
      context.setLineDash(width > 2 ? [] : [0.5 * frame.em, 0.3 * frame.em]);
      context.rect(Math.min(ax, bx), Math.min(ay, by), Math.abs(bx - ax), Math.abs(by - ay));
    });
    context.setLineDash([]);
  }
}
