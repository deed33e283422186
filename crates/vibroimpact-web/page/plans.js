/** The plans sent to the server, made from the state. */

import { PARAMETERS, START } from "./parameters.js";

/** @typedef {import("./state.js").State} State */

/**
 * The oscillator of the chosen point, with some parameters replaced.
 * @param {State} state
 * @param {Record<string, number>} [instead]
 */
export function systemOf(state, instead = {}) {
  const value = (name) => instead[name] ?? state[name];
  const system = {};
  if ("beta" in instead) system.beta = instead.beta;
  else if ("inverse_beta" in instead || state.beta === null) system.inverse_beta = value("inverse_beta");
  else system.beta = state.beta;
  system.gap = value("gap");
  system.restitution = value("restitution");
  system.damping = value("damping");
  if (state.second) {
    system.second_stop = { gap: value("second_gap"), restitution: value("second_restitution") };
  }
  return system;
}

const plan = (system, task) => ({ version: 1, system, task });

/** `first:last:count`, or a list of one value. */
export const over = (first, last, count) => (count === 1 ? [first] : `${first}:${last}:${count}`);

const firstOf = (values) => (Array.isArray(values) ? values[0] : Number(values.split(":")[0]));

/** The quantity whose values are the colours, as a part of a plan. */
const fieldsOf = ({ colour }) => (colour ? { fields: [colour] } : {});

/**
 * A map of the plane over these values.
 * @param {State} state
 * @param {string | number[]} overX
 * @param {string | number[]} overY
 * @param {number} [refine]
 */
export function mapPlan(state, overX, overY, refine) {
  const system = systemOf(state, { [state.x]: firstOf(overX), [state.y]: firstOf(overY) });
  const map = { axes: [{ vary: state.x, over: overX }, { vary: state.y, over: overY }], starts: state.starts, seed: 1, impacts: state.impacts, ...fieldsOf(state) };
  if (refine) map.refine = refine;
  return plan(system, { map });
}

/** The basin of the chosen point over these starts. */
export function basinPlan(state, overX, overY, refine) {
  const basin = { axes: [{ vary: "x", over: overX }, { vary: "v", over: overY }], start: { phase: startOf(state).phase }, impacts: state.impacts, ...fieldsOf(state) };
  if (refine) basin.refine = refine;
  return plan(systemOf(state), { basin });
}

/** @param {State} state @returns {{x: number, v: number, phase: number}} the chosen start; by default at rest */
export function startOf(state) {
  const [lowest, highest] = room(state);
  const [x, v, phase] = state.start ?? [0, 0, 0];
  return { x: Math.min(highest, Math.max(lowest, x)), v, phase };
}

/** @param {State} state @returns {[number, number]} the range of positions of the mass */
export const room = (state) => [state.second ? -state.second_gap : -Infinity, state.gap];

export const settlePlan = (state) => plan(systemOf(state), { settle: { start: startOf(state) } });

export const simulatePlan = (state, periods = state.periods) =>
  plan(systemOf(state), { simulate: { start: startOf(state), impacts: null, periods } });

export const attractorsPlan = (state) => plan(systemOf(state), { attractors: { starts: 200, seed: 1 } });

export const lyapunovPlan = (state) =>
  plan(systemOf(state), { lyapunov: { start: startOf(state), impacts: 20000, transient: 1000, points: 2000 } });

/**
 * The two parameters along the chosen line. The first is the one in which the line is longer on the screen, with rising values.
 * @param {State} state
 * @returns {{parameter: string, from: number, to: number}[]}
 */
export function alongLine(state) {
  const [x0, y0, x1, y1] = state.line;
  const across = { parameter: state.x, from: x0, to: x1 };
  const up = { parameter: state.y, from: y0, to: y1 };
  const length = ({ parameter, from, to }) => {
    const [low, high] = PARAMETERS[parameter].window;
    return Math.abs(to - from) / (high - low);
  };
  const both = length(across) >= length(up) ? [across, up] : [up, across];
  return both[0].from < both[0].to ? both : both.map(({ parameter, from, to }) => ({ parameter, from: to, to: from }));
}

/** The orbit diagram along the chosen line. */
export function diagramPlan(state, count = 400) {
  const [first, second] = alongLine(state);
  const system = systemOf(state, { [first.parameter]: first.from, [second.parameter]: second.from });
  const diagram = { vary: first.parameter, over: over(first.from, first.to, count), direction: "both", show: state.show };
  if (second.from !== second.to) diagram.also = second;
  return plan(system, { diagram });
}

/** The legal range of a parameter in the plane, which must leave room between the stops. */
export function legalRange(state, name) {
  const { least, most } = PARAMETERS[name] ?? START[name];
  if (!state.second) return [least, most];
  if (name === "gap") return [state.y === "second_gap" || state.x === "second_gap" ? 0 : -state.second_gap, most];
  if (name === "second_gap") return [state.x === "gap" || state.y === "gap" ? 0 : -state.gap, most];
  return [least, most];
}

/**
 * The legal part of a window along one axis. Excluded ends of the legal range are avoided.
 * @param {[number, number]} range the result of `legalRange`
 * @param {import("./parameters.js").Coordinate} coordinate
 * @param {number} low
 * @param {number} high
 * @returns {[number, number]}
 */
export function within([least, most], coordinate, low, high) {
  const open = coordinate.open || least !== coordinate.least;
  return [Math.max(low, open ? least + 1e-3 * (high - low) : least), Math.min(most, high)];
}
