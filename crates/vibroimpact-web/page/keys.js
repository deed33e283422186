/** The keys of the page, and the dialog that lists them. */

import { byId, element } from "./dom.js";

const KEYS = [
  ["In the plane and in the plane of starts", [
    ["drag, arrow keys", "move (Shift with an arrow: in small steps)"],
    ["wheel, pinch, double click, + −", "zoom"],
    ["the same over the numbers of an axis, x, y", "zoom along that axis alone (Shift with x or y: out)"],
    ["click, Enter", "choose the point, or put the start, at the pointer or the cross"],
    ["0, Home", "the whole view"],
  ]],
  ["Anywhere", [
    ["p", "to the plane"],
    ["l", "line tool"],
    ["t", "tour of the 1971 paper"],
    ["[ and ]", "previous and next step of the tour"],
    ["e", "export"],
    ["d", "light or dark"],
    ["?", "these keys"],
    ["Esc", "leave the line tool, close a dialog"],
  ]],
];

/**
 * @param {{line: import("./line.js").LineTool, plane: import("./plane.js").Plane}} parts
 */
export function keys({ line, plane }) {
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
    t: press("tour-button"),
    e: press("export-button"),
    d: press("theme-button"),
    "[": () => document.querySelector("#tour .buttons button:nth-child(1)").click(),
    "]": () => document.querySelector("#tour .buttons button:nth-child(2)").click(),
    Escape: () => line.use(false),
  };
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    if (event.target.closest("input, select, textarea") && event.key !== "Escape") return;
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
