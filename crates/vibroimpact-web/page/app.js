/** Creates the parts of the page and connects them. */

import { about } from "./api.js";
import { BoxZoom } from "./box.js";
import { Cache } from "./cache.js";
import { quantitiesKnown } from "./colourchoice.js";
import { learn } from "./colours.js";
import { controls } from "./controls.js";
import { byId } from "./dom.js";
import { Export } from "./export.js";
import { glide } from "./gestures.js";
import { keys } from "./keys.js";
import { Layers } from "./layers.js";
import { Legend } from "./legend.js";
import { LineTool } from "./line.js";
import { links } from "./links.js";
import { mapStarts } from "./mapstarts.js";
import { Messages } from "./messages.js";
import { panels as enlarging } from "./panel.js";
import { Plane } from "./plane.js";
import { Point } from "./point.js";
import { preview } from "./preview.js";
import { Queue } from "./queue.js";
import { ranges } from "./ranges.js";
import { Readout } from "./readout.js";
import { sharpening } from "./sharpening.js";
import { sketches } from "./sketch.js";
import { Store } from "./state.js";
import { subject } from "./subject.js";
import { theme } from "./theme.js";
import { tour } from "./tour.js";
import { units } from "./units.js";
import { learnValues, quantities } from "./values.js";

const store = new Store(location, history);
const queue = new Queue(3);
const messages = new Messages(() => {
  queue.pause(false);
  plane.view.retry();
  point.basin.view.retry();
  point.retry();
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
const legend = new Legend(byId("legend"), plane.view, store, true);
const exporting = new Export(store, { plane, basin: () => point.basin });
const exported = (view) => exporting.open(view);
const point = new Point(store, plane, parts, say, exported);
const line = new LineTool(store, plane, { failed, say, exported });
const layers = new Layers(plane, store, failed);
const box = new BoxZoom(store, plane, say);
const readout = new Readout(store, plane, say);
keys({ line, box, plane, readout });
mapStarts(store);
ranges(store, plane);
links(store, plane, (text) => messages.put(text));
store.complain = (refused) => messages.put(refused.join("\n"));
if (store.refused.length) store.complain(store.refused);
sharpening(queue, () => [plane.view, point.basin.view], () => messages.gone);
sketches(store);
preview(plane, store);
enlarging();
units(store, failed, () => {
  plane.refresh(new Set());
  point.retry();
  line.refresh();
});
theme(byId("theme-button"), store, () => {
  for (const view of [plane.view, point.basin.view]) {
    view.frame.measure();
    view.draw();
  }
});
panels();
tour(store, say);
// with larger type the frames of the views have other margins
subject(store, () => dispatchEvent(new Event("resize")));
toolbar();
line.refresh();
greet().finally(() => point.refresh(null));

/** Gets the points of the paper and the colours of motions from the server. */
async function greet() {
  try {
    const told = await about();
    const { points, version, groups } = told;
    learn(groups ?? []);
    learnValues(told);
    quantitiesKnown();
    plane.refresh(new Set());
    const { colour } = store.state;
    if (colour && !quantities().some(({ name }) => name === colour)) {
      messages.put(`There is no quantity ${colour}. The colours are those of motions.`);
      store.set({ colour: null }, "replace");
    }
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
  store.show(["panel", "point"], show);
}

function toolbar() {
  byId("zoom-in").addEventListener("click", () => glide(plane.view, 1));
  byId("zoom-out").addEventListener("click", () => glide(plane.view, -1));
  byId("whole").addEventListener("click", () => store.set({ view: null }));
  plane.view.addEventListener("limit", ({ detail: met }) => {
    byId("limit").hidden = !met;
  });
}
