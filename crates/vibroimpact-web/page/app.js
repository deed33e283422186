/** Creates the parts of the page and connects them. */

import { about } from "./api.js";
import { learn } from "./colours.js";
import { controls } from "./controls.js";
import { byId, debounced, swatch } from "./dom.js";
import { Export } from "./export.js";
import { glide } from "./gestures.js";
import { keys } from "./keys.js";
import { Layers } from "./layers.js";
import { Legend } from "./legend.js";
import { LineTool } from "./line.js";
import { Messages } from "./messages.js";
import { Plane } from "./plane.js";
import { Point } from "./point.js";
import { Store } from "./state.js";
import { theme } from "./theme.js";
import { Cache, Queue } from "./tiles.js";
import { tour } from "./tour.js";

const store = new Store(location, history);
const queue = new Queue(3);
const messages = new Messages(() => {
  queue.pause(false);
  plane.view.retry();
  point.basin.view.retry();
  point.shown = null;
  point.refresh(null);
  line.refresh();
  layers.refresh();
  greet();
});
const failed = (error) => {
  messages.failed(error);
  if (messages.gone) queue.pause(true);
};
const say = (text) => messages.say(text);
const parts = { cache: new Cache(400), queue, failed };

const plane = new Plane(byId("plane"), store, parts);
controls(store);
plane.start();
const legend = new Legend(byId("legend"), plane.view, store);
const exporting = new Export(store, { plane, basin: () => point.basin });
const exported = (view) => exporting.open(view);
const point = new Point(store, plane, parts, say, exported);
const line = new LineTool(store, plane, { failed, say, exported });
const layers = new Layers(plane, store, failed);
keys({ line, plane });
theme(byId("theme-button"), store, () => {
  for (const view of [plane.view, point.basin.view]) {
    view.frame.measure();
    view.draw();
  }
});
panels();
tour(store, say);
toolbar();
readout();
line.refresh();
greet().finally(() => point.refresh(null));

/** Gets the points of the paper and the colours of motions from the server. */
async function greet() {
  try {
    const { points, version, groups } = await about();
    learn(groups ?? []);
    plane.named(points);
    byId("version").textContent = version;
  } catch (error) {
    failed(error);
  }
}

/** Shows the chosen panel beside the plane. */
function panels() {
  const show = () => {
    const { panel, point: chosen } = store.state;
    document.body.dataset.panel = panel;
    for (const button of document.querySelectorAll("[data-panel-button]")) {
      button.setAttribute("aria-pressed", String(button.dataset.panelButton === panel));
    }
    byId("panel-show").hidden = panel !== "none";
    byId("point").hidden = panel !== "point" || !chosen;
    byId("hint").hidden = panel !== "point" || chosen;
    byId("line").hidden = panel !== "line";
  };
  for (const button of document.querySelectorAll("[data-panel-button]")) {
    button.addEventListener("click", () => store.set({ panel: button.dataset.panelButton }));
  }
  byId("panel-show").addEventListener("click", () => store.set({ panel: "point" }));
  store.on(["panel", "point"], show);
  show();
}

function toolbar() {
  byId("zoom-in").addEventListener("click", () => glide(plane.view, 1));
  byId("zoom-out").addEventListener("click", () => glide(plane.view, -1));
  byId("whole").addEventListener("click", () => store.set({ view: null }));
}

/** The line below the plane: the motion at the pointer, the progress of the tiles, the numeric limit of the zoom. */
function readout() {
  const said = byId("readout");
  const spoken = debounced((text) => say(text), 400);
  const { view } = plane;
  let last = null;
  const tell = () => {
    if (!last) {
      said.replaceChildren("Point at the plane.");
      return;
    }
    const { place, motions, colour } = plane.tell(last);
    const placed = document.createElement("span");
    placed.className = "place";
    placed.textContent = place;
    said.replaceChildren(placed, colour ? swatch(colour) : "", motions);
  };
  view.addEventListener("hover", ({ detail: px }) => {
    const { width, height } = view.viewport;
    last = px && px[0] >= 0 && px[1] >= 0 && px[0] <= width && px[1] <= height ? px : null;
    tell();
  });
  view.addEventListener("crosshair", ({ detail: px }) => {
    const { place, motions } = plane.tell(px);
    spoken(`${place}: ${motions}`);
  });
  view.addEventListener("tiles", () => {
    const [known, all] = view.progress ?? [0, 0];
    byId("progress").textContent = known < all ? `${known} of ${all} tiles` : "";
    byId("plane").toggleAttribute("data-complete", known >= all);
    if (last) tell();
  });
  view.addEventListener("limit", ({ detail: met }) => {
    byId("limit").hidden = !met;
  });
  legend.soon();
}
