/** The first row that holds for m/n names its group: m from and to, n from and to, whether m = n is asked. Written by crates/vibroimpact-report/tests/tables.rs; do not edit. */
export const GROUP_RULES = [
  [[0, 0], [1, Infinity], false, "0"],
  [[1, 1], [1, 1], false, "1/1"],
  [[2, 2], [1, 1], false, "2/1"],
  [[3, 3], [1, 1], false, "3/1"],
  [[4, 4], [1, 1], false, "4/1"],
  [[5, Infinity], [1, 1], false, "m/1"],
  [[1, 1], [2, 2], false, "1/2"],
  [[1, 1], [3, 3], false, "1/3"],
  [[1, 1], [4, Infinity], false, "1/n"],
  [[2, Infinity], [2, Infinity], true, "k/k"],
  [[3, 3], [2, 2], false, "3/2"],
  [[2, Infinity], [2, Infinity], false, "m/n"],
];

/** Further colours of groups: m/n has number (m + 2n) mod 5, where 0 is the colour of the group and infinitely many impacts count as 0. */
export const SHADES = {
  "m/1": ["#bbacff", "#738dfb", "#5e4674", "#1c5ac0"],
  "1/n": ["#bf5c40", "#ab544e", "#b5531d", "#650b00"],
  "k/k": ["#bbca86", "#8ea035", "#bfcd55", "#ada95c"],
  "m/n": ["#54f1d8", "#789c5d", "#4df7b5", "#59b281"],
  "inf/n": ["#de75d3", "#9e668e", "#62394d", "#8a576b"],
};
