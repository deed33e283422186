/** The steps of the tour: figures 4 to 11 of the 1971 paper, and presets beyond it. Each is a few sentences and a state of the page. */

/** The state common to all steps. */
const COMMON = {
  x: "inverse_beta", y: "gap", view: null, beta: null, restitution: 0.5, damping: 0, second: false, second_gap: 2, second_restitution: 0.5,
  start: null, basin: null, line: null, show: "velocity", layers: ["paper", "stripes"], panel: "point", point: true,
  wave: "start", portrait: "settled", periods: 10, pin: null, subject: "motion",
  // the texts have nondimensional numbers and the colours of motions
  machine: null, colour: null, range: null,
};

/** Windows of the paper's figures 7 to 9, with the gap as their right edge. */
const starts = (gap) => [-8, gap + 0.4, -8, 8];

export const GROUPS = ["Fukaya and Irie, 1971", "Beyond the paper"];

/**
 * The panel of a step that must be on the screen is `subject` of its state; `map` is the map itself.
 * @type {{group: number, name: string, title: string, text: string[], state: Partial<import("./state.js").State>}[]}
 */
export const STEPS = [
  {
    group: 0, name: "Figure 4", title: "Figure 4. The motions and where they are stable",
    text: [
      "1/β to the right, the gap δ upwards, restitution 0.5, no damping. Each colour is a motion m/n: m impacts in n periods of the force.",
      "Black lines bound the regions in which simple motions are stable. Dashed: |f|, the amplitude without a stop. Below it every start ends in impacts; above it that depends on the start.",
    ],
    state: { point: false, layers: ["paper", "stripes", "regions", "amplitude"], starts: 2, subject: "map" },
  },
  {
    group: 0, name: "Figure 5", title: "Figure 5. Four impacts in each period, at N",
    text: ["The motion 4/1. Each rebound is lower and shorter than the one before, until the force takes the mass away from the stop again. Play it, or step from impact to impact."],
    state: { inverse_beta: 1.8, gap: 0.25, view: [1.45, 2.05, 0, 1], wave: "settled", periods: 2 },
  },
  {
    group: 0, name: "Figure 6", title: "Figure 6. Starts at P",
    text: ["Two steady motions: 1/1, and the motion without impacts. Only starts close to the motion without impacts lead to it, in a small area of the plane of starts."],
    state: { inverse_beta: 0.6, gap: 0.75, basin: [-2, 0.85, -2, 2], subject: "basin" },
  },
  {
    group: 0, name: "Figure 7", title: "Figure 7. Starts at Q",
    text: ["The same two motions with a larger gap. The basin of the motion without impacts is much wider and contains the mass at rest. Around it the two basins wind into one another."],
    state: { inverse_beta: 0.7, gap: 2.5, basin: starts(2.5), subject: "basin" },
  },
  {
    group: 0, name: "Figure 8", title: "Figure 8. Starts at R",
    text: ["Here the motion with impacts is 2/1. Whether the impacts last depends on the start. From rest they do not."],
    state: { inverse_beta: 1.7, gap: 2.25, basin: starts(2.25), subject: "basin" },
  },
  {
    group: 0, name: "Figure 9", title: "Figure 9. Starts at S",
    text: ["Two motions with impacts, 1/1 and 2/1, are stable at the same point. Every start leads to one of them. Drag the dot from one colour into the other."],
    state: { inverse_beta: 1.3, gap: 0.75, basin: starts(0.75), subject: "basin" },
  },
  {
    group: 0, name: "Figure 10", title: "Figure 10. From an unstable motion to a stable one, at T",
    text: ["At T the motion 1/1 is unstable and 1/2 is stable. This start is close to 1/1. From one impact to the next the error changes its sign and grows by a factor of 1.16, until after about 25 periods the mass misses the stop in every second period: 1/2."],
    state: { inverse_beta: 1.11, gap: 2, start: [2, -0.82, 1.54], view: [0.8, 1.6, 1, 3.6], basin: starts(2), periods: 30 },
  },
  {
    group: 0, name: "Figure 11", title: "Figure 11. Chaos, at U",
    text: ["The gap is below |f|, so the impacts never end, but no steady motion is reached: neighbouring motions separate exponentially. Pieces that look like 1/1 and 1/2 come and go. The paper found this motion not settled after a hundred impacts."],
    state: { inverse_beta: 1.11, gap: 3, view: [0.8, 1.6, 1, 3.6], basin: starts(3), periods: 50 },
  },
  {
    group: 1, name: "Period doubling", title: "Period doubling on the line 1/β = 1.11",
    text: ["The gap grows from left to right. At δ = 1.829 the motion 1/1 flips to 2/2, which is stable to a fold at 1.90567 and coexists with 1/2 from 1.832 on. 1/2 flips at 2.881, and 2/4 is stable to its grazing event at 2.91617. Beyond that is chaos."],
    state: { inverse_beta: 1.11, gap: 1.87, view: [0.8, 1.6, 1, 3.6], line: [1.11, 1.6, 1.11, 3.1], panel: "line", subject: "line" },
  },
  {
    group: 1, name: "Grazing", title: "A grazing event: 1/1 gains an impact",
    text: ["The gap grows from left to right. At δ = 0.240 the motion 1/1 grazes the stop between its impacts: there it meets an unstable 2/1, and neither exists below. The stable 2/1 lasts up to its fold at δ = 0.314, so between the two both motions are stable."],
    state: { inverse_beta: 1.11, gap: 0.28, view: [0.9, 1.4, -0.2, 0.8], line: [1.11, 0.15, 1.11, 0.4], panel: "line", subject: "line" },
  },
  {
    group: 1, name: "Chatter", title: "Chatter: infinitely many impacts in a finite time",
    text: ["Each flight is shorter than the one before by a factor close to the restitution, so infinitely many impacts end in a finite time. Then the mass sticks to the stop until the force pulls it away. Enlarge the panel and zoom in to see the impacts accumulate."],
    state: { inverse_beta: 1.9, gap: 0.05, view: [1.5, 2.05, -0.2, 0.6], wave: "settled", periods: 2 },
  },
  {
    group: 1, name: "Three motions", title: "Three motions at one point",
    text: ["With little damping and hard impacts 5/3, 2/1 and the motion without impacts are all stable. The start decides. Move the phase of the force to see how the basins turn."],
    state: { inverse_beta: 1.6, gap: 1.9, restitution: 0.9, damping: 0.02, basin: [-6, 2.3, -5, 5], subject: "basin" },
  },
  {
    group: 1, name: "Two stops", title: "Two stops: a symmetric machine with an asymmetric motion",
    text: ["The stops are at equal distances. Still, each steady motion strikes only one of them, and its mirror image strikes the other one. Below 1/β = 1.086 the symmetric motion is stable, which strikes both stops in each period."],
    state: {
      inverse_beta: 1.2, gap: 1.5, second: true, second_gap: 1.5, second_restitution: 0.6, restitution: 0.6, damping: 0.02,
      basin: [-1.6, 1.6, -4, 4], subject: "basin", wave: "settled", periods: 3,
    },
  },
  {
    group: 1, name: "Two frequencies compared", title: "Both sides of the loss of symmetry",
    text: ["The same machine with two stops at 1/β = 1.0, pinned, and at 1/β = 1.2. On the left it strikes both stops, on the right only one of them."],
    state: {
      inverse_beta: 1.2, gap: 1.5, second: true, second_gap: 1.5, second_restitution: 0.6, restitution: 0.6, damping: 0.02,
      wave: "settled", periods: 3, pin: [1, 1.5, 0.6, 0.02, 1.5, 0.6, 1, 0, 0, 0, 0], subject: "compare",
    },
  },
].map((step) => ({ ...step, state: { ...COMMON, ...step.state } }));
