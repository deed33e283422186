/** Tables of answers that are a few numbers: the impacts of a steady motion, its multipliers, the motions that coexist. */

const csv = (heads, rows) => new Blob([[heads, ...rows].map((row) => row.join(",")).join("\n"), "\n"], { type: "text/csv" });

const multipliers = (motion) => motion.multipliers ?? [];

/** @param {object} answer of a settle plan @returns {Blob} an impact a row */
export const impactsTable = ({ motion }) => csv(
  ["label", "impact", "phase", "velocity_before", "interval", "side"],
  motion.cycle.map((one, k) => [motion.label, k + 1, one.phase, one.velocity_before, one.interval, one.side]),
);

/** @param {object} answer of a settle plan @returns {Blob} a multiplier a row */
export const multipliersTable = ({ motion }) => csv(
  ["label", "real", "imaginary", "modulus"],
  multipliers(motion).map(([re, im]) => [motion.label, re, im, Math.hypot(re, im)]),
);

/** @param {object} answer of an attractors plan @returns {Blob} a motion a row */
export const attractorsTable = ({ motions }) => csv(
  ["label", "share", "starts", "largest_multiplier"],
  motions.map((motion) => [
    motion.label, motion.share, motion.count, multipliers(motion).length ? Math.hypot(...multipliers(motion)[0]) : "",
  ]),
);
