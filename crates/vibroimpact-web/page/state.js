/**
 * The state of the page, and its form in the address: everything that a link must restore.
 *
 * @typedef {object} State
 * @property {string} x parameter of the abscissa
 * @property {string} y parameter of the ordinate
 * @property {number[] | null} view window: left, right, bottom, top; null for the initial window
 * @property {number} inverse_beta of the chosen point
 * @property {number | null} beta set if the frequency was given in this form; `inverse_beta` then follows it
 * @property {number} gap
 * @property {number} restitution
 * @property {number} damping
 * @property {boolean} second whether there is a second stop
 * @property {number} second_gap
 * @property {number} second_restitution
 * @property {number} starts per point
 * @property {number} impacts largest budget for each start, at which the picture is complete
 * @property {string | null} colour name of the quantity whose values are the colours; null for a colour of each motion
 * @property {"largest" | "smallest" | "likeliest"} of which of several motions at a point has the colour
 * @property {number[] | null} range values at the ends of the colours, in the units that are shown; null to fit the view
 * @property {boolean} point whether a point is chosen
 * @property {number[] | null} start position, velocity, phase; null for rest
 * @property {number[] | null} basin window of the basin
 * @property {string[]} layers switched on
 * @property {string} panel `point`, `line` or `none`
 * @property {number[] | null} line x and y of its beginning, x and y of its end
 * @property {string} show of the line: `velocity` or `strobe`
 * @property {"start" | "settled"} wave part of the motion in the waveform: from the start, or after the transient
 * @property {"start" | "settled"} portrait part of the motion in the phase portrait
 * @property {number} periods of the force shown in both
 * @property {number[] | null} pin a second point, for comparison: its numbers as in `compare.js`
 * @property {number[] | null} machine mass in kg, stiffness in N/m and force in N, for results in SI units
 * @property {boolean} present whether the page is in presentation mode
 * @property {string} subject name of the panel that the tour and the presentation show
 * @property {number} tour step, 0 for none
 * @property {string | null} theme `light` or `dark` if chosen
 */

import { frequencyAxes } from "./machineplans.js";
import { PARAMETERS, isFrequency, legal, ofSecondStop, reasonAgainst } from "./parameters.js";

/** Maximum number of starts per point. */
export const MOST_STARTS = 16;

/** Budgets of impacts for each start; the last one is the full budget of a verdict. */
export const BUDGETS = [200, 1000, 20000];

/** @returns {number[]} the budgets up to the largest one */
export const budgets = (impacts) => [...BUDGETS.filter((less) => less < impacts), impacts];

export const LAYERS = ["regions", "amplitude", "paper", "stripes", "boundaries"];

/** @type {State} */
export const DEFAULTS = {
  x: "inverse_beta", y: "gap", view: null,
  inverse_beta: 1.3, beta: null, gap: 0.75, restitution: 0.5, damping: 0,
  second: false, second_gap: 2, second_restitution: 0.5,
  starts: 1, impacts: 20000, colour: null, of: "largest", range: null, point: false, start: null, basin: null,
  layers: ["paper", "stripes"], panel: "point", line: null, show: "velocity",
  wave: "start", portrait: "settled", periods: 10, pin: null, machine: null, present: false, subject: "motion", tour: 0, theme: null,
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

/** The parser of each part of the state; it returns `undefined` for an invalid value. */
const READ = {
  x: oneOf(...Object.keys(PARAMETERS)),
  y: oneOf(...Object.keys(PARAMETERS)),
  view: (text) => interval(numbers(text, 4)),
  ...Object.fromEntries(Object.keys(PARAMETERS).map((name) => [name, number(name)])),
  second: flag,
  starts: count(1, MOST_STARTS),
  impacts: (text) => BUDGETS.find((impacts) => impacts === Number(text)),
  colour: (text) => (/^[a-z_]+$/.test(text) ? text : undefined),
  of: oneOf("largest", "smallest", "likeliest"),
  range: (text) => {
    const ends = numbers(text, 2);
    return ends && ends[0] < ends[1] ? ends : undefined;
  },
  point: flag,
  start: (text) => numbers(text, 3),
  basin: (text) => interval(numbers(text, 4)),
  layers: (text) => text.split(",").filter((name) => LAYERS.includes(name)),
  panel: oneOf("point", "line", "none"),
  line: (text) => segment(numbers(text, 4)),
  show: oneOf("velocity", "strobe"),
  wave: oneOf("start", "settled"),
  portrait: oneOf("start", "settled"),
  periods: count(1, 1000),
  pin: (text) => numbers(text, 11),
  machine: (text) => numbers(text, 3)?.every((value) => value > 0) ? numbers(text, 3) : undefined,
  present: flag,
  subject: (text) => (/^[a-z]+$/.test(text) ? text : undefined),
  tour: count(0, 40),
  theme: oneOf("light", "dark"),
};

/** The sentence about a part of an address that is not possible. */
function refusal(name, text) {
  const parameter = PARAMETERS[name];
  const value = Number(text);
  const why = parameter && text !== "" && Number.isFinite(value) ? reasonAgainst(parameter, value) : "";
  if (why) return why;
  return name in READ ? `${name} = ${text} has no meaning.` : `There is no ${name}.`;
}

/**
 * @param {string} hash of an address
 * @param {string[]} [refused] receives a sentence for each part that is not possible
 * @returns {State} its state, with defaults for missing parts and those that are not possible
 */
export function read(hash, refused = []) {
  const state = structuredClone(DEFAULTS);
  for (const [name, text] of new URLSearchParams(hash.replace(/^#/, ""))) {
    const value = READ[name]?.(text);
    if (value !== undefined && value !== null) state[name] = value;
    else refused.push(refusal(name, text));
  }
  if (refused.length) refused.unshift("The link has parts that are not possible. Their usual values are shown instead.");
  if (state.beta !== null) state.inverse_beta = 1 / state.beta;
  if (state.x === state.y || (isFrequency(state.x) && isFrequency(state.y))) {
    Object.assign(state, { x: DEFAULTS.x, y: DEFAULTS.y, view: null });
  }
  Object.assign(state, frequencyAxes(state));
  if (ofSecondStop(state.x) || ofSecondStop(state.y)) state.second = true;
  return state;
}

/** @param {State} state @returns {string} its hash, without parts that have their default values */
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

/** Milliseconds without a new value after which a slider is taken to rest. */
const REST = 150;

/** The state, and the listeners for its changes. */
export class Store {
  /** @param {Location} location @param {History} history */
  constructor(location, history) {
    this.location = location;
    this.history = history;
    this.listeners = [];
    /** Sentences about parts of the link that are not possible. @type {string[]} */
    this.refused = [];
    /** @type {State} */
    this.state = read(location.hash, this.refused);
    /** Number of steps that can be undone, and the number after all that can be redone. */
    this.depth = history.state?.depth ?? 0;
    this.deepest = this.depth;
    this.moved = () => {};
    this.complain = () => {};
    addEventListener("popstate", ({ state }) => {
      this.depth = state?.depth ?? 0;
      this.deepest = Math.max(this.deepest, this.depth);
      const refused = [];
      this.replaceBy(read(location.hash, refused));
      this.moved();
      if (refused.length) this.complain(refused);
    });
  }

  /**
   * @param {string[]} names
   * @param {(state: State, changed: Set<string>) => void} listener called when one of them changes
   * @param {() => void} [meanwhile] called instead while a slider of the map moves; the listener is called when it rests
   */
  on(names, listener, meanwhile = null) {
    this.listeners.push({ names, listener, meanwhile, missed: new Set() });
  }

  /** Calls a listener now, and when one of these parts changes. */
  show(names, listener) {
    this.on(names, listener);
    listener(this.state);
  }

  /**
   * Changes parts of the state.
   * @param {Partial<State>} patch
   * @param {"push" | "replace" | "quiet" | "moving"} how to change the history; `quiet` does not change the address, nor does
   *   `moving`, for a slider of the map
   */
  set(patch, how = "push") {
    const changed = this.changes({ ...this.state, ...patch });
    Object.assign(this.state, patch);
    if (how === "push" || how === "replace") this.address(how);
    this.tell(changed, how === "moving");
  }

  /** @param {"push" | "replace"} how */
  address(how) {
    const hash = write(this.state);
    if (hash === this.location.hash) return;
    const address = this.location.pathname + this.location.search + hash;
    if (how === "push") {
      this.depth++;
      this.deepest = this.depth;
    }
    const step = { depth: this.depth };
    if (how === "push") this.history.pushState(step, "", address);
    else this.history.replaceState(step, "", address);
    this.moved();
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

  tell(changed, moving = false) {
    if (!changed.size) return;
    for (const one of this.listeners) {
      if (!one.names.some((name) => changed.has(name))) continue;
      if (!moving || !one.meanwhile) one.listener(this.state, changed);
      else {
        for (const name of changed) one.missed.add(name);
        one.meanwhile();
      }
    }
    if (moving) this.resume();
  }

  /** When the slider rests, listeners are told what they have missed. */
  resume() {
    clearTimeout(this.resting);
    this.resting = setTimeout(() => {
      for (const one of this.listeners) {
        const { missed } = one;
        one.missed = new Set();
        if (missed.size) one.listener(this.state, missed);
      }
    }, REST);
  }
}
