/** Requests for tiles and coarse pictures: the positions of their points, restricted to legal values. */

import { tile as ask } from "./api.js";
import { over } from "./plans.js";
import { SIDE, STRIPE, Tile } from "./tiles.js";

/** Approximate number of points of the coarse picture, and minimum distance between them in pixels. */
const COARSE_POINTS = 9000;
const COARSE_PIXELS = 8;

/** Step of the refinement of a tile: every point with this distance is computed first. */
const REFINE = 8;

/** The cells with legal centres, among `count` cells that begin at `first` and have the size `h`. */
function cut(first, h, count, [least, most], open) {
  const centre = (k) => (first + k + 0.5) * h;
  let [begin, end] = [0, count];
  while (begin < end && (open ? centre(begin) <= least : centre(begin) < least)) begin++;
  while (end > begin && centre(end - 1) > most) end--;
  return { first: first + begin, count: end - begin, values: over(centre(begin), centre(end - 1), end - begin) };
}

/**
 * Requests the tile of a level with the given column and row.
 * @param {import("./tileview.js").TileView} view
 * @param {string} key
 * @param {number} level
 * @param {[number, number]} at
 * @param {AbortSignal} signal
 */
export function askTile(view, key, level, [column, row], signal) {
  const { source, viewport: v } = view;
  const shape = v.shapeOf(level);
  const [hx, hy] = [v.stepX * 2 ** -level, v.stepY * 2 ** -(level + shape)];
  const across = cut(column * SIDE, hx, SIDE, source.legal.x, source.x.open);
  const up = cut(row * SIDE, hy, SIDE, source.legal.y, source.y.open);
  return { key, source, tile: filled({ source, key, level, shape, hx, hy, across, up }, REFINE, signal) };
}

/** Requests the coarse picture: a few points over the whole view. */
export function askCoarse(view, key, signal) {
  const { source, viewport: v } = view;
  const pixels = Math.max(COARSE_PIXELS, Math.sqrt((v.width * v.height) / COARSE_POINTS));
  const [hx, hy] = [v.hx * pixels, v.hy * pixels];
  const [left, bottom] = v.toPlane(0, v.height);
  const across = cut(Math.floor(left / hx), hx, Math.ceil(v.width / pixels) + 1, source.legal.x, source.x.open);
  const up = cut(Math.floor(bottom / hy), hy, Math.ceil(v.height / pixels) + 1, source.legal.y, source.y.open);
  return { key, source, tile: filled({ source, key, level: -Infinity, hx, hy, across, up }, undefined, signal) };
}

async function filled({ source, key, level, shape, hx, hy, across, up }, refine, signal) {
  const place = across.first + up.first;
  const tile = new Tile({
    source: source.key, look: source.look, impacts: source.impacts, key, level, shape, hx, hy, x0: across.first * hx, y0: up.first * hy,
    columns: across.count, rows: up.count, phase: ((place % STRIPE) + STRIPE) % STRIPE,
  });
  if (tile.columns > 0 && tile.rows > 0) {
    tile.fill(source.read(await ask(source.plan(across.values, up.values, refine), signal)));
  }
  return tile;
}
