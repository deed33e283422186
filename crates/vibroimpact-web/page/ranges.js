/** Fields for the ends of both axes of the plane. */

import { byId, element } from "./dom.js";
import { numberField } from "./field.js";
import { givenValue, shownAs, titled } from "./units.js";

/** Names of the ends of the axes, in the order of a window. */
const ENDS = ["left end", "right end", "lower end", "upper end"];

/** The end of an axis in the units that are shown, with as many digits as a pixel needs. */
function shownEnd({ factor }, value, pixel) {
  if (factor === 1) return value;
  return Number((value * factor).toFixed(Math.min(20, Math.max(0, Math.ceil(-Math.log10(pixel * factor)) + 2))));
}

/** @param {import("./state.js").Store} store @param {import("./plane.js").Plane} plane */
export function ranges(store, plane) {
  const { view } = plane;
  const axisOf = (k) => shownAs(store.state, store.state["xy"[k >> 1]]);
  const shown = (window) => window.map((value, k) => shownEnd(axisOf(k), value, k < 2 ? view.viewport.hx : view.viewport.hy));
  const fields = ENDS.map((end, k) => numberField({
    id: `range-${k}`, label: `${end} of the axis`,
    check: (value) => {
      const other = shown(view.viewport.window())[k ^ 1];
      if (k % 2 === 0 ? value < other : value > other) return "";
      return k % 2 === 0 ? `The ${end} must be below ${other}.` : `The ${end} must be above ${other}.`;
    },
    set: (value) => {
      const window = view.viewport.window();
      window[k] = givenValue(axisOf(k), value);
      store.set({ view: window });
    },
  }));
  const symbols = [0, 1].map(() => element("i", { class: "math" }));
  const row = (k) => element("div", { class: "range" }, symbols[k], fields[2 * k].input, element("span", { class: "soft", text: "to" }), fields[2 * k + 1].input);
  byId("ranges").append(row(0), row(1), ...fields.map(({ said }) => said));
  const show = () => {
    if (!view.sized || !view.source) return;
    symbols.forEach((symbol, k) => {
      symbol.textContent = titled(axisOf(2 * k));
    });
    shown(view.viewport.window()).forEach((value, k) => fields[k].show(value));
  };
  view.addEventListener("tiles", show);
  view.addEventListener("view", show);
  store.show(["x", "y", "view", "machine"], show);
}
