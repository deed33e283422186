/** The legend: what each colour and pattern in view means, with shares. Pointing at a row or clicking it isolates its motions. */

import { ColourBar } from "./colourbar.js";
import { colourChoice } from "./colourchoice.js";
import { groupOf, groupText } from "./colours.js";
import { element, paint, swatch } from "./dom.js";
import { extremes, shares } from "./shares.js";
import { percent } from "./ticks.js";
import { rangeFor } from "./values.js";
import { labelText, legendText } from "./words.js";

/** Maximum number of motions listed separately; if there are more, those of groups with several labels are listed together. */
const SHOWN = 14;
/** Number of motions of a group that are named in its row. */
const NAMED = 3;

/**
 * A row of the legend.
 * @typedef {object} Row
 * @property {string} key
 * @property {Set<number>} ids the motions
 * @property {string} name
 * @property {string} title
 * @property {number} share
 * @property {string[]} colours
 * @property {string} pattern
 */

export class Legend {
  /**
   * @param {HTMLElement} host
   * @param {import("./tileview.js").TileView} view
   * @param {import("./state.js").Store} store
   * @param {boolean} [main] whether it chooses what the colours are, for all views
   */
  constructor(host, view, store, main = false) {
    Object.assign(this, { host, view, store, pinned: null, all: false });
    this.bar = new ColourBar(view, store, main);
    this.list = element("ul", { class: "legend-list" });
    this.others = element("ul", { class: "legend-list legend-other" });
    this.more = element("button", { type: "button", class: "quiet", hidden: true, onclick: () => this.toggleAll() });
    this.note = element("p", { class: "note" });
    if (main) colourChoice(host, store);
    host.append(this.bar.box, this.list, this.others, this.more, this.note);
    this.items = new Map();
    view.addEventListener("tiles", () => this.soon());
    view.addEventListener("view", () => this.soon());
    store.on(["range", "colour", "of"], () => this.soon());
  }

  soon() {
    if (this.timer) return;
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.refresh();
    }, 150);
  }

  toggleAll() {
    this.all = !this.all;
    this.refresh();
  }

  refresh() {
    const { view } = this;
    if (!view.source || !view.sized || !view.progress) return;
    if (view.source.quantity) {
      this.refreshValues();
      return;
    }
    this.bar.refresh();
    this.title("Motions in view");
    this.list.hidden = false;
    const { counts, coarse } = shares(view);
    const total = [...counts.values()].reduce((sum, n) => sum + n, 0);
    this.fillOthers();
    if (!total) {
      const nothing = view.progress.all === 0;
      // an earlier picture is still shown
      if (!nothing) return;
      this.note.textContent = "No legal values in view.";
      this.fill([]);
      this.more.hidden = true;
      return;
    }
    const motions = [...counts].map(([id, n]) => ({ id, share: n / total, ...view.source.look(id) }))
      .sort((a, b) => b.share - a.share);
    const many = motions.length > SHOWN;
    this.fill(many && !this.all ? this.grouped(motions) : motions.map((motion) => this.single(motion)));
    this.more.hidden = !many;
    this.more.textContent = this.all ? "fewer rows" : `all ${motions.length} motions`;
    this.note.textContent = coarse ? "Shares so far; not all of it is computed." : "";
  }

  title(text) {
    const heading = this.host.querySelector("h2");
    if (heading && heading.textContent !== text) heading.textContent = text;
  }

  /** Shows the colours of a quantity: their range for the values in view, and what has no value. */
  refreshValues() {
    const { view } = this;
    const { quantity } = view.source;
    this.title("Values in view");
    const { low, high, missing, coarse } = extremes(view);
    const key = `${quantity.name} ${quantity.factor}`;
    // a range of another quantity, or in other units, says nothing about this one
    const before = this.rangeOf === key ? this.fitted : null;
    // until the view is there, the range does not become smaller
    const [least, most] = coarse && before ? [Math.min(before[0], low * quantity.factor), Math.max(before[1], high * quantity.factor)] : [low * quantity.factor, high * quantity.factor];
    this.fitted = rangeFor(before, least, most);
    this.rangeOf = key;
    const range = this.store.state.range ?? this.fitted;
    if (JSON.stringify(range) !== JSON.stringify(view.range)) {
      view.range = range;
      view.draw();
    }
    this.list.hidden = true;
    this.more.hidden = true;
    this.fillOthers();
    this.note.textContent = coarse ? "Values so far; not all of it is computed." : "";
    this.bar.refresh([...missing].sort());
  }

  /** @returns {Row} */
  single({ id, name, remark, share, colour }) {
    const open = this.view.progress.done < this.view.progress.all;
    const text = legendText(name, open ? null : this.view.source.impacts) + (remark ? `, ${remark}` : "");
    const pattern = name === "undecided" ? "undecided" : "";
    return { key: String(id), ids: new Set([id]), name: text, title: "", share, colours: [colour], pattern };
  }

  /** Rows in which the motions of each group with several labels are together. @returns {Row[]} */
  grouped(motions) {
    const rows = new Map();
    for (const motion of motions) {
      const group = groupOf(motion.name);
      rows.set(group, [...(rows.get(group) ?? []), motion]);
    }
    return [...rows].map(([group, of]) => (of.length > 1 ? this.together(group, of) : this.single(of[0])))
      .sort((a, b) => b.share - a.share);
  }

  together(group, motions) {
    const names = [...new Set(motions.map(({ name }) => labelText(name)))];
    const left = names.length - NAMED;
    const share = motions.reduce((sum, motion) => sum + motion.share, 0);
    const list = names.slice(0, NAMED).join(", ") + (left > 0 ? ` and ${left} more` : "");
    const name = names.length > 1 ? `${groupText(group)}: ${list}` : `${legendText(motions[0].name, null)}, ${motions.length} cycles`;
    return {
      key: group, ids: new Set(motions.map(({ id }) => id)), name, title: names.join(", "), share,
      colours: motions.map(({ colour }) => colour), pattern: "",
    };
  }

  /** Updates the rows. Those that remain are reused, so that the focus is not lost. @param {Row[]} rows */
  fill(rows) {
    const left = new Map(this.items);
    this.items.clear();
    rows.forEach((row, place) => {
      const item = left.get(row.key) ?? this.item(row);
      left.delete(row.key);
      this.items.set(row.key, item);
      item.ids = row.ids;
      item.name.textContent = row.name;
      item.share.textContent = percent(row.share);
      item.button.title = row.title ? `${row.title}: show only these in colour` : "Show only this motion in colour";
      paint(item.patch, row.colours, row.pattern);
      if (this.list.children[place] !== item.row) this.list.insertBefore(item.row, this.list.children[place] ?? null);
    });
    for (const [key, { row }] of left) {
      row.remove();
      if (key === this.pinned) this.pin(key);
    }
  }

  /** What is no motion: places that are not computed, and values without an oscillator or a start. */
  fillOthers() {
    const { view } = this;
    const [[left, top], [right, bottom]] = [view.viewport.toPlane(0, 0), view.viewport.toPlane(view.viewport.width, view.viewport.height)];
    const { x, y } = view.source.legal;
    const beyond = left < x[0] || right > x[1] || bottom < y[0] || top > y[1];
    const rows = [];
    if (view.progress.seen < view.progress.all && view.supply.blank()) rows.push(["blank", "not computed yet"]);
    if (beyond) rows.push(["impossible", view.source.beyond ?? "impossible values"]);
    const key = rows.join();
    if (key === this.shownOthers) return;
    this.shownOthers = key;
    this.others.replaceChildren(...rows.map(([pattern, name]) =>
      element("li", { class: "legend-item" }, swatch([], pattern), element("span", { class: "legend-name", text: name }))));
  }

  item({ key, colours, pattern }) {
    const patch = swatch(colours, pattern);
    const name = element("span", { class: "legend-name" });
    const share = element("span", { class: "legend-share" });
    const show = () => this.point(item.ids);
    const back = () => this.point(this.items.get(this.pinned)?.ids ?? null);
    const button = element("button", {
      type: "button", class: "legend-item", "aria-pressed": "false",
      onmouseenter: show, onmouseleave: back, onfocus: show, onblur: back, onclick: () => this.pin(key),
    }, patch, name, share);
    const item = { row: element("li", {}, button), patch, name, share, button, ids: new Set() };
    return item;
  }

  pin(key) {
    this.pinned = this.pinned === key ? null : key;
    for (const [of, { button }] of this.items) button.setAttribute("aria-pressed", String(of === this.pinned));
    this.point(this.items.get(this.pinned)?.ids ?? null);
  }

  /** @param {Set<number> | null} ids the motions that keep their colours */
  point(ids) {
    this.view.only = ids;
    this.view.draw();
  }
}
