/** The clock of the animation: play, slow motion, one impact after the other, and the position in time. It never starts by itself. */

import { choice, element } from "./dom.js";
import { short } from "./ticks.js";

/** Seconds for a forcing period at each speed. */
const SPEEDS = [[16, "slowest"], [6, "slow"], [2.5, "medium"], [1, "fast"], [0.3, "fastest"]];

export class Player extends EventTarget {
  constructor() {
    super();
    Object.assign(this, { track: null, time: 0, playing: false, repeats: false });
    this.play = element("button", { type: "button", class: "play", text: "Play", onclick: () => (this.playing ? this.pause() : this.begin()) });
    this.step = element("button", { type: "button", text: "Next impact", onclick: () => this.toImpact() });
    this.speed = choice({ "aria-label": "Speed of the animation" }, SPEEDS);
    this.speed.value = "2.5";
    this.slider = element("input", {
      type: "range", min: 0, max: 1, step: "any", "aria-label": "Time in the animation", class: "time",
      oninput: () => this.go(Number(this.slider.value)),
    });
    this.said = element("p", { class: "readout now" });
    this.box = element("div", { class: "player" },
      element("div", { class: "controls" }, this.play, this.step, element("label", { class: "speed" }, this.speed)), this.slider, this.said);
  }

  /** @param {import("./track.js").Track} track @param {boolean} repeats whether it begins again at its end */
  load(track, repeats) {
    const rest = this.track?.period ? (this.time / this.track.period) : 0;
    this.track = track;
    this.repeats = repeats;
    this.slider.max = String(track.duration);
    this.step.disabled = !track.next(-1);
    // the same number of periods after the beginning, so that a change of a parameter does not move the cursor
    this.go(Math.min(track.duration, rest * track.period));
  }

  begin() {
    if (!this.track) return;
    if (this.time >= this.track.duration) this.go(0);
    this.playing = true;
    this.play.textContent = "Pause";
    let last = performance.now();
    const frame = (now) => {
      if (!this.playing) return;
      // while the page is hidden there are no frames, and the time stands still
      const seconds = Math.min(0.25, Math.max(0, (now - last) / 1000));
      last = now;
      const { duration, period } = this.track;
      const next = this.time + (seconds / Number(this.speed.value)) * period;
      if (next >= duration && !this.repeats) {
        this.go(duration);
        this.pause();
        return;
      }
      this.go(next >= duration ? 0 : next);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  pause() {
    this.playing = false;
    this.play.textContent = "Play";
  }

  toImpact() {
    this.pause();
    const event = this.track?.next(this.time);
    if (event) this.go(event.time);
  }

  go(time) {
    if (!this.track) return;
    this.time = Math.min(this.track.duration, Math.max(0, time));
    const now = this.track.at(this.time);
    this.slider.value = String(this.time);
    const text = this.track.units === "si"
      ? `t ${fixed(this.time, 3)} s   ξ ${fixed(1000 * now.x, 3)} mm   ξ′ ${fixed(now.v, 3)} m/s   force ${fixed(now.force, 2)} F`
      : `τ ${fixed(this.time, 2)}   ξ ${fixed(now.x, 3)}   ξ′ ${fixed(now.v, 3)}   force ${fixed(now.force, 2)}`;
    this.said.textContent = text;
    this.slider.setAttribute("aria-valuetext", `time ${short(this.time)}, position ${short(now.x)}`);
    this.dispatchEvent(new CustomEvent("time", { detail: now }));
  }
}

/** A number with a constant number of decimals, so that it does not jump while it changes. */
function fixed(value, decimals) {
  const size = Math.abs(value);
  if (size >= 1e5 || (size > 0 && size < 1e-3)) return short(value);
  return value.toFixed(decimals).replace("-", "−");
}
