/** Light or dark: the setting of the system until the user chooses. */

const SYSTEM = matchMedia("(prefers-color-scheme: dark)");

/**
 * @param {HTMLElement} button
 * @param {import("./state.js").Store} store
 * @param {() => void} changed
 */
export function theme(button, store, changed) {
  const isDark = () => (store.state.theme ?? (SYSTEM.matches ? "dark" : "light")) === "dark";
  const apply = () => {
    document.documentElement.dataset.theme = isDark() ? "dark" : "light";
    button.setAttribute("aria-pressed", String(isDark()));
    changed();
  };
  button.addEventListener("click", () => {
    const wanted = isDark() ? "light" : "dark";
    const asSystem = (wanted === "dark") === SYSTEM.matches;
    store.set({ theme: asSystem ? null : wanted }, "replace");
  });
  SYSTEM.addEventListener("change", apply);
  store.show(["theme"], apply);
}
