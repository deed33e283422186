/** A line in the plane, drawn with the pointer or the keyboard, and the bifurcation diagram along it. */

import { bifurcation } from "./api.js";
import { byId, choice, element, strokes } from "./dom.js";
import { numberField } from "./field.js";
import { Figure } from "./figure.js";
import { Latest } from "./latest.js";
import { LinkedDiagram } from "./linked.js";
import { PARAMETERS, reasonAgainst, valueOf } from "./parameters.js";
import { alongLine, diagramPlan } from "./plans.js";
import { digits } from "./ticks.js";
import { asShown, givenValue, perUnit, shownAs, shownValue } from "./units.js";
import { Viewport } from "./viewport.js";
import { labelText } from "./words.js";

/** Names of events that explain themselves less than others. */
const EVENTS = { flip: "flip (period doubling)" };

/** A line shorter than this number of pixels is ignored. */
const SHORTEST = 12;
/** A line with a smaller slope than this, relative to an axis, is made parallel to that axis. */
const LEVEL = 0.05;

export class LineTool {
  /**
   * @param {import("./state.js").Store} store
   * @param {import("./plane.js").Plane} plane
   * @param {{failed: (error: Error) => void, say: (text: string) => void, exported: (view: string) => void}} parts
   */
  constructor(store, plane, { failed, say, exported }) {
    Object.assign(this, { store, plane, say, active: false, draft: null });
    this.button = byId("line-tool");
    this.button.addEventListener("click", () => this.use(!this.active));
    this.figure = new Figure("Bifurcation diagram", 0.8, failed, () => exported("line"));
    this.figure.resized = () => {
      this.key = null;
      this.refresh();
    };
    this.told = element("p", { class: "place" });
    this.progress = element("progress", { max: "1", value: "0", hidden: true, "aria-label": "Bifurcation diagram" });
    this.show = choice({ id: "show", onchange: (event) => store.set({ show: event.target.value }) },
      [["velocity", "speed of impacts"], ["strobe", "position once a period"]]);
    this.linked = new LinkedDiagram(this.figure, store, plane);
    this.ends = this.endFields();
    this.events = element("section", { class: "events", "aria-label": "Events on the branches", hidden: true });
    byId("line").append(this.told, this.beginnings(), this.ends.box, element("label", { class: "row" }, element("span", { text: "shown" }), this.show),
      this.progress, this.figure.box, this.events,
      element("p", { class: "note", text: "Points: what simulation finds, swept up and down. Lines: branches of orbits, stable solid, neutral dashed and dotted, unstable dashed." }));
    this.asked = new Latest((state, signal) => this.fetch(state, signal), (error) => this.refused(error, failed));
    plane.view.grab = (px, xy) => (this.active ? this.hold(px, xy) : null);
    plane.view.painters.push((context, viewport) => this.paint(context, viewport));
    store.on(["line", "show", "panel", "x", "y", ...Object.keys(PARAMETERS), "second", "machine"], () => this.refresh(), () => this.wait());
  }

  /** Buttons for a line through the chosen point, or through the centre of the map, along either axis. */
  beginnings() {
    this.through = ["y", "x"].map((axis) => element("button", { type: "button", "data-through": axis, onclick: () => this.lay(axis) }));
    return element("div", { class: "buttons" }, ...this.through);
  }

  /** Puts the line through the chosen point, or the centre of the map, from edge to edge. */
  lay(axis) {
    const { state } = this.store;
    const { viewport: v } = this.plane.view;
    const [left, right, bottom, top] = v.window();
    const [x, y] = state.point ? [valueOf(state, state.x), valueOf(state, state.y)] : [Viewport.rounded(v.cx, v.hx), Viewport.rounded(v.cy, v.hy)];
    const line = this.snapped(...(axis === "y" ? [[x, bottom], [x, top]] : [[left, y], [right, y]]));
    // through the point itself, and not through the pixel that it is in
    const exactly = axis === "y" ? { 0: x, 2: x } : { 1: y, 3: y };
    this.store.set({ line: Object.assign(line, exactly), panel: "line" });
  }

  /** Lists the events on the branches, in the order of their values; a click chooses the place. */
  list(listed) {
    const [{ parameter, from: first, to: last }] = alongLine(this.store.state);
    const { symbol, unit, factor } = shownAs(this.store.state, parameter);
    const [from, to] = [first * factor, last * factor];
    const pixel = Math.abs(to - from) / 1e5;
    const events = listed.map(({ value, ...event }) => ({ ...event, value: value * perUnit(this.store.state, parameter) }));
    this.events.hidden = !events.length;
    this.events.replaceChildren(element("h3", { text: "Events on the branches" }), element("ul", {}, ...events.map(({ label, kind, value }) =>
      element("li", {}, element("button", {
        type: "button", class: "quiet", title: `Choose this place. ${symbol} = ${value}${unit && ` ${unit}`}`, onclick: () => this.linked.choose((value - from) / (to - from)),
        text: `${labelText(label)}: ${EVENTS[kind] ?? kind} at ${symbol} = ${digits(value, pixel)}${unit && ` ${unit}`}`,
      })))));
  }

  /** Fields for the coordinates of both ends. */
  endFields() {
    const { store } = this;
    const own = (k) => shownAs(store.state, k % 2 ? store.state.y : store.state.x);
    const names = ["beginning, to the right", "beginning, upwards", "end, to the right", "end, upwards"];
    const fields = names.map((name, k) => numberField({
      label: `line: ${name}`,
      check: (value) => reasonAgainst(own(k), givenValue(own(k), value)),
      set: (value) => {
        const line = [...store.state.line];
        line[k] = givenValue(own(k), value);
        if (line[0] !== line[2] || line[1] !== line[3]) store.set({ line });
      },
    }));
    const row = (word, k) => element("div", { class: "fields" }, element("span", { class: "soft", text: word }), fields[k].input, fields[k + 1].input);
    return { fields, box: element("div", { class: "line-ends" }, row("from", 0), row("to", 2), ...fields.map(({ said }) => said)) };
  }

  use(active) {
    this.active = active;
    this.draft = null;
    this.button.setAttribute("aria-pressed", String(active));
    this.plane.view.surface.classList.toggle("draws", active);
    this.plane.view.entered = active ? (px) => this.entered(px) : null;
    this.plane.view.draw();
    if (active) this.say("Line: drag along the map in any direction, or press Enter at the cross for one end and again for the other.");
  }

  hold(px, xy) {
    this.draft = { px, from: xy, to: xy };
    const end = () => {
      this.draft = null;
      this.plane.view.draw();
    };
    return {
      move: (at, to) => {
        this.draft.to = to;
        this.plane.view.draw();
      },
      up: (at, to, moved) => {
        if (moved && Math.max(Math.abs(at[0] - px[0]), Math.abs(at[1] - px[1])) > SHORTEST) this.finish(xy, to);
        end();
      },
      cancel: end,
    };
  }

  /** Sets one end of the line, then the other, with the keyboard. */
  entered(px) {
    const xy = this.plane.view.viewport.toPlane(...px);
    if (this.draft) {
      this.finish(this.draft.from, xy);
      return;
    }
    this.draft = { px, from: xy, to: null };
    this.say("One end of the line. Move with the arrow keys and press Enter for the other.");
    this.plane.view.draw();
  }

  /** The ends rounded to the accuracy of a pixel, and made parallel to an axis if they are nearly so. */
  snapped(from, to) {
    const { viewport: v } = this.plane.view;
    const { state } = this.store;
    const within = (name, value, pixel) => {
      const { least, most, open } = PARAMETERS[name];
      return Math.min(most, Math.max(open ? pixel : least, Viewport.rounded(value, pixel)));
    };
    const [x0, y0, x1, y1] = [from, to].flatMap(([x, y]) => [within(state.x, x, v.hx), within(state.y, y, v.hy)]);
    const [wide, high] = [Math.abs(x1 - x0) / v.hx, Math.abs(y1 - y0) / v.hy];
    return [x0, y0, wide < LEVEL * high ? x0 : x1, high < LEVEL * wide ? y0 : y1];
  }

  finish(from, to) {
    const line = this.snapped(from, to);
    this.use(false);
    if (line[0] !== line[2] || line[1] !== line[3]) this.store.set({ line, panel: "line" });
  }

  refresh() {
    const { state } = this.store;
    byId("line").removeAttribute("data-stale");
    this.plane.view.draw();
    this.show.value = state.show;
    this.ends.box.hidden = !state.line;
    for (const button of this.through) {
      const { symbol } = shownAs(state, state[button.dataset.through]);
      button.textContent = `Along ${symbol} through ${state.point ? "the chosen point" : "the middle"}`;
    }
    state.line?.forEach((value, k) => this.ends.fields[k].show(shownValue(shownAs(state, k % 2 ? state.y : state.x), value)));
    if (state.panel !== "line" || !state.line) {
      this.asked.stop();
      this.told.textContent = "Press Line above the map, then drag along the map, in any direction. Or begin with one of these lines:";
      if (!state.line) {
        this.figure.hide();
        this.events.hidden = true;
      }
      this.key = null;
      return;
    }
    const parts = alongLine(state).map(({ parameter, from, to }) => {
      const own = shownAs(state, parameter);
      const [a, b] = [from * own.factor, to * own.factor];
      const pixel = Math.abs(b - a) / 1000;
      const words = pixel ? `from ${digits(a, pixel)} to ${digits(b, pixel)}` : `= ${shownValue(own, from)}`;
      return `${own.symbol} ${words}${own.unit && ` ${own.unit}`}`;
    });
    this.told.textContent = parts.join(", ");
    const plan = asShown(diagramPlan(state), state);
    if (JSON.stringify(plan) === this.key) return;
    this.key = JSON.stringify(plan);
    this.asked.ask(plan, true);
  }

  async fetch(plan, signal) {
    this.progress.hidden = false;
    this.progress.removeAttribute("value");
    this.figure.box.hidden = false;
    try {
      const { size } = this.figure;
      const { svg, events } = await bifurcation(plan, size, signal, (part) => {
        this.progress.value = part;
      });
      this.linked.drawn(svg);
      this.list(events ?? []);
      await this.figure.put(svg, `Bifurcation diagram: ${this.told.textContent}`, size);
      this.say("Bifurcation diagram drawn.");
    } finally {
      this.progress.hidden = true;
    }
  }

  /** While a slider of the map moves, only the map is computed. */
  wait() {
    this.asked.stop();
    byId("line").toggleAttribute("data-stale", true);
    this.key = null;
  }

  refused(error, failed) {
    this.key = null;
    failed(error);
  }

  paint(context, viewport) {
    const { state } = this.store;
    const lines = [];
    if (state.line && state.panel === "line") lines.push(state.line);
    if (this.draft) lines.push(this.snapped(this.draft.from, this.draft.to ?? viewport.toPlane(viewport.width / 2, viewport.height / 2)));
    for (const [x0, y0, x1, y1] of lines) {
      const ends = [viewport.toPixel(x0, y0), viewport.toPixel(x1, y1)];
      const [dx, dy] = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
      const length = Math.hypot(dx, dy) || 1;
      // a short mark across each end
      const [sx, sy] = [(-5 * dy) / length, (5 * dx) / length];
      strokes(context, [[5, "#ffffff"], [2.4, "#b5221b"]], () => {
        for (const end of ends) context.lineTo(...end);
        for (const [px, py] of ends) {
          context.moveTo(px - sx, py - sy);
          context.lineTo(px + sx, py + sy);
        }
      });
    }
  }
}
