/** The panel that the tour or the presentation shows: it comes first, and in a presentation it is the only one. */

import { byId, element } from "./dom.js";

/** @param {import("./state.js").Store} store @param {() => void} resized called when the size of the text has changed */
export function subject(store, resized) {
  const host = byId("point");
  const verdict = host.querySelector(".verdict");
  const order = [...host.children];
  const list = element("select", { id: "subject", "aria-label": "Panel in the presentation", onchange: () => choose(store, list.value) });
  byId("present-bar").append(list,
    element("button", { type: "button", class: "quiet", text: "Leave", "aria-label": "Leave the presentation", onclick: () => store.set({ present: false }) }));
  byId("present-button").addEventListener("click", () => toggle(store));
  let presenting = false;
  const show = () => {
    const { present, tour, point, line, panel } = store.state;
    const name = panel === "line" ? "line" : store.state.subject;
    const boxes = order.filter((box) => box.dataset.name);
    const first = tour || present ? boxes.find((box) => box.dataset.name === name && !box.hidden) : undefined;
    // the comparison has verdicts of its own
    const top = first ? [verdict, first] : [];
    if (first?.dataset.name === "compare") top.shift();
    // only boxes that are in another place are moved, because a box that is moved loses the focus
    const wanted = [...top, ...order.filter((box) => !top.includes(box))];
    const enlarged = byId("large").open;
    if (!enlarged) wanted.forEach((box, k) => host.children[k] !== box && host.insertBefore(box, host.children[k] ?? null));
    for (const box of order) box.toggleAttribute("data-aside", Boolean(present) && !top.includes(box));
    document.body.toggleAttribute("data-present", present);
    byId("present-bar").hidden = !present;
    byId("present-button").setAttribute("aria-pressed", String(present));
    const names = [["map", "Map alone"], ...(line ? [["line", "Line"]] : []),
      ...(point ? boxes.filter((box) => !box.hidden).map((box) => [box.dataset.name, box.querySelector("h3").textContent]) : [])];
    list.replaceChildren(...names.map(([value, text]) => element("option", { value, text })));
    list.value = names.some(([value]) => value === name) ? name : "map";
    document.body.toggleAttribute("data-map-alone", present && list.value === "map" && !tour);
    if (present !== presenting) {
      presenting = present;
      resized();
    }
  };
  store.show(["present", "subject", "tour", "point", "panel", "line", "pin"], show);
  // which panels there are depends on the motion
  new MutationObserver(show).observe(host, { attributes: true, attributeFilter: ["hidden"], subtree: true });
}

function choose(store, name) {
  if (name === "line") store.set({ panel: "line", subject: name });
  else store.set({ panel: "point", subject: name });
}

/** @param {import("./state.js").Store} store */
export function toggle(store) {
  const { present, subject: name, point } = store.state;
  store.set({ present: !present, subject: !present && name === "map" && point ? "motion" : name });
}
