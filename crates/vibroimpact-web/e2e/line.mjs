/** Tests of the line: its diagram and the map show the same place, and its events are listed. */

import assert from "node:assert/strict";
import { drawn, enter, hash, place, sharp, until } from "./page.mjs";

export async function the_diagram_and_the_map_show_the_same_place({ open, folder }) {
  const { page } = await open("#line=1.11,1,1.11,2.5&panel=line&view=0.9,1.4,0.5,3&impacts=200");
  const image = page.locator("#line .sheet img");
  await image.waitFor({ timeout: 120000 });
  await sharp(page);
  const box = await image.boundingBox();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.4 * box.height);
  const note = page.locator(".linked-note");
  await until("the place is said", async () => /^1\/β 1\.11\d*\s+δ \d\.\d+\s+\S/.test(await note.textContent()));
  assert.ok(await page.locator(".linked-mark").isVisible());
  const gap = Number(/δ (\d\.\d+)/.exec(await note.textContent())[1]);
  assert.ok(gap > 1.4 && gap < 2.1, `the middle of the line: ${gap}`);
  await page.screenshot({ path: `${folder}/linked.png` });
  // the other way
  await page.mouse.move(...await place(page, 1.11, 2.2, [0.9, 1.4, 0.5, 3]));
  await until("the place on the map", async () => Math.abs(Number(/δ (\d\.\d+)/.exec(await note.textContent())?.[1]) - 2.2) < 0.02);
  await page.mouse.move(...await place(page, 1.3, 2.2, [0.9, 1.4, 0.5, 3]));
  await until("no mark far from the line", async () => page.locator(".linked-mark").isHidden());
  // the ends are typed
  await enter(page.locator(".line-ends input").nth(3), "2,2");
  assert.equal((await hash(page)).get("line"), "1.11,1,1.11,2.2");
  await until("the diagram of the shorter line", async () => /to 2\.200/.test(await image.getAttribute("alt")), 60);
  await image.click({ position: { x: 0.5 * box.width, y: 0.4 * box.height } });
  await until("the point is chosen", async () => (await hash(page)).get("point") === "1");
  assert.equal((await hash(page)).get("inverse_beta"), "1.11");
}

/** Where 1/1 doubles its period at 1/β = 1.11. */
export async function events_on_the_line_are_listed_and_chosen({ open }) {
  const { page } = await open("#point=1&inverse_beta=1.11&gap=1.6&view=0.9,1.4,1,2.5&impacts=200&panel=line");
  await drawn(page);
  await page.locator("[data-through=y]").click();
  assert.equal((await hash(page)).get("line"), "1.11,1,1.11,2.5");
  const flip = page.locator(".events button", { hasText: /^1\/1: flip \(period doubling\) at δ = 1\.829/ });
  await flip.waitFor({ timeout: 60000 });
  assert.equal(await flip.count(), 1);
  await flip.click();
  const { gap, point } = Object.fromEntries(await hash(page));
  assert.ok(point === "1" && Math.abs(Number(gap) - 1.829) < 1e-3, gap);
}
