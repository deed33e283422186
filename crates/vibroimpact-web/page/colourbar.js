/** The colour bar: the quantity of a view, its values as colours with ticks, and the values that are no number. */

import { element, swatch } from "./dom.js";
import { numberField } from "./field.js";
import { short, ticks } from "./ticks.js";
import { colours, missingLook } from "./values.js";

/** Part of the bar at each end in which a number begins or ends at its tick. */
const END = 0.05;

export class ColourBar {
  /**
   * @param {import("./tileview.js").TileView} view
   * @param {import("./state.js").Store} store
   * @param {boolean} typed whether the range can be typed here
   */
  constructor(view, store, typed) {
    Object.assign(this, { view, store });
    this.name = element("p", { class: "bar-name" });
    this.bar = element("canvas", { class: "bar-colours", width: 256, height: 1, "aria-hidden": "true" });
    this.ticks = element("div", { class: "bar-ticks", "aria-hidden": "true" });
    this.others = element("ul", { class: "legend-list legend-other" });
    this.fields = [0, 1].map((k) => numberField({
      id: typed ? `colour-${k ? "high" : "low"}` : undefined, label: `${k ? "largest" : "smallest"} value of the colours`,
      check: (value) => {
        const [low, high] = this.view.range ?? [-Infinity, Infinity];
        if (k ? value > low : value < high) return "";
        return k ? `The end must be above ${low}.` : `The beginning must be below ${high}.`;
      },
      set: (value) => {
        const range = [...this.view.range];
        range[k] = value;
        store.set({ range });
      },
    }));
    this.auto = element("button", { type: "button", class: "quiet", id: typed ? "colour-auto" : undefined, text: "Fit to the view", onclick: () => store.set({ range: null }) });
    const row = typed ? element("div", { class: "range" }, this.fields[0].input, element("span", { class: "soft", text: "to" }), this.fields[1].input, this.auto) : null;
    this.box = element("div", { class: "colour-bar", hidden: true }, this.name, this.bar, this.ticks, row,
      ...(typed ? this.fields.map(({ said }) => said) : []), this.others);
    new ResizeObserver(() => this.refresh()).observe(this.box);
  }

  /** Shows the range of the view and the values without a number in it. @param {string[]} missing */
  refresh(missing = this.missing ?? []) {
    const { view } = this;
    const quantity = view.source?.quantity;
    this.box.hidden = !quantity;
    if (!quantity) return;
    this.missing = missing;
    const { description, unit } = quantity;
    this.name.textContent = unit ? `${description} (${unit})` : description;
    this.paint();
    const range = view.range;
    this.auto.hidden = !this.store.state.range;
    this.bar.hidden = !range;
    this.ticks.replaceChildren();
    if (range) {
      const [low, high] = range;
      const wide = this.bar.clientWidth / (parseFloat(getComputedStyle(this.bar).fontSize) || 16);
      this.ticks.replaceChildren(...ticks(low, high, Math.max(2, wide / 3.4)).ticks.map(({ value, text }) => {
        const size = Math.max(Math.abs(low), Math.abs(high));
        const tick = element("span", { text: size >= 1e5 || size < 1e-3 ? short(value) : text });
        const part = (value - low) / (high - low);
        tick.style.left = `${100 * part}%`;
        if (part < END || part > 1 - END) tick.classList.add(part < 0.5 ? "first" : "last");
        return tick;
      }));
      range.forEach((value, k) => this.fields[k].show(value));
      this.bar.setAttribute("data-range", range.join());
    }
    const rows = missing.map((name) => {
      if (name === "undecided") return element("li", { class: "legend-item" }, swatch(missingLook(name).colour, name), element("span", { class: "legend-name", text: name }));
      const { colour, hatch } = missingLook(name);
      const patch = swatch(colour);
      if (hatch) patch.style.backgroundImage = `repeating-linear-gradient(-45deg, transparent 0 2.5px, ${hatch} 2.5px 3.5px)`;
      return element("li", { class: "legend-item" }, patch, element("span", { class: "legend-name", text: name }));
    });
    this.others.replaceChildren(...rows);
  }

  paint() {
    const list = colours();
    if (this.painted === list.length) return;
    this.painted = list.length;
    this.bar.width = list.length || 1;
    const pen = this.bar.getContext("2d");
    list.forEach((colour, k) => {
      pen.fillStyle = colour;
      pen.fillRect(k, 0, 1, 1);
    });
  }
}
