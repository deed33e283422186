/** What the colours of the map and the basins are: motions, or the values of a quantity; and of which of several motions at a point. */

import { choice, element } from "./dom.js";
import { quantities } from "./values.js";

const OF = { largest: "largest value", smallest: "smallest value", likeliest: "most frequent motion" };

/** Called when the server has told the quantities. */
let heard = () => {};

/** The choice shows the quantities that are known now. */
export const quantitiesKnown = () => heard();

/** @param {HTMLElement} host @param {import("./state.js").Store} store */
export function colourChoice(host, store) {
  const what = element("select", { id: "colour", onchange: () => store.set({ colour: what.value || null, range: null }) });
  const which = choice({ id: "colour-of", onchange: () => store.set({ of: which.value }) }, Object.entries(OF));
  const row = element("label", { class: "row" }, element("span", { text: "of several motions" }), which);
  host.append(element("label", { class: "row" }, element("span", { text: "colour by" }), what), row);
  const show = () => {
    const { colour, of, starts } = store.state;
    if (colour && ![...what.options].some(({ value }) => value === colour)) what.append(element("option", { value: colour, text: colour.replaceAll("_", " ") }));
    document.body.toggleAttribute("data-values", colour !== null);
    what.value = colour ?? "";
    which.value = of;
    row.hidden = !colour || starts === 1;
  };
  heard = () => {
    what.replaceChildren(element("option", { value: "", text: "motion" }),
      ...quantities().map(({ name, description }) => element("option", { value: name, text: description })));
    show();
  };
  store.on(["colour", "of", "starts"], show);
  heard();
}
