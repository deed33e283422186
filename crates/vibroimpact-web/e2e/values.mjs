/** Tests of quantities as colours. */

import assert from "node:assert/strict";
import { answer, drawn, enter, hash, pixel, place, sharp, tasks, until } from "./page.mjs";

/** A view without undecided points. */
const VIEW = [0.9, 1.4, 0.4, 1.4];
const HASH = `#impacts=200&view=${VIEW}`;
const QUANTITY = "impact_speed_max";

const range = async (page) => (await page.locator("#legend .bar-colours").getAttribute("data-range"))?.split(",").map(Number);

/** The colour of a value, from the colours that the server tells. */
async function colourOf(address, value, [low, high]) {
  const { colours } = await (await fetch(`${address}api/about`)).json();
  const step = Math.min(colours.length - 1, Math.floor(Math.min(1, Math.max(0, (value - low) / (high - low))) * colours.length));
  return [1, 3, 5].map((at) => parseInt(colours[step].slice(at, at + 2), 16));
}

const near = (a, b, most = 14) => a.every((part, k) => Math.abs(part - b[k]) <= most);

/** The value at a point of the map, with the full budget. */
const valueAt = async (address, x, y, name = QUANTITY) => (await answer(address, { settle: { start: {} } },
  { inverse_beta: x, gap: y, restitution: 0.5 })).motion.quantities[name];

export async function the_map_shows_a_quantity_as_colours({ open, address }) {
  const { page } = await open(HASH, { viewport: { width: 800, height: 600 } });
  await drawn(page);
  await page.locator("#colour").selectOption(QUANTITY);
  await until("the values are there", async () => (await range(page)) !== undefined);
  await sharp(page);
  assert.equal((await hash(page)).get("colour"), QUANTITY);
  assert.match(await page.locator("#legend .bar-name").textContent(), /^largest impact speed$/);
  assert.ok((await page.locator("#legend .bar-ticks span").count()) >= 3);
  const points = [[1, 0.8], [1.2, 0.6], [1.35, 1.3], [0.95, 1.2]];
  for (const [x, y] of points) {
    const wanted = await colourOf(address, await valueAt(address, x, y), await range(page));
    const at = await place(page, x, y, VIEW);
    await until(`the colour at ${x}, ${y} is ${wanted}, not ${await pixel(page, at)}`, async () => near(await pixel(page, at), wanted));
  }
  // the readout has the value
  await page.mouse.move(...await place(page, 1, 0.8, VIEW));
  await until("the value at the pointer", async () => /largest impact speed \d\.\d+/.test(await page.locator("#readout").textContent()));
  // a small pan does not change the colours
  const before = await range(page);
  await page.locator("#plane canvas").last().focus();
  await page.keyboard.press("ArrowRight");
  await until("the view has moved", async () => (await hash(page)).get("view") !== VIEW.join());
  await sharp(page);
  assert.deepEqual(await range(page), before);
  await page.goBack();
  await until("the first view again", async () => (await hash(page)).get("view") === VIEW.join());
  // a typed range is in the address, and undone
  const high = await valueAt(address, 1, 0.8);
  await enter(page.locator("#colour-high"), String(high));
  await until("the typed range", async () => (await range(page))[1] === high);
  assert.equal(Number((await hash(page)).get("range").split(",")[1]), high);
  const last = await colourOf(address, high, await range(page));
  await until("the colour of the end", async () => near(await pixel(page, await place(page, 1, 0.8, VIEW)), last, 20));
  await page.reload();
  await until("the link keeps it", async () => (await range(page))?.[1] === high);
  await page.locator("#colour-auto").click();
  await until("fitted to the view", async () => (await range(page))[1] > high && !(await hash(page)).has("range"));
  await page.goBack();
  await until("undone", async () => (await range(page))[1] === high);
  await page.locator("#colour").selectOption("");
  await until("motions again", async () => (await page.locator("#legend button.legend-item:visible").count()) > 0);
  assert.ok(await page.locator("#legend .colour-bar").isHidden());
}

/** What has no value keeps a look of its own, and of several motions one is chosen. */
export async function points_without_a_value_are_named({ open }) {
  const { page } = await open("#impacts=200&view=1,1.3,2.5,4&colour=impact_speed_max&starts=2");
  const others = () => page.locator("#legend .colour-bar .legend-other").textContent();
  await until("undecided points", async () => /undecided/.test(await others()));
  await page.locator("#colour-of").selectOption("smallest");
  await until("the other choice is in the address", async () => (await hash(page)).get("of") === "smallest");
  await page.locator("#layers label", { hasText: "stripes" }).waitFor();
  assert.match(await page.locator("#layers label", { hasText: "stripes" }).textContent(), /shows motions/);
}

export async function basins_show_a_quantity_too({ open }) {
  const { page } = await open("#impacts=200&point=1&inverse_beta=1.3&gap=0.75&colour=impact_speed_max");
  const bar = page.locator("[data-name=basin] .bar-colours");
  await until("the colours of the basins", async () => (await bar.getAttribute("data-range")) !== null);
  const { page: other, complaints } = await open("#impacts=200&point=1&inverse_beta=1.3&gap=0.75&colour=nonsense");
  await until("an unknown quantity is refused", async () => /no quantity/.test(await other.locator("#strip").textContent()));
  await until("motions have the colours", async () => !(await hash(other)).has("colour"));
  // the first tiles were refused
  complaints.length = 0;
}

/** After the first picture of the basins every point is computed, so that no thin arm is missing. */
export async function the_last_picture_of_the_basins_computes_every_point({ open, address }) {
  const { page } = await open("about:blank");
  const tiles = tasks(page, "/api/tile", "basin");
  await page.goto(`${address}#impacts=200&point=1&inverse_beta=1.3&gap=0.75`);
  const key = ({ axes }) => JSON.stringify(axes);
  const sides = ({ axes }) => Math.min(...axes.map(({ over }) => Number(String(over).split(":")[2] ?? 1)));
  const fine = () => tiles.filter((tile) => sides(tile) > 60);
  await until("every tile is computed without refinement after the first picture", async () => {
    const [first, last] = [fine().filter((tile) => tile.refine === 2), fine().filter((tile) => tile.refine === undefined)];
    return first.length > 0 && first.every((tile) => last.some((other) => key(other) === key(tile)));
  });
  const sources = () => page.locator("#basin").getAttribute("data-picture");
  await until("the last tile that is drawn has every point", async () => /\|200\|1\|/.test(await sources()));
}
