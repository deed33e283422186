/** What belongs to the address of the page: its title, the button that copies the link, undo and redo. */

import { byId } from "./dom.js";
import { valueOf } from "./parameters.js";
import { short } from "./ticks.js";
import { shownAs } from "./units.js";

/** The state of the page as a title, so that tabs, bookmarks and the history tell views apart. */
function titleOf(state, [left, right, bottom, top]) {
  const span = (name, low, high) => {
    const { symbol, unit, factor } = shownAs(state, name);
    return `${symbol} ${short(low * factor)} to ${short(high * factor)}${unit && ` ${unit}`}`;
  };
  const parts = [span(state.x, left, right), span(state.y, bottom, top)];
  if (state.x !== "restitution" && state.y !== "restitution") parts.push(`ε ${short(state.restitution)}`);
  if (state.line && state.panel === "line") parts.push("bifurcation diagram");
  else if (state.point) {
    const of = ["beta", "gap"].map((name) => shownAs(state, state.machine || name !== "beta" ? name : "inverse_beta"));
    parts.push(`point ${of.map(({ name, symbol, unit, factor }) => `${symbol} ${short(valueOf(state, name) * factor)}${unit && ` ${unit}`}`).join(", ")}`);
  }
  if (state.colour) parts.unshift(state.colour.replaceAll("_", " "));
  return `${parts.join(", ")} · vibro explore`;
}

/**
 * @param {import("./state.js").Store} store
 * @param {import("./plane.js").Plane} plane
 * @param {(text: string) => void} tell says a sentence on the page
 */
export function links(store, { view }, tell) {
  const name = () => {
    document.title = titleOf(store.state, view.viewport.window());
  };
  view.addEventListener("view", name);
  view.addEventListener("tiles", name);
  byId("link-button").addEventListener("click", () => copy(location.href, "Link copied.", tell));
  const [undo, redo] = [byId("undo"), byId("redo")];
  undo.addEventListener("click", () => history.back());
  redo.addEventListener("click", () => history.forward());
  const show = () => {
    undo.disabled = store.depth === 0;
    redo.disabled = store.depth >= store.deepest;
    name();
  };
  store.moved = show;
  show();
}

/**
 * Copies a text and says so.
 * @param {string} text
 * @param {string} done the sentence for success
 * @param {(text: string) => void} tell
 */
export async function copy(text, done, tell) {
  try {
    await navigator.clipboard.writeText(text);
    tell(done);
  } catch {
    tell(`The browser does not let the page copy. ${text}`);
  }
}
