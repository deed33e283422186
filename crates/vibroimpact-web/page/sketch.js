/** A sketch of the oscillator, and what each symbol means, with its present value. */

import { byId, drawn, element } from "./dom.js";
import { PARAMETERS, valueOf } from "./parameters.js";
import { startOf } from "./plans.js";
import { short } from "./ticks.js";

const text = (x, y, said, kind = "", anchor = "middle") => drawn("text", { x, y, "text-anchor": anchor, class: kind, text: said });
const line = (d, kind = "") => drawn("path", { d, class: kind });

/** A hatched edge from (x, y0) to (x, y1), with its hatching at the side of `towards`. */
function edge(x, y0, y1, towards) {
  const marks = [];
  for (let y = y0 + 6; y <= y1; y += 9) marks.push(`M${x} ${y}l${7 * towards} -7`);
  return drawn("g", { class: "ground" }, line(`M${x} ${y0}V${y1}${marks.join("")}`));
}

/** A length between two abscissas, with a symbol over it. */
function length(x0, x1, y, symbol) {
  const head = (x, to) => `M${x} ${y}l${6 * to} -3.5M${x} ${y}l${6 * to} 3.5`;
  return drawn("g", {}, line(`M${x0} ${y}H${x1}${head(x0, 1)}${head(x1, -1)}`, "measure"), text((x0 + x1) / 2, y - 6, symbol, "symbol"));
}

/** The drawing: the mass between spring and damper on the left and the stop on the right. */
function figure(second) {
  const [left, mass, stop, middle] = [28, 170, 330, 110];
  const coil = Array.from({ length: 10 }, (_, k) => `L${54 + 9 * k} ${middle - 26 + (k % 2 ? 9 : -9)}`).join("");
  const parts = [
    edge(left, 60, 170, -1),
    line(`M${left} ${middle - 26}H45${coil}L${mass - 26} ${middle - 26}H${mass}`, "spring"),
    text(94, middle - 44, "spring", "word"),
    // the damper: a cylinder and a piston
    line(`M${left} ${middle + 30}H80M80 ${middle + 18}V${middle + 42}M76 ${middle + 14}H112M76 ${middle + 46}H112M76 ${middle + 14}V${middle + 46}M98 ${middle + 18}V${middle + 42}M98 ${middle + 30}H${mass}`, "spring"),
    text(94, middle + 64, "damper ζ", "word"),
    drawn("rect", { x: mass, y: 68, width: 86, height: 84, rx: 3, class: "mass" }),
    text(mass + 43, 94, "mass", "word on-mass"),
    text(mass + 43, 120, "sin(βτ + φ)", "symbol small on-mass"),
    line(`M${mass + 12} 134h58m-8 -5l8 5l-8 5`, "force"),
    edge(stop, 48, 172, 1),
    text(stop + 14, 96, "stop ε", "word", "start"),
    line(`M${mass + 86} 152V200M${stop} 172V200`, "thin"),
    length(mass + 86, stop, 194, "δ"),
    line(`M${mass + 86} 68V26`, "thin"),
    line(`M${mass + 86} 32h46m-8 -5l8 5l-8 5`, "measure"),
    text(mass + 112, 24, "ξ, velocity ξ′", "symbol small", "start"),
    line(`M20 178H${stop + 60}`, "thin"),
  ];
  if (second) {
    parts.push(line(`M${mass - 34} 30V66M${mass - 34} 30H${mass - 60}`, "ground"), edge(mass - 34, 34, 70, -1),
      text(mass - 40, 24, "second stop ε₂", "word"), line(`M${mass} 68V52`, "thin"), length(mass - 34, mass, 58, "δ₂"));
  }
  return drawn("svg", { class: "sketch", viewBox: "0 0 440 212", role: "img", "aria-label": second
    ? "A mass on a spring and a damper, driven by a force, between a stop on the right and a second stop on the left"
    : "A mass on a spring and a damper, driven by a force, with a stop on the right" }, ...parts);
}

/** The symbols: symbol, description, value. */
function symbols(state) {
  const of = (name) => short(valueOf(state, name));
  const second = state.second ? [
    ["δ₂", "gap of the second stop, at ξ = −δ₂", of("second_gap")],
    ["ε₂", "restitution of the second stop", of("second_restitution")],
  ] : [];
  return [
    ["ξ", "position of the mass, 0 where the spring is free, in units of force over stiffness", ""],
    ["ξ′", "velocity of the mass", ""],
    ["τ", "time; the free mass takes 2π for one vibration", ""],
    ["β", "frequency of the force over the natural frequency", `${of("beta")}, 1/β = ${of("inverse_beta")}`],
    ["φ", "phase of the force at the start, in radians", short(startOf(state).phase)],
    ["δ", "gap: the position of the stop; negative if the stop presses the spring", of("gap")],
    ["ε", "restitution: speed after an impact over the speed before it", of("restitution")],
    ["ζ", "damping ratio of the damper", of("damping")],
    ...second,
    ["m/n", "label of a motion: m impacts in n periods of the force", ""],
  ];
}

/** @param {HTMLElement} host @param {import("./state.js").Store} store */
function sketch(host, store) {
  const show = () => {
    const { state } = store;
    host.replaceChildren(figure(state.second), element("dl", { class: "symbols" },
      ...symbols(state).flatMap(([symbol, words, value]) => [
        element("dt", {}, element("i", { class: "math", text: symbol })),
        element("dd", {}, words, value ? element("span", { class: "value", text: ` ${value}` }) : null),
      ])));
  };
  store.show([...Object.keys(PARAMETERS), "second", "start"], show);
}

/** The sketch in its dialog, and beside the map while no point is chosen. @param {import("./state.js").Store} store */
export function sketches(store) {
  sketch(byId("symbols-body"), store);
  sketch(byId("hint-sketch"), store);
  byId("symbols-button").addEventListener("click", () => byId("symbols").showModal());
}
