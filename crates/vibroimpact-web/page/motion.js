/** The panel of the motion: the waveform from the chosen start or after the transient, and beside it the mass that moves. */

import { choice, drawn, element } from "./dom.js";
import { Latest } from "./latest.js";
import { Machine } from "./machine.js";
import { panel } from "./panel.js";
import { Player } from "./player.js";
import { PARTS, trackOf } from "./track.js";
import { Waveform } from "./waveform.js";

/** Numbers of forcing periods to choose from. */
const SPANS = [1, 2, 3, 5, 10, 20, 30, 50, 100, 200, 500];

export class MotionPanel {
  /**
   * @param {import("./state.js").Store} store
   * @param {(error: Error) => void} failed
   * @param {() => void} exported
   */
  constructor(store, failed, exported) {
    this.store = store;
    this.wave = new Waveform({ column: 5.4, height: 0.66, label: "The moving mass, and its waveform: position over time" });
    this.machine = new Machine(this.wave.plot);
    this.player = new Player();
    this.cursor = drawn("path", { class: "cursor" });
    this.dot = drawn("circle", { class: "cursor-dot" });
    this.from = choice({ id: "wave", onchange: (event) => store.set({ wave: event.target.value }) }, PARTS);
    this.periods = choice({ id: "periods", onchange: (event) => store.set({ periods: Number(event.target.value) }) },
      SPANS.map((n) => [n, n === 1 ? "1 period" : `${n} periods`]));
    this.note = element("p", { class: "note" });
    this.box = panel("motion", "Motion and waveform", { exported, zoom: (factor) => this.zoom(factor) },
      element("div", { class: "controls span" },
        element("label", {}, element("span", { class: "visually-hidden", text: "Periods shown" }), this.periods),
        element("label", {}, element("span", { class: "visually-hidden", text: "Part of the motion" }), this.from)),
      this.wave.plot.host, this.note, this.player.box);
    this.wave.plot.painters.push(() => this.paint());
    this.wave.plot.addEventListener("place", ({ detail }) => {
      this.player.pause();
      this.player.go(detail);
    });
    this.player.addEventListener("time", () => this.move());
    this.asked = new Latest((question, signal) => this.fetch(question, signal), (error) => {
      this.note.textContent = error.message.split("\n")[0];
      failed(error);
    });
  }

  /** @param {import("./state.js").State} state of the motion to show */
  show(state) {
    this.from.value = state.wave;
    if (![...this.periods.options].some(({ value }) => Number(value) === state.periods)) {
      this.periods.append(element("option", { value: state.periods, text: `${state.periods} periods` }));
    }
    this.periods.value = String(state.periods);
    this.asked.ask(structuredClone(state));
  }

  async fetch(state, signal) {
    const shown = await trackOf(state, state.wave, signal);
    this.note.textContent = "";
    this.wave.show(shown, true);
    this.player.load(shown, state.wave === "settled");
  }

  stop() {
    this.asked.stop();
    this.player.pause();
  }

  zoom(factor) {
    if (!this.wave.track) return;
    this.wave.plot.zoom(factor, this.player.time);
  }

  paint() {
    const { plot, track: shown } = this.wave;
    if (!shown) return;
    this.machine.stand(shown.stops);
    this.dot.setAttribute("r", String(0.36 * plot.em));
    plot.over.append(this.machine.group, this.cursor, this.dot);
    this.place();
  }

  /** Moves the cursor and the mass, and the window after them. */
  move() {
    const { plot } = this.wave;
    if (!plot.window || !plot.size) return;
    const { time } = this.player;
    const [left, right] = plot.window;
    if (plot.zoomed && (time < left || time > right)) {
      plot.pan((time - left) / (right - left) - (time > right ? 0.1 : 0.9), 0);
      return;
    }
    this.place();
  }

  place() {
    const { plot, track: shown } = this.wave;
    const now = shown.at(this.player.time);
    const [x, y] = [plot.toX(this.player.time), plot.toY(now.x)];
    this.cursor.setAttribute("d", `M${x} ${plot.top}v${plot.high}`);
    this.dot.setAttribute("cx", x);
    this.dot.setAttribute("cy", y);
    this.machine.move(now, x);
  }
}
