/**
 * The cycles of a basin: their numbers, names and colours. Several cycles can share a label. Each is then named with the phase of
 * its fastest impact, and has the colour of its place among these phases, so that neither depends on which tile was there first.
 */

/** Numbers of cycles begin here, above all codes of labels. */
export const CYCLES = 2_000_000_000;

/** Cycles whose impacts differ by less are the same: what different tiles compute differs by rounding. */
const SAME = 1e-6;

/** The largest number of digits of a phase in a name. */
const DIGITS = 6;

/** The colour of the k-th cycle of a label, as in figures: alternately darker and lighter. */
function shade(colour, k) {
  const towards = k % 2 ? 0 : 255;
  const part = 1 - 0.6 ** Math.ceil(k / 2);
  const rgb = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
  return `#${rgb.map((v) => Math.round(v + part * (towards - v)).toString(16).padStart(2, "0")).join("")}`;
}

/** The place of a phase in the order; phases just below a full turn are 0 but for rounding. */
const place = ({ phase }) => ((phase ?? 0) + SAME) % (2 * Math.PI);

export class Cycles {
  constructor() {
    this.list = [];
  }

  /** @returns {number} the number of a cycle, by which tiles know it; they follow the order in which cycles appear */
  number({ label, phase, velocity, colour }) {
    const same = (a, b) => Math.abs(a - b) <= SAME * Math.max(1, Math.abs(a));
    const alike = (c) => c.label === label && same(c.velocity, velocity) && same(Math.cos(c.phase), Math.cos(phase))
      && same(Math.sin(c.phase), Math.sin(phase));
    let at = this.list.findIndex(alike);
    if (at < 0) at = this.list.push({ label, phase, velocity, colour }) - 1;
    return CYCLES + at;
  }

  /** @returns {{name: string, remark: string, colour: string}} the label, what tells it from others with this label, and its colour */
  look(id) {
    const own = this.list[id - CYCLES];
    const twins = this.list.filter(({ label }) => label === own.label)
      .sort((a, b) => place(a) - place(b) || a.velocity - b.velocity);
    return { name: own.label, remark: remark(own, twins), colour: shade(own.colour, twins.indexOf(own)) };
  }
}

/** The phase of the fastest impact with as many digits as tell it from those of other cycles; with equal phases its speed too. */
function remark(own, twins) {
  if (twins.length < 2) return "";
  const others = twins.filter((other) => other !== own);
  const text = (cycle, digits) => (cycle.phase ?? 0).toFixed(digits);
  const differs = (digits) => others.every((other) => text(other, digits) !== text(own, digits));
  for (let digits = 2; digits <= DIGITS; digits++) {
    if (differs(digits)) return `phase ${text(own, digits)}`;
  }
  return `phase ${text(own, 2)}, speed ${(own.velocity ?? 0).toPrecision(DIGITS)}`;
}
