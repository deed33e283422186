/** The share of a view that each motion has. */

/** Number of sample positions along each axis while tiles of the view are missing. */
const ACROSS = 120;
const UP = 90;

/**
 * @param {import("./tileview.js").TileView} view
 * @returns {{counts: Map<number, number>, coarse: boolean}} numbers of points by motion; `coarse` while tiles are missing
 */
export function shares(view) {
  const level = view.level();
  const counts = new Map();
  if (!view.supply.covered(level)) {
    sample(view, counts);
    return { counts, coarse: true };
  }
  for (const [a, b] of view.places(level)) {
    const { tile } = view.supply.best(level, a, b);
    if (tile.classes) tile.count(counts, ...inView(tile, view.viewport));
  }
  return { counts, coarse: false };
}

/**
 * The smallest and the largest value of the quantity in a view, and the words for values that are no finite number.
 * @param {import("./tileview.js").TileView} view
 * @returns {{low: number, high: number, missing: Set<string>, coarse: boolean}}
 */
export function extremes(view) {
  const level = view.level();
  const found = { low: Infinity, high: -Infinity, missing: new Set(), coarse: !view.supply.covered(level) };
  const tiles = found.coarse ? view.supply.known() : [...view.places(level)].map(([a, b]) => view.supply.best(level, a, b).tile);
  for (const tile of tiles) {
    if (tile.values) tile.extremes(found, ...inView(tile, view.viewport), view.source.quantity.of);
  }
  return found;
}

/** The columns and the rows of a tile that are in view. */
function inView({ x0, y0, hx, hy, columns, rows }, viewport) {
  const { left, right, bottom, top } = ends(viewport);
  const place = (at, begin, h, count) => Math.min(count, Math.max(0, Math.round((at - begin) / h)));
  return [[place(left, x0, hx, columns), place(right, x0, hx, columns)], [place(bottom, y0, hy, rows), place(top, y0, hy, rows)]];
}

function ends(viewport) {
  const [left, top] = viewport.toPlane(0, 0);
  const [right, bottom] = viewport.toPlane(viewport.width, viewport.height);
  return { left, right, bottom, top };
}

/** Samples the best available tiles at these positions. */
function sample(view, counts) {
  const { left, right, bottom, top } = ends(view.viewport);
  const [wide, high] = [(right - left) / ACROSS, (top - bottom) / UP];
  const taken = new Uint8Array(ACROSS * UP);
  const cut = (low, begin, end, h, count) => [
    Math.max(0, Math.ceil((begin - low) / h - 0.5)), Math.min(count, Math.ceil((end - low) / h - 0.5)),
  ];
  for (const tile of view.supply.known().reverse()) {
    const [c0, c1] = cut(left, tile.x0, tile.x0 + tile.columns * tile.hx, wide, ACROSS);
    const [r0, r1] = cut(bottom, tile.y0, tile.y0 + tile.rows * tile.hy, high, UP);
    for (let row = r0; row < r1; row++) {
      for (let column = c0; column < c1; column++) {
        if (taken[row * ACROSS + column]) continue;
        taken[row * ACROSS + column] = 1;
        for (const { id, share } of tile.at(left + (column + 0.5) * wide, bottom + (row + 0.5) * high)) {
          counts.set(id, (counts.get(id) ?? 0) + share);
        }
      }
    }
  }
}
