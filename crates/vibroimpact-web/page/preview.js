/** A small waveform of the motion at the pointer, in the corner of the map away from it. */

import { drawn, element } from "./dom.js";
import { Latest } from "./latest.js";
import { PARAMETERS, legal } from "./parameters.js";
import { systemOf } from "./plans.js";
import { placed } from "./plane.js";
import { range, track } from "./track.js";

/** Milliseconds for which the pointer must rest. */
const REST = 250;
/** Budget of impacts and number of periods: little work for the server. */
const IMPACTS = 200;
const PERIODS = 2;
/** Size of the drawing in its own units. */
const [WIDE, HIGH] = [200, 64];

/** @param {import("./plane.js").Plane} plane @param {import("./state.js").Store} store */
export function preview(plane, store) {
  const { view } = plane;
  const svg = drawn("svg", { class: "plot", viewBox: `0 0 ${WIDE} ${HIGH}`, preserveAspectRatio: "none" });
  const box = element("div", { id: "preview", hidden: true, "aria-hidden": "true" }, svg,
    element("p", { class: "soft", text: "two periods, settled" }));
  view.host.after(box);
  let timer = 0;
  // the motion at the pointer is no question of the user, so nothing is reported if it has no answer
  const asked = new Latest(async ({ plan, side }, signal) => {
    const shown = await track(plan, PERIODS, signal);
    if (signal.aborted) return;
    paint(svg, shown);
    box.dataset.side = side;
    box.hidden = false;
  }, () => {});
  const hide = () => {
    clearTimeout(timer);
    asked.stop();
    box.hidden = true;
  };
  view.addEventListener("hover", ({ detail: px }) => {
    hide();
    if (!view.viewport.holds(px)) return;
    timer = setTimeout(() => {
      const { state } = store;
      const [x, y] = view.viewport.toPlane(...px);
      if (!legal(PARAMETERS[state.x], x) || !legal(PARAMETERS[state.y], y)) return;
      const here = { ...state, ...placed(state, x, y) };
      const plan = { version: 1, system: systemOf(here), task: { settle: { start: {}, impacts: IMPACTS } } };
      asked.ask({ plan, side: px[0] < view.viewport.width / 2 ? "right" : "left" }, true);
    }, REST);
  });
  view.host.addEventListener("pointerdown", hide);
  view.host.addEventListener("wheel", hide, { passive: true });
}

function paint(svg, { time, position, stops, duration }) {
  const [low, high] = range([...position, ...stops.slice(0, 1)]);
  const size = high - low || 1;
  const [x, y] = [(t) => (WIDE * t) / duration, (at) => 4 + (HIGH - 8) * (1 - (at - low) / size)];
  const line = time.map((t, k) => `${k ? "L" : "M"}${x(t).toFixed(1)} ${y(position[k]).toFixed(1)}`).join("");
  svg.replaceChildren(
    ...stops.map((at) => drawn("g", { class: "stop" }, drawn("path", { d: `M0 ${y(at)}H${WIDE}`, "vector-effect": "non-scaling-stroke" }))),
    drawn("path", { class: "motion", d: line, "vector-effect": "non-scaling-stroke" }),
  );
}
