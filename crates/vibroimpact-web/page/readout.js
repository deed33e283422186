/** The line below the plane: the motions at the pointer or the cross, or the chosen point with all digits of its coordinates. */

import { byId, element, swatch } from "./dom.js";
import { copy } from "./links.js";
import { PARAMETERS, valueOf } from "./parameters.js";
import { shownAs, shownValue } from "./units.js";

export class Readout {
  /**
   * @param {import("./state.js").Store} store
   * @param {import("./plane.js").Plane} plane
   * @param {(text: string) => void} say
   */
  constructor(store, plane, say) {
    Object.assign(this, { store, plane, say, at: null });
    this.host = byId("readout");
    const { view } = plane;
    view.addEventListener("hover", ({ detail }) => this.move(detail));
    view.surface.addEventListener("blur", () => this.move(null));
    view.spoken((px) => plane.tell(px), say);
    // what is under a pointer that rests changes when the view does
    view.addEventListener("drawn", () => this.refresh());
    store.show(["point", "x", "y", "machine", "beta", "second", ...Object.keys(PARAMETERS)], () => this.refresh());
  }

  move(px) {
    this.at = this.plane.view.viewport.holds(px) ? px : null;
    this.refresh();
  }

  refresh() {
    if (this.at && this.plane.view.source) {
      const { place, motions, colours, pattern } = this.plane.tell(this.at);
      const text = `${place} ${motions}`;
      if (text === this.shown) return;
      this.shown = text;
      this.host.replaceChildren(element("span", { class: "place", text: place }), colours.length && !this.plane.view.source.quantity ? swatch(colours, pattern) : "", motions);
      return;
    }
    const { state } = this.store;
    const text = state.point ? this.coordinates(null).replaceAll(", ", "   ") : "Click to choose a point.";
    if (text === this.shown) return;
    this.shown = text;
    const copying = element("button", {
      type: "button", class: "quiet", id: "copy-point", text: "Copy", "aria-label": "Copy the coordinates of the chosen point", onclick: () => this.copy(),
    });
    this.host.replaceChildren(...(state.point ? [copying, ` ${text}`] : [text]));
  }

  /** The coordinates with all their digits: at the pointer, or else of the chosen point. */
  coordinates(at) {
    const { state } = this.store;
    const { viewport: v } = this.plane.view;
    const values = at ? v.toPlane(...at) : [valueOf(state, state.x), valueOf(state, state.y)];
    return [state.x, state.y].map((name, k) => {
      const own = shownAs(state, name);
      return `${own.symbol} = ${shownValue(own, values[k])}${own.unit && ` ${own.unit}`}`;
    }).join(", ");
  }

  /** Copies the coordinates at the pointer or of the chosen point. */
  copy() {
    const { state } = this.store;
    if (!this.at && !state.point) return;
    const text = this.coordinates(this.at);
    copy(text, `Copied: ${text}`, (said) => {
      this.say(said);
      this.shown = null;
      this.host.textContent = said;
    });
  }
}
