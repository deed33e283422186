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

/**
 * An SVG element with attributes and children; `text` sets the text.
 * @param {string} name
 * @param {Record<string, any>} [attributes]
 * @param {...(Node | null)} children
 * @returns {SVGElement}
 */
export function drawn(name, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "text") made.textContent = value;
    else if (value !== null && value !== undefined) made.setAttribute(key, value);
  }
  made.append(...children.filter((child) => child));
  return made;
}

/** A select. @param {Iterable<[any, string]>} options values with their texts */
export const choice = (attributes, options) =>
  element("select", attributes, ...Array.from(options, ([value, text]) => element("option", { value, text })));

/**
 * Draws lines on a canvas, several times one over the other.
 * @param {CanvasRenderingContext2D} context
 * @param {[number, string][]} strokes widths and colours, the broadest first
 * @param {(width: number) => void} trace makes their path
 */
export function strokes(context, strokes, trace) {
  for (const [width, colour] of strokes) {
    context.lineWidth = width;
    context.strokeStyle = colour;
    context.beginPath();
    trace(width);
    context.stroke();
  }
}

/** @param {string} id @returns {HTMLElement} */
export const byId = (id) => document.getElementById(id);

/**
 * A small area in the colours of a motion, or of the motions of a group.
 * @param {string | string[]} colour
 * @param {string} [pattern] `undecided`, `impossible` or `blank`
 * @returns {HTMLElement}
 */
export function swatch(colour, pattern = "") {
  const patch = element("span", { class: "swatch", "aria-hidden": "true" });
  paint(patch, colour, pattern);
  return patch;
}

/** Paints a swatch again. Parameters as for `swatch`. */
export function paint(patch, colour, pattern = "") {
  patch.className = `swatch ${pattern}`.trim();
  const colours = [colour].flat().slice(0, 4);
  patch.style.backgroundColor = colours[0] ?? "";
  if (!pattern) {
    const stops = colours.map((one, k) => `${one} ${(100 * k) / colours.length}% ${(100 * (k + 1)) / colours.length}%`);
    patch.style.backgroundImage = colours.length > 1 ? `linear-gradient(90deg, ${stops.join(", ")})` : "";
  }
}

/** Calls `work` when there was no call for `delay` milliseconds. */
export function debounced(work, delay) {
  let timer = 0;
  return (...given) => {
    clearTimeout(timer);
    timer = setTimeout(() => work(...given), delay);
  };
}

/** Calls `work` at once, and then at most every `delay` milliseconds with the newest arguments. */
export function throttled(work, delay) {
  let waiting = null;
  let timer = 0;
  const next = () => {
    timer = 0;
    if (!waiting) return;
    work(...waiting);
    waiting = null;
    timer = setTimeout(next, delay);
  };
  return (...given) => {
    waiting = given;
    if (!timer) next();
  };
}
