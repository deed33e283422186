/**
 * The state of the page and its place in the address bar: everything that a link must bring back.
 *
 * @typedef {object} State
 * @property {string} x parameter to the right
 * @property {string} y parameter upwards
 * @property {number[] | null} view what is shown: left, right, bottom, top; null for the window shown first
 * @property {number} inverse_beta of the chosen point
 * @property {number | null} beta where the frequency was given so; its inverse then follows it
 * @property {number} gap
 * @property {number} restitution
 * @property {number} damping
 * @property {boolean} second whether there is a second stop
 * @property {number} second_gap
 * @property {number} second_restitution
 * @property {number} starts per point
 * @property {number} impacts to follow each start for
 * @property {boolean} point whether a point is chosen
 * @property {number[] | null} start position, velocity, phase; null for rest
 * @property {number[] | null} basin what the basin shows
 * @property {string[]} layers switched on
 * @property {string} panel `point`, `line` or `none`
 * @property {number[] | null} line across and up where it begins, and where it ends
 * @property {string} show of the line: `velocity` or `strobe`
 * @property {number} tour step, 0 for none
 * @property {string | null} theme `light` or `dark` where chosen
 */

import { PARAMETERS, isFrequency, legal, ofSecondStop } from "./parameters.js";

/** Starts per point at most. */
export const MOST_STARTS = 16;

/** Impacts to follow each start for, at most; the last is what a verdict in full takes. */
export const BUDGETS = [200, 1000, 20000];

/** @returns {number | undefined} the next larger budget */
export const longer = (impacts) => BUDGETS.find((more) => more > impacts);

/** @returns {number[]} the smaller budgets */
export const shorter = (impacts) => BUDGETS.filter((less) => less < impacts);

export const LAYERS = ["regions", "amplitude", "paper", "stripes"];

/** @type {State} */
export const DEFAULTS = {
  x: "inverse_beta", y: "gap", view: null,
  inverse_beta: 1.3, beta: null, gap: 0.75, restitution: 0.5, damping: 0,
  second: false, second_gap: 2, second_restitution: 0.5,
  starts: 1, impacts: 200, point: false, start: null, basin: null,
  layers: ["paper", "stripes"], panel: "point", line: null, show: "velocity", tour: 0, theme: null,
};

const numbers = (text, count) => {
  const list = text.split(",").map(Number);
  return list.length === count && list.every(Number.isFinite) ? list : null;
};

const interval = (list) => (list && list[0] < list[1] && list[2] < list[3] ? list : null);

const segment = (list) => (list && (list[0] !== list[2] || list[1] !== list[3]) ? list : null);

const number = (name) => (text) => (text !== "" && legal(PARAMETERS[name], Number(text)) ? Number(text) : undefined);
const oneOf = (...names) => (text) => (names.includes(text) ? text : undefined);
const count = (least, most) => (text) => {
  const n = Number(text);
  return Number.isInteger(n) && n >= least && n <= most ? n : undefined;
};
const flag = (text) => text === "1";

/** How each part of the state is read; `undefined` is no value. */
const READ = {
  x: oneOf(...Object.keys(PARAMETERS)),
  y: oneOf(...Object.keys(PARAMETERS)),
  view: (text) => interval(numbers(text, 4)),
  ...Object.fromEntries(Object.keys(PARAMETERS).map((name) => [name, number(name)])),
  second: flag,
  starts: count(1, MOST_STARTS),
  impacts: (text) => BUDGETS.find((impacts) => impacts === Number(text)),
  point: flag,
  start: (text) => numbers(text, 3),
  basin: (text) => interval(numbers(text, 4)),
  layers: (text) => text.split(",").filter((name) => LAYERS.includes(name)),
  panel: oneOf("point", "line", "none"),
  line: (text) => segment(numbers(text, 4)),
  show: oneOf("velocity", "strobe"),
  tour: count(0, 20),
  theme: oneOf("light", "dark"),
};

/** @param {string} hash of an address @returns {State} what it says, defaults for the rest */
export function read(hash) {
  const state = structuredClone(DEFAULTS);
  for (const [name, text] of new URLSearchParams(hash.replace(/^#/, ""))) {
    const value = READ[name]?.(text);
    if (value !== undefined) state[name] = value;
  }
  if (state.beta !== null) state.inverse_beta = 1 / state.beta;
  if (state.x === state.y || (isFrequency(state.x) && isFrequency(state.y))) {
    Object.assign(state, { x: DEFAULTS.x, y: DEFAULTS.y, view: null });
  }
  if (ofSecondStop(state.x) || ofSecondStop(state.y)) state.second = true;
  return state;
}

/** @param {State} state @returns {string} its hash, what is as in the defaults left out */
export function write(state) {
  const search = new URLSearchParams();
  for (const name of Object.keys(DEFAULTS)) {
    const value = state[name];
    if (JSON.stringify(value) === JSON.stringify(DEFAULTS[name])) continue;
    if (name === "inverse_beta" && state.beta !== null) continue;
    search.set(name, typeof value === "boolean" ? (value ? "1" : "0") : String(value));
  }
  return search.size ? `#${search.toString().replaceAll("%2C", ",")}` : "";
}

/** The state and those who want to know when it changes. */
export class Store {
  /** @param {Location} location @param {History} history */
  constructor(location, history) {
    this.location = location;
    this.history = history;
    this.listeners = [];
    /** @type {State} */
    this.state = read(location.hash);
    addEventListener("popstate", () => this.replaceBy(read(location.hash)));
  }

  /** @param {string[]} names @param {(state: State, changed: Set<string>) => void} listener called when one changes */
  on(names, listener) {
    this.listeners.push({ names, listener });
  }

  /**
   * Changes parts of the state.
   * @param {Partial<State>} patch
   * @param {"push" | "replace" | "quiet"} how it goes into the history; `quiet` leaves the address alone
   */
  set(patch, how = "push") {
    const changed = this.changes({ ...this.state, ...patch });
    Object.assign(this.state, patch);
    if (how !== "quiet") this.address(how);
    this.tell(changed);
  }

  /** @param {"push" | "replace"} how */
  address(how) {
    const hash = write(this.state);
    if (hash === this.location.hash) return;
    const address = this.location.pathname + this.location.search + hash;
    if (how === "push") this.history.pushState(null, "", address);
    else this.history.replaceState(null, "", address);
  }

  replaceBy(state) {
    const changed = this.changes(state);
    this.state = state;
    this.tell(changed);
  }

  changes(next) {
    const differs = (name) => JSON.stringify(this.state[name]) !== JSON.stringify(next[name]);
    return new Set(Object.keys(DEFAULTS).filter(differs));
  }

  tell(changed) {
    if (!changed.size) return;
    for (const { names, listener } of this.listeners) {
      if (names.some((name) => changed.has(name))) listener(this.state, changed);
    }
  }
}
