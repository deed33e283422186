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
  byId("legend").append(element("p", { id: "starts-note", class: "soft" }, text, " ", button));
  const show = () => {
    const { starts } = store.state;
    text.textContent = starts === 1 ? "Each point of the map shows one start: at rest at the origin, phase 0."
      : `Each point of the map shows ${starts} starts; stripes and the line below the map have their shares.`;
    button.textContent = starts === 1 ? `Shares of ${OFFERED} starts` : "One start";
  };
  store.on(["starts"], show);
  show();
}
