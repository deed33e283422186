/** Text fields for numbers. A decimal comma is read as a decimal point; what is no number is refused with a sentence. */

import { element } from "./dom.js";

/**
 * @param {string} text
 * @returns {{value: number, why: ""} | {value: null, why: string}}
 */
export function parsed(text) {
  const plain = text.trim().replace("−", "-");
  if (/^[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?$/i.test(plain)) {
    const value = Number(plain.replace(",", "."));
    if (Number.isFinite(value)) return { value, why: "" };
  }
  return { value: null, why: plain === "" ? "A number is missing." : `"${text.trim()}" is not a number. Write one like 0.05 or 1e-3.` };
}

/**
 * A field for a number.
 * @param {{id?: string, label: string, check: (value: number) => string, set: (value: number) => void}} options check
 *   returns the reason why a value is not possible, or nothing; set receives a possible value
 * @returns {{input: HTMLInputElement, said: HTMLElement, show: (value: number) => void}} said has the reason
 */
export function numberField({ id, label, check, set }) {
  const said = element("p", { class: "why", role: "alert" });
  const input = element("input", { type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", id, "aria-label": label });
  let shown = "";
  const refuse = (why) => {
    input.setAttribute("aria-invalid", String(why !== ""));
    said.textContent = why;
  };
  input.addEventListener("change", () => {
    const { value, why } = parsed(input.value);
    const reason = why || check(value);
    refuse(reason);
    if (!reason) set(value);
  });
  input.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || input.value === shown) return;
    event.stopPropagation();
    input.value = shown;
    refuse("");
  });
  const show = (value) => {
    const text = String(value);
    if (text === shown && document.activeElement === input) return;
    shown = text;
    input.value = text;
    refuse("");
  };
  return { input, said, show };
}
