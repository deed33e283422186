/** The legend: the motions in view with their shares. While one is pointed at, the others are grey. */

import { element, swatch } from "./dom.js";
import { shares } from "./shares.js";
import { longer } from "./state.js";
import { grouped, percent } from "./ticks.js";
import { legendText } from "./words.js";

/** Maximum number of motions listed separately; the others are summed. */
const SHOWN = 14;

export class Legend {
  /**
   * @param {HTMLElement} host
   * @param {import("./tileview.js").TileView} view
   * @param {import("./state.js").Store} store
   */
  constructor(host, view, store) {
    Object.assign(this, { host, view, store, pinned: null, all: false, ids: "" });
    this.list = element("ul", { class: "legend-list" });
    this.more = element("button", { type: "button", class: "quiet", hidden: true, onclick: () => this.toggleAll() });
    this.note = element("p", { class: "note" });
    this.longer = element("button", { type: "button", class: "quiet longer", text: "look longer", onclick: () => this.lookLonger() });
    host.append(this.list, this.more, this.note);
    this.items = new Map();
    view.addEventListener("tiles", () => this.soon());
    view.addEventListener("view", () => this.soon());
    store.on(["impacts"], () => this.refresh());
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

  /** Follows motions that have not settled for more impacts. */
  lookLonger() {
    this.store.set({ impacts: longer(this.store.state.impacts) });
  }

  refresh() {
    if (!this.view.source || !this.view.sized) return;
    const { counts, coarse } = shares(this.view);
    const total = [...counts.values()].reduce((sum, n) => sum + n, 0);
    if (!total) {
      const nothing = this.view.progress?.[1] === 0;
      this.note.textContent = nothing ? "No legal values in view." : "Computing.";
      if (nothing) {
        this.fill([]);
        this.more.hidden = true;
      }
      return;
    }
    const sorted = [...counts].map(([id, n]) => ({ id, share: n / total, ...this.view.source.look(id) }))
      .sort((a, b) => b.share - a.share);
    const shown = this.all || sorted.length <= SHOWN + 1 ? sorted : sorted.slice(0, SHOWN);
    const rest = sorted.slice(shown.length);
    this.fill(shown);
    this.more.hidden = !rest.length && !(this.all && sorted.length > SHOWN + 1);
    const sum = rest.reduce((part, { share }) => part + share, 0);
    this.more.textContent = rest.length ? `${rest.length} others, ${percent(sum)}` : "fewer";
    this.note.textContent = coarse ? "Shares so far; not all of it is computed." : "";
  }

  /** Updates the items. Items that remain are reused, so that the focus is not lost. */
  fill(shown) {
    const left = new Map(this.items);
    this.items.clear();
    shown.forEach((motion, place) => {
      const item = left.get(motion.id) ?? this.item(motion);
      left.delete(motion.id);
      this.items.set(motion.id, item);
      item.name.textContent = this.nameOf(motion);
      item.share.textContent = percent(motion.share);
      item.patch.style.backgroundColor = motion.colour;
      if (this.list.children[place] !== item.row) this.list.insertBefore(item.row, this.list.children[place] ?? null);
    });
    for (const { row } of left.values()) row.remove();
    this.offer(shown.find(({ name }) => name === "undecided"));
  }

  /** The button that increases the budget, next to the item of motions that have not settled. */
  offer(open) {
    const next = longer(this.store.state.impacts);
    if (!next || !open) {
      this.longer.remove();
      return;
    }
    this.longer.title = `Follow what is not settled for ${grouped(next)} impacts`;
    const { row } = this.items.get(open.id);
    if (this.longer.parentElement !== row) row.append(this.longer);
  }

  nameOf({ name, variant }) {
    return legendText(name, this.store.state.impacts) + (variant ? ` (${variant + 1}${["st", "nd", "rd"][variant] ?? "th"})` : "");
  }

  item({ id, colour }) {
    const patch = swatch(colour);
    const name = element("span", { class: "legend-name" });
    const share = element("span", { class: "legend-share" });
    const button = element("button", {
      type: "button", class: "legend-item", "aria-pressed": "false", title: "Show only this motion in its colour",
      onmouseenter: () => this.point(id), onmouseleave: () => this.point(this.pinned),
      onfocus: () => this.point(id), onblur: () => this.point(this.pinned),
      onclick: () => this.pin(id),
    }, patch, name, share);
    return { row: element("li", {}, button), patch, name, share, button };
  }

  pin(id) {
    this.pinned = this.pinned === id ? null : id;
    for (const [of, { button }] of this.items) button.setAttribute("aria-pressed", String(of === this.pinned));
    this.point(this.pinned);
  }

  point(id) {
    this.view.highlight = id;
    this.view.draw();
  }
}
