/**
 * A motion over some forcing periods, from the server: points, between which it is interpolated, and events.
 *
 * @typedef {object} TrackEvent
 * @property {"impact" | "stick" | "release" | "graze"} kind
 * @property {number} time
 * @property {"upper" | "lower"} stop
 * @property {number} speed
 * @property {number[]} q
 * @property {number[]} qdot
 */

import { motion } from "./api.js";
import { Cache } from "./cache.js";
import { settlePlan, simulatePlan } from "./plans.js";
import { inUnits } from "./units.js";

/** Number of motions kept. */
const KEPT = 8;

export class Track {
  /** @param {object} answer of the server */
  constructor(answer) {
    Object.assign(this, answer);
    /** @type {TrackEvent[]} */
    this.impacts = this.events.filter(({ kind }) => kind === "impact");
    this.duration = this.time.at(-1) ?? 0;
  }

  /** The number of the last point at or before a time. */
  index(time) {
    let [low, high] = [0, this.time.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.time[middle] <= time) low = middle;
      else high = middle;
    }
    return low;
  }

  /**
   * Position, velocity and force at a time. Between two points the motion is the cubic with their positions and velocities.
   * @param {number} time
   * @returns {{x: number, v: number, force: number, phase: number}}
   */
  at(time) {
    const k = this.index(time);
    const h = this.time[k + 1] - this.time[k];
    const s = h > 0 ? Math.min(1, Math.max(0, (time - this.time[k]) / h)) : 0;
    const [p, q] = [this.position[k], this.position[k + 1] ?? this.position[k]];
    const [v, w] = [this.velocity[k] * h || 0, this.velocity[k + 1] * h || 0];
    const [a, b] = [3 * (q - p) - 2 * v - w, 2 * (p - q) + v + w];
    const x = p + s * (v + s * (a + s * b));
    const speed = h > 0 ? (v + s * (2 * a + 3 * s * b)) / h : this.velocity[k];
    const phase = this.beta * time + this.phase;
    return { x, v: speed, force: Math.sin(phase), phase: phase - 2 * Math.PI * Math.floor(phase / (2 * Math.PI)) };
  }

  /** The first impact or stick after a time; the first one of all if there is none. */
  next(time) {
    const stops = this.events.filter(({ kind }) => kind === "impact" || kind === "stick");
    const later = 1e-9 * Math.max(this.period, this.duration);
    return stops.find((event) => event.time > time + later) ?? stops[0] ?? null;
  }

  /** The smallest and the largest position, and the stops near them. */
  extent() {
    const [low, high] = range(this.position);
    const size = Math.max(high - low, 1e-12);
    const near = this.stops.filter((at) => at > low - size && at < high + size);
    return [Math.min(low, ...near), Math.max(high, ...near)];
  }
}

/** @param {number[]} values @returns {[number, number]} the smallest and the largest */
export function range(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

/** The parts of a motion that are shown: the plan of each, and its name. */
const PLANS = { start: simulatePlan, settled: settlePlan };
export const PARTS = [["start", "from the start"], ["settled", "after the transient"]];

const kept = new Cache(KEPT);

/**
 * A motion, from the server or from memory.
 * @param {object} plan to simulate or to settle
 * @param {number} periods
 * @param {AbortSignal} signal
 * @returns {Promise<Track>}
 */
export async function track(plan, periods, signal) {
  const key = JSON.stringify([plan, periods]);
  const found = kept.get(key) ?? new Track(await motion(plan, periods, signal));
  kept.set(key, found);
  return found;
}

/** A part of the motion of a state, in its units. */
export const trackOf = (state, part, signal) => track(inUnits(PLANS[part](state), state), state.periods, signal);
