/**
 * An element with attributes and children. `on...` are listeners; `class` and `text` set the class and the text.
 * @param {string} name
 * @param {Record<string, any>} [attributes]
 * @param {...(Node | string | null | undefined)} children
 * @returns {HTMLElement}
 */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (key === "text") made.textContent = value;
    else made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** @param {string} id @returns {HTMLElement} */
export const byId = (id) => document.getElementById(id);

/** @param {string} colour @returns {HTMLElement} a small area of this colour */
export function swatch(colour) {
  const patch = element("span", { class: "swatch", "aria-hidden": "true" });
  patch.style.backgroundColor = colour;
  return patch;
}

/** Calls `work` when there was no call for `delay` milliseconds. */
export function debounced(work, delay) {
  let timer = 0;
  return (...given) => {
    clearTimeout(timer);
    timer = setTimeout(() => work(...given), delay);
  };
}
