/** What belongs to the address of the page: its title, the button that copies the link, undo and redo. */

import { byId } from "./dom.js";
import { PARAMETERS } from "./parameters.js";
import { short } from "./ticks.js";

/** The state of the page as a title, so that tabs, bookmarks and the history tell views apart. */
function titleOf(state, [left, right, bottom, top]) {
  const [x, y] = [PARAMETERS[state.x].symbol, PARAMETERS[state.y].symbol];
  const parts = [`${x} ${short(left)} to ${short(right)}`, `${y} ${short(bottom)} to ${short(top)}`];
  if (state.x !== "restitution" && state.y !== "restitution") parts.push(`ε ${short(state.restitution)}`);
  if (state.line && state.panel === "line") parts.push("bifurcation diagram");
  else if (state.point) parts.push(`point 1/β ${short(state.inverse_beta)}, δ ${short(state.gap)}`);
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
