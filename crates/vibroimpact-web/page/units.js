/** The physical units of a body, from the server, and the fields for its mass, stiffness and force. */

import { units as askUnits } from "./api.js";
import { byId, element } from "./dom.js";
import { numberField } from "./field.js";
import { Latest } from "./latest.js";
import { exact, frequencyAxes, inMachine, unitOf } from "./machineplans.js";
import { PARAMETERS, START, valueOf } from "./parameters.js";
import { short } from "./ticks.js";
import { quantities } from "./values.js";

const NUMBERS = [["mass", "kg"], ["stiffness", "N/m"], ["force", "N"]];
/** The body of docs/units.md. */
const EXAMPLE = [0.8, 12000, 30];

const known = new Map();
const keyOf = ({ machine }) => JSON.stringify(machine);

/** @param {import("./state.js").State} state @returns {{units: object, velocity_m_per_s: number, natural_hz: number} | null} null without a body */
const unitsOf = (state) => (state.machine ? known.get(keyOf(state)) ?? null : null);

/** A plan whose results are in the units of the body of the state, if it has one. */
export function inUnits(plan, state) {
  const found = unitsOf(state);
  return found ? { ...plan, units: found.units } : plan;
}

/** A plan in the numbers of the body of the state, if it has one. */
export const asShown = (plan, state) => inMachine(plan, state.machine, unitsOf(state));

/** A value of a parameter in the unit that it has in plans in the units of the body of the state, if it has one. */
export function planValue(state, name, value) {
  const found = unitsOf(state);
  const unit = found ? unitOf(name, found) : 1;
  return unit === 1 ? value : exact(value * unit);
}

/** One unit of a parameter in the plan of a diagram, in the units that are shown: a plan has metres, the page millimetres. */
export function perUnit(state, name) {
  const found = unitsOf(state);
  return found && name !== "inverse_beta" ? shownAs(state, name).factor / unitOf(name, found) : 1;
}

/** Coordinates in the units of a body: symbol, name and unit, and one nondimensional unit in them. */
const IN_UNITS = {
  beta: { symbol: "f", words: "frequency of the force", unit: "Hz", factor: ({ natural_hz: natural }) => natural },
  gap: { unit: "mm", factor: ({ units }) => 1000 * units.length_m },
  second_gap: { unit: "mm", factor: ({ units }) => 1000 * units.length_m },
  x: { unit: "mm", factor: ({ units }) => 1000 * units.length_m },
  v: { unit: "m/s", factor: ({ velocity_m_per_s: velocity }) => velocity },
};

const coordinates = new Map();

/**
 * A coordinate as it is shown: with the units of the body, if there is one.
 * @param {import("./state.js").State} state
 * @param {string} name of a parameter, or `x` or `v` of a start
 * @returns {import("./parameters.js").Coordinate & {unit: string, factor: number}} the same object for the same units
 */
export function shownAs(state, name) {
  const found = unitsOf(state);
  const key = `${name} ${found ? keyOf(state) : ""}`;
  if (!coordinates.has(key)) {
    const plain = { ...(PARAMETERS[name] ?? START[name]), name, unit: "", factor: 1 };
    const { factor, ...other } = (found && IN_UNITS[name]) || {};
    coordinates.set(key, factor ? { ...plain, ...other, factor: factor(found) } : plain);
  }
  return coordinates.get(key);
}

/** A value with its digits in the units that are shown, without those of the conversion. */
export const shownValue = ({ factor }, value) => (factor === 1 ? value : Number((value * factor).toPrecision(12)));

/** The value that has this number in the units that are shown. */
export const givenValue = ({ factor }, shown) => shown / factor;

/** A symbol with its unit, if it has one. */
export const titled = ({ symbol, unit }) => (unit ? `${symbol} (${unit})` : symbol);

/** An SI unit as the page shows it, with its size: lengths are in millimetres. */
export const pageUnit = (unit) => (unit === "m" ? { unit: "mm", per: 1000 } : { unit, per: 1 });

/** The quantity whose values are the colours, with its unit and one nondimensional unit in it; null for none. `per` are shown units in one of a plan. */
export function quantityOf(state) {
  const found = unitsOf(state);
  const named = quantities().find(({ name }) => name === state.colour);
  if (!named) return null;
  const { name, description } = named;
  const { unit, per } = found ? pageUnit(named.unit) : { unit: "", per: 1 };
  return { name, description, unit, per, factor: per * (found?.quantities[name] ?? 1), of: state.of };
}

/** The chosen point as a body: frequency of the force, gaps, natural frequency. */
export function machineText(state) {
  const found = unitsOf(state);
  if (!found) return "";
  const { units: { length_m: length }, natural_hz: natural } = found;
  const gaps = [`gap ${short(1000 * length * state.gap)} mm`, state.second ? `second gap ${short(1000 * length * state.second_gap)} mm` : ""];
  return [`Force at ${short(natural * valueOf(state, "beta"))} Hz`, ...gaps.filter(Boolean), `natural frequency ${short(natural)} Hz`,
    `F/k ${short(1000 * length)} mm`].join(", ") + ".";
}

/**
 * The fields.
 * @param {import("./state.js").Store} store
 * @param {(error: Error) => void} failed
 * @param {() => void} changed called when the units have changed
 */
export function units(store, failed, changed) {
  const said = element("p", { class: "note" });
  const fields = NUMBERS.map(([name, unit], k) => numberField({
    id: `machine-${name}`, label: `${name} in ${unit}`,
    check: (value) => (value > 0 ? "" : `The ${name} must be above 0 ${unit}.`),
    set: (value) => store.set({ machine: store.state.machine.map((before, at) => (at === k ? value : before)) }),
  }));
  const box = element("div", {}, ...NUMBERS.map(([name, unit], k) => element("div", { class: "parameter" },
    element("label", { for: `machine-${name}`, text: `${name} in ${unit}` }), fields[k].input, fields[k].said)), said);
  const on = element("input", {
    type: "checkbox", id: "machine",
    // the frequency is an axis of a body, its inverse is none; numbers that are typed for the colours are in other units
    onchange: () => store.set({ ...(on.checked ? frequencyAxes({ ...store.state, machine: EXAMPLE }) : {}), machine: on.checked ? EXAMPLE : null, range: null }),
  });
  byId("machine-units").append(element("label", { class: "check" }, on, element("span", { text: "a body, in mm, Hz, m/s, N, J, W" })), box);
  const asked = new Latest(async (state, signal) => {
    const [mass_kg, stiffness_n_per_m, force_n] = state.machine;
    known.set(keyOf(state), await askUnits({ mass_kg, stiffness_n_per_m, force_n }, signal));
    // everything that is shown in units
    store.tell(new Set(["machine"]));
  }, failed);
  const show = (_, what) => {
    const { state } = store;
    on.checked = state.machine !== null;
    box.hidden = !state.machine;
    state.machine?.forEach((value, k) => fields[k].show(value));
    said.textContent = machineText(state);
    if (state.machine && !known.has(keyOf(state))) asked.ask(structuredClone(state), true);
    else if (what?.has("machine")) changed();
  };
  store.show(["machine", "inverse_beta", "beta", "gap", "second", "second_gap"], show);
}
