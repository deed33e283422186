/** Sliders and fields for parameters on no axis, and controls for axes, starts and budget. */

import { byId, choice, element, throttled } from "./dom.js";
import { numberField } from "./field.js";
import { PARAMETERS, isFrequency, ofSecondStop, patchOf, reasonAgainst, valueOf } from "./parameters.js";
import { BUDGETS, MOST_STARTS } from "./state.js";
import { grouped } from "./ticks.js";
import { givenValue, shownAs, shownValue } from "./units.js";

/** @param {import("./state.js").Store} store */
export function controls(store) {
  axes(store);
  const rows = Object.keys(PARAMETERS).map((name) => parameter(store, name));
  const second = element("input", {
    type: "checkbox", id: "second", onchange: (event) => secondStop(store, event.target.checked),
  });
  byId("parameters").append(
    ...rows.slice(0, 5).map((row) => row.box),
    element("label", { class: "check" }, second, element("span", { text: "second stop, at ξ = −δ₂" })),
    ...rows.slice(5).map((row) => row.box),
  );
  const starts = startsPerPoint(store);
  const impacts = choice({ id: "impacts", onchange: () => store.set({ impacts: Number(impacts.value) }) },
    BUDGETS.map((n) => [n, `${grouped(n)} impacts`]));
  byId("budget").append(
    starts.box,
    element("label", { class: "row" }, element("span", { text: "at most" }), impacts),
  );
  const show = () => {
    const { state } = store;
    second.checked = state.second;
    second.disabled = ofSecondStop(state.x) || ofSecondStop(state.y);
    starts.show();
    impacts.value = String(state.impacts);
    for (const row of rows) row.show();
  };
  store.show(["x", "y", ...Object.keys(PARAMETERS), "second", "starts", "impacts", "machine"], show);
}

function secondStop(store, second) {
  const { state } = store;
  const gap = Math.max(state.second_gap, 0.1 - state.gap);
  store.set(second ? { second, second_gap: gap } : { second });
}

/** The slider of the starts per point. The plane is computed only when it is released, because every start takes equally long. */
function startsPerPoint(store) {
  const said = element("output", { for: "starts" });
  const range = element("input", {
    type: "range", id: "starts", min: 1, max: MOST_STARTS, step: 1,
    oninput: () => {
      said.value = range.value;
    },
    onchange: () => store.set({ starts: Number(range.value) }),
  });
  const box = element("div", { class: "parameter" }, element("label", { for: "starts", text: "starts per point" }), range, said);
  const show = () => {
    range.value = String(store.state.starts);
    said.value = range.value;
  };
  return { box, show };
}

/** The slider and field of a parameter; shown only if it is on no axis. */
function parameter(store, name) {
  const { symbol, words, slider: [from, to, step] } = PARAMETERS[name];
  const own = () => shownAs(store.state, name);
  const live = throttled((value) => store.set(patchOf(name, value), "moving"), 40);
  const commit = (value) => store.set(patchOf(name, value));
  const range = element("input", {
    type: "range", min: from, max: to, step, "aria-label": `${words} ${symbol}`,
    oninput: (event) => {
      field.input.value = String(shownValue(own(), Number(event.target.value)));
      live(Number(event.target.value));
    },
    onchange: (event) => {
      const value = Number(event.target.value);
      // after the last events of the slider
      setTimeout(() => commit(value), 60);
    },
  });
  const field = numberField({
    id: `field-${name}`, label: `${words} ${symbol}`, 
    check: (value) => reasonAgainst(own(), givenValue(own(), value)), set: (value) => commit(givenValue(own(), value)),
  });
  const title = element("label", { for: `field-${name}`, title: words });
  const box = element("div", { class: "parameter" },
    title,
    range, field.input, field.said);
  return { box, show: () => showParameter(store.state, name, { box, range, field, title }) };
}

function showParameter(state, name, { box, range, field, title }) {
  const onAxis = [state.x, state.y].includes(name) || (isFrequency(name) && [state.x, state.y].some(isFrequency));
  const own = shownAs(state, name);
  title.replaceChildren(element("i", { class: "math", text: own.symbol }), ` ${own.words}${own.unit && `, ${own.unit}`}`);
  // a body has a frequency, and not its inverse
  box.hidden = onAxis || name === (state.machine ? "inverse_beta" : "beta") || (ofSecondStop(name) && !state.second);
  const value = valueOf(state, name);
  if (document.activeElement !== range) range.value = String(value);
  field.show(shownValue(own, value));
}

/** The controls that choose the parameter of each axis. */
function axes(store) {
  // their texts are shown below
  const selects = ["x", "y"].map((axis) => choice({
    id: `axis-${axis}`, "aria-label": axis === "x" ? "Parameter to the right" : "Parameter upwards",
    onchange: (event) => turn(store, axis, event.target.value),
  }, Object.keys(PARAMETERS).map((name) => [name, ""])));
  byId("axes").append(selects[0], element("span", { class: "times", text: "×" }), selects[1]);
  const show = () => {
    const { state } = store;
    selects.forEach((select, k) => {
      select.value = state[["x", "y"][k]];
      for (const option of select.options) {
        option.disabled = (ofSecondStop(option.value) && !state.second) || (option.value === "inverse_beta" && state.machine !== null);
        const { symbol, words, unit } = shownAs(state, option.value);
        option.text = `${symbol} ${words}${unit && `, ${unit}`}`;
      }
    });
  };
  store.show(["x", "y", "second", "machine"], show);
}

/** Puts a parameter on an axis. The other axis changes if the combination is not possible. */
function turn(store, axis, name) {
  const { state } = store;
  const [other, had] = axis === "x" ? ["y", state.y] : ["x", state.x];
  const patch = { [axis]: name, view: null, line: null };
  const clash = had === name || (isFrequency(had) && isFrequency(name));
  if (clash) patch[other] = had === name ? state[axis] : isFrequency(state[axis]) ? "gap" : state[axis];
  if (isFrequency(name) && isFrequency(patch[other] ?? had)) patch[other] = "gap";
  store.set(patch);
}
