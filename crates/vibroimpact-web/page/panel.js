/** A panel of the page: a title, its buttons, and a body. It can be enlarged over the whole page; Escape returns. */

import { byId, element } from "./dom.js";

/**
 * @param {string} name of the panel, for the presentation and the tour
 * @param {string} title
 * @param {{exported?: (() => void) | null, zoom?: ((factor: number) => void) | null}} [buttons]
 * @param {...(Node | null)} body
 * @returns {HTMLElement}
 */
export function panel(name, title, { exported = null, zoom = null } = {}, ...body) {
  const id = `panel-${name}`;
  const quiet = (text, label, onclick, kind = "quiet") => element("button", { type: "button", class: kind, text, "aria-label": label, onclick });
  const of = title[0].toLowerCase() + title.slice(1);
  const box = element("section", { class: "panel", "data-name": name, "aria-labelledby": id },
    element("header", { class: "head" },
      element("h3", { id, text: title }),
      element("span", { class: "head-buttons" },
        zoom && quiet("−", `Zoom out of ${of}`, () => zoom(0.5), "zoom"),
        zoom && quiet("+", `Zoom into ${of}`, () => zoom(2), "zoom"),
        quiet("Enlarge", `Enlarge ${of}`, () => (box.closest("dialog") ? reduce() : enlarge(box)), "quiet enlarge"),
        exported && quiet("Export", `Export ${of}`, exported))),
    ...body);
  return box;
}

/** The place of the enlarged panel on the page. */
const place = document.createComment("the enlarged panel");

/** Shows a panel over the whole page. */
function enlarge(box) {
  const dialog = byId("large");
  const button = box.querySelector(".enlarge");
  box.replaceWith(place);
  dialog.replaceChildren(box);
  rename(button, "Enlarge", "Reduce");
  dialog.setAttribute("aria-labelledby", box.getAttribute("aria-labelledby"));
  dialog.showModal();
  button.focus();
}

/** Changes the verb of the button, seen and heard. */
function rename(button, from, to) {
  button.textContent = to;
  button.setAttribute("aria-label", button.getAttribute("aria-label").replace(from, to));
}

/** Returns the enlarged panel to its place. */
export function reduce() {
  const dialog = byId("large");
  if (dialog.open) dialog.close();
}

/** Connects the dialog of enlarged panels. */
export function panels() {
  const dialog = byId("large");
  dialog.addEventListener("close", () => {
    const box = dialog.firstElementChild;
    if (!box) return;
    place.replaceWith(box);
    const button = box.querySelector(".enlarge");
    rename(button, "Reduce", "Enlarge");
    button.focus({ preventScroll: true });
  });
}
