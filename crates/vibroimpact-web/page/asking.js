/** Requests for tiles and coarse pictures: the positions of their points, restricted to legal values. */

import { tile as ask, picture, whole } from "./api.js";
import { over } from "./plans.js";
import { SIDE, Tile, wrapped } from "./tiles.js";

/** Smallest and largest number of points of the coarse picture, and minimum distance between them in pixels. */
const COARSE_POINTS = [100, 9000];
const COARSE_PIXELS = 8;
/**
 * Time in which the server answers with a coarse picture, in milliseconds. When a slider moves, a picture is at most two of
 * these times old, one interval between two values of the slider, and two times that of the way to the screen.
 */
export const COARSE_TIME = 70;
/** The same while nothing moves. The second picture is asked for if the first one has fewer points than `FEW`, because tiles will take long then. */
export const STILL_TIMES = [200, 1000];
export const FEW = 1500;
/**
 * The next coarse picture has this part of the points if not all of them were computed in time, and more of them if all
 * were; many more if half of the time was enough. So few pictures in a row have other cells than the one before.
 */
const [FEWER, MORE, MANY_MORE] = [0.75, 1.03, 1.25];

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
 * @property {boolean} [whole] whether it computes points that an earlier stage did not, which have the motions of their neighbours
 * @property {{within: number, after: string}} [parts] if it computes them a part at a time: the options of these requests
 */

/**
 * The tile of a level with the given column and row. It is a plan of the view as it is now: when it is requested, the view
 * may show something else.
 * @param {import("./tileview.js").TileView} view
 * @param {string} key
 * @param {Stage} stage
 * @param {number} level
 * @param {[number, number]} at
 * @returns {(signal: AbortSignal) => {key: string, stage: Stage, tile: Promise<Tile>}} requests it
 */
export function tileAsked(view, key, stage, level, [column, row]) {
  const { source, viewport: v } = view;
  const shape = v.shapeOf(level);
  const [hx, hy] = [v.stepX * 2 ** -level, v.stepY * 2 ** -(level + shape)];
  const place = () => ({
    across: cut(column * SIDE, hx, SIDE, source.legal.x, source.x.open), up: cut(row * SIDE, hy, SIDE, source.legal.y, source.y.open),
  });
  return (signal) => ({ key, stage, tile: filled({ source, stage, key, level, shape, hx, hy, ...place() }, (plan) => (stage.parts ? whole(plan, stage.parts, signal) : ask(plan, signal))) });
}

/** Number of points of the next coarse picture. */
let coarsePoints = 1600;

/** Requests the coarse picture: a few points over the whole view, as many as the server computes in time. @param {number} time in milliseconds */
export function askCoarse(view, key, stage, time, signal) {
  const { source, viewport: v } = view;
  const pixels = Math.max(COARSE_PIXELS, Math.sqrt((v.width * v.height) / (time > COARSE_TIME ? COARSE_POINTS[1] : coarsePoints)));
  const [hx, hy] = [v.hx * pixels, v.hy * pixels];
  const [left, bottom] = v.toPlane(0, v.height);
  const across = cut(Math.floor(left / hx), hx, Math.ceil(v.width / pixels) + 1, source.legal.x, source.x.open);
  const up = cut(Math.floor(bottom / hy), hy, Math.ceil(v.height / pixels) + 1, source.legal.y, source.y.open);
  const [begin, points] = [performance.now(), across.count * up.count];
  const asked = filled({ source, stage: { ...stage, refine: undefined }, key, level: -Infinity, hx, hy, across, up }, (plan) => picture(plan, time, signal));
  if (time === COARSE_TIME) asked.then(({ columns, rows }) => {
    const factor = columns * rows < points ? FEWER : performance.now() - begin < COARSE_TIME / 2 ? MANY_MORE : MORE;
    const [least, most] = COARSE_POINTS;
    coarsePoints = Math.min(most, Math.max(least, factor * coarsePoints));
  }, () => {});
  return { key, stage, tile: asked };
}

async function filled({ source, stage, key, level, shape, hx, hy, across, up }, ask) {
  const tile = new Tile({
    source: stage.key, look: source.look, impacts: stage.impacts, key, level, shape, hx, hy, x0: across.first * hx, y0: up.first * hy,
    columns: across.count, rows: up.count, phase: wrapped(across.first + up.first), slant: wrapped(across.first - up.first),
  });
  if (tile.columns > 0 && tile.rows > 0) {
    const plan = source.plan(across.values, up.values, stage.refine);
    for (const task of Object.values(plan.task)) task.impacts = stage.impacts;
    const answer = await ask(plan);
    tile.fill(source.read(answer), answer.header.shape);
  }
  return tile;
}
