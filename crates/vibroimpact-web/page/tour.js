/** The tour of the 1971 paper: its figures 4 to 11, each as a few sentences and a state of the page. */

import { byId, element } from "./dom.js";
import { DEFAULTS } from "./state.js";

/** The state common to all figures. */
const PAPER = {
  x: "inverse_beta", y: "gap", view: null, beta: null, restitution: 0.5, damping: 0, second: false,
  start: null, basin: null, line: null, layers: ["paper", "stripes"], panel: "point", point: true,
};

/** Windows of the paper's figures 7 to 9, with the gap as their right edge. */
const starts = (gap) => [-8, gap + 0.4, -8, 8];

/** @type {{title: string, text: string[], state: Partial<import("./state.js").State>}[]} */
export const STEPS = [
  {
    title: "Figure 4. Which motions there are",
    text: [
      "The plane of the paper: 1/β to the right, the gap δ upwards, restitution 0.5, no damping. Each colour is a motion m/n, m impacts in n forcing periods; the orders 1/1, 2/1, 3/1 follow one another towards smaller gaps.",
      "Black lines bound the regions in which the simple motions are stable. Dashed: |f|, the amplitude that the mass would have without a stop. Below it every start ends in impacts; above it that depends on the start.",
    ],
    state: { ...PAPER, point: false, layers: ["paper", "stripes", "regions", "amplitude"], starts: 2, impacts: 1000 },
  },
  {
    title: "Figure 5. A motion of order four, at N",
    text: [
      "Four impacts in every forcing period. The flights between them are far from equal: each rebound is lower and shorter than the one before, until the force takes the mass away from the stop again.",
    ],
    state: { ...PAPER, inverse_beta: 1.8, gap: 0.25, view: [1.45, 2.05, 0, 1] },
  },
  {
    title: "Figure 6. Starts at P",
    text: [
      "Two steady motions share the starts: 1/1, and the motion without impacts. Only starts close to the free motion stay clear of the stop, in a small area round the centre of the plane of starts.",
    ],
    state: { ...PAPER, inverse_beta: 0.6, gap: 0.75, basin: [-2, 0.85, -2, 2] },
  },
  {
    title: "Figure 7. Starts at Q",
    text: [
      "The same pair of motions with a larger gap. The area from which impacts cease is much wider and holds the origin: a mass at rest stays free of the stop. Around it the two basins wind into one another.",
    ],
    state: { ...PAPER, inverse_beta: 0.7, gap: 2.5, basin: starts(2.5) },
  },
  {
    title: "Figure 8. Starts at R",
    text: [
      "Here the motion with impacts is of order two, 2/1. Again it depends on the start whether the impacts last, and the mass at rest is not among the starts that lead to 2/1.",
    ],
    state: { ...PAPER, inverse_beta: 1.7, gap: 2.25, basin: starts(2.25) },
  },
  {
    title: "Figure 9. Starts at S",
    text: [
      "Two motions with impacts, 1/1 and 2/1, are stable at one and the same point. No start ends without impacts; which of the two motions arises, the start alone decides. Drag the dot from one colour into the other.",
    ],
    state: { ...PAPER, inverse_beta: 1.3, gap: 0.75, basin: starts(0.75) },
  },
  {
    title: "Figure 10. From an unstable motion to a stable one, at T",
    text: [
      "At T the motion 1/1 exists but is unstable, and 1/2 is stable. This start lies close to 1/1, a few per cent off: for a while the impacts look like 1/1, then the error, which grows by a factor of 1.16 from one to the next and changes its sign, takes the motion over to 1/2.",
    ],
    state: { ...PAPER, inverse_beta: 1.11, gap: 2, start: [2, -0.82, 1.54], view: [0.8, 1.6, 1, 3.6], basin: starts(2) },
  },
  {
    title: "Figure 11. Impacts that never settle, at U",
    text: [
      "The gap is below |f|, so the impacts never cease, yet no steady motion is reached: neighbouring motions part exponentially, as the positive Lyapunov exponent says. The paper counted such a motion as unstable after a hundred impacts. Pieces that look like 1/1 and like 1/2 come and go.",
    ],
    state: { ...PAPER, inverse_beta: 1.11, gap: 3, view: [0.8, 1.6, 1, 3.6], basin: starts(3), impacts: 1000 },
  },
];

/** @param {import("./state.js").Store} store @param {(text: string) => void} say */
export function tour(store, say) {
  const card = byId("tour");
  const title = element("h2", { id: "tour-title", tabindex: "-1" });
  const text = element("div", { class: "tour-text" });
  const count = element("span", { class: "soft" });
  const to = (step) => () => go(store, step);
  const back = element("button", { type: "button", text: "Previous", onclick: () => go(store, store.state.tour - 1) });
  const next = element("button", { type: "button", class: "main", text: "Next", onclick: () => go(store, store.state.tour + 1) });
  card.append(
    element("header", { class: "head" }, element("p", { class: "soft", text: "Fukaya and Irie, 1971" }), count),
    title, text,
    element("footer", { class: "buttons" }, back, next, element("button", { type: "button", class: "quiet", text: "Close", onclick: to(0) })),
  );
  byId("tour-button").addEventListener("click", () => go(store, store.state.tour || 1));
  let shown = 0;
  const show = () => {
    const step = Math.min(store.state.tour, STEPS.length);
    card.hidden = step === 0;
    if (!step) {
      shown = 0;
      return;
    }
    const { title: heading, text: sentences } = STEPS[step - 1];
    title.textContent = heading;
    text.replaceChildren(...sentences.map((sentence) => element("p", { text: sentence })));
    count.textContent = `${step} of ${STEPS.length}`;
    back.disabled = step === 1;
    next.disabled = step === STEPS.length;
    if (shown !== step) {
      title.focus({ preventScroll: false });
      say(heading);
    }
    shown = step;
  };
  store.on(["tour"], show);
  show();
}

/** Goes to a step, 0 to leave. */
function go(store, step) {
  if (step < 0 || step > STEPS.length) return;
  if (step === 0) {
    store.set({ tour: 0 });
    return;
  }
  const { starts: few, impacts } = DEFAULTS;
  store.set({ starts: few, impacts, ...structuredClone(STEPS[step - 1].state), tour: step });
}
