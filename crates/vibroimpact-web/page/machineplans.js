/** Plans in the units of a body: the numbers of the body instead of nondimensional ones, as its owner would type them. */

/** Names of parameters of a body in plans, and of those that are pure numbers in both. */
const NAMES = {
  beta: "frequency_hz", gap: "gap_m", second_gap: "second_gap_m", damping: "damping_ratio",
  restitution: "restitution", second_restitution: "second_restitution",
};

/** Significant digits of numbers that are converted. */
const DIGITS = 12;

/** A number that is converted, without the digits of the conversion. */
export const exact = (value) => Number(value.toPrecision(DIGITS));

/** One nondimensional unit of a parameter in the unit of its name. */
export const unitOf = (name, { units, natural_hz: natural }) => ({ beta: natural, gap: units.length_m, second_gap: units.length_m })[name] ?? 1;

/** The numbers of the body at the system of a plan. */
function bodyOf({ beta, inverse_beta: inverse, gap, restitution, damping, second_stop: second }, [mass, stiffness, force], found) {
  const machine = {
    mass_kg: mass, stiffness_n_per_m: stiffness, force_n: force, restitution,
    frequency_hz: exact((beta ?? 1 / inverse) * found.natural_hz), gap_m: exact(gap * found.units.length_m),
  };
  if (damping) machine.damping_ratio = damping;
  if (second) Object.assign(machine, { second_gap_m: exact(second.gap * found.units.length_m), second_restitution: second.restitution });
  return machine;
}

/** A range `first:last:count` or a list in another unit. Its ends have as many digits as its steps need. */
function rangeIn(over, unit, back = 1) {
  if (unit === 1 && back === 1) return over;
  if (Array.isArray(over)) return over.map((value) => exact(value * unit) / back);
  const [first, last, count] = over.split(":").map(Number);
  const decimals = Math.min(20, Math.max(0, Math.ceil(-Math.log10(Math.abs(last - first) * unit)) + 5));
  const end = (value) => Number((value * unit).toFixed(decimals)) / back;
  return `${end(first)}:${end(last)}:${count}`;
}

/**
 * A plan for the body of the state; the same plan if the units are not known, or if what varies is no number of a body.
 * @param {object} plan
 * @param {number[] | null} machine mass, stiffness and force
 * @param {object | null} found the answer about its units
 */
export function inMachine(plan, machine, found) {
  if (!machine || !found) return plan;
  const task = structuredClone(plan.task);
  const parameters = [...(task.map?.axes ?? []), ...(task.diagram ? [task.diagram] : [])].map(({ vary }) => vary);
  if (task.diagram?.also) parameters.push(task.diagram.also.parameter);
  if (parameters.some((name) => !(name in NAMES))) return { ...plan, units: found.units };
  for (const axis of task.map?.axes ?? []) Object.assign(axis, { vary: NAMES[axis.vary], over: rangeIn(axis.over, unitOf(axis.vary, found)) });
  for (const axis of task.basin?.axes ?? []) {
    // positions and velocities of a start are nondimensional in plans
    const unit = { x: found.units.length_m, v: found.velocity_m_per_s }[axis.vary];
    axis.over = rangeIn(axis.over, unit, unit);
  }
  if (task.diagram) {
    const { vary, over, also } = task.diagram;
    Object.assign(task.diagram, { vary: NAMES[vary], over: rangeIn(over, unitOf(vary, found)) });
    if (also) {
      const { parameter, from, to } = also;
      const unit = unitOf(parameter, found);
      task.diagram.also = { parameter: NAMES[parameter], from: exact(from * unit), to: exact(to * unit) };
    }
  }
  return { ...plan, system: { machine: bodyOf(plan.system, machine, found) }, task };
}

/**
 * A frequency axis instead of that of its inverse, with the same part of it in view.
 * @param {import("./state.js").State} state
 * @returns {Partial<import("./state.js").State>} the change
 */
export function frequencyAxes(state) {
  const at = ["x", "y"].findIndex((axis) => state[axis] === "inverse_beta");
  if (!state.machine || at < 0) return {};
  const patch = { ["xy"[at]]: "beta", beta: state.beta ?? 1 / state.inverse_beta, view: null, line: null };
  const ends = state.view?.slice(2 * at, 2 * at + 2);
  if (ends && ends[0] > 0) {
    patch.view = [...state.view];
    patch.view.splice(2 * at, 2, exact(1 / ends[1]), exact(1 / ends[0]));
  }
  return patch;
}
