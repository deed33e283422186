/** The oscillator beside its waveform: the mass moves on the scale of the ordinate, between its spring and the stop. */

import { drawn } from "./dom.js";

/** Turns of the spring. */
const TURNS = 7;

export class Machine {
  /** @param {import("./plot.js").Plot} plot with a column at its left */
  constructor(plot) {
    this.plot = plot;
    this.group = drawn("g", { class: "machine" });
    this.spring = drawn("path", { class: "spring" });
    this.mass = drawn("rect", { class: "mass", rx: 2 });
    this.level = drawn("path", { class: "level" });
    this.force = drawn("path", { class: "force" });
    this.fixed = drawn("g");
    this.group.append(this.fixed, this.spring, this.mass, this.level, this.force);
  }

  /** Draws what does not move: the ground and the stops. */
  stand(stops) {
    const { em, size: [, height], column, top } = this.plot;
    const middle = (column * em) / 2;
    this.side = Math.min(1.9 * em, 0.42 * column * em);
    this.tall = 1.15 * em;
    this.middle = middle;
    this.ground = height - 0.35 * em;
    const hatch = (x, y, wide, up) => {
      const marks = [];
      for (let k = 0; k <= 6; k++) marks.push(`M${x - wide + (k * wide) / 3} ${y}l${-0.3 * em} ${(up ? -0.4 : 0.4) * em}`);
      return drawn("path", { class: "ground", d: `M${x - wide} ${y}h${2 * wide}${marks.join("")}` });
    };
    const inside = (at) => this.plot.toY(at) > top - 1 && this.plot.toY(at) < this.ground - 2 * this.tall;
    this.fixed.replaceChildren(
      hatch(middle, this.ground - 0.3 * em, 0.36 * column * em, false),
      ...stops.filter(inside).map((at, k) => (k === 0
        ? hatch(middle, this.plot.toY(at), 0.36 * column * em, true)
        // the lower stop meets the lower face of the mass
        : hatch(middle, this.plot.toY(at) + this.tall, 0.36 * column * em, false))),
    );
  }

  /** Places what moves. `until` is the abscissa of the cursor, up to which the dashed line goes. */
  move({ x, force }, until) {
    const { em } = this.plot;
    const [face, foot] = [this.plot.toY(x), this.ground - 0.3 * em];
    const low = face + this.tall;
    const { middle, side } = this;
    for (const [name, value] of Object.entries({ x: middle - side, y: face, width: 2 * side, height: this.tall })) {
      this.mass.setAttribute(name, value);
    }
    const step = (foot - low) / (2 * TURNS + 2);
    const turns = Array.from({ length: 2 * TURNS }, (_, k) => `L${middle + (k % 2 ? -0.5 : 0.5) * side} ${low + (k + 1.5) * step}`);
    this.spring.setAttribute("d", `M${middle} ${low}V${low + step}${turns.join("")}L${middle} ${foot - step}V${foot}`);
    this.level.setAttribute("d", `M${middle + side} ${face}H${until}`);
    const [at, long] = [middle - 1.25 * side, -1.7 * em * force];
    const [mid, tip] = [face + this.tall / 2, 0.28 * em * Math.sign(long)];
    this.force.setAttribute("d", Math.abs(long) < 0.3 * em ? ""
      : `M${at} ${mid}v${long}m${-0.25 * em} ${-tip}l${0.25 * em} ${tip}l${0.25 * em} ${-tip}`);
  }
}
