/** How many starts each point of the map has, and the button that offers the shares of several starts. */

import { byId, element } from "./dom.js";

/** Number of starts that is offered. */
const OFFERED = 8;

/** @param {import("./state.js").Store} store */
export function mapStarts(store) {
  const text = element("span");
  const button = element("button", {
    type: "button", class: "quiet", id: "more-starts",
    onclick: () => store.set({ starts: store.state.starts > 1 ? 1 : OFFERED }),
  });
  // above the list, which may be longer than its place
  byId("legend").querySelector(":scope > .legend-list").before(element("p", { id: "starts-note", class: "soft" }, text, " ", button));
  const show = () => {
    const { starts, colour } = store.state;
    text.textContent = starts === 1 ? "One start at each point: at rest at the origin, phase 0."
      : `${starts} starts at each point: ${colour ? "" : "stripes and "}the line below the map ${colour ? "has" : "have"} their shares.`;
    button.textContent = starts === 1 ? `Shares of ${OFFERED} starts` : "One start";
  };
  store.show(["starts", "colour"], show);
}
