/** The picture sharpens by itself while nothing else is asked: what is being done, the pause button, and the rest while the tab is hidden. */

import { pending } from "./api.js";
import { byId } from "./dom.js";
import { NEXT_STAGE } from "./supply.js";
import { grouped } from "./ticks.js";

/**
 * @param {import("./queue.js").Queue} queue
 * @param {() => import("./tileview.js").TileView[]} views the plane first
 * @param {(error: Error) => boolean} gone whether the server is gone
 */
export function sharpening(queue, views, gone) {
  const button = byId("pause");
  const said = byId("progress");
  let paused = false;
  const [plane] = views();

  const tell = () => {
    if (!plane.progress) return;
    const { all, seen, full, done, impacts } = plane.progress;
    const complete = done >= all;
    byId("plane").toggleAttribute("data-sharp", seen >= all);
    byId("plane").toggleAttribute("data-full", full >= all);
    byId("plane").toggleAttribute("data-complete", complete);
    button.hidden = (complete || seen < all) && !paused;
    button.textContent = paused ? "Sharpen" : "Pause";
    const budget = grouped(impacts || plane.source?.impacts || 0);
    if (!all || complete) said.textContent = all ? `Complete: every point computed, ${grouped(plane.source.impacts)} impacts.` : "";
    else if (seen < all) said.textContent = `First picture: ${seen} of ${all} tiles.`;
    else {
      const sharp = `${full} of ${all} tiles sharp`;
      const filled = `${all - done} of ${all} tiles have filled points`;
      const state = full < all ? sharp : filled;
      if (paused) said.textContent = `Paused: ${state}.`;
      else if (pending.count) said.textContent = `Waiting: ${state}.`;
      else said.textContent = full < all ? `Sharpening, ${budget} impacts: ${sharp}.` : `Sharp; ${filled}.`;
    }
    said.title = seen >= all && !complete ? "Filled points have the motions of their neighbours, which agree. They are computed at last." : "";
  };

  button.addEventListener("click", () => {
    paused = !paused;
    for (const view of views()) {
      view.supply.held = paused;
      view.changed();
    }
    tell();
  });
  plane.addEventListener("tiles", tell);
  // an answer that someone waits for goes first
  pending.listen(() => {
    queue.only(pending.count ? NEXT_STAGE : Infinity);
    tell();
  });
  document.addEventListener("visibilitychange", () => {
    if (gone()) return;
    queue.pause(document.hidden);
    if (!document.hidden) for (const view of views()) if (view.source) view.changed();
  });
  tell();
}
