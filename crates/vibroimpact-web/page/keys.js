/** The keys of the page, and the dialog that lists them. */

import { byId, element } from "./dom.js";

const KEYS = [
  ["In the map and in the basins", [
    ["drag, arrow keys", "move (Shift with an arrow: in small steps)"],
    ["wheel, pinch, double click, + −", "zoom"],
    ["the same over the numbers of an axis, x, y", "zoom along that axis alone (Shift with x or y: out)"],
    ["click, Enter", "choose the point, or put the start, at the pointer or the cross"],
    ["0, Home", "show all"],
  ]],
  ["Anywhere", [
    ["p", "to the map"],
    ["l", "line tool"],
    ["b", "box: zoom to a rectangle (also: drag with Shift)"],
    ["c", "copy the coordinates at the pointer or the cross, or of the chosen point"],
    ["u", "undo (Shift: redo)"],
    ["t", "tour of the 1971 paper and beyond"],
    ["[ and ], Page Up and Page Down", "previous and next step of the tour"],
    ["m, n", "play the motion; to its next impact"],
    ["f", "presentation: large type, the map and one panel"],
    ["s", "symbols"],
    ["e", "export"],
    ["d", "light or dark"],
    ["?", "these keys"],
    ["Esc", "leave the line tool, an enlarged panel, the presentation; close a dialog"],
  ]],
];

/** Controls in which letters are typed. Sliders and boxes are none. */
const TYPING = "select, textarea, input:not([type=range], [type=checkbox])";

/**
 * @param {{line: import("./line.js").LineTool, box: import("./box.js").BoxZoom, plane: import("./plane.js").Plane, readout: import("./readout.js").Readout}} parts
 */
export function keys({ line, box, plane, readout }) {
  const dialog = byId("keys");
  for (const [title, rows] of KEYS) {
    byId("keys-body").append(element("h3", { text: title }), element("dl", { class: "keys" },
      ...rows.flatMap(([key, does]) => [element("dt", { text: key }), element("dd", { text: does })])));
  }
  byId("keys-button").addEventListener("click", () => dialog.showModal());
  const press = (id) => () => byId(id).click();
  const acts = {
    "?": () => dialog.showModal(),
    p: () => plane.view.surface.focus(),
    l: () => {
      line.use(!line.active);
      plane.view.surface.focus();
    },
    b: () => box.use(!box.active),
    c: () => readout.copy(),
    u: press("undo"),
    U: press("redo"),
    t: press("tour-button"),
    e: press("export-button"),
    d: press("theme-button"),
    "[": () => document.querySelector("#tour .buttons button:nth-child(1)").click(),
    "]": () => document.querySelector("#tour .buttons button:nth-child(2)").click(),
    m: () => document.querySelector(".player .play").click(),
    n: () => document.querySelector(".player .play + button").click(),
    f: press("present-button"),
    s: press("symbols-button"),
    Escape: () => {
      if (document.body.hasAttribute("data-present") && !line.active) press("present-button")();
      else line.use(false);
    },
  };
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    if (event.target.closest(TYPING) && event.key !== "Escape") return;
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  for (const open of document.querySelectorAll("dialog")) {
    open.addEventListener("click", (event) => {
      if (event.target === open || event.target.closest("[data-close]")) open.close();
    });
  }
}
