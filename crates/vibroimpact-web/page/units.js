/** The physical units of a machine, from the server, and the fields for its mass, stiffness and force. */

import { units as askUnits } from "./api.js";
import { byId, element } from "./dom.js";
import { numberField } from "./field.js";
import { Latest } from "./latest.js";
import { valueOf } from "./parameters.js";
import { short } from "./ticks.js";

const NUMBERS = [["mass", "kg"], ["stiffness", "N/m"], ["force", "N"]];
/** The machine of docs/machines-in-si.md. */
const EXAMPLE = [0.8, 12000, 30];

const known = new Map();
const keyOf = ({ machine }) => JSON.stringify(machine);

/** @param {import("./state.js").State} state @returns {{units: object, velocity_m_per_s: number, natural_hz: number} | null} null without a machine */
const unitsOf = (state) => (state.machine ? known.get(keyOf(state)) ?? null : null);

/** A plan whose results are in the units of the machine of the state, if it has one. */
export function inUnits(plan, state) {
  const found = unitsOf(state);
  return found ? { ...plan, units: found.units } : plan;
}

/** The chosen point as a machine: frequency of the force, gaps, natural frequency. */
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
    type: "checkbox", id: "machine", onchange: () => store.set({ machine: on.checked ? EXAMPLE : null }),
  });
  byId("machine-units").append(element("label", { class: "check" }, on, element("span", { text: "results in m, s, N, J, W" })), box);
  const asked = new Latest(async (state, signal) => {
    const [mass_kg, stiffness_n_per_m, force_n] = state.machine;
    known.set(keyOf(state), await askUnits({ mass_kg, stiffness_n_per_m, force_n }, signal));
    said.textContent = machineText(store.state);
    changed();
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
  store.on(["machine", "inverse_beta", "beta", "gap", "second", "second_gap"], show);
  show();
}
