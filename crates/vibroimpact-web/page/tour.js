/** The card of the tour: title and text of a step, and the buttons that go to others. */

import { byId, element } from "./dom.js";
import { DEFAULTS } from "./state.js";
import { GROUPS, STEPS } from "./steps.js";

/** @param {import("./state.js").Store} store @param {(text: string) => void} say */
export function tour(store, say) {
  const card = byId("tour");
  const title = element("h2", { id: "tour-title", tabindex: "-1" });
  const text = element("div", { class: "tour-text" });
  const count = element("span", { class: "soft" });
  const to = (by) => () => go(store, store.state.tour + by);
  const back = element("button", { type: "button", text: "Previous", onclick: to(-1) });
  const next = element("button", { type: "button", class: "main", text: "Next", onclick: to(1) });
  const list = element("select", { id: "tour-step", "aria-label": "Step of the tour", onchange: () => go(store, Number(list.value)) },
    ...GROUPS.map((label, group) => element("optgroup", { label },
      ...STEPS.map((step, k) => (step.group === group ? element("option", { value: k + 1, text: step.name }) : null)))));
  card.append(
    // the buttons come first: so they stay where they are when the text is longer or shorter
    element("header", { class: "buttons" }, back, next, list, count,
      element("button", { type: "button", class: "quiet", text: "Close", "aria-label": "Close the tour", onclick: () => go(store, 0) })),
    title, text,
  );
  byId("tour-button").addEventListener("click", () => go(store, store.state.tour || 1));
  addEventListener("keydown", (event) => {
    const by = { PageDown: 1, PageUp: -1 }[event.key];
    if (!by || !store.state.tour || event.ctrlKey || event.altKey || event.metaKey || document.querySelector("dialog[open]")) return;
    event.preventDefault();
    go(store, store.state.tour + by);
  });
  let shown = 0;
  const show = () => {
    const step = Math.min(store.state.tour, STEPS.length);
    card.hidden = step === 0;
    document.body.toggleAttribute("data-tour", step > 0);
    if (!step) {
      shown = 0;
      return;
    }
    const { title: heading, text: sentences } = STEPS[step - 1];
    title.textContent = heading;
    text.replaceChildren(...sentences.map((sentence) => element("p", { text: sentence })));
    count.textContent = `${step} of ${STEPS.length}`;
    list.value = String(step);
    back.disabled = step === 1;
    next.disabled = step === STEPS.length;
    if (shown !== step) {
      title.focus({ preventScroll: true });
      // the card is at the top of its column; where the column is the page, the page is scrolled to it
      byId("panel").scrollTop = 0;
      card.scrollIntoView({ block: matchMedia("(max-width: 719px)").matches ? "start" : "nearest" });
      say(heading);
    }
    shown = step;
  };
  store.show(["tour"], show);
}

/** Goes to a step, 0 to leave. */
function go(store, step) {
  if (step < 0 || step > STEPS.length) return;
  if (step === 0) {
    store.set({ tour: 0 });
    return;
  }
  const { starts, impacts } = DEFAULTS;
  store.set({ starts, impacts, ...structuredClone(STEPS[step - 1].state), tour: step });
}
