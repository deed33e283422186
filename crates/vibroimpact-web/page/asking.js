/** Requests for tiles and coarse pictures: the positions of their points, restricted to legal values. */

import { tile as ask } from "./api.js";
import { over } from "./plans.js";
import { SIDE, Tile, wrapped } from "./tiles.js";

/** Largest and smallest number of points of the coarse picture, and minimum distance between them in pixels. */
const COARSE_POINTS = [800, 9000];
const COARSE_PIXELS = 8;
/** Time in which a coarse picture should be there, in milliseconds, so that it follows a slider. */
const COARSE_TIME = 65;

/** The cells with legal centres, among `count` cells that begin at `first` and have the size `h`. */
function cut(first, h, count, [least, most], open) {
  const centre = (k) => (first + k + 0.5) * h;
  let [begin, end] = [0, count];
  while (begin < end && (open ? centre(begin) <= least : centre(begin) < least)) begin++;
  while (end > begin && centre(end - 1) > most) end--;
  return { first: first + begin, count: end - begin, values: over(centre(begin), centre(end - 1), end - begin) };
}

/**
 * A step of the computation of a place.
 * @typedef {object} Stage
 * @property {string} key of its tiles
 * @property {number} impacts the budget
 * @property {number} [refine] distance of the points that are computed first, if those between are computed only where these differ
 * @property {boolean} [whole] whether it computes points that an earlier stage with the same budget did not
 */

/**
 * Requests the tile of a level with the given column and row.
 * @param {import("./tileview.js").TileView} view
 * @param {string} key
 * @param {Stage} stage
 * @param {number} level
 * @param {[number, number]} at
 * @param {AbortSignal} signal
 */
export function askTile(view, key, stage, level, [column, row], signal) {
  const { source, viewport: v } = view;
  const shape = v.shapeOf(level);
  const [hx, hy] = [v.stepX * 2 ** -level, v.stepY * 2 ** -(level + shape)];
  const across = cut(column * SIDE, hx, SIDE, source.legal.x, source.x.open);
  const up = cut(row * SIDE, hy, SIDE, source.legal.y, source.y.open);
  return { key, stage, tile: filled({ source, stage, key, level, shape, hx, hy, across, up }, stage.refine, signal) };
}

/** Number of points of the next coarse picture: fewer if the last one took long. */
let coarsePoints = COARSE_POINTS[1];

/** Requests the coarse picture: a few points over the whole view. Parameters as for `askTile`. */
export function askCoarse(view, key, stage, signal) {
  const { source, viewport: v } = view;
  const pixels = Math.max(COARSE_PIXELS, Math.sqrt((v.width * v.height) / coarsePoints));
  const [hx, hy] = [v.hx * pixels, v.hy * pixels];
  const [left, bottom] = v.toPlane(0, v.height);
  const across = cut(Math.floor(left / hx), hx, Math.ceil(v.width / pixels) + 1, source.legal.x, source.x.open);
  const up = cut(Math.floor(bottom / hy), hy, Math.ceil(v.height / pixels) + 1, source.legal.y, source.y.open);
  const begin = performance.now();
  const tile = filled({ source, stage, key, level: -Infinity, hx, hy, across, up }, undefined, signal);
  tile.then(({ columns, rows }) => {
    const [least, most] = COARSE_POINTS;
    const fitting = (columns * rows * COARSE_TIME) / Math.max(1, performance.now() - begin);
    // half of the way, because a busy machine is slow for a moment
    coarsePoints = Math.min(most, Math.max(least, (coarsePoints + fitting) / 2));
  }, () => {});
  return { key, stage, tile };
}

async function filled({ source, stage, key, level, shape, hx, hy, across, up }, refine, signal) {
  const tile = new Tile({
    source: stage.key, look: source.look, impacts: stage.impacts, key, level, shape, hx, hy, x0: across.first * hx, y0: up.first * hy,
    columns: across.count, rows: up.count, phase: wrapped(across.first + up.first), slant: wrapped(across.first - up.first),
  });
  if (tile.columns > 0 && tile.rows > 0) {
    const plan = source.plan(across.values, up.values, refine);
    for (const task of Object.values(plan.task)) task.impacts = stage.impacts;
    tile.fill(source.read(await ask(plan, signal)));
  }
  return tile;
}
